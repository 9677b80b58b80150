#include "tests/benchmarks/contenders/floor.h"

#include "tests/benchmarks/contenders/notice_space.h"
#include "tests/benchmarks/contenders/plain_sweep.h"

#include <deque>
#include <string>
#include <utility>

namespace ode_predictive_space::benchmarks
{
namespace
{
using worlds::IndexPair;

class FloorSpace : public NoticeSpace
{
public:
    explicit FloorSpace(bool with_boxes) : with_boxes_(with_boxes) {}

    void add(dxGeom *geom) override
    {
        NoticeSpace::add(geom);
        moved_.push_back(geom);
    }

    void dirty(dxGeom *geom) override { moved_.push_back(geom); }

    void collide(void *data, dNearCallback *callback) override
    {
        double sum = 0;
        for (dxGeom *const geom : moved_)
        {
            if ((geom->gflags & GEOM_PLACEABLE) != 0)
            {
                geom->recomputePosr();
                const dReal *position = geom->final_posr->pos;
                sum += position[0] + position[1] + position[2];
            }
        }
        sum_of_positions_ = sum;
        if (with_boxes_)
        {
            compute_boxes();
        }
        for (const auto &[first, second] : known_.front())
        {
            callback(data, first, second);
        }
    }

    void learn(const std::vector<IndexPair> &pairs)
    {
        if (by_index_.size() != slots())
        {
            number_geoms();
        }
        known_.emplace_back();
        for (const auto &[first, second] : pairs)
        {
            known_.back().emplace_back(by_index_[first], by_index_[second]);
        }
    }

    void end_tick()
    {
        known_.pop_front();
        take_moved();
        for (dxGeom *const geom : moved_)
        {
            geom->gflags &= ~GEOM_DIRTY;
        }
        moved_.clear();
    }

private:
    void compute_boxes() const
    {
        for (const auto &[first, second] : known_.front())
        {
            first->recomputeAABB();
            second->recomputeAABB();
        }
    }

    void number_geoms()
    {
        by_index_.resize(slots());
        for (Slot slot = 0; slot < slots(); ++slot)
        {
            by_index_[worlds::geom_index(geom_in(slot))] = geom_in(slot);
        }
    }

    const bool with_boxes_;
    std::vector<dxGeom *> moved_;
    std::vector<dxGeom *> by_index_;
    std::deque<std::vector<std::pair<dxGeom *, dxGeom *>>> known_; // pairs of the ticks to come
    volatile double sum_of_positions_ = 0;
};

class Floor : public worlds::Contender
{
public:
    Floor(const std::string &name, const worlds::WorldFactory &factory, FloorSpace *space)
        : Contender(name, worlds::Family::reference, worlds::OwnedSpace(space)), floor_(*space),
          leader_(make_plain_sweep()), scene_(factory.make(leader_->space()))
    {}

    void prepare(int ticks) override
    {
        for (int tick = 0; tick < ticks; ++tick)
        {
            scene_->advance();
            list_.clear();
            dSpaceCollide(leader_->space(), &list_, &worlds::PairList::collect);
            const std::vector<IndexPair> pairs = list_.sorted();
            scene_->respond(pairs);
            floor_.learn(pairs);
        }
    }

    void end_tick() override { floor_.end_tick(); }

private:
    FloorSpace &floor_;
    std::unique_ptr<worlds::Contender> leader_; // outlives its scene, whose geoms are in its space
    std::unique_ptr<worlds::World> scene_;
    worlds::PairList list_;
};
} // namespace

std::unique_ptr<worlds::Contender> make_floor(const worlds::WorldFactory &factory)
{
    return std::make_unique<Floor>("floor", factory, new FloorSpace(false));
}

std::unique_ptr<worlds::Contender> make_floor_with_boxes(const worlds::WorldFactory &factory)
{
    return std::make_unique<Floor>("floor-boxes", factory, new FloorSpace(true));
}
} // namespace ode_predictive_space::benchmarks
