#include "tests/differential/generator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/contract/support/geom_zoo.h"

namespace ode_predictive_space
{
namespace
{
// SplitMix64 and plain arithmetic, as the distributions of standard libraries differ.
class Random
{
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits()
    {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    int below(int count) { return static_cast<int>(bits() % static_cast<std::uint64_t>(std::max(count, 1))); }
    double between(double low, double high)
    {
        return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
    }
    bool chance(double probability) { return between(0, 1) < probability; }

private:
    std::uint64_t state_;
};

class Generator
{
public:
    Generator(const Profile &profile, std::uint64_t seed) : profile_(profile), random_(seed) {}

    History make()
    {
        set_up();
        for (int i = 0; i < profile_.geoms; ++i)
            make_object(i);
        if (random_.chance(0.3))
            settings();
        int ticks = 0;
        while (ticks < profile_.ticks)
        {
            surprise();
            ticks += let_time_pass(profile_.ticks - ticks);
            ask();
        }
        return history_;
    }

private:
    bool is(Flavour flavour) const { return profile_.flavour == flavour; }

    void set_up()
    {
        const double spacing = random_.between(0.8, 4);
        history_.extent = 0.5 * spacing * std::cbrt(profile_.geoms) + 0.5;
        for (double &axis : history_.middle)
            axis = is(Flavour::far) ? random_.between(-1, 1) * std::pow(10, random_.between(2, 8)) : 0;
        history_.contacts = is(Flavour::pile) || (!is(Flavour::extreme) && random_.chance(0.1));
        history_.gravity = is(Flavour::pile) ? 9.81 : random_.chance(0.3) ? random_.between(0, 10) : 0;
        history_.auto_disable = random_.chance(0.3);
        seconds_ = random_.chance(0.5) ? 0.01 : std::pow(10, random_.between(-3.5, -1.5));
        // Metres per second, from creeping to crossing the scene in a few ticks.
        speed_ = std::pow(10, random_.between(-2, 1.3));
        bodies_ = random_.chance(0.2) ? 0 : static_cast<int>(random_.between(0.3, 1) * profile_.geoms);
        if (profile_.nested_spaces)
            spaces_ = is(Flavour::nests) ? most_nested : random_.below(4);
        for (int i = 1; i <= spaces_; ++i)
            make_space(i);
        for (int i = 0; i < bodies_; ++i)
            make_body(i);
        if (is(Flavour::pile))
            add(Action::make_geom, profile_.geoms, 0, static_cast<int>(GeomKind::plane), {history_.extent});
    }

    void add(Action action, int subject, int object, int number, std::array<double, 4> value = {})
    {
        history_.operations.push_back({action, subject, object, number, value});
    }

    double anywhere() { return random_.between(-history_.extent, history_.extent); }
    std::array<double, 4> place(double fourth = 0)
    {
        const std::array<double, 3> &middle = history_.middle;
        return {middle[0] + anywhere(), middle[1] + anywhere(), middle[2] + anywhere(), fourth};
    }
    std::array<double, 4> distance_from_middle(const std::array<double, 4> &place, double fourth) const
    {
        const std::array<double, 3> &middle = history_.middle;
        return {place[0] - middle[0], place[1] - middle[1], place[2] - middle[2], fourth};
    }
    double speed() { return speed_ * random_.between(-1, 1); }
    double size() { return random_.chance(0.03) ? random_.between(2, 8) : random_.between(0.2, 1.2); }
    int any_geom() { return random_.below(profile_.geoms + 1); }
    int any_body() { return random_.below(bodies_); }
    int any_space() { return random_.below(spaces_ + 1); }
    int any_reference() { return random_.chance(0.3) ? space_reference(any_space()) : any_geom(); }

    GeomKind any_kind()
    {
        if (is(Flavour::pile))
            return static_cast<GeomKind>(random_.below(3));
        // Infinite geoms overlap half of all others, so a few are enough.
        if (random_.chance(0.01))
            return static_cast<GeomKind>(static_cast<int>(GeomKind::plane) + random_.below(3));
        if (random_.chance(0.5))
            return static_cast<GeomKind>(random_.below(4));
        return static_cast<GeomKind>(random_.below(static_cast<int>(GeomKind::plane)));
    }

    void make_space(int slot)
    {
        if (is(Flavour::nests))
            return make_deep_space(slot);
        const int kinds = is(Flavour::extreme) ? 2 : 3; // a hash space aborts on extreme coordinates
        const int parent = random_.chance(0.2) ? -1 : random_.below(slot);
        add(Action::make_space, slot, parent, random_.below(kinds) + 16 * random_.below(2));
    }

    // Most are in the previous space. Some begin a separate nest, which no predictive space contains. A quadtree space that
    // does not destroy its geoms leaves them unfit for others.
    void make_deep_space(int slot)
    {
        const int parent = random_.chance(0.2) ? -1 : random_.chance(0.8) ? slot - 1 : random_.below(slot);
        const int kind = random_.below(static_cast<int>(NestedKind::last) + 1);
        const bool cleans_up = kind == static_cast<int>(NestedKind::quadtree) || random_.chance(0.5);
        add(Action::make_space, slot, parent, kind + 16 * cleans_up);
    }

    void make_body(int slot)
    {
        const int kind = random_.chance(0.8) ? 0 : 1 + random_.below(2);
        add(Action::make_body, slot, -1, kind, place());
        add(Action::velocity, slot, -1, 0, {speed(), speed(), speed(), random_.chance(0.5) ? 0 : speed()});
    }

    void make_geom(int slot)
    {
        const double outermost = is(Flavour::nests) ? 0.2 : 0.8;
        const int space = random_.chance(0.04) ? -1 : random_.chance(outermost) ? 0 : any_space();
        const auto where = place();
        const GeomKind kind = any_kind();
        if (kind == GeomKind::ray)
            rays_.push_back(slot);
        add(Action::make_geom, slot, space, static_cast<int>(kind), {size(), where[0], where[1], where[2]});
    }

    // At times the ray gets the body of another geom, whose matrix it changes.
    void aim_ray()
    {
        if (rays_.empty())
            return;
        const int ray = rays_[static_cast<std::size_t>(random_.below(static_cast<int>(rays_.size())))];
        if (bodies_ > 0 && random_.chance(0.5))
            add(Action::attach, ray, any_body(), 0);
        add(Action::aim_ray, ray, -1, random_.below(125), place());
    }

    void make_object(int slot)
    {
        make_geom(slot);
        if (slot < bodies_)
            add(Action::attach, slot, random_.chance(0.9) ? slot : any_body(), 0);
        else if (random_.chance(0.3))
            drive(slot);
        if (random_.chance(0.15))
            add(Action::offset, slot, -1, 0, {random_.between(-1, 1), random_.between(-1, 1), 0, speed()});
        if (random_.chance(0.1))
            add(Action::bits, slot, -1, random_.below(65536));
    }

    void drive(int slot)
    {
        add(Action::drive, slot, -1, random_.below(4), {speed() * seconds_, speed() * seconds_, speed() * seconds_});
    }

    void settings()
    {
        const int space = any_space();
        if (random_.chance(0.5))
        {
            const int shortest = 1 + random_.below(20);
            add(Action::horizon, space, shortest + random_.below(random_.chance(0.5) ? 20 : 10000), shortest);
        }
        if (random_.chance(0.5))
            add(Action::deviation, space, -1, random_.below(2),
                {random_.between(0, 0.1), random_.between(0, 0.01), random_.between(0, 0.001)});
    }

    int surprises()
    {
        switch (profile_.flavour)
        {
        case Flavour::calm:
        case Flavour::explosion:
            return random_.below(3);
        case Flavour::teleport:
            return 2;
        case Flavour::nests:
            return random_.below(12);
        case Flavour::wild:
            return random_.below(profile_.geoms / 4 + 4);
        default:
            return random_.below(profile_.geoms / 20 + 4);
        }
    }

    void surprise()
    {
        if (is(Flavour::teleport))
        {
            const double part = random_.between(0, 1.2);
            for (int i = 0; i < profile_.geoms; ++i)
            {
                if (random_.chance(part))
                    add(Action::move_geom, i, -1, 0, place());
            }
        }
        if (is(Flavour::explosion) && random_.chance(0.1))
            explode();
        for (int i = surprises(); i > 0; --i)
            happen();
        if (is(Flavour::extreme))
            go_to_extremes();
    }

    void explode()
    {
        const double part = random_.between(0.1, 1);
        const bool replaces = random_.chance(0.2);
        for (int i = 0; i < profile_.geoms; ++i)
        {
            if (!random_.chance(part))
                continue;
            if (replaces)
                add(Action::destroy_geom, i, -1, 0);
            if (replaces && random_.chance(0.9))
                make_object(i);
            else if (i < bodies_)
                add(Action::velocity, i, -1, 0, {speed(), speed(), speed(), speed()});
        }
    }

    void go_to_extremes()
    {
        static const double extremes[] = {std::numeric_limits<double>::quiet_NaN(),
                                          std::numeric_limits<double>::infinity(),
                                          -std::numeric_limits<double>::infinity(),
                                          1e12,
                                          -1e12,
                                          1e39, // beyond single precision, as are the next ones
                                          -1e300,
                                          1e-300,
                                          5e-324};
        auto where = place();
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
            if (random_.chance(0.5))
                where[axis] = extremes[random_.below(9)];
        }
        if (random_.chance(0.4) && bodies_ > 0)
            add(random_.chance(0.7) ? Action::move_body : Action::velocity, any_body(), -1, 0, where);
        else
            add(Action::move_geom, any_geom(), -1, 0, where);
        // Most come back, so that the scene does not empty.
        for (int i = 0; i < 2; ++i)
            add(Action::move_geom, any_geom(), -1, 0, place());
        if (bodies_ > 0)
        {
            const int body = any_body();
            add(Action::velocity, body, -1, 0, {speed(), speed(), speed(), 0});
            add(Action::move_body, body, -1, 0, place());
        }
    }

    void happen_in_nests()
    {
        switch (random_.below(7))
        {
        case 0:
            return add(Action::clean, any_space(), -1, 0);
        case 1:
            return add(Action::ask_bounds, space_reference(any_space()), -1, 0);
        case 2:
            return add(Action::query, any_geom(), space_reference(any_space()), 0);
        case 3:
        {
            const int space = space_reference(1 + random_.below(spaces_));
            add(Action::take_out, space, -1, 0);
            return random_.chance(0.8) ? add(Action::put_in, space, any_space(), 0) : void();
        }
        default:
            return add(Action::move_geom, any_geom(), -1, 0, place());
        }
    }

    void happen()
    {
        if (is(Flavour::nests) && random_.chance(0.7))
            return happen_in_nests();
        const int geom = any_geom();
        const int body = any_body();
        const auto where = place();
        switch (random_.below(33))
        {
        case 0:
        case 1:
            return add(Action::move_geom, geom, -1, 0, where);
        case 2:
            return add(Action::move_body, body, -1, 0, where);
        case 3:
            return add(Action::turn_geom, geom, -1, 0, distance_from_middle(where, anywhere()));
        case 4:
            return add(Action::turn_body, body, -1, 0, distance_from_middle(where, anywhere()));
        case 5:
        case 6:
            return add(Action::resize, geom, -1, 0, {random_.chance(0.02) ? 0 : size()});
        case 7:
        case 8:
            return add(Action::enable_geom, geom, -1, random_.below(2));
        case 9:
            return add(Action::enable_body, body, -1, random_.below(2));
        case 10:
            return add(Action::bits, any_reference(), -1, random_.chance(0.5) ? 65535 : random_.below(65536));
        case 11:
        case 12:
        case 13:
            return add(Action::velocity, body, -1, 0, {speed(), speed(), speed(), speed()});
        case 14:
            return add(Action::force, body, -1, 0, {50 * speed(), 50 * speed(), 50 * speed()});
        case 15:
            return add(Action::kinematic, body, -1, random_.below(2));
        case 16:
            return add(Action::attach, geom, random_.chance(0.3) ? -1 : body, 0);
        case 17:
            return add(Action::offset, geom, -1, 0, {random_.between(-1, 1), 0, random_.between(-1, 1), anywhere()});
        case 18:
            return add(Action::clear_offset, geom, -1, 0);
        case 19:
            return drive(geom);
        case 20:
            add(Action::take_out, any_reference(), -1, 0);
            return add(Action::put_in, any_geom(), any_space(), 0);
        case 21:
            add(Action::take_out, geom, -1, 0);
            add(Action::put_in, geom, any_space(), 0);
            return add(Action::put_in, space_reference(1 + random_.below(3)), any_space(), 0);
        case 22:
        case 23:
            add(Action::destroy_geom, geom, -1, 0);
            return make_geom(any_geom());
        case 24:
            add(Action::destroy_body, body, -1, 0);
            return bodies_ > 0 && random_.chance(0.8) ? make_body(any_body()) : void();
        case 25:
            return add(Action::clean, any_space(), -1, 0);
        case 26:
            return add(Action::ask_bounds, any_reference(), -1, 0);
        case 27:
            return add(Action::role, geom, -1, random_.below(2));
        case 28:
            return random_.chance(0.2) ? settings() : void();
        case 29:
            return add(Action::distort_geom, geom, -1, random_.below(36), distance_from_middle(where, anywhere()));
        case 30:
            return add(Action::distort_body, body, -1, random_.below(36), distance_from_middle(where, anywhere()));
        case 31:
            return aim_ray();
        default:
            return change_spaces();
        }
    }

    void change_spaces()
    {
        if (spaces_ == 0 || !random_.chance(0.3))
            return;
        const int space = 1 + random_.below(spaces_);
        add(Action::destroy_space, space, -1, 0);
        if (random_.chance(0.8))
            make_space(space);
        for (int i = 0; i < 3; ++i)
            make_geom(any_geom());
    }

    int let_time_pass(int most)
    {
        if (is(Flavour::calm) || random_.chance(is(Flavour::mixed) || is(Flavour::pile) ? 0.2 : 0.02))
        {
            const int longest = is(Flavour::calm) ? std::max(profile_.ticks / 2, 10) : 100;
            const int ticks = std::min(most, 1 + random_.below(longest));
            add(Action::calm, -1, random_.chance(0.8) ? 1 : random_.below(4), ticks, {seconds_});
            return ticks;
        }
        for (int steps = random_.chance(0.8) ? 1 : random_.below(4); steps > 0; --steps)
            add(Action::step, -1, -1, 0, {seconds_ * (random_.chance(0.95) ? 1 : random_.between(0, 10))});
        add(Action::tick, -1, -1, 0);
        return 1;
    }

    void ask()
    {
        while (random_.chance(0.3))
        {
            const int first = random_.chance(0.5) ? space_reference(0) : any_reference();
            const int second = any_reference();
            const bool swapped = random_.chance(0.5);
            add(Action::query, swapped ? second : first, swapped ? first : second, 0);
        }
    }

    static constexpr int most_nested = 6;

    Profile profile_;
    Random random_;
    History history_;
    double seconds_ = 0.01;
    double speed_ = 1;
    int bodies_ = 0;
    int spaces_ = 0;
    std::vector<int> rays_; // slots of rays
};
} // namespace

const char *flavour_name(Flavour flavour)
{
    static const char *const names[flavour_count] = {"calm",    "mixed",     "wild",  "teleport", "pile",
                                                     "extreme", "explosion", "nests", "far"};
    return names[static_cast<int>(flavour)];
}

History make_history(const Profile &profile, std::uint64_t seed)
{
    return Generator(profile, seed * 1000003 + static_cast<std::uint64_t>(profile.flavour)).make();
}
} // namespace ode_predictive_space
