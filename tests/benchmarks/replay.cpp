#include "tests/benchmarks/replay.h"

#include "ode_predictive_space/space/ode_internals.h"
#include "tests/benchmarks/contenders/plain_sweep.h"

#include <algorithm>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
std::vector<dGeomID> geoms_by_number(dSpaceID space)
{
    std::vector<dGeomID> geoms(static_cast<std::size_t>(dSpaceGetNumGeoms(space)), nullptr);
    for (int i = 0; i < dSpaceGetNumGeoms(space); ++i)
    {
        const dGeomID geom = dSpaceGetGeom(space, i);
        const std::uint32_t number = scenes::geom_index(geom);
        if (number >= geoms.size() || geom->offset_posr != nullptr || geom->body_next != nullptr)
        {
            throw std::logic_error("the motion of this scene cannot be recorded");
        }
        geoms[number] = geom;
    }
    return geoms;
}

Move state_of(std::uint32_t number, dGeomID geom)
{
    Move move;
    move.index = number;
    if (geom->final_posr != nullptr)
    {
        std::copy_n(geom->final_posr->pos, move.position.size(), move.position.begin());
        std::copy_n(geom->final_posr->R, move.rotation.size(), move.rotation.begin());
    }
    if (geom->body != nullptr)
    {
        std::copy_n(dBodyGetLinearVel(geom->body), 3, move.velocity.begin());
        std::copy_n(dBodyGetAngularVel(geom->body), 3, move.angular_velocity.begin());
    }
    return move;
}

bool differ(const Move &a, const Move &b)
{
    return a.position != b.position || a.rotation != b.rotation || a.velocity != b.velocity ||
           a.angular_velocity != b.angular_velocity;
}
} // namespace

Recorder::Recorder(const scenes::SceneFactory &factory)
    : contender_(make_plain_sweep()), scene_(factory.make(contender_->space())),
      geoms_(geoms_by_number(contender_->space())), start_(changes())
{}

std::vector<Move> Recorder::changes()
{
    std::vector<Move> result;
    last_seen_.resize(geoms_.size());
    for (std::uint32_t number = 0; number < geoms_.size(); ++number)
    {
        const Move now = state_of(number, geoms_[number]);
        if (differ(now, last_seen_[number]))
        {
            last_seen_[number] = now;
            result.push_back(now);
        }
    }
    return result;
}

Motion Recorder::record(int ticks)
{
    Motion motion;
    for (int tick = 0; tick < ticks; ++tick)
    {
        scene_->advance();
        list_.clear();
        dSpaceCollide(contender_->space(), &list_, &scenes::PairList::collect);
        scene_->respond(list_.sorted());
        motion.push_back(changes());
    }
    return motion;
}

// Not every space can list its geoms (a quadtree cannot): they are made in one that can, and then change over.
Replay::Replay(const scenes::SceneFactory &factory, dSpaceID space)
    : nursery_(dSimpleSpaceCreate(nullptr)), scene_(factory.make(nursery_.get())),
      geoms_(geoms_by_number(nursery_.get()))
{
    for (const dGeomID geom : geoms_)
    {
        dSpaceRemove(nursery_.get(), geom);
        dSpaceAdd(space, geom);
    }
}

// What a step of the world does to a body's geom, but for the body's quaternion, which only the next step would read.
void Replay::make(const std::vector<Move> &moves)
{
    for (const Move &move : moves)
    {
        const dGeomID geom = geoms_[move.index];
        std::copy(move.position.begin(), move.position.end(), geom->final_posr->pos);
        std::copy(move.rotation.begin(), move.rotation.end(), geom->final_posr->R);
        if (geom->body != nullptr)
        {
            dBodySetLinearVel(geom->body, move.velocity[0], move.velocity[1], move.velocity[2]);
            dBodySetAngularVel(geom->body, move.angular_velocity[0], move.angular_velocity[1],
                               move.angular_velocity[2]);
        }
        dGeomMoved(geom);
    }
}
} // namespace ode_predictive_space::benchmarks
