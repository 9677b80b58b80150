// Notices: is a moved object still in its envelope?

#include "tests/benchmarks/micro/inputs.h"
#include "tests/broadphase/support/world.h"

#include <benchmark/benchmark.h>

namespace ode_predictive_space::micro
{
namespace
{
/// Objects that fly, each in an envelope around it.
struct Moved
{
    std::vector<Object> objects;
    std::vector<Place> places;
};

Moved moved_objects(std::size_t count, Watch watch)
{
    Random random(1);
    Moved result;
    for (std::size_t i = 0; i < count; ++i)
    {
        const Vector3 centre = random.vector(half_room(count));
        result.objects.push_back(watch == Watch::box ? box(centre, {0.05, 0.06, 0.06}, {0, 0, 0}, true)
                                                     : ball(centre, 0.1, {0, 0, 0}));
        Place place;
        const Float4 middle = Float4::nearest(centre.data());
        place.set_envelope({middle - Float4::all(0.2f), middle + Float4::all(0.2f)});
        place.watch_solid(solid_of(result.objects.back()));
        float start[4];
        middle.store(start);
        if (watch == Watch::centre)
            place.watch_centre(start, 0.1f, Origin().doubt());
        result.places.push_back(place);
    }
    return result;
}

/// All of them, one by one; items are objects.
void notices(benchmark::State &state, Watch watch)
{
    Moved moved = moved_objects(static_cast<std::size_t>(state.range(0)), watch);
    const Origin origin;
    std::size_t inside = 0;
    double move = 0.01;
    while (state.KeepRunning())
    {
        for (std::size_t i = 0; i < moved.places.size(); ++i)
        {
            Object &object = moved.objects[i];
            object.centre.x() += move;
            inside +=
                moved.places[i].follow(object.centre.data(), object.rotation.data(), origin) == Followed::moved ? 1 : 0;
        }
        move = -move;
    }
    if (inside != static_cast<std::size_t>(state.iterations()) * moved.places.size())
    {
        state.SkipWithError("an object is outside its envelope");
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}

void notice_of_a_centre(benchmark::State &state)
{
    notices(state, Watch::centre);
}
BENCHMARK(notice_of_a_centre)->ArgName("n")->Arg(100)->Arg(1000)->Arg(10000)->Arg(100000);

void notice_of_a_box(benchmark::State &state)
{
    notices(state, Watch::box);
}
BENCHMARK(notice_of_a_box)->ArgName("n")->Arg(100)->Arg(1000)->Arg(10000)->Arg(100000);
} // namespace
} // namespace ode_predictive_space::micro
