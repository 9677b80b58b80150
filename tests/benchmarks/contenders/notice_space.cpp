#include "tests/benchmarks/contenders/notice_space.h"

namespace ode_predictive_space::benchmarks
{
NoticeSpace::NoticeSpace() : dxSpace(nullptr)
{
    type = dSimpleSpaceClass;
}

// The geoms leave here: ~dxSpace no longer calls the functions of this class, and a geom must not keep a stale slot.
NoticeSpace::~NoticeSpace()
{
    while (first != nullptr)
    {
        give_back(first);
    }
}

// A geom's next_ex is reserved for its space; here it holds the slot.
NoticeSpace::Slot NoticeSpace::slot_of(const dxGeom *geom)
{
    return static_cast<Slot>(reinterpret_cast<std::uintptr_t>(geom->next_ex));
}

void NoticeSpace::add(dxGeom *geom)
{
    dxSpace::add(geom);
    if (free_.empty())
    {
        free_.push_back(slots());
        geoms_.push_back(nullptr);
    }
    const Slot slot = free_.back();
    free_.pop_back();
    geoms_[slot] = geom;
    // A number, not an address. NOLINTNEXTLINE(performance-no-int-to-ptr)
    geom->next_ex = reinterpret_cast<dxGeom *>(std::uintptr_t{slot});
    noticed_.push_back(slot);
}

void NoticeSpace::remove(dxGeom *geom)
{
    forget(slot_of(geom));
    give_back(geom);
}

void NoticeSpace::give_back(dxGeom *geom)
{
    const Slot slot = slot_of(geom);
    geoms_[slot] = nullptr;
    free_.push_back(slot);
    geom->next_ex = nullptr;
    dxSpace::remove(geom);
}

void NoticeSpace::dirty(dxGeom *geom)
{
    noticed_.push_back(slot_of(geom));
}

void NoticeSpace::cleanGeoms()
{
    for (const Slot slot : noticed_)
    {
        if (geoms_[slot] != nullptr)
        {
            compute_box_beside_others(geoms_[slot]);
        }
    }
}

const std::vector<NoticeSpace::Slot> &NoticeSpace::take_moved()
{
    moved_.clear();
    for (const Slot slot : noticed_)
    {
        dxGeom *const geom = geoms_[slot];
        if (geom != nullptr)
        {
            compute_box_beside_others(geom);
            geom->gflags &= ~GEOM_DIRTY;
            moved_.push_back(slot);
        }
    }
    noticed_.clear();
    return moved_;
}

void NoticeSpace::collide2(void *data, dxGeom *geom, dNearCallback *callback)
{
    const Lock lock(*this);
    cleanGeoms();
    compute_box_beside_others(geom);
    for (dxGeom *const own : geoms_)
    {
        if (own != nullptr)
        {
            report(own, geom, data, callback);
        }
    }
}
} // namespace ode_predictive_space::benchmarks
