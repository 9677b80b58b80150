#include "ode_predictive_space/ode/check.h"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#if __has_include(<link.h>)
#include <dlfcn.h>
#include <link.h>
#endif

#include "ode_predictive_space/ode/geom_access.h"

namespace ode_predictive_space
{
namespace
{
bool precision_differs()
{
    const char *wanted = sizeof(dReal) == sizeof(double) ? "ODE_double_precision" : "ODE_single_precision";
    return dCheckConfiguration(wanted) == 0;
}

#if __has_include(<link.h>)
int collect_name(dl_phdr_info *object, size_t, void *names)
{
    static_cast<std::vector<std::string> *>(names)->emplace_back(object->dlpi_name ? object->dlpi_name : "");
    return 0;
}

// No name is opened during the iteration: dlopen() waits for threads that load an object, and these wait for the iteration.
bool several_copies()
{
    std::vector<std::string> names;
    dl_iterate_phdr(collect_name, &names);
    std::set<void *> copies;
    for (const std::string &name : names)
    {
        // The main program has an empty name, for which dlopen() expects a null pointer.
        void *handle = dlopen(name.empty() ? nullptr : name.c_str(), RTLD_LAZY | RTLD_NOLOAD);
        if (!handle)
            continue;
        if (void *symbol = dlsym(handle, "dSpaceGetNumGeoms"))
            copies.insert(symbol);
        dlclose(handle);
    }
    return copies.size() > 1;
}
#else
// A program with a static ODE has one copy.
bool several_copies()
{
    return false;
}
#endif

// Builds a geom with a distinct value in every member that the public API can set.
bool geom_layout_differs(dSpaceID space)
{
    int data = 0;
    dGeomID geom = dCreateBox(space, 2, 4, 6);
    dGeomSetData(geom, &data);
    dGeomSetCategoryBits(geom, 0x1234UL);
    dGeomSetCollideBits(geom, 0x5678UL);
    dGeomSetPosition(geom, 10, 20, 30);
    dReal aabb[6];
    dGeomGetAABB(geom, aabb);
    const dReal expected[6] = {9, 11, 18, 22, 27, 33};
    const dxBox *box = static_cast<const dxBox *>(geom);
    const bool agrees = box->type == dBoxClass && box->data == &data && box->body == nullptr &&
                        box->offset_posr == nullptr && box->final_posr->pos[2] == 30 && box->next_ex == nullptr &&
                        box->tome_ex == nullptr && box->parent_space == space &&
                        std::equal(expected, expected + 6, box->aabb) && std::equal(expected, expected + 6, aabb) &&
                        box->category_bits == 0x1234UL && box->collide_bits == 0x5678UL &&
                        sizes_of(geom) == box->side && box->side[0] == 2 && box->side[2] == 6 &&
                        box->gflags == (GEOM_DIRTY | GEOM_PLACEABLE | GEOM_ENABLED);
    dGeomDestroy(geom);
    return !agrees;
}

bool space_layout_differs(dSpaceID space)
{
    dSpaceSetCleanup(space, 0);
    dSpaceSetSublevel(space, 77);
    dGeomID geom = dCreateSphere(space, 3);
    const bool agrees = space->type == dSimpleSpaceClass && space->count == 1 && space->first == geom &&
                        space->cleanup == 0 && space->sublevel == 77 && space->lock_count == 0 &&
                        geom->tome == &space->first && static_cast<const dxSphere *>(geom)->radius == 3 &&
                        *sizes_of(geom) == 3 && space->getGeom(0) == geom && space->current_geom == geom;
    dGeomDestroy(geom);
    return !agrees || space->count != 0;
}

// CarriedGeom reads the pose of a body as that of a geom.
bool body_layout_differs(dSpaceID space)
{
    dWorldID world = dWorldCreate();
    dBodyID body = dBodyCreate(world);
    dGeomID geom = dCreateSphere(space, 1);
    dGeomSetBody(geom, body);
    const bool agrees = geom->body == body && geom->final_posr->pos == dBodyGetPosition(body) &&
                        geom->final_posr->R == dBodyGetRotation(body);
    dGeomDestroy(geom);
    dWorldDestroy(world);
    return !agrees;
}

bool layout_differs()
{
    dSpaceID space = dSimpleSpaceCreate(nullptr);
    const bool differs = geom_layout_differs(space) || space_layout_differs(space) || body_layout_differs(space);
    dSpaceDestroy(space);
    return differs;
}

const char *find_mismatch()
{
    if (precision_differs())
        return "it has another precision (dSINGLE, dDOUBLE) than the ODE that this plugin was built for";
    if (several_copies())
        return "there is more than one copy of ODE in this process, for example a static and a shared one";
    if (layout_differs())
        return "its geoms or spaces have another memory layout than those of the ODE that this plugin was built for; "
               "it may be a fork";
    return nullptr;
}
} // namespace

// The check creates a space. Under the launcher this may be the process's first call of ODE, which loads the second part of the
// launcher. That part, after its own check, makes a predictive space during this check: the nested call finds no mismatch.
const char *ode_mismatch()
{
    static thread_local bool checking = false;
    if (checking)
        return nullptr;
    static const char *const mismatch = [] {
        checking = true;
        const char *found = find_mismatch();
        checking = false;
        return found;
    }();
    return mismatch;
}
} // namespace ode_predictive_space
