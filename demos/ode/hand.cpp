#include "demos/ode/hand.h"

#include "ode_predictive_space/haptics/drivers.h"
#include "ode_predictive_space/haptics/penalty_law.h"

#include <cmath>
#include <iostream>
#include <ode/rotation.h>

namespace ode_predictive_space::ode_demos
{
namespace
{
constexpr double probe_size = 0.035;          // radius, in parts of the place's diagonal
constexpr double stiffness_per_radius = 80;   // N/m per metre, in the scene: larger objects are heavier
constexpr double usual_hand_stiffness = 60;   // N/m; for devices that do not report theirs
constexpr double more_than_any_device = 1e12; // N/m
constexpr double radians = 3.14159265358979323846 / 180;
constexpr unsigned clutch_button = 0;
constexpr std::size_t trail_length = 90; // frames
constexpr double look_ahead = 0.5;       // s
constexpr std::size_t most_shown = 5;

/// To the right is the device's x, upwards its y, towards the person its z.
haptics::Quaternion axes_for(double heading)
{
    const haptics::Quaternion turn(Eigen::AngleAxisd((heading - 90) * radians, Vector3::UnitZ()));
    return (turn * haptics::WorkspacePlacement::z_up()).normalized();
}

void draw_line(const Vector3 &from, const Vector3 &to)
{
    dsDrawLineD(from.data(), to.data());
}

Vector3 middle_of(dGeomID geom)
{
    dReal box[6];
    dGeomGetAABB(geom, box);
    return {(box[0] + box[1]) / 2, (box[2] + box[3]) / 2, (box[4] + box[5]) / 2};
}
} // namespace

Hand::Hand(const std::string &device)
    : device_(haptics::make_device(device)), mouse_(dynamic_cast<haptics::MouseDevice *>(device_.get()))
{
    device_->open();
}

Hand::~Hand()
{
    probe_.reset();
    device_->close();
}

/// The stiffness that the device can render at this low rate.
double Hand::hand_stiffness() const
{
    haptics::Rendering rendering;
    rendering.stiffness = more_than_any_device;
    rendering.rate = 1 / frame_seconds;
    const double stiffest = haptics::check_stability(device_->capabilities(), rendering).stiffness;
    return stiffest < more_than_any_device ? stiffest : usual_hand_stiffness;
}

/// The whole volume is within reach. Any reach beyond it is above, because the ground is below.
haptics::WorkspacePlacement Hand::placement_in(const Place &place) const
{
    const Eigen::AlignedBox3d &workspace = device_->capabilities().workspace;
    haptics::WorkspacePlacement placement =
        haptics::WorkspacePlacement::covering(place.bounds, workspace, axes_for(place.heading));
    const double height = placement.scale * workspace.sizes().y();
    placement.offset.z() += (height - place.bounds.sizes().z()) / 4;
    return placement;
}

void Hand::make_probe(const Place &place)
{
    radius_ = probe_size * place.bounds.diagonal().norm();
    const double stiffness = stiffness_per_radius * radius_;
    haptics::RenderSettings settings;
    settings.placement = placement_in(place);
    // As stiff at the hand as possible, as soft in the scene as light objects need.
    settings.placement.force_scale = hand_stiffness() / (stiffness * settings.placement.scale);
    settings.law = std::make_shared<haptics::PenaltyLaw>(haptics::Material{stiffness, 0, 0});
    settings.rate = settings.physics_rate = 1 / frame_seconds;
    settings.clutch_button = clutch_button;
    settings.notice = [](const haptics::Notice &notice) { std::cerr << "-- " << notice.sentence() << std::endl; };
    probe_ = std::make_unique<haptics::HapticProbe>(*device_, place.space, radius_, settings);
    trail_.clear();
}

void Hand::step(const Place &place)
{
    if (!probe_)
    {
        make_probe(place);
    }
    else
    {
        probe_->render(frame_seconds);
        const double force = probe_->last_tick().force.norm();
        frames_with_force_ += force > 0 ? 1 : 0;
        largest_force_ = std::max(largest_force_, force);
    }
    time_ += frame_seconds;
    probe_->begin(time_);
    trail_.push_back(probe_->tool().position);
    if (trail_.size() > trail_length)
        trail_.pop_front();
}

bool Hand::touch(dGeomID first, dGeomID second)
{
    if (!probe_ || (first != probe_->geom() && second != probe_->geom()))
        return false;
    const dGeomID other = first == probe_->geom() ? second : first;
    if (dGeomIsSpace(other) == 0)
        return dGeomGetClass(other) != dRayClass && probe_->touch(first, second);
    const auto near = [](void *hand, dGeomID one, dGeomID another) { static_cast<Hand *>(hand)->touch(one, another); };
    dSpaceCollide2(probe_->geom(), other, this, near);
    return true;
}

void Hand::draw()
{
    if (!probe_)
        return;
    dMatrix3 upright;
    dRSetIdentity(upright);
    dsSetTexture(DS_NONE);
    dsSetColor(0.9F, 0.1F, 0.1F);
    dsDrawSphereD(probe_->tool().position.data(), upright, static_cast<float>(radius_));
    dsSetColor(1, 0.4F, 0.3F);
    for (std::size_t i = 1; i < trail_.size(); ++i)
        draw_line(trail_[i - 1], trail_[i]);
    draw_force();
    draw_what_comes_next();
}

/// A rod from the probe in the direction of the force; its length is proportional to the force.
void Hand::draw_force() const
{
    const Vector3 force = probe_->last_tick().force;
    if (!(force.norm() > 0))
        return;
    const Vector3 direction = force.normalized();
    const double length = 8 * radius_ * std::tanh(force.norm() / (stiffness_per_radius * radius_ * radius_));
    const Vector3 centre = probe_->tool().position + (length / 2) * direction;
    dMatrix3 rotation;
    dRFromZAxis(rotation, direction.x(), direction.y(), direction.z());
    dsSetColor(1, 0.6F, 0);
    dsDrawCylinderD(centre.data(), rotation, static_cast<float>(length), static_cast<float>(radius_ / 4));
}

void Hand::draw_what_comes_next()
{
    dsSetColor(0, 0.9F, 1);
    std::size_t shown = 0;
    for (const haptics::Encounter &next : probe_->encounters())
    {
        if (next.seconds > look_ahead || shown == most_shown)
            return;
        if (dGeomGetClass(next.geom) != dPlaneClass)
        {
            draw_line(probe_->tool().position, middle_of(next.geom));
            ++shown;
        }
    }
}

void Hand::pointer(const dsPointerEvent &event)
{
    if (mouse_ == nullptr)
        return;
    if (last_pointer_ && event.buttons == 0)
        mouse_->pointer(event.x - last_pointer_->x, event.y - last_pointer_->y);
    mouse_->wheel(event.wheel);
    last_pointer_ = event;
}
} // namespace ode_predictive_space::ode_demos
