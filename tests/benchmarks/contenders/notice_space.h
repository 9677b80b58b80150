// Base of the contenders that are not ODE spaces: a space that knows which of its geoms have moved.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_NOTICE_SPACE_H
#define ODE_PREDICTIVE_SPACE_TESTS_BENCHMARKS_CONTENDERS_NOTICE_SPACE_H

#include <cstdint>
#include <vector>

#include "ode_predictive_space/ode/internals.h"
#include "ode_predictive_space/ode/pair_filter.h"

namespace ode_predictive_space::benchmarks
{
/// Gives each geom a slot, a small number that is reused after the geom has left, and notes the slots of the geoms that ODE
/// reports as moved. Geoms that do not move cost nothing. Nested spaces are not supported.
class NoticeSpace : public dxSpace
{
public:
    using Slot = std::uint32_t;

    NoticeSpace();
    ~NoticeSpace() override;

    void add(dxGeom *geom) override;
    void remove(dxGeom *geom) override;
    void dirty(dxGeom *geom) override;
    void cleanGeoms() override;

    /// Tests every geom of the space, as the contenders have no index for queries.
    void collide2(void *data, dxGeom *geom, dNearCallback *callback) override;

protected:
    virtual void forget(Slot) {}

    /// Slots of geoms moved or added since the last call, with current boxes, until the next motion. A slot may occur twice.
    const std::vector<Slot> &take_moved();

    /// The geom in a slot, or null.
    dxGeom *geom_in(Slot slot) const { return geoms_[slot]; }

    Slot slots() const { return static_cast<Slot>(geoms_.size()); }

    /// The final test, as in ODE's own spaces: bits, bodies, boxes.
    static void report(dxGeom *first, dxGeom *second, void *data, dNearCallback *callback)
    {
        if (is_enabled(first) && is_enabled(second) && bits_agree(first, second) && aabbs_overlap(first, second) &&
            wants_callback(first, second))
            callback(data, first, second);
    }

    class Lock
    {
    public:
        explicit Lock(dxSpace &space) : space_(space) { ++space_.lock_count; }
        ~Lock() { --space_.lock_count; }
        Lock(const Lock &) = delete;
        Lock &operator=(const Lock &) = delete;

    private:
        dxSpace &space_;
    };

private:
    static bool is_enabled(const dxGeom *geom)
    {
        return (geom->gflags & GEOM_ENABLE_TEST_MASK) == GEOM_ENABLE_TEST_VALUE;
    }
    static Slot slot_of(const dxGeom *geom);
    void give_back(dxGeom *geom);

    std::vector<dxGeom *> geoms_; // indexed by slot
    std::vector<Slot> free_;
    std::vector<Slot> noticed_;
    std::vector<Slot> moved_;
};
} // namespace ode_predictive_space::benchmarks

#endif
