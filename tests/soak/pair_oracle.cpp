#include "tests/soak/pair_oracle.h"

#include <algorithm>
#include <array>

namespace ode_predictive_space::soak
{
namespace
{
using worlds::IndexPair;

struct Record
{
    explicit Record(dGeomID the_geom)
        : geom(the_geom), number(worlds::geom_index(geom)), body(dGeomGetBody(geom)),
          category(dGeomGetCategoryBits(geom)), collide(dGeomGetCollideBits(geom))
    {
        dGeomGetAABB(geom, box.data());
    }

    dGeomID geom;
    std::uint32_t number;
    dBodyID body;
    unsigned long category, collide;
    std::array<dReal, 6> box{}; ///< the bounds along x, y and z
};

bool must_be_reported(const Record &a, const Record &b)
{
    const bool overlap = a.box[0] <= b.box[1] && b.box[0] <= a.box[1] && a.box[2] <= b.box[3] && b.box[2] <= a.box[3] &&
                         a.box[4] <= b.box[5] && b.box[4] <= a.box[5];
    return overlap && ((a.category & b.collide) != 0 || (b.category & a.collide) != 0) &&
           (a.body == nullptr || a.body != b.body);
}

GeomPair in_order(const Record &a, const Record &b)
{
    return a.number < b.number ? GeomPair{{a.number, b.number}, a.geom, b.geom}
                               : GeomPair{{b.number, a.number}, b.geom, a.geom};
}

std::vector<Record> records_of(const std::vector<dGeomID> &geoms)
{
    return {geoms.begin(), geoms.end()};
}

void sort(std::vector<GeomPair> &pairs)
{
    std::sort(pairs.begin(), pairs.end(), [](const GeomPair &a, const GeomPair &b) { return a.numbers < b.numbers; });
}
} // namespace

std::vector<GeomPair> overlapping_pairs(const std::vector<dGeomID> &geoms)
{
    const std::vector<Record> records = records_of(geoms);
    std::vector<GeomPair> pairs;
    for (std::size_t i = 0; i < records.size(); ++i)
    {
        for (std::size_t j = 0; j < i; ++j)
        {
            if (must_be_reported(records[i], records[j]))
            {
                pairs.push_back(in_order(records[i], records[j]));
            }
        }
    }
    sort(pairs);
    return pairs;
}

std::vector<GeomPair> pairs_of_queries(const std::vector<dGeomID> &queries, const std::vector<dGeomID> &geoms)
{
    const std::vector<Record> records = records_of(geoms);
    std::vector<GeomPair> pairs;
    for (const Record &query : records_of(queries))
    {
        for (const Record &record : records)
        {
            if (must_be_reported(query, record))
            {
                pairs.push_back(in_order(query, record));
            }
        }
    }
    sort(pairs);
    return pairs;
}
} // namespace ode_predictive_space::soak
