// The part of ODE's inner binary interface that the space uses: our own declarations of its classes, flags and functions.
//
// A new kind of dSpace must derive from dxSpace, which ODE declares only in its source. What is declared here lies in memory, is
// called and is named for the linker as in ODE 0.15 to 0.16.6. What a virtual function is for, and which members there are, is
// settled by ODE; members that are not used here keep their place. Where ODE's source is at hand, layout_test compares all of
// this with it; ode_mismatch() checks the ODE in the process.

#ifndef ODE_PREDICTIVE_SPACE_SPACE_ODE_LAYOUT_H
#define ODE_PREDICTIVE_SPACE_SPACE_ODE_LAYOUT_H

#include <cstddef>

#include <ode/collision.h>
#include <ode/collision_space.h>
#include <ode/error.h>
#include <ode/memory.h>
#include <ode/objects.h>

// An assertion about what a program asks. As in ODE, it ends the program, is not compiled with dNODEBUG, and complains about a
// locked space in the same words.
#ifdef dNODEBUG
#define dUASSERT(condition, message) static_cast<void>(0)
#else
#define dUASSERT(condition, message)                                                                                   \
    static_cast<void>((condition) || (dDebug(d_ERR_UASSERT, "%s in %s()", message, __func__), false))
#endif
#define dAASSERT(condition) dUASSERT(condition, "bad argument: no " #condition)
#define CHECK_NOT_LOCKED(space) dUASSERT((space)->lock_count == 0, "Invalid operation for locked space")

// These classes live in ODE's library, also for a program that is compiled with -fvisibility=hidden.
#pragma GCC visibility push(default)

/// Flags of a geom, in dxGeom::gflags.
enum
{
    GEOM_DIRTY = 1 << 0,    ///< moved or changed since its space was last brought up to date
    GEOM_POSR_BAD = 1 << 1, ///< final_posr is to be computed from the body's pose and the offset
    GEOM_AABB_BAD = 1 << 2, ///< the bounding box is to be computed
    GEOM_PLACEABLE = 1 << 3,
    GEOM_ENABLED = 1 << 4,
    GEOM_ZERO_SIZED = 1 << 5, ///< without extent: never collides

    GEOM_ENABLE_TEST_MASK = GEOM_ENABLED | GEOM_ZERO_SIZED,
    GEOM_ENABLE_TEST_VALUE = GEOM_ENABLED
};

/// A position and a rotation matrix of three rows of four numbers.
struct dxPosR
{
    dVector3 pos;
    dMatrix3 R;
};

/// Has ODE's objects in ODE's memory: a program may have set the functions for it.
struct dBase
{
    static void *operator new(std::size_t size) { return dAlloc(size); }
    static void operator delete(void *memory, std::size_t size) { dFree(memory, size); }
};

/// What a dGeomID points to. The order of the virtual functions is that of the table of functions.
struct dxGeom : public dBase
{
    int type; ///< class number
    int gflags;
    void *data; ///< the program's own
    dBodyID body;
    dxGeom *body_next;     ///< list of the body's geoms
    dxPosR *final_posr;    ///< in the world; a geom's own or its body's
    dxPosR *offset_posr;   ///< from the body; null for a geom without offset
    dxGeom *next;          ///< list of the space's geoms
    dxGeom **tome;         ///< the pointer in this list that points here
    dxGeom *next_ex;       ///< a second list, or what else the space keeps with the geom
    dxGeom **tome_ex;      ///< the same for the second list
    dxSpace *parent_space; ///< null outside of spaces
    dReal aabb[6];         ///< least and greatest x, y, z; valid unless GEOM_AABB_BAD
    unsigned long category_bits;
    unsigned long collide_bits;

    dxGeom(dSpaceID space, int is_placeable);
    virtual ~dxGeom();
    virtual bool controlGeometry(int control_class, int code, void *value, int *size);
    virtual void computeAABB() = 0; ///< fills aabb from a valid final_posr; leaves the flags
    virtual int AABBTest(dxGeom *other,
                         dReal box[6]); ///< may the geom touch what is in the box? True but for user classes.

    void computePosr(); ///< fills final_posr; leaves the flags

    void recomputePosr()
    {
        if (!(gflags & GEOM_POSR_BAD))
            return;
        computePosr();
        gflags &= ~GEOM_POSR_BAD;
    }

    void recomputeAABB()
    {
        if (!(gflags & GEOM_AABB_BAD))
            return;
        recomputePosr();
        computeAABB();
        gflags &= ~GEOM_AABB_BAD;
    }
};

/// What a dSpaceID points to: a geom that holds geoms.
struct dxSpace : public dxGeom
{
    int count;     ///< of the geoms in it
    dxGeom *first; ///< of the list of these
    int cleanup;   ///< the geoms are destroyed with the space
    int sublevel;
    unsigned tls_kind;
    int current_index;    ///< of current_geom, for getGeom()
    dxGeom *current_geom; ///< the geom that getGeom() found last; null when the list has changed
    int lock_count;       ///< positive while the space collides

    explicit dxSpace(dSpaceID parent);
    ~dxSpace() override;
    void computeAABB() override;

    virtual dxGeom *getGeom(int index);
    virtual void add(dxGeom *geom);
    virtual void remove(dxGeom *geom);
    virtual void dirty(dxGeom *geom); ///< the geom is moved, and was not dirty before
    virtual void cleanGeoms() = 0;    ///< brings all bounding boxes up to date
    virtual void collide(void *data, dNearCallback *callback) = 0;
    virtual void collide2(void *data, dxGeom *geom, dNearCallback *callback) = 0;
};

inline bool IS_SPACE(const dxGeom *geom)
{
    return geom->type >= dFirstSpaceClass && geom->type <= dLastSpaceClass;
}

// The shapes, to be read only: ODE makes them.

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

/// The arrays are the program's own.
struct dxConvex : public dxGeom
{
    const dReal *planes;
    const dReal *points;      ///< x, y, z of each
    const unsigned *polygons; ///< of each, the number of its corners and these
    unsigned planecount;
    unsigned pointcount;
};

#pragma GCC visibility pop

#endif
