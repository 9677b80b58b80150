#include "tests/benchmarks/replay.h"

#include "ode_predictive_space/space/ode_internals.h"
#include "tests/benchmarks/contenders/plain_sweep.h"

#include <algorithm>
#include <stdexcept>

namespace ode_predictive_space::benchmarks
{
namespace
{
/// Does this geom stand for its body, or for itself?
bool leads(dGeomID geom)
{
    if (geom == nullptr)
    {
        throw std::logic_error("the motion of this scene cannot be recorded");
    }
    return geom->body == nullptr || dBodyGetFirstGeom(geom->body) == geom;
}

Move move_to(std::uint32_t number, dGeomID geom)
{
    Move move;
    move.index = number;
    if (geom->body != nullptr)
    {
        std::copy_n(dBodyGetPosition(geom->body), 3, move.position.begin());
        std::copy_n(dBodyGetRotation(geom->body), move.rotation.size(), move.rotation.begin());
        std::copy_n(dBodyGetLinearVel(geom->body), 3, move.velocity.begin());
        std::copy_n(dBodyGetAngularVel(geom->body), 3, move.angular_velocity.begin());
    }
    else if (geom->final_posr != nullptr)
    {
        std::copy_n(geom->final_posr->pos, 3, move.position.begin());
        std::copy_n(geom->final_posr->R, move.rotation.size(), move.rotation.begin());
    }
    return move;
}

/// Was the geom moved or set since it was collided, even to where it is?
bool was_noticed(dGeomID geom)
{
    return (geom->gflags & GEOM_DIRTY) != 0;
}

bool differ(const Move &a, const Move &b)
{
    return a.position != b.position || a.rotation != b.rotation || a.velocity != b.velocity ||
           a.angular_velocity != b.angular_velocity;
}
} // namespace

Recorder::Recorder(const worlds::WorldFactory &factory)
    : contender_(make_plain_sweep()), scene_(factory.make(contender_->space())), start_(changes())
{
    clean();
}

std::vector<Move> Recorder::changes()
{
    std::vector<Move> result;
    const std::vector<dGeomID> &geoms = scene_->geoms();
    last_seen_.resize(geoms.size());
    for (std::uint32_t number = 0; number < geoms.size(); ++number)
    {
        if (!leads(geoms[number]) || dGeomGetClass(geoms[number]) == dPlaneClass)
        {
            continue;
        }
        const Move now = move_to(number, geoms[number]);
        if (was_noticed(geoms[number]) || differ(now, last_seen_[number]))
        {
            last_seen_[number] = now;
            result.push_back(now);
        }
    }
    return result;
}

void Recorder::clean()
{
    list_.clear();
    scene_->collide(contender_->space(), &list_, worlds::PairList::near);
}

Motion Recorder::record(int ticks)
{
    Motion motion;
    for (int tick = 0; tick < ticks; ++tick)
    {
        scene_->advance();
        motion.push_back(changes());
        clean();
        scene_->respond(list_.sorted());
    }
    return motion;
}

Replay::Replay(const worlds::WorldFactory &factory, dSpaceID space) : scene_(factory.make(space)) {}

// What a step of the world does to a body and its geoms, but for the body's quaternion, which only the next step would read.
// ODE has no function that sets position and rotation with a single notice.
void Replay::make(const std::vector<Move> &moves)
{
    for (const Move &move : moves)
    {
        const dGeomID geom = scene_->geoms()[move.index];
        const dBodyID body = geom->body;
        if (body == nullptr)
        {
            std::copy_n(move.position.begin(), 3, geom->final_posr->pos);
            std::copy(move.rotation.begin(), move.rotation.end(), geom->final_posr->R);
            dGeomMoved(geom);
            continue;
        }
        std::copy_n(move.position.begin(), 3, const_cast<dReal *>(dBodyGetPosition(body)));
        std::copy(move.rotation.begin(), move.rotation.end(), const_cast<dReal *>(dBodyGetRotation(body)));
        dBodySetLinearVel(body, move.velocity[0], move.velocity[1], move.velocity[2]);
        dBodySetAngularVel(body, move.angular_velocity[0], move.angular_velocity[1], move.angular_velocity[2]);
        for (dGeomID one = dBodyGetFirstGeom(body); one != nullptr; one = dBodyGetNextGeom(one))
        {
            dGeomMoved(one);
        }
    }
}
} // namespace ode_predictive_space::benchmarks
