// Compiled twice: with ODE's own internal headers, and with ours.

#include "tests/layout/facts.h"

#include <cstddef>
#include <cstring>

#ifdef FACTS_OF_ODE
#include <ode/ode.h>

#include "collision_kernel.h"
#include "collision_std.h"
#define facts_of_these_headers facts_of_odes_headers
#else
#include "ode_predictive_space/ode/layout.h"
#define facts_of_these_headers facts_of_our_header
#endif

namespace
{
// In the C++ ABI of Linux, the first word of a pointer to a virtual member function gives its place in the table of functions;
// on some processors the mark is in the second word instead of the first.
template <typename Member> long place_of(Member function)
{
    static_assert(sizeof function == 2 * sizeof(long), "two words");
    long words[2];
    std::memcpy(words, &function, sizeof words);
    const bool is_virtual = ((words[0] | words[1]) & 1) != 0;
    return is_virtual ? words[0] & ~1L : -1;
}

LayoutFacts sizes()
{
    return {
#define SIZE(type) {"sizeof(" #type ")", static_cast<long>(sizeof(type))}
        SIZE(dReal), SIZE(dVector3),  SIZE(dxPosR),     SIZE(dxGeom),  SIZE(dxSpace), SIZE(dxSphere),
        SIZE(dxBox), SIZE(dxCapsule), SIZE(dxCylinder), SIZE(dxPlane), SIZE(dxRay)
#undef SIZE
    };
}

LayoutFacts offsets()
{
    return {
#define MEMBER(type, member)                                                                                           \
    {#type "::" #member, static_cast<long>(offsetof(type, member))},                                                   \
        {"sizeof(" #type "::" #member ")", static_cast<long>(sizeof(type::member))}
        MEMBER(dxPosR, pos), MEMBER(dxPosR, R),
        // every geom
        MEMBER(dxGeom, type), MEMBER(dxGeom, gflags), MEMBER(dxGeom, data), MEMBER(dxGeom, body),
        MEMBER(dxGeom, body_next), MEMBER(dxGeom, final_posr), MEMBER(dxGeom, offset_posr), MEMBER(dxGeom, next),
        MEMBER(dxGeom, tome), MEMBER(dxGeom, next_ex), MEMBER(dxGeom, tome_ex), MEMBER(dxGeom, parent_space),
        MEMBER(dxGeom, aabb), MEMBER(dxGeom, category_bits), MEMBER(dxGeom, collide_bits),
        // spaces
        MEMBER(dxSpace, count), MEMBER(dxSpace, first), MEMBER(dxSpace, cleanup), MEMBER(dxSpace, sublevel),
        MEMBER(dxSpace, tls_kind), MEMBER(dxSpace, current_index), MEMBER(dxSpace, current_geom),
        MEMBER(dxSpace, lock_count),
        // shapes
        MEMBER(dxSphere, radius), MEMBER(dxBox, side), MEMBER(dxCapsule, radius), MEMBER(dxCapsule, lz),
        MEMBER(dxCylinder, radius), MEMBER(dxCylinder, lz), MEMBER(dxPlane, p), MEMBER(dxRay, length),
        MEMBER(dxConvex, planes), MEMBER(dxConvex, points), MEMBER(dxConvex, polygons), MEMBER(dxConvex, planecount),
        MEMBER(dxConvex, pointcount)
#undef MEMBER
    };
}

LayoutFacts functions()
{
    return {
#define FUNCTION(type, function) {#type "::" #function "()", place_of(&type::function)}
        FUNCTION(dxGeom, controlGeometry),
        FUNCTION(dxGeom, computeAABB),
        FUNCTION(dxGeom, AABBTest),
        FUNCTION(dxGeom, computePosr),
        FUNCTION(dxSpace, computeAABB),
        FUNCTION(dxSpace, getGeom),
        FUNCTION(dxSpace, add),
        FUNCTION(dxSpace, remove),
        FUNCTION(dxSpace, dirty),
        FUNCTION(dxSpace, cleanGeoms),
        FUNCTION(dxSpace, collide),
        FUNCTION(dxSpace, collide2)
#undef FUNCTION
    };
}

LayoutFacts numbers()
{
    return {
#define NUMBER(name) {#name, static_cast<long>(name)}
        NUMBER(GEOM_DIRTY),
        NUMBER(GEOM_POSR_BAD),
        NUMBER(GEOM_AABB_BAD),
        NUMBER(GEOM_PLACEABLE),
        NUMBER(GEOM_ENABLED),
        NUMBER(GEOM_ZERO_SIZED),
        NUMBER(GEOM_ENABLE_TEST_MASK),
        NUMBER(GEOM_ENABLE_TEST_VALUE)
#undef NUMBER
    };
}
} // namespace

LayoutFacts facts_of_these_headers()
{
    LayoutFacts all;
    for (const LayoutFacts &some : {sizes(), offsets(), functions(), numbers()})
        all.insert(some.begin(), some.end());
    return all;
}
