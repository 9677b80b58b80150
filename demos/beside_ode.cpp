// Measures dSpaceCollide() with 1,000 balls in each of ODE's spaces and in the predictive one, and compares the reported pairs.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <ode/ode.h>
#include <ode_predictive_space/predictive_space.h>
#include <vector>

namespace
{
constexpr int balls = 1000;
constexpr int ticks = 2000;
constexpr double room = 10;          // metres along each side
constexpr double tick_length = 1e-3; // seconds

struct Reported
{
    std::uint64_t pairs = 0;
    std::uint64_t hash = 0;
};

void note_pair(void *reported, dGeomID first, dGeomID second)
{
    const std::uint64_t a = reinterpret_cast<std::uintptr_t>(dGeomGetData(first));
    const std::uint64_t b = reinterpret_cast<std::uintptr_t>(dGeomGetData(second));
    auto *notes = static_cast<Reported *>(reported);
    ++notes->pairs;
    notes->hash += (a + b) * (a + b) * (a * b); // the same for a pair and its reverse, and in any order of pairs
}

/// Every second ball drifts, by a sequence that is the same in each world.
void fill(dWorldID world, dSpaceID space)
{
    std::uint32_t state = 1;
    const auto random = [&state](double from, double to) {
        state = 1664525 * state + 1013904223;
        return from + (to - from) * (state >> 8) / (1 << 24);
    };
    for (std::uintptr_t i = 1; i <= balls; ++i)
    {
        const dGeomID ball = dCreateSphere(space, random(0.1, 0.2));
        dGeomSetData(ball, reinterpret_cast<void *>(i));
        const double x = random(0, room), y = random(0, room), z = random(0, room);
        dGeomSetPosition(ball, x, y, z);
        if (i % 2 == 0)
            continue;
        const dBodyID body = dBodyCreate(world);
        dBodySetPosition(body, x, y, z);
        dBodySetLinearVel(body, random(-1, 1), random(-1, 1), random(-1, 1));
        dGeomSetBody(ball, body);
    }
}

/// @return median microseconds in dSpaceCollide() per tick.
double measure(dSpaceID space, Reported &reported)
{
    using Clock = std::chrono::steady_clock;
    const dWorldID world = dWorldCreate();
    fill(world, space);
    std::vector<Clock::duration> spent;
    for (int tick = 0; tick < ticks; ++tick)
    {
        const Clock::time_point begin = Clock::now();
        dSpaceCollide(space, &reported, &note_pair);
        spent.push_back(Clock::now() - begin);
        dWorldQuickStep(world, tick_length);
    }
    dSpaceDestroy(space);
    dWorldDestroy(world);
    std::nth_element(spent.begin(), spent.begin() + ticks / 2, spent.end());
    return std::chrono::duration<double, std::micro>(spent[ticks / 2]).count();
}

struct Row
{
    const char *name;
    dSpaceID (*create)();
};

const Row rows[] = {
    {"dHashSpace", [] { return dHashSpaceCreate(nullptr); }},
    {"dQuadTreeSpace",
     [] {
         const dVector3 centre = {room / 2, room / 2, room / 2}, extents = {room / 2, room / 2, room / 2};
         return dQuadTreeSpaceCreate(nullptr, centre, extents, 5);
     }},
    {"dSweepAndPruneSpace", [] { return dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ); }},
    {"dPredictiveSpace", [] { return dPredictiveSpaceCreate(nullptr); }},
};
} // namespace

int main()
{
    dInitODE2(0);
    std::printf("%d balls in a room, half of them at rest; %d ticks of %g ms.\n"
                "Microseconds in dSpaceCollide() per tick, medians, without contacts and the step\nof the world:\n\n",
                balls, ticks, 1e3 * tick_length);
    Reported first;
    bool same = true;
    double best_of_ode = std::numeric_limits<double>::infinity(), last = best_of_ode;
    for (const Row &row : rows)
    {
        best_of_ode = std::min(best_of_ode, last);
        Reported reported;
        last = measure(row.create(), reported);
        std::printf("  %-20s %9.2f\n", row.name, last);
        std::fflush(stdout);
        if (first.pairs == 0)
            first = reported;
        same = same && reported.pairs == first.pairs && reported.hash == first.hash;
    }
    std::printf("\nThe predictive space is %.0f times as fast as the best of ODE's.\n", best_of_ode / last);
    if (same)
        std::printf("All four reported the same %llu pairs.\n", static_cast<unsigned long long>(first.pairs));
    else
        std::printf("They did NOT report the same pairs.\n");
    dCloseODE();
    return same ? 0 : 1;
}
