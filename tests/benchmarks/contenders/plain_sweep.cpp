#include "tests/benchmarks/contenders/plain_sweep.h"

#include "ode_predictive_space/broadphase/index/sort_and_sweep.h"
#include "tests/benchmarks/contenders/boxes.h"
#include "tests/benchmarks/contenders/notice_space.h"

namespace ode_predictive_space::benchmarks
{
namespace
{
class PlainSweepSpace : public NoticeSpace
{
public:
    void collide(void *data, dNearCallback *callback) override
    {
        const Lock lock(*this);
        update_items();
        pairs_.clear();
        sort_and_sweep_.find_pairs(items_, pairs_);
        for (const CandidatePair &pair : pairs_)
        {
            report(geom_in(pair.first), geom_in(pair.second), data, callback);
        }
    }

protected:
    void forget(Slot) override { all_anew_ = true; }

private:
    static SweptProxy item_for(Slot slot, const dxGeom *geom) { return {slot, float_box_of(geom)}; }

    // Until a geom leaves, its item is at the index of its slot.
    void update_items()
    {
        const std::vector<Slot> &moved = take_moved();
        if (all_anew_ || items_.size() != slots())
        {
            make_items();
            return;
        }
        for (const Slot slot : moved)
        {
            items_[slot] = item_for(slot, geom_in(slot));
        }
    }

    void make_items()
    {
        items_.clear();
        for (Slot slot = 0; slot < slots(); ++slot)
        {
            if (geom_in(slot) != nullptr)
            {
                items_.push_back(item_for(slot, geom_in(slot)));
            }
        }
        all_anew_ = items_.size() != slots();
    }

    SortAndSweep sort_and_sweep_;
    std::vector<SweptProxy> items_;
    std::vector<CandidatePair> pairs_;
    bool all_anew_ = false;
};
} // namespace

std::unique_ptr<Contender> make_plain_sweep()
{
    return std::make_unique<Contender>(worlds::OwnedSpace(new PlainSweepSpace));
}
} // namespace ode_predictive_space::benchmarks
