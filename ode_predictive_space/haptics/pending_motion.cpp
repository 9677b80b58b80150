#include "ode_predictive_space/haptics/pending_motion.h"

#include <algorithm>
#include <cmath>

namespace ode_predictive_space::haptics
{
namespace
{
constexpr double fading_of_free = 1;  // 1/s
constexpr double fading_of_held = 50; // 1/s
constexpr std::uint64_t unnumbered = ~std::uint64_t{0};
} // namespace

PendingMotion::PendingMotion(std::size_t most_impulses) : most_impulses_(most_impulses)
{
    given_.reserve(most_impulses + 2 * ContactModel::capacity);
    leads_.reserve(ContactModel::capacity);
    leads_before_.reserve(ContactModel::capacity);
}

void PendingMotion::add(std::uintptr_t object, const Vector3 &point, const Vector3 &impulse, double time,
                        std::uint64_t number)
{
    if (given_.size() < most_impulses_)
    {
        given_.push_back({object, point, impulse, time, number});
    }
}

void PendingMotion::update(const ContactModel &contacts, bool is_new, const std::vector<ForceShare> &held, double since,
                           double now)
{
    const std::size_t known = given_.size();
    for (const ForceShare &share : held)
    {
        given_.push_back({share.object, share.point, (since - now) * share.force, since, unnumbered});
    }
    fade(std::max(0.0, now - last_time_));
    last_time_ = now;
    if (is_new)
    {
        renew(contacts, now);
    }
    shift(contacts, now);
    given_.resize(known);
    if (is_new)
    {
        given_.erase(given_.begin(), std::find_if(given_.begin(), given_.end(), [&](const Given &given) {
                         return given.number > contacts.last_included();
                     }));
    }
}

/// Of the same plane, or else of the same object: it begins where that is.
const PendingMotion::Lead *PendingMotion::lead_before(const Touch &touch) const
{
    const Lead *found = nullptr;
    for (const Lead &lead : leads_before_)
    {
        if (lead.object == touch.object && (found == nullptr || lead.feature == touch.feature))
        {
            found = &lead;
        }
    }
    return found;
}

void PendingMotion::renew(const ContactModel &contacts, double now)
{
    leads_.swap(leads_before_);
    leads_.clear();
    for (std::size_t i = 0; i < contacts.count(); ++i)
    {
        const auto &[touch, mobility] = contacts.surface(i);
        const Lead *last = lead_before(touch);
        Lead lead;
        lead.object = touch.object;
        lead.feature = touch.feature;
        lead.yield = mobility.yield;
        lead.offset = last != nullptr ? last->offset : Vector3::Zero();
        const double yield_before = last != nullptr ? last->yield : mobility.yield;
        for (const Given &given : given_)
        {
            if (given.object != touch.object)
            {
                continue;
            }
            const bool included = given.number <= contacts.last_included();
            const double shown_since = included ? contacts.included_since() : given.time;
            const double missing = yield_before * (now - given.time) - mobility.yield * (now - shown_since);
            lead.offset += missing * mobility.response(given.impulse, given.point, touch.point);
        }
        leads_.push_back(lead);
    }
}

void PendingMotion::fade(double elapsed)
{
    for (Lead &lead : leads_)
    {
        const double rate = lead.yield * fading_of_free + (1 - lead.yield) * fading_of_held;
        lead.offset *= std::exp(-rate * elapsed);
    }
}

void PendingMotion::shift(const ContactModel &contacts, double now)
{
    for (std::size_t i = 0; i < leads_.size(); ++i)
    {
        const auto &[touch, mobility] = contacts.surface(i);
        ContactModel::Shift &shift = shifts_[i];
        shift.moved = leads_[i].offset;
        shift.velocity.setZero();
        for (const Given &given : given_)
        {
            if (given.object == touch.object && given.number > contacts.last_included())
            {
                const Vector3 change = mobility.yield * mobility.response(given.impulse, given.point, touch.point);
                shift.moved += (now - given.time) * change;
                shift.velocity += change;
            }
        }
    }
}
} // namespace ode_predictive_space::haptics
