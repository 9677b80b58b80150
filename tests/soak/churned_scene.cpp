#include "tests/soak/churned_scene.h"

#include "tests/support/overlap.h"

#include <algorithm>
#include <map>
#include <sstream>

namespace ode_predictive_space::soak
{
namespace
{
using namespace worlds;

constexpr std::size_t transients = 16;
constexpr std::uint32_t first_transient = 1u << 31; // numbers of transients; those of the scene are below
constexpr int ticks_between_changes = 5;
constexpr int longest_absence = 50;    // ticks
constexpr int ticks_per_circle = 1000; // for a transient that moves
constexpr double largest_circle = 0.5; // metres
constexpr double smallest_size = 0.02; // metres
constexpr double largest_size = 0.2;   // metres

using GeomPairs = std::map<IndexPair, std::pair<dGeomID, dGeomID>>;

void add_if_near(dGeomID one, dGeomID other, GeomPairs &pairs)
{
    if (geom_index(other) < geom_index(one))
    {
        std::swap(one, other);
    }
    if (may_collide(one, other) && boxes_overlap(one, other))
    {
        pairs[{geom_index(one), geom_index(other)}] = {one, other};
    }
}

/// The pairs that are in one list only, as text. With the shape test, an overlapping pair without contacts may be left out.
std::string differences(const GeomPairs &expected, const std::vector<IndexPair> &reported, bool by_shapes)
{
    std::ostringstream text;
    for (auto next = reported.begin(); next != reported.end(); ++next)
    {
        if (expected.count(*next) == 0 || (next != reported.begin() && *next == *(next - 1)))
        {
            text << "not to be reported: " << next->first << ", " << next->second << '\n';
        }
    }
    for (const auto &[pair, geoms] : expected)
    {
        dContactGeom contact;
        if (!std::binary_search(reported.begin(), reported.end(), pair) &&
            (!by_shapes || dCollide(geoms.first, geoms.second, 1, &contact, sizeof contact) > 0))
        {
            text << "missing: " << pair.first << ", " << pair.second << '\n';
        }
    }
    return text.str();
}
} // namespace

ChurnedScene::ChurnedScene(const WorldSpec &spec, const std::string &space, int ticks_per_copy)
    : factory_(spec), space_(make_space(space, factory_)), scene_(factory_.make(space_.get())),
      ticks_per_copy_(ticks_per_copy), by_shapes_(space == "predictive-shape"), random_(spec.seed)
{
    for (std::size_t number = 0; number < transients; ++number)
    {
        transients_.push_back(make_transient(number));
    }
}

ChurnedScene::~ChurnedScene()
{
    for (const Transient &transient : transients_)
    {
        dGeomDestroy(transient.geom);
    }
}

void ChurnedScene::tick()
{
    ++tick_;
    if (ticks_per_copy_ != 0 && tick_ % ticks_per_copy_ == 0)
    {
        renew_scene();
    }
    scene_->advance();
    for (const Transient &transient : transients_)
    {
        if (transient.radius > 0)
        {
            place(transient);
        }
    }
    return_due();
    if (tick_ % ticks_between_changes == 0)
    {
        change();
    }
    collide();
    respond();
}

// Geoms of the scene that are outside the space are destroyed with the others.
void ChurnedScene::renew_scene()
{
    absent_.erase(
        std::remove_if(absent_.begin(), absent_.end(), [](const Absent &absent) { return !absent.is_transient; }),
        absent_.end());
    scene_.reset();
    scene_ = factory_.make(space_.get());
}

ChurnedScene::Transient ChurnedScene::make_transient(std::size_t number)
{
    const Bounds bounds = factory_.bounds();
    Transient transient{make_geom(), bounds.centre + random_.in_box(bounds.half_extent), 0};
    transient.radius = number % 2 == 0 ? random_.uniform(0, largest_circle) : 0;
    set_geom_index(transient.geom, first_transient + static_cast<std::uint32_t>(number));
    set_orientation(transient.geom, random_.orientation());
    place(transient);
    return transient;
}

dGeomID ChurnedScene::make_geom()
{
    switch (random_.index(3))
    {
    case 0:
        return dCreateSphere(space_.get(), any_size());
    case 1:
        return dCreateCapsule(space_.get(), any_size(), any_size());
    default:
        return dCreateBox(space_.get(), any_size(), any_size(), any_size());
    }
}

double ChurnedScene::any_size()
{
    return random_.uniform(smallest_size, largest_size);
}

void ChurnedScene::place(const Transient &transient) const
{
    const double angle = 2 * pi * tick_ / ticks_per_circle;
    set_position(transient.geom,
                 transient.home + transient.radius * Vector3(std::cos(angle), std::sin(angle), std::sin(2 * angle)));
}

// In a scene with contacts no geom may miss a tick: the floor could be missing.
void ChurnedScene::change()
{
    switch (random_.index(6))
    {
    case 0:
        return leave(false, false);
    case 1:
        return leave(false, scene_->moves_by_itself());
    case 2:
        return leave(true, false);
    case 3:
        return leave(true, true);
    case 4:
        return replace_transient();
    default:
        return resize_transient();
    }
}

void ChurnedScene::leave(bool is_transient, bool for_long)
{
    const std::size_t number = random_.index(is_transient ? transients_.size() : scene_->geoms().size());
    const dGeomID leaving = geom(is_transient, number);
    if (leaving == nullptr || dGeomGetSpace(leaving) == nullptr)
    {
        return;
    }
    dSpaceRemove(space_.get(), leaving);
    if (for_long)
    {
        const int absence = 1 + static_cast<int>(random_.index(longest_absence));
        absent_.push_back({is_transient, number, tick_ + absence});
    }
    else
    {
        dSpaceAdd(space_.get(), leaving);
    }
}

// Its number may now be that of another transient, which is in the space.
void ChurnedScene::return_due()
{
    const auto is_due = [this](const Absent &absent) { return absent.return_tick <= tick_; };
    for (const Absent &absent : absent_)
    {
        const dGeomID returning = geom(absent.is_transient, absent.number);
        if (is_due(absent) && returning != nullptr && dGeomGetSpace(returning) == nullptr)
        {
            dSpaceAdd(space_.get(), returning);
        }
    }
    absent_.erase(std::remove_if(absent_.begin(), absent_.end(), is_due), absent_.end());
}

void ChurnedScene::replace_transient()
{
    const std::size_t number = random_.index(transients_.size());
    dGeomDestroy(transients_[number].geom);
    transients_[number] = make_transient(number);
}

void ChurnedScene::resize_transient()
{
    const dGeomID resized = transients_[random_.index(transients_.size())].geom;
    switch (dGeomGetClass(resized))
    {
    case dSphereClass:
        return dGeomSphereSetRadius(resized, any_size());
    case dCapsuleClass:
        return dGeomCapsuleSetParams(resized, any_size(), any_size());
    default:
        return dGeomBoxSetLengths(resized, any_size(), any_size(), any_size());
    }
}

void ChurnedScene::collide()
{
    list_.clear();
    dSpaceCollide(space_.get(), &list_, &PairList::collect);
    pairs_ = list_.sorted();
    answers_.clear();
    for (const dGeomID query : scene_->queries())
    {
        list_.clear();
        dSpaceCollide2(query, reinterpret_cast<dGeomID>(space_.get()), &list_, &PairList::collect);
        const std::vector<IndexPair> found = list_.sorted();
        answers_.insert(answers_.end(), found.begin(), found.end());
    }
    std::sort(answers_.begin(), answers_.end());
}

void ChurnedScene::respond()
{
    if (scene_->moves_by_itself())
    {
        return;
    }
    std::vector<IndexPair> of_scene = pairs_;
    const auto has_transient = [](const IndexPair &pair) { return pair.second >= first_transient; };
    of_scene.erase(std::remove_if(of_scene.begin(), of_scene.end(), has_transient), of_scene.end());
    scene_->respond(of_scene);
}

dGeomID ChurnedScene::geom(bool is_transient, std::size_t number) const
{
    return is_transient ? transients_[number].geom : scene_->geoms()[number];
}

std::vector<dGeomID> ChurnedScene::geoms_inside() const
{
    std::vector<dGeomID> geoms = scene_->geoms();
    for (const Transient &transient : transients_)
    {
        geoms.push_back(transient.geom);
    }
    const auto is_outside = [](dGeomID geom) { return geom == nullptr || dGeomGetSpace(geom) == nullptr; };
    geoms.erase(std::remove_if(geoms.begin(), geoms.end(), is_outside), geoms.end());
    return geoms;
}

std::string ChurnedScene::wrong_pairs() const
{
    const std::vector<dGeomID> geoms = geoms_inside();
    GeomPairs pairs, answers;
    for (std::size_t i = 0; i < geoms.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j)
        {
            add_if_near(geoms[i], geoms[j], pairs);
        }
    }
    for (const dGeomID query : scene_->queries())
    {
        for (const dGeomID geom : geoms)
        {
            add_if_near(query, geom, answers);
        }
    }
    return differences(pairs, pairs_, by_shapes_) + differences(answers, answers_, false);
}
} // namespace ode_predictive_space::soak
