#include "tests/benchmarks/contenders/bullet_space.h"

#include "tests/benchmarks/contenders/boxes.h"
#include "tests/benchmarks/contenders/notice_space.h"

#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <algorithm>

namespace ode_predictive_space::benchmarks
{
namespace
{
constexpr int handles_of_16_bits = 16384;
constexpr int handles_to_spare = 1000; // walls, ground, probes

/// A corner within Bullet's range, also for an infinite geom.
btVector3 corner(const float *place)
{
    const auto bounded = [](float coordinate) { return std::clamp(coordinate, -BT_LARGE_FLOAT, BT_LARGE_FLOAT); };
    return {bounded(place[0]), bounded(place[1]), bounded(place[2])};
}

class BulletSpace : public NoticeSpace
{
public:
    /// @param owns_proxies whether the broad phase frees the proxies that it still has.
    BulletSpace(std::unique_ptr<btBroadphaseInterface> broadphase, bool owns_proxies)
        : broadphase_(std::move(broadphase)), owns_proxies_(owns_proxies)
    {}

    ~BulletSpace() override
    {
        for (btBroadphaseProxy *const proxy : proxies_)
        {
            if (!owns_proxies_)
            {
                destroy(proxy);
            }
        }
    }

    void collide(void *data, dNearCallback *callback) override
    {
        const Lock lock(*this);
        for (const Slot slot : take_moved())
        {
            place(slot);
        }
        broadphase_->calculateOverlappingPairs(nullptr);
        btOverlappingPairCache *const cache = broadphase_->getOverlappingPairCache();
        const btBroadphasePair *const pairs = cache->getOverlappingPairArrayPtr();
        const int count = cache->getNumOverlappingPairs();
        for (int i = 0; i < count; ++i)
        {
            report(static_cast<dxGeom *>(pairs[i].m_pProxy0->m_clientObject),
                   static_cast<dxGeom *>(pairs[i].m_pProxy1->m_clientObject), data, callback);
        }
    }

protected:
    void forget(Slot slot) override
    {
        if (slot < proxies_.size())
        {
            destroy(proxies_[slot]);
            proxies_[slot] = nullptr;
        }
    }

private:
    void place(Slot slot)
    {
        dxGeom *const geom = geom_in(slot);
        const FloatBox box = float_box_of(geom);
        if (slot >= proxies_.size())
        {
            proxies_.resize(slots(), nullptr);
        }
        if (proxies_[slot] == nullptr)
        {
            proxies_[slot] = broadphase_->createProxy(corner(box.low), corner(box.high), 0, geom, 1, 1, nullptr);
            return;
        }
        broadphase_->setAabb(proxies_[slot], corner(box.low), corner(box.high), nullptr);
    }

    void destroy(btBroadphaseProxy *proxy)
    {
        if (proxy != nullptr)
        {
            broadphase_->destroyProxy(proxy, nullptr);
        }
    }

    std::unique_ptr<btBroadphaseInterface> broadphase_;
    const bool owns_proxies_;
    std::vector<btBroadphaseProxy *> proxies_; // indexed by slot
};

std::unique_ptr<Contender> contender(std::unique_ptr<btBroadphaseInterface> broadphase, bool owns_proxies)
{
    return std::make_unique<Contender>(worlds::OwnedSpace(new BulletSpace(std::move(broadphase), owns_proxies)));
}

/// btAxisSweep3 frees its array of proxies at once. Destroying a proxy would sort it to the end of each axis.
std::unique_ptr<Contender> sweep_contender(std::unique_ptr<btBroadphaseInterface> broadphase)
{
    return contender(std::move(broadphase), true);
}

btVector3 bullet_vector(const worlds::Vector3 &v)
{
    return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}
} // namespace

std::unique_ptr<Contender> make_bullet_dbvt()
{
    return contender(std::make_unique<btDbvtBroadphase>(), false);
}

std::unique_ptr<Contender> make_bullet_sap(const worlds::WorldFactory &factory)
{
    const worlds::Bounds bounds = factory.bounds();
    const btVector3 low = bullet_vector(bounds.centre - bounds.half_extent);
    const btVector3 high = bullet_vector(bounds.centre + bounds.half_extent);
    const int handles = factory.spec().objects + handles_to_spare;
    if (handles <= handles_of_16_bits)
    {
        return sweep_contender(
            std::make_unique<btAxisSweep3>(low, high, static_cast<unsigned short>(handles), nullptr, true));
    }
    return sweep_contender(
        std::make_unique<bt32BitAxisSweep3>(low, high, static_cast<unsigned>(handles), nullptr, true));
}
} // namespace ode_predictive_space::benchmarks
