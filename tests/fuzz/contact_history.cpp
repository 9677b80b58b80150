#include "tests/fuzz/contact_history.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <ode_predictive_space/predictive_space.h>

namespace ode_predictive_space
{
namespace
{
using Eigen::Vector3d;

constexpr std::size_t most_operations = 200;

// Bits of the first byte. Two bits choose the deviation.
constexpr int by_shape = 1, asks = 8, deviations_at = 2;

// Bits of the number of a geom that is made.
constexpr int with_body = 16, coherent = 32, single = 64;

double fraction(std::uint8_t byte)
{
    return byte / 255.0;
}

// A length from 0.1 mm to 100 m: sides have ratios up to a million.
double side(std::uint8_t byte)
{
    return std::pow(10, -4 + 6 * fraction(byte));
}

Vector3d sides(const std::uint8_t *bytes)
{
    return {side(bytes[0]), side(bytes[1]), side(bytes[2])};
}

double small(std::uint8_t byte)
{
    return std::pow(10, -9 + 9 * fraction(byte));
}

Vector3d direction(std::uint8_t height, std::uint8_t around)
{
    if (around < 48)
        return (height % 2 ? 1 : -1) * Vector3d::Unit(around % 3);
    if (around < 112)
        return Vector3d(height & 1 ? 1 : -1, height & 2 ? 1 : -1, height & 4 ? 1 : -1).normalized();
    const double z = 2 * fraction(height) - 1, angle = 0.1 * around, across = std::sqrt(1 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

Vector3d place(const std::uint8_t *bytes)
{
    return 0.02 * Vector3d(bytes[0] - 128, bytes[1] - 128, bytes[2] - 128);
}

Form form(const std::uint8_t *bytes)
{
    Form form;
    form.type = bytes[2] % (dHeightfieldClass + 1);
    form.polyhedron = bytes[3] % 16;
    form.body = (bytes[3] & with_body) != 0;
    form.coherent = (bytes[3] & coherent) != 0;
    form.single = (bytes[3] & single) != 0;
    form.sides = sides(bytes + 4);
    return form;
}

ContactWorld::Setting setting(std::uint8_t byte)
{
    constexpr std::array deviations{0.0, 0.01, 0.3, 5.0};
    ContactWorld::Setting setting;
    setting.proximity = byte & by_shape ? dPredictiveProximityShape : dPredictiveProximitySphere;
    setting.deviation = deviations[static_cast<std::size_t>(byte) / deviations_at % deviations.size()];
    setting.asks = (byte & asks) != 0;
    return setting;
}

ContactAction action_of(std::uint8_t byte)
{
    return static_cast<ContactAction>(byte % (static_cast<int>(ContactAction::last) + 1));
}

const char *action_name(std::uint8_t byte)
{
    constexpr std::array names{
        "make", "destroy", "place", "place_beside", "creep",   "spin",   "breathe",         "wobble",          "turn",
        "skew", "offset",  "drive", "steps",        "release", "resize", "change_in_place", "rebuild_in_place"};
    static_assert(names.size() == static_cast<std::size_t>(ContactAction::last) + 1);
    return names[static_cast<std::size_t>(action_of(byte))];
}

class ContactStep
{
public:
    ContactStep(ContactWorld &world, const std::uint8_t *bytes)
        : world_(world), bytes_(bytes), subject_(bytes[1] % slot_count), object_(bytes[2] % slot_count),
          ticks_(1 + bytes[3] % 24)
    {}

    std::string run()
    {
        switch (action())
        {
        case ContactAction::creep:
            return creep();
        case ContactAction::spin:
            return spin();
        case ContactAction::breathe:
            return breathe();
        case ContactAction::wobble:
            return wobble();
        case ContactAction::steps:
            return each_tick([this](int) { world_.step(side(bytes_[4])); });
        default:
            change();
            return world_.tick();
        }
    }

private:
    ContactAction action() const { return action_of(bytes_[0]); }

    template <typename Act> std::string each_tick(Act act)
    {
        std::string wrong;
        for (int i = 0; i < ticks_ && wrong.empty(); ++i)
        {
            act(i);
            wrong = world_.tick();
        }
        return wrong;
    }

    Vector3d heading() const { return direction(bytes_[5], bytes_[6]); }

    std::string creep()
    {
        const Vector3d by = world_.extent_of(subject_) * small(bytes_[4]) * heading();
        return each_tick([&](int) { world_.move(subject_, by); });
    }

    std::string spin()
    {
        const double angle = 3 * small(bytes_[4]);
        return each_tick([&](int) { world_.turn(subject_, heading(), angle); });
    }

    std::string breathe()
    {
        const double radius = world_.radius_of(subject_), depth = 0.9 * small(bytes_[4]);
        return each_tick([&](int i) {
            const double left = depth * (ticks_ - 1 - i) / ticks_;
            if (radius > 0)
                world_.resize(subject_, Vector3d::Constant((1 - left) * radius));
        });
    }

    // Waits until both are predicted to stay.
    std::string rest()
    {
        constexpr int ticks = 8;
        std::string wrong;
        for (int i = 0; i < ticks && wrong.empty(); ++i)
            wrong = world_.tick();
        return wrong;
    }

    // The geoms go to opposite corners of cubes around their places, the farthest that a check of coordinates allows.
    std::string wobble()
    {
        const double half = side(bytes_[4]);
        Vector3d off = Vector3d::Zero();
        if (const std::string wrong = rest(); !wrong.empty())
            return wrong;
        return each_tick([&](int i) {
            if (i > 0) // a geom that has just moved may deviate
                world_.foretell(subject_, object_);
            const int corner = bytes_[5] * (i + 1) + bytes_[6] * i * i;
            const Vector3d to = half * Vector3d(corner & 4 ? 1 : -1, corner & 8 ? 1 : -1, corner & 16 ? 1 : -1);
            world_.move(subject_, to - off);
            if (subject_ != object_)
                world_.move(object_, off - to);
            off = to;
        });
    }

    void change()
    {
        switch (action())
        {
        case ContactAction::make:
            return world_.make(subject_, form(bytes_));
        case ContactAction::destroy:
            return world_.destroy(subject_);
        case ContactAction::place:
            return world_.place(subject_, place(bytes_ + 4));
        case ContactAction::place_beside:
            return place_beside();
        case ContactAction::turn:
            return world_.turn(subject_, heading(), 4 * fraction(bytes_[4]));
        case ContactAction::skew:
            return world_.set_quaternion(subject_, quaternion());
        default:
            change_more();
        }
    }

    void place_beside()
    {
        const bool with_contact = bytes_[3] % 2 != 0, exactly = bytes_[3] / 2 % 2 != 0;
        const double part = exactly ? 0 : bytes_[3] / 4 % 2 ? small(bytes_[7]) : fraction(bytes_[7]);
        world_.place_beside(subject_, object_, heading(), with_contact, with_contact ? -part : part);
    }

    Eigen::Vector4d quaternion() const
    {
        const Vector3d imaginary = heading() * fraction(bytes_[7]);
        return std::exp2(2 * fraction(bytes_[4]) - 1) *
               Eigen::Vector4d(1.001 - fraction(bytes_[7]), imaginary[0], imaginary[1], imaginary[2]).normalized();
    }

    void change_more()
    {
        switch (action())
        {
        case ContactAction::offset:
            return world_.set_offset(subject_, 0.2 * place(bytes_ + 4));
        case ContactAction::drive:
            return world_.set_velocity(subject_, small(bytes_[4]) * heading(), side(bytes_[7]) * heading());
        case ContactAction::release:
            return world_.take_body(subject_);
        case ContactAction::resize:
            return world_.resize(subject_, sides(bytes_ + 4));
        case ContactAction::change_in_place:
            return world_.change_in_place(subject_, Vector3d::Ones() + 0.5 * small(bytes_[4]) * heading());
        case ContactAction::rebuild_in_place:
            return world_.rebuild_in_place(subject_, bytes_[3] % 16, sides(bytes_ + 4));
        default:
            return;
        }
    }

    ContactWorld &world_;
    const std::uint8_t *bytes_;
    int subject_, object_, ticks_;
};
} // namespace

std::string run_contact_history(const std::uint8_t *data, std::size_t size, ContactTally &tally)
{
    if (size == 0)
        return "";
    ContactWorld world(setting(data[0]), tally);
    const std::size_t count = std::min((size - 1) / bytes_per_contact_operation, most_operations);
    for (std::size_t i = 0; i < count; ++i)
        if (const std::string wrong = ContactStep(world, data + 1 + i * bytes_per_contact_operation).run();
            !wrong.empty())
            return "operation " + std::to_string(i) + ", " + wrong;
    return "";
}

namespace
{
using Bytes = std::vector<std::uint8_t>;

std::string run(const Bytes &bytes)
{
    ContactTally tally;
    return run_contact_history(bytes.data(), bytes.size(), tally);
}

Bytes shrunk(Bytes bytes)
{
    bytes.resize(1 + (bytes.size() - 1) / bytes_per_contact_operation * bytes_per_contact_operation);
    for (std::size_t end = bytes.size(); end > 1; end -= bytes_per_contact_operation)
    {
        Bytes shorter = bytes;
        const auto last = shorter.begin() + static_cast<std::ptrdiff_t>(end);
        shorter.erase(last - bytes_per_contact_operation, last);
        if (!run(shorter).empty())
            bytes = shorter;
    }
    return bytes;
}
} // namespace

std::string report_of_contact_history(const std::uint8_t *data, std::size_t size)
{
    Bytes bytes(data, data + size);
    if (run(bytes).empty())
        return "";
    bytes = shrunk(bytes);
    std::ostringstream text;
    text << "settings " << int{bytes[0]} << "\n";
    for (std::size_t at = 1; at < bytes.size(); at += bytes_per_contact_operation)
    {
        text << action_name(bytes[at]);
        for (std::size_t i = 1; i < bytes_per_contact_operation; ++i)
            text << " " << int{bytes[at + i]};
        text << "\n";
    }
    text << run(bytes);
    return text.str();
}
} // namespace ode_predictive_space
