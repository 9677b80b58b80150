#include "tests/differential/comparison.h"

#include <algorithm>
#include <memory>
#include <sstream>

#include <ode_predictive_space/predictive_space.h>

#include "tests/differential/universe.h"

namespace ode_predictive_space
{
namespace
{
struct Broken : std::runtime_error
{
    FailureKind kind;
    Broken(FailureKind kind, const std::string &text) : std::runtime_error(text), kind(kind) {}
};

std::string to_text(const Pairs &pairs)
{
    std::ostringstream text;
    for (const Pair &pair : pairs)
        text << " (" << pair.first << ", " << pair.second << ")";
    return text.str();
}

Pairs without(const Pairs &pairs, const Pairs &others)
{
    Pairs rest;
    std::set_difference(pairs.begin(), pairs.end(), others.begin(), others.end(), std::back_inserter(rest));
    return rest;
}

// A small space predicts once it has been validated. So the first part of a history, one over this number, is not validated.
constexpr std::size_t unvalidated_part = 5;

class TwinRun
{
public:
    TwinRun(const History &history, const Terms &terms, Tally &tally)
        : terms_(terms), tally_(tally), reference_(SpaceKind::simple, history), tested_(SpaceKind::predictive, history)
    {
        if (terms.measure != Measure::boxes)
            tested_.measure_by(terms.measure == Measure::spheres ? dPredictiveProximitySphere
                                                                 : dPredictiveProximityShape);
    }

    void begin_to_validate() { validates_ = terms_.with_invariant; }

    void apply(const Operation &operation)
    {
        switch (operation.action)
        {
        case Action::tick:
            return tick();
        case Action::calm:
            for (int i = 0; i < operation.number; ++i)
            {
                for (int step = 0; step < operation.object; ++step)
                    in_both([&](Universe &universe) { universe.step(operation.value[0]); });
                tick();
            }
            return;
        case Action::query:
            return compare_pairs(
                [&](Universe &universe) { return universe.query(operation.subject, operation.object); });
        case Action::tick_asking:
            // A pair that is left out makes no query, so answers are compared by boxes only.
            if (terms_.measure == Measure::boxes)
                return compare_pairs([](Universe &universe) { return universe.tick_asking(); });
            return tick();
        default:
            in_both([&](Universe &universe) { universe.apply(operation); });
        }
    }

private:
    template <typename Act> static auto watched(Universe &universe, FailureKind kind, Act act)
    {
        try
        {
            return act(universe);
        }
        catch (const OdeAbort &abort)
        {
            const char *where = kind == FailureKind::abort ? "predictive" : "simple";
            throw Broken(kind, std::string("ODE aborted in the ") + where + " universe: " + abort.what());
        }
    }

    template <typename Act> void in_both(Act act)
    {
        watched(reference_, FailureKind::abort_in_reference, act);
        watched(tested_, FailureKind::abort, act);
    }

    void tick()
    {
        ++tally_.ticks;
        compare_pairs([](Universe &universe) { return universe.tick(); });
        // Validation is by brute force, so a large scene is not validated at every tick.
        const std::size_t every = 1 + reference_.geom_count() * reference_.geom_count() / 4000;
        if (validates_ && tally_.ticks % every == 0 &&
            !watched(tested_, FailureKind::abort, [](Universe &universe) { return universe.valid(); }))
            throw Broken(FailureKind::invariant, "the invariant does not hold: " + OdeMessages::text());
    }

    template <typename Ask> void compare_pairs(Ask ask)
    {
        const Pairs expected = watched(reference_, FailureKind::abort_in_reference, ask);
        compare_pairs(expected, watched(tested_, FailureKind::abort, ask));
    }

    void compare_pairs(const Pairs &expected, const Pairs &reported)
    {
        tally_.pairs += reported.size();
        if (expected == reported)
            return;
        const Pairs missing = without(expected, reported);
        const Pairs extra = without(reported, expected);
        if (terms_.measure != Measure::boxes && extra.empty())
            return expect_no_contacts(missing);
        throw Broken(FailureKind::pairs, "missing:" + to_text(missing) + "; not expected:" + to_text(extra));
    }

    void expect_no_contacts(const Pairs &left_out)
    {
        tally_.left_out += left_out.size();
        for (const Pair &pair : left_out)
        {
            if (reference_.contacts_between(pair.first, pair.second) > 0)
                throw Broken(FailureKind::pairs, "left out, but in contact:" + to_text(Pairs{pair}) + ", " +
                                                     reference_.kind_name(pair.first) + " and " +
                                                     reference_.kind_name(pair.second));
        }
    }

    Terms terms_;
    Tally &tally_;
    bool validates_ = false;
    Universe reference_;
    Universe tested_;
};

class Shrinker
{
public:
    Shrinker(const History &history, const Terms &terms, FailureKind kind, int most_runs)
        : history_(history), terms_(terms), kind_(kind), runs_left_(most_runs)
    {}

    History shrink()
    {
        for (std::size_t length = history_.operations.size() / 2; length > 0 && runs_left_ > 0;)
        {
            if (!drop_runs(length) || length > 1)
                length /= 2;
        }
        shorten_calms();
        return history_;
    }

private:
    bool take_if_it_fails(const History &shorter)
    {
        --runs_left_;
        const auto failure = compare(shorter, terms_);
        if (!failure || failure->kind != kind_)
            return false;
        history_ = shorter;
        return true;
    }

    bool drop_runs(std::size_t length)
    {
        bool dropped = false;
        for (std::size_t end = history_.operations.size(); end > 0 && runs_left_ > 0;)
        {
            const std::size_t begin = end > length ? end - length : 0;
            History shorter = history_;
            shorter.operations.erase(shorter.operations.begin() + static_cast<std::ptrdiff_t>(begin),
                                     shorter.operations.begin() + static_cast<std::ptrdiff_t>(end));
            dropped |= take_if_it_fails(shorter);
            end = begin;
        }
        return dropped;
    }

    void shorten_calms()
    {
        for (std::size_t i = 0; i < history_.operations.size(); ++i)
        {
            bool shortened = history_.operations[i].action == Action::calm;
            while (shortened && history_.operations[i].number > 1 && runs_left_ > 0)
            {
                History shorter = history_;
                shorter.operations[i].number /= 2;
                shortened = take_if_it_fails(shorter);
            }
        }
    }

    History history_;
    Terms terms_;
    FailureKind kind_;
    int runs_left_;
};
} // namespace

std::optional<Failure> compare(const History &history, const Terms &terms, Tally *tally)
{
    const OdeMessages messages;
    Tally own_tally;
    std::size_t at = 0;
    auto run = std::make_unique<TwinRun>(history, terms, tally ? *tally : own_tally);
    try
    {
        for (; at < history.operations.size(); ++at)
        {
            if (unvalidated_part * at >= history.operations.size())
                run->begin_to_validate();
            run->apply(history.operations[at]);
        }
    }
    catch (const Broken &broken)
    {
        // A universe in which ODE aborted stays locked, and cannot be destroyed.
        if (broken.kind == FailureKind::abort || broken.kind == FailureKind::abort_in_reference)
            static_cast<void>(run.release());
        return Failure{broken.kind, at, broken.what()};
    }
    return std::nullopt;
}

History shrink(const History &history, const Terms &terms, int most_runs)
{
    const auto failure = compare(history, terms);
    if (!failure)
        return history;
    History cut = history;
    cut.operations.resize(failure->operation + 1);
    return Shrinker(cut, terms, failure->kind, most_runs).shrink();
}

std::string report_of(const Profile &profile, std::uint64_t seed, const Terms &terms, Tally *tally)
{
    const History history = make_history(profile, seed);
    const auto failure = compare(history, terms, tally);
    if (!failure)
        return "";
    std::ostringstream text;
    text << "operation " << failure->operation << ": " << failure->text
         << "\nreplay: predictive_differential --flavour " << flavour_name(profile.flavour) << " --seed " << seed
         << " --histories 1 --geoms " << profile.geoms << " --ticks " << profile.ticks
         << (profile.nested_spaces ? "" : " --flat") << (terms.measure == Measure::spheres ? " --spheres" : "")
         << (terms.measure == Measure::shapes ? " --shapes" : "") << "\n";
    const History shrunk = shrink(history, terms);
    const auto shrunk_failure = compare(shrunk, terms);
    text << "shrunk: " << (shrunk_failure ? shrunk_failure->text : std::string("fails no more")) << "\n"
         << to_text(shrunk);
    return text.str();
}
} // namespace ode_predictive_space
