#include "tests/benchmarks/contenders/brute_force.h"

#include "tests/benchmarks/contenders/notice_space.h"

namespace ode_predictive_space::benchmarks
{
namespace
{
class BruteForceSpace : public NoticeSpace
{
public:
    void collide(void *, dNearCallback *) override
    {
        const Lock lock(*this);
        take_moved();
        for_each_pair([](dxGeom *first, dxGeom *second) {
            dContactGeom contact;
            dCollide(first, second, 1, &contact, sizeof contact);
        });
    }

    void find_overlapping(worlds::PairList &list)
    {
        for_each_pair(
            [&list](dxGeom *first, dxGeom *second) { report(first, second, &list, &worlds::PairList::collect); });
    }

private:
    static bool may_collide(const dxGeom *first, const dxGeom *second)
    {
        const bool bits_match = ((first->category_bits & second->collide_bits) != 0) ||
                                ((second->category_bits & first->collide_bits) != 0);
        return bits_match && (first->body != second->body || first->body == nullptr);
    }

    template <class Function> void for_each_pair(Function function) const
    {
        for (Slot i = 0; i < slots(); ++i)
        {
            for (Slot j = 0; j < i; ++j)
            {
                dxGeom *const first = geom_in(i);
                dxGeom *const second = geom_in(j);
                if (first != nullptr && second != nullptr && may_collide(first, second))
                {
                    function(first, second);
                }
            }
        }
    }
};

class BruteForce : public Contender
{
public:
    explicit BruteForce(BruteForceSpace *space) : Contender(worlds::OwnedSpace(space)), brute_(*space) {}

    void finish(worlds::PairList &list) override { brute_.find_overlapping(list); }

private:
    BruteForceSpace &brute_;
};
} // namespace

std::unique_ptr<Contender> make_brute_force()
{
    return std::make_unique<BruteForce>(new BruteForceSpace);
}
} // namespace ode_predictive_space::benchmarks
