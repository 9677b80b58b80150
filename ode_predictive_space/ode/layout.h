// The part of ODE's internal binary interface that the space uses: declarations of its classes, flags and functions. A new kind
// of dSpace must derive from dxSpace, which ODE declares only in its source. Layout (with unused members), calls and symbols
// are those of ODE 0.15 to 0.16.6. layout_test compares them with ODE's source; ode_mismatch() checks the ODE in the process.

#ifndef ODE_PREDICTIVE_SPACE_ODE_LAYOUT_H
#define ODE_PREDICTIVE_SPACE_ODE_LAYOUT_H

#include <cstddef>

#include <ode/collision.h>
#include <ode/collision_space.h>
#include <ode/error.h>
#include <ode/memory.h>
#include <ode/objects.h>

// Assertions of user errors, as in ODE: they end the program unless dNODEBUG is defined. CHECK_NOT_LOCKED has ODE's message.
#ifdef dNODEBUG
#define dUASSERT(condition, message) static_cast<void>(0)
#else
#define dUASSERT(condition, message)                                                                                   \
    static_cast<void>((condition) || (dDebug(d_ERR_UASSERT, "%s in %s()", message, __func__), false))
#endif
#define dAASSERT(condition) dUASSERT(condition, "bad argument: no " #condition)
#define CHECK_NOT_LOCKED(space) dUASSERT((space)->lock_count == 0, "Invalid operation for locked space")

// The classes are ODE's, so they stay visible in a program that is compiled with -fvisibility=hidden.
#pragma GCC visibility push(default)

/// Bits of dxGeom::gflags.
enum
{
    GEOM_DIRTY = 1 << 0,    ///< moved or changed since its space was last brought up to date
    GEOM_POSR_BAD = 1 << 1, ///< final_posr must be computed from the body's pose and the offset
    GEOM_AABB_BAD = 1 << 2, ///< the bounding box must be computed
    GEOM_PLACEABLE = 1 << 3,
    GEOM_ENABLED = 1 << 4,
    GEOM_ZERO_SIZED = 1 << 5, ///< without extent: never collides

    GEOM_ENABLE_TEST_MASK = GEOM_ENABLED | GEOM_ZERO_SIZED,
    GEOM_ENABLE_TEST_VALUE = GEOM_ENABLED
};

struct dxPosR
{
    dVector3 pos;
    dMatrix3 R;
};

/// Allocates by ODE's memory functions, which a program may have replaced.
struct dBase
{
    static void *operator new(std::size_t size) { return dAlloc(size); }
    static void operator delete(void *memory, std::size_t size) { dFree(memory, size); }
};

/// The object behind a dGeomID. Virtual functions are in the order of ODE's virtual table.
struct dxGeom : public dBase
{
    int type;
    int gflags;
    void *data;
    dBodyID body;
    dxGeom *body_next;     ///< list of the body's geoms
    dxPosR *final_posr;    ///< pose in the world; the geom's own or its body's
    dxPosR *offset_posr;   ///< pose relative to the body; null for a geom without offset
    dxGeom *next;          ///< list of the space's geoms
    dxGeom **tome;         ///< the pointer in this list that points here
    dxGeom *next_ex;       ///< a second list, or other data of the space
    dxGeom **tome_ex;      ///< as tome, for the second list
    dxSpace *parent_space; ///< null outside of spaces
    dReal aabb[6];         ///< least and greatest x, y, z; valid unless GEOM_AABB_BAD
    unsigned long category_bits;
    unsigned long collide_bits;

    dxGeom(dSpaceID space, int is_placeable);
    virtual ~dxGeom();
    virtual bool controlGeometry(int control_class, int code, void *value, int *size);
    virtual void computeAABB() = 0; ///< fills aabb from a valid final_posr; leaves the flags
    virtual int AABBTest(dxGeom *other,
                         dReal box[6]); ///< may the geom touch what is in the box? Always true except for user classes.

    void computePosr(); ///< fills final_posr; leaves the flags

    void recomputePosr()
    {
        if (!(gflags & GEOM_POSR_BAD))
            return;
        computePosr();
        gflags &= ~GEOM_POSR_BAD;
    }
};

/// The object behind a dSpaceID, a geom that contains geoms.
struct dxSpace : public dxGeom
{
    int count; ///< number of geoms
    dxGeom *first;
    int cleanup; ///< the geoms are destroyed with the space
    int sublevel;
    unsigned tls_kind;
    int current_index;    ///< place of current_geom in the list
    dxGeom *current_geom; ///< the geom that getGeom() found last; null when the list has changed
    int lock_count;       ///< positive while the space collides

    explicit dxSpace(dSpaceID parent);
    ~dxSpace() override;
    void computeAABB() override;

    virtual dxGeom *getGeom(int index);
    virtual void add(dxGeom *geom);
    virtual void remove(dxGeom *geom);
    virtual void dirty(dxGeom *geom); ///< a geom has moved that was not dirty before
    virtual void cleanGeoms() = 0;    ///< computes all bounding boxes
    virtual void collide(void *data, dNearCallback *callback) = 0;
    virtual void collide2(void *data, dxGeom *geom, dNearCallback *callback) = 0;
};

inline bool IS_SPACE(const dxGeom *geom)
{
    return geom->type >= dFirstSpaceClass && geom->type <= dLastSpaceClass;
}

// The classes of geoms. ODE creates them; the space only reads them.

struct dxSphere : public dxGeom
{
    dReal radius;
};

struct dxBox : public dxGeom
{
    dVector3 side; ///< whole lengths
};

struct dxCapsule : public dxGeom
{
    dReal radius;
    dReal lz; ///< between the centres of its ends
};

struct dxCylinder : public dxGeom
{
    dReal radius;
    dReal lz;
};

struct dxPlane : public dxGeom
{
    dReal p[4]; ///< normal and distance from the origin
};

struct dxRay : public dxGeom
{
    dReal length;
};

/// The program owns the arrays.
struct dxConvex : public dxGeom
{
    const dReal *planes;
    const dReal *points;      ///< x, y, z of each
    const unsigned *polygons; ///< per polygon: the number of its corners, then their indices
    unsigned planecount;
    unsigned pointcount;
};

#pragma GCC visibility pop

#endif
