// A program whose space is recorded, or counted by callgrind like a replay of the recording.
//    counted_live SCENE box|shape         counts are for counted_changes and counted_collide
//    counted_live SCENE none              the same changes without a space that is collided
//    counted_live SCENE box|shape FILE    records it, and calls dCollide() for its pairs
// It prints the number of pairs and of contacts.

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <ode/ode.h>

#include "ode_predictive_space/history.h"
#include "ode_predictive_space/predictive_space.h"

namespace
{
class Scene
{
public:
    explicit Scene(dSpaceID space) : space_(space), world_(dWorldCreate()) {}
    virtual ~Scene() { dWorldDestroy(world_); }
    virtual void move(int tick) = 0;

protected:
    dReal random() { return static_cast<dReal>((seed_ = seed_ * 1664525u + 1013904223u) >> 8) / (1u << 24); }

    dSpaceID space_;
    dWorldID world_;

private:
    unsigned seed_ = 1;
};

// Like an engine with a separate world, it sets all poses at each tick, though one geom in twenty moves.
class PosesThatAreSet final : public Scene
{
public:
    explicit PosesThatAreSet(dSpaceID space) : Scene(space)
    {
        for (int i = 0; i < 400; ++i)
        {
            geoms_.push_back(i % 2 ? dCreateSphere(space_, REAL(0.2))
                                   : dCreateBox(space_, REAL(0.3), REAL(0.3), REAL(0.3)));
            places_.push_back({10 * random(), 10 * random(), 5 * random()});
        }
    }
    void move(int tick) override
    {
        dMatrix3 rotation;
        dRSetIdentity(rotation);
        for (std::size_t i = 0; i < geoms_.size(); ++i)
        {
            if (i % 20 == 0)
                places_[i].x += REAL(0.01) * std::sin(REAL(0.03) * static_cast<dReal>(tick));
            dGeomSetPosition(geoms_[i], places_[i].x, places_[i].y, places_[i].z);
            dGeomSetRotation(geoms_[i], rotation);
        }
    }

private:
    struct Point
    {
        dReal x, y, z;
    };
    std::vector<dGeomID> geoms_;
    std::vector<Point> places_;
};

dReal hill(void * /*data*/, int column, int row)
{
    return std::sin(REAL(0.7) * static_cast<dReal>(column)) * std::cos(REAL(0.5) * static_cast<dReal>(row));
}

class Terrain final : public Scene
{
public:
    explicit Terrain(dSpaceID space) : Scene(space), data_(dGeomHeightfieldDataCreate())
    {
        dGeomHeightfieldDataBuildCallback(data_, nullptr, hill, 40, 40, 41, 41, 1, 0, 1, 0);
        dGeomHeightfieldDataSetBounds(data_, -1, 1);
        dCreateHeightfield(space_, data_, 1);
        for (int i = 0; i < 150; ++i)
        {
            const dBodyID body = dBodyCreate(world_);
            dGeomSetBody(dCreateSphere(space_, REAL(0.4)), body);
            if (i % 3 == 0)
            {
                const dGeomID arm = dCreateBox(space_, 1, REAL(0.2), REAL(0.2));
                dGeomSetBody(arm, body);
                dGeomSetOffsetPosition(arm, REAL(0.5), 0, 0);
            }
            dBodySetPosition(body, 36 * random() - 18, 1 + random(), 36 * random() - 18);
            dBodySetLinearVel(body, random() - REAL(0.5), 0, random() - REAL(0.5));
            dBodySetAngularVel(body, 0, random() - REAL(0.5), 0);
        }
    }
    ~Terrain() override { dGeomHeightfieldDataDestroy(data_); }
    void move(int /*tick*/) override { dWorldStep(world_, REAL(0.01)); }

private:
    dHeightfieldDataID data_;
};

struct Collisions
{
    unsigned long calls = 0, contacts = 0;
};

void count(void *collisions, dGeomID /*first*/, dGeomID /*second*/)
{
    ++static_cast<Collisions *>(collisions)->calls;
}

void collide(void *data, dGeomID first, dGeomID second)
{
    dContactGeom found[8];
    Collisions &collisions = *static_cast<Collisions *>(data);
    ++collisions.calls;
    collisions.contacts += static_cast<unsigned long>(dCollide(first, second, 8, found, sizeof found[0]));
}
} // namespace

extern "C" {
__attribute__((noinline, visibility("default"))) void counted_changes(Scene *scene, int tick)
{
    scene->move(tick);
}

__attribute__((noinline, visibility("default"))) void counted_collide(dSpaceID space, Collisions *collisions,
                                                                      dNearCallback *callback)
{
    dSpaceCollide(space, collisions, callback);
}
}

int main(int words, char **word)
{
    if (words < 3)
        return 2;
    const std::string scene_name = word[1], kind = word[2];
    const char *file = words > 3 ? word[3] : nullptr;
    constexpr int ticks = 200;
    dInitODE2(0);
    const dSpaceID space = kind == "none" ? dSimpleSpaceCreate(nullptr) : dPredictiveSpaceCreate(nullptr);
    if (kind == "shape")
        dPredictiveSpaceSetProximity(space, dPredictiveProximityShape);
    Scene *const scene =
        scene_name == "terrain" ? static_cast<Scene *>(new Terrain(space)) : new PosesThatAreSet(space);
    if (file && !dPredictiveSpaceRecord(space, file, 0))
        return 2;
    scene->move(0);
    Collisions collisions;
    for (int tick = 1; tick <= ticks; ++tick)
    {
        if (kind != "none")
            counted_collide(space, &collisions, file ? collide : count);
        if (tick < ticks)
            counted_changes(scene, tick);
    }
    std::printf("%lu %lu\n", collisions.calls, collisions.contacts);
    dSpaceDestroy(space);
    delete scene;
    dCloseODE();
    return 0;
}
