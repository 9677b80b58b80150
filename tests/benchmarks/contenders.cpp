#include "tests/benchmarks/contenders.h"

#include "ode_predictive_space/ode/pair_filter.h"

namespace ode_predictive_space::benchmarks
{
namespace
{
class BruteForceSpace : public dxSpace
{
public:
    BruteForceSpace() : dxSpace(nullptr) { type = dSimpleSpaceClass; }

    // ODE puts a geom that has moved at the front of the list.
    void cleanGeoms() override
    {
        for (dxGeom *geom = first; geom != nullptr && (geom->gflags & GEOM_DIRTY) != 0; geom = geom->next)
        {
            compute_box_beside_others(geom);
            geom->gflags &= ~GEOM_DIRTY;
        }
    }

    void collide(void *, dNearCallback *) override
    {
        ++lock_count;
        cleanGeoms();
        for_each_pair([](dxGeom *one, dxGeom *other) {
            dContactGeom contact;
            dCollide(one, other, 1, &contact, sizeof contact);
        });
        --lock_count;
    }

    void collide2(void *data, dxGeom *geom, dNearCallback *callback) override
    {
        ++lock_count;
        cleanGeoms();
        compute_box_beside_others(geom);
        for (dxGeom *own = first; own != nullptr; own = own->next)
            report(own, geom, data, callback);
        --lock_count;
    }

    void find_overlapping(worlds::PairList &list) const
    {
        for_each_pair([&](dxGeom *one, dxGeom *other) { report(one, other, &list, &worlds::PairList::collect); });
    }

private:
    /// The final test, as in ODE's own spaces: bits, bodies, boxes.
    static void report(dxGeom *one, dxGeom *other, void *data, dNearCallback *callback)
    {
        if (both_enabled(one, other) && bits_agree(one, other) && aabbs_overlap(one, other) &&
            wants_callback(one, other))
            callback(data, one, other);
    }

    template <class Function> void for_each_pair(Function function) const
    {
        for (dxGeom *one = first; one != nullptr; one = one->next)
        {
            for (dxGeom *other = one->next; other != nullptr; other = other->next)
            {
                if (bits_agree(one, other) && (one->body != other->body || one->body == nullptr))
                    function(one, other);
            }
        }
    }
};

class BruteForce : public worlds::Contender
{
public:
    explicit BruteForce(BruteForceSpace *space) : Contender("brute", worlds::OwnedSpace(space)), brute_(*space) {}

    std::size_t finish(worlds::PairList &list) override
    {
        brute_.find_overlapping(list);
        return 0;
    }

private:
    BruteForceSpace &brute_;
};
} // namespace

std::unique_ptr<worlds::Contender> make_contender(const std::string &name, const worlds::WorldFactory &factory)
{
    if (name == "brute")
        return std::make_unique<BruteForce>(new BruteForceSpace);
    return worlds::make_contender(worlds::space_named(name), factory);
}
} // namespace ode_predictive_space::benchmarks
