// A scene in one predictive space that continues while geoms come, go and change their size.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_SOAK_CHURNED_SCENE_H
#define ODE_PREDICTIVE_SPACE_TESTS_SOAK_CHURNED_SCENE_H

#include "demos/worlds/spaces.h"
#include "ode_predictive_space/haptics/device/random.h"

#include <memory>
#include <vector>

namespace ode_predictive_space::soak
{
/// Beside the geoms of the scene there are transients: spheres, boxes and capsules of the test, half of which move along
/// circles. Every few ticks a geom of the scene or a transient leaves the space and returns, at once or some ticks later, or a
/// transient is replaced or resized. The scene does not see the transients.
class ChurnedScene
{
public:
    /// @param ticks_per_copy ticks after which the scene is made again in the same space, or 0. It is for scenes that do not
    ///         stay as they begin (a pile settles, an explosion ends), or that keep all numbers or all reaches of a hand.
    ChurnedScene(const worlds::WorldSpec &spec, const std::string &space, int ticks_per_copy);
    ~ChurnedScene();
    ChurnedScene(const ChurnedScene &) = delete;
    ChurnedScene &operator=(const ChurnedScene &) = delete;

    void tick();

    /// Compares the report of the last tick with a comparison of all geoms. @return what is wrong, or an empty text.
    std::string wrong_pairs() const;

    dSpaceID space() const { return space_.get(); }

    const std::vector<worlds::IndexPair> &pairs() const { return pairs_; }

private:
    struct Transient
    {
        dGeomID geom;
        worlds::Vector3 home;
        double radius; ///< radius of its circle; 0: it does not move
    };
    struct Absent
    {
        bool is_transient;
        std::size_t number;
        int return_tick;
    };

    void renew_scene();
    Transient make_transient(std::size_t number);
    dGeomID make_geom();
    double any_size();
    void place(const Transient &transient) const;
    void change();
    void leave(bool is_transient, bool for_long);
    void return_due();
    void replace_transient();
    void resize_transient();
    void collide();
    void respond();
    dGeomID geom(bool is_transient, std::size_t number) const;
    std::vector<dGeomID> geoms_inside() const;

    worlds::WorldFactory factory_;
    worlds::OwnedSpace space_; // outlives its content
    std::unique_ptr<worlds::World> scene_;
    int ticks_per_copy_;
    bool by_shapes_;
    haptics::Random random_;
    std::vector<Transient> transients_;
    std::vector<Absent> absent_;
    worlds::PairList list_;
    std::vector<worlds::IndexPair> pairs_;
    std::vector<worlds::IndexPair> answers_; ///< pairs of dSpaceCollide2(), sorted
    int tick_ = 0;
};
} // namespace ode_predictive_space::soak

#endif
