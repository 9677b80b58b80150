// Contract 14: the order of the callbacks depends on the program's calls, never on memory addresses.

#include <memory>
#include <random>

#include <ode_predictive_space/predictive_space.h>

#include "tests/contract/support/geom_zoo.h"
#include "tests/contract/support/scenario.h"

namespace ode_predictive_space
{
namespace
{
using Contract = OdeTest;

enum class Variation
{
    none,
    junk_on_the_heap,
    moves_in_reverse,
};

// Allocates and frees memory of many sizes, so that later allocations have other addresses than in another run.
class HeapJunk
{
public:
    void stir()
    {
        for (int i = 0; i < 40; ++i)
        {
            const std::size_t place = random_() % 200;
            pieces_.resize(200);
            pieces_[place] = std::make_unique<char[]>(16 + random_() % 600);
        }
    }

private:
    std::mt19937 random_{99};
    std::vector<std::unique_ptr<char[]>> pieces_;
};

class History
{
public:
    explicit History(Variation variation) : variation_(variation) {}

    std::vector<Pairs> run()
    {
        for (int i = 0; i < 150; ++i)
            make_geom(i);
        for (int tick = 0; tick < 150; ++tick)
        {
            move_geoms(tick);
            if (tick % 10 == 5)
                replace_geom(static_cast<std::size_t>(tick) * 7 % 150, tick);
            log_.push_back(collide(scene_.space()));
            log_.push_back(collide2(geoms_[3], as_geom(scene_.space())));
        }
        return log_;
    }

private:
    void make_geom(int i)
    {
        stir();
        geoms_.push_back(scene_.numbered(create_geom(static_cast<GeomKind>(i % 10), 1, scene_.space())));
        dGeomSetPosition(geoms_.back(), anywhere_(random_), anywhere_(random_), anywhere_(random_));
        if (i % 3 == 0)
            scene_.body(geoms_.back(), anywhere_(random_), anywhere_(random_), 0);
    }

    void replace_geom(std::size_t which, int tick)
    {
        stir();
        dGeomDestroy(geoms_[which]);
        geoms_[which] = scene_.sphere(0.7, 0.01 * tick, 0, 0);
    }

    void move_geoms(int tick)
    {
        // Moves may be reported in any order, as worker threads make them.
        for (std::size_t i = 0; i < geoms_.size(); ++i)
        {
            const std::size_t which = variation_ == Variation::moves_in_reverse ? geoms_.size() - 1 - i : i;
            if ((which + static_cast<std::size_t>(tick)) % 4 == 0)
                continue;
            const dReal *position = dGeomGetPosition(geoms_[which]);
            dGeomSetPosition(geoms_[which], position[0] + 0.02 * static_cast<dReal>(which % 5), position[1] * 0.99,
                             position[2]);
        }
    }

    void stir()
    {
        if (variation_ == Variation::junk_on_the_heap)
            junk_.stir();
    }

    Variation variation_;
    HeapJunk junk_;
    Scenario scene_{SpaceKind::predictive};
    std::mt19937 random_{5};
    std::uniform_real_distribution<dReal> anywhere_{-5, 5};
    std::vector<dGeomID> geoms_;
    std::vector<Pairs> log_;
};

void expect_same_sequence(Variation variation)
{
    const std::vector<Pairs> first = History(Variation::none).run();
    const std::vector<Pairs> second = History(variation).run();
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i)
        ASSERT_EQ(first[i], second[i]) << "in report " << i;
}

TEST_F(Contract, 14_TwoRunsGiveTheSameSequence)
{
    expect_same_sequence(Variation::none);
}

TEST_F(Contract, 14_AddressesDoNotMatter)
{
    expect_same_sequence(Variation::junk_on_the_heap);
}

TEST_F(Contract, 14_TheOrderOfMovesWithinATickDoesNotMatter)
{
    expect_same_sequence(Variation::moves_in_reverse);
}
} // namespace
} // namespace ode_predictive_space
