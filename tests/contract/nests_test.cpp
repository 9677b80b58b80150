// Contract 11: all nests of four spaces of all classes, compared with the nest that has a simple space in the place of each
// predictive one. The spaces hold what ODE's dGeomMoved() and cleanGeoms() rest on, too.

#include <array>
#include <functional>
#include <ostream>
#include <string>
#include <tuple>
#include <vector>

#include <ode_predictive_space/predictive_space.h>

#include "ode_predictive_space/space/ode_internals.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
enum class Class
{
    simple,
    hash,
    sweep_and_prune,
    quadtree,
    predictive
};
constexpr std::array class_names{"simple", "hash", "sweep_and_prune", "quadtree", "predictive"};

constexpr std::size_t depth = 4;
/// From the outermost space to the innermost.
using Classes = std::array<Class, depth>;

std::string to_text(const Classes &classes)
{
    std::string text;
    for (Class each : classes)
        text += std::string(text.empty() ? "" : " > ") + class_names[static_cast<std::size_t>(each)];
    return text;
}

bool is_as_simple(Class kind)
{
    return kind == Class::simple || kind == Class::predictive;
}

/// When the predictive spaces of a nest begin to predict.
enum class Predicting
{
    when_asked, ///< they have few geoms
    at_once,    ///< they have few geoms, and one of these gets a role
    later,      ///< as before, after the first update
    when_filled ///< they have many geoms
};

dSpaceID make_space(Class kind, dSpaceID parent)
{
    const dVector3 centre = {0, 0, 0}, extents = {500, 500, 500};
    switch (kind)
    {
    case Class::simple:
        return dSimpleSpaceCreate(parent);
    case Class::hash:
        return dHashSpaceCreate(parent);
    case Class::sweep_and_prune:
        return dSweepAndPruneSpaceCreate(parent, dSAP_AXES_XYZ);
    case Class::quadtree:
        return dQuadTreeSpaceCreate(parent, centre, extents, 2);
    default:
        return dPredictiveSpaceCreate(parent);
    }
}

/// What one program saw.
struct Log
{
    std::vector<Pairs> pairs;
    std::vector<std::array<dReal, 6>> boxes;
    std::string failure; ///< an assertion of ODE, or a broken invariant

    bool operator==(const Log &other) const
    {
        return pairs == other.pairs && boxes == other.boxes && failure == other.failure;
    }
};

std::ostream &operator<<(std::ostream &out, const Log &log)
{
    out << "failure: '" << log.failure << "'";
    for (const Pairs &pairs : log.pairs)
    {
        out << "\n  pairs:";
        for (const Pair &pair : pairs)
            out << " " << pair.first << "-" << pair.second;
    }
    for (const auto &box : log.boxes)
    {
        out << "\n  box:";
        for (dReal side : box)
            out << " " << side;
    }
    return out;
}

void enter_spaces(void *data, dGeomID first, dGeomID second)
{
    static_cast<Pairs *>(data)->push_back({geom_number(first), geom_number(second)});
    if (dGeomIsSpace(first) || dGeomIsSpace(second))
        dSpaceCollide2(first, second, data, enter_spaces);
}

/// Four spaces in each other, and a probe outside. Each space holds a post and a mover, 100 m from those of the next.
class Nest
{
public:
    Nest(const Classes &classes, Predicting predicting) : classes_(classes), predicting_(predicting)
    {
        probe_ = number_geom(dCreateSphere(nullptr, 0.5), next_number_++);
        dSpaceID parent = nullptr;
        for (std::size_t level = 0; level < depth; ++level)
        {
            spaces_[level] = parent = make_space(classes[level], parent);
            number_geom(as_geom(parent), next_number_++);
            parents_[level] = level - 1;
            movers_[level] = sphere(level, 3);
            if (predicting == Predicting::when_filled && is_as_simple(classes[level]))
                for (int i = 0; i < 15; ++i) // at least 17 with the others: a predictive space scans 16
                    sphere(level, 6 + 3 * i);
        }
        // Last, so that the inner space is not the first in ODE's lists, where cleanGeoms() finds a dirty geom by chance.
        for (std::size_t level = 0; level < depth; ++level)
            sphere(level, 0);
        if (predicting == Predicting::at_once)
            set_roles();
    }
    Nest(const Nest &) = delete;
    Nest &operator=(const Nest &) = delete;

    // A space that ODE has left by an assertion stays locked, so that it cannot be destroyed.
    ~Nest()
    {
        if (!log_.failure.empty())
            return;
        for (std::size_t level = 0; level < depth; ++level)
            if (spaces_[level] && parents_[level] == outside)
                dSpaceDestroy(spaces_[level]);
        dGeomDestroy(probe_);
    }

    const Log &log() const { return log_; }

    void collide(std::size_t level)
    {
        note([&](Pairs *pairs) { dSpaceCollide(spaces_[level], pairs, enter_spaces); });
    }
    void ask(std::size_t level)
    {
        note([&](Pairs *pairs) { dSpaceCollide2(probe_, as_geom(spaces_[level]), pairs, enter_spaces); });
    }
    void clean(std::size_t level) { dSpaceClean(spaces_[level]); }
    void ask_bounds(std::size_t level)
    {
        std::array<dReal, 6> box{};
        dGeomGetAABB(as_geom(spaces_[level]), box.data());
        log_.boxes.push_back(box);
    }

    void note_first_update()
    {
        if (predicting_ == Predicting::later)
            set_roles();
    }

    /// To a post of another level.
    void move(std::size_t level) { place(level, level == 0 ? 100.4 : 0.4); }
    void move_back(std::size_t level) { place(level, 100 * static_cast<dReal>(level) + 3); }

    void take_out(std::size_t level)
    {
        dSpaceRemove(spaces_[parents_[level]], as_geom(spaces_[level]));
        parents_[level] = outside;
    }
    // ODE's own spaces stop at an assertion when a clean geom is added while another is dirty.
    void put_in(std::size_t level, std::size_t parent)
    {
        if (classes_[parent] != Class::predictive)
            dSpaceClean(spaces_[parent]);
        dSpaceAdd(spaces_[parent], as_geom(spaces_[level]));
        parents_[level] = parent;
    }
    void destroy(std::size_t level)
    {
        dSpaceDestroy(spaces_[level]);
        for (; level < depth; ++level)
            spaces_[level] = nullptr;
    }
    bool has(std::size_t level) const { return spaces_[level] != nullptr; }

    template <typename Program> void run(const Program &program)
    {
        try
        {
            program(*this);
            for (std::size_t level = 0; level < depth; ++level)
                if (has(level) && classes_[level] == Class::predictive && !dPredictiveSpaceValidate(spaces_[level]))
                    log_.failure = "the invariant does not hold at level " + std::to_string(level);
        }
        catch (const OdeAbort &abort)
        {
            log_.failure = abort.what();
        }
    }

    /// ODE: a space is dirty while a geom in it is, and a geom with a bad box is dirty. (Within a predictive space, the latter
    /// need not hold.)
    void check_flags()
    {
        for (std::size_t level = 0; level < depth; ++level)
        {
            if (!has(level))
                continue;
            const int space_flags = as_geom(spaces_[level])->gflags;
            for (dGeomID geom = spaces_[level]->first; geom; geom = geom->next)
            {
                if ((geom->gflags & GEOM_DIRTY) && !(space_flags & GEOM_DIRTY))
                    log_.failure = "a dirty geom is in a clean space at level " + std::to_string(level);
                if ((geom->gflags & GEOM_AABB_BAD) && !(geom->gflags & GEOM_DIRTY) &&
                    classes_[level] != Class::predictive)
                    log_.failure = "a clean geom has a bad box at level " + std::to_string(level);
            }
        }
    }

private:
    static constexpr std::size_t outside = std::size_t{0} - 1;

    dGeomID sphere(std::size_t level, dReal x)
    {
        const dGeomID geom = number_geom(dCreateSphere(spaces_[level], 0.5), next_number_++);
        dGeomSetPosition(geom, 100 * static_cast<dReal>(level) + x, 0, 0);
        return geom;
    }
    void set_roles()
    {
        for (std::size_t level = 0; level < depth; ++level)
            if (classes_[level] == Class::predictive)
                dPredictiveSpaceSetGeomRole(spaces_[level], movers_[level], dPredictiveRoleInteractive);
    }
    void place(std::size_t level, dReal x)
    {
        if (has(level))
            dGeomSetPosition(movers_[level], x, 0, 0);
    }
    template <typename Call> void note(const Call &call)
    {
        Pairs pairs;
        call(&pairs);
        log_.pairs.push_back(unordered(pairs));
    }

    Classes classes_;
    Predicting predicting_;
    dGeomID probe_;
    std::array<dSpaceID, depth> spaces_{};
    std::array<std::size_t, depth> parents_{};
    std::array<dGeomID, depth> movers_{};
    int next_number_ = 0;
    Log log_;
};

/// What brings a space up to date.
using Step = void (Nest::*)(std::size_t level);
struct Update
{
    Step step;
    std::size_t level;
    void operator()(Nest &nest) const
    {
        if (nest.has(level))
            (nest.*step)(level);
        nest.check_flags();
    }
};

std::vector<Update> all_updates()
{
    std::vector<Update> updates;
    for (Step step : {&Nest::collide, &Nest::ask, &Nest::clean, &Nest::ask_bounds})
        for (std::size_t level = 0; level < depth; ++level)
            updates.push_back({step, level});
    return updates;
}

void move_and_collide(Nest &nest, std::size_t level)
{
    nest.move(level);
    Update{&Nest::collide, 0}(nest);
    nest.move_back(level);
    Update{&Nest::collide, 0}(nest);
}

using Program = std::function<void(Nest &)>;

/// A move at each level between any two updates of any two spaces.
void for_each_move(const std::function<void(const std::string &name, const Program &)> &visit)
{
    const std::vector<Update> updates = all_updates();
    for (std::size_t first = 0; first < updates.size(); ++first)
        for (std::size_t second = 0; second < updates.size(); ++second)
            for (std::size_t level = 0; level < depth; ++level)
                visit("update " + std::to_string(first) + ", move at level " + std::to_string(level) + ", update " +
                          std::to_string(second),
                      [&](Nest &nest) {
                          updates[first](nest);
                          nest.note_first_update();
                          nest.move(level);
                          updates[second](nest);
                          Update{&Nest::collide, 0}(nest);
                          nest.move_back(level);
                          Update{&Nest::collide, 0}(nest);
                      });
}

/// After each update and each move, each inner space goes out of its parent, and back or into each of the spaces around that, or
/// it is destroyed. While it is outside, it is updated or not.
void for_each_change(const std::function<void(const std::string &name, const Program &)> &visit)
{
    const std::vector<Update> updates = all_updates();
    for (std::size_t first = 0; first < updates.size(); ++first)
        for (std::size_t level = 0; level < depth; ++level)
            for (std::size_t inner = 1; inner < depth; ++inner)
                for (std::size_t parent = 0; parent <= inner; ++parent)
                    visit("update " + std::to_string(first) + ", move at level " + std::to_string(level) +
                              ", the space at level " + std::to_string(inner) +
                              (parent == inner ? " is destroyed" : " goes to level " + std::to_string(parent)),
                          [&](Nest &nest) {
                              updates[first](nest);
                              nest.note_first_update();
                              nest.move(level);
                              if (parent < inner)
                              {
                                  nest.take_out(inner);
                                  nest.check_flags();
                                  if (first % 2)
                                      Update{&Nest::collide, inner}(nest);
                                  nest.move_back(level);
                                  nest.put_in(inner, parent);
                              }
                              else
                                  nest.destroy(inner);
                              nest.check_flags();
                              for (std::size_t each = 0; each < depth; ++each)
                                  move_and_collide(nest, each);
                          });
}

Log log_of(const Classes &classes, Predicting predicting, const Program &program)
{
    Nest nest(classes, predicting);
    nest.run(program);
    return nest.log();
}

/// All nests of ODE's own spaces with this outermost one.
std::vector<Classes> nests_of_ode(Class outermost)
{
    std::vector<Classes> nests{{outermost}};
    for (std::size_t level = 1; level < depth; ++level)
    {
        std::vector<Classes> deeper;
        for (Classes nest : nests)
            for (Class inner : {Class::simple, Class::hash, Class::sweep_and_prune, Class::quadtree})
            {
                nest[level] = inner;
                deeper.push_back(nest);
            }
        nests = std::move(deeper);
    }
    return nests;
}

/// The nest with a predictive space in the place of at least one simple one, in all variants.
std::vector<Classes> with_predictive_spaces(const Classes &nest)
{
    std::vector<Classes> variants{nest};
    for (std::size_t level = 0; level < depth; ++level)
        for (std::size_t i = variants.size(); i > 0 && nest[level] == Class::simple; --i)
        {
            variants.push_back(variants[i - 1]);
            variants.back()[level] = Class::predictive;
        }
    variants.erase(variants.begin());
    return variants;
}

class AllNests : public OdeTest, public ::testing::WithParamInterface<std::tuple<Class, Predicting>>
{
protected:
    /// Runs a program in all nests whose outermost space is of the class, or predictive in the place of a simple one.
    void expect_as_simple(const std::string &name, const Program &program) const
    {
        const auto [outermost, predicting] = GetParam();
        for (const Classes &reference : nests_of_ode(outermost))
        {
            const std::vector<Classes> variants = with_predictive_spaces(reference);
            if (variants.empty())
                continue;
            const Log expected = log_of(reference, predicting, program);
            ASSERT_EQ(expected.failure, "") << to_text(reference) << ": " << name;
            for (const Classes &classes : variants)
                ASSERT_EQ(log_of(classes, predicting, program), expected) << to_text(classes) << ": " << name;
        }
    }
};

TEST_P(AllNests, MovesAreSeenBetweenAnyTwoUpdates)
{
    for_each_move([this](const std::string &name, const Program &program) {
        if (!HasFatalFailure())
            expect_as_simple(name, program);
    });
}

TEST_P(AllNests, InnerSpacesChangeTheirParents)
{
    for_each_change([this](const std::string &name, const Program &program) {
        if (!HasFatalFailure())
            expect_as_simple(name, program);
    });
}

constexpr std::array predicting_names{"predicting_when_asked", "predicting_at_once", "predicting_later",
                                      "predicting_when_filled"};

INSTANTIATE_TEST_SUITE_P(Contract11, AllNests,
                         ::testing::Combine(::testing::Values(Class::simple, Class::hash, Class::sweep_and_prune,
                                                              Class::quadtree),
                                            ::testing::Values(Predicting::when_asked, Predicting::at_once,
                                                              Predicting::later, Predicting::when_filled)),
                         [](const ::testing::TestParamInfo<AllNests::ParamType> &info) {
                             return std::string(class_names[static_cast<std::size_t>(std::get<0>(info.param))]) + "_" +
                                    predicting_names[static_cast<std::size_t>(std::get<1>(info.param))];
                         });
} // namespace
} // namespace ode_predictive_space
