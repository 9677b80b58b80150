// The half that is loaded into every process: functions with the names of ODE's, which the dynamic linker finds first.
//
// In a process without ODE only the program file is read, once at the start. This half is compiled without exceptions and
// linked with the C library alone, so that /bin/sh loads nothing else.

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <dlfcn.h>
#include <pthread.h>

#include <ode/collision.h>

#include "ode_predictive_space/preload/find_ode.h"
#include "ode_predictive_space/preload/looked_up.h"
#include "ode_predictive_space/preload/program_file.h"
#include "ode_predictive_space/preload/say.h"

using namespace ode_predictive_space::preload;

namespace
{
/// An ODE that was called, and the hooks that serve it.
struct Ode
{
    Object object;
    OdeCalls calls;
    const Hooks *hooks; // 0: the program keeps its own spaces
};

/// An object of the process, and the ODE that its calls go to. After it is unloaded, another object may have its map.
struct Caller
{
    const link_map *map;
    const char *name;
    const Ode *ode; // 0 if none is visible to it: a call that seems to be its own is a jump from another object
    const Caller *next;
};

// Callers are added at the front, under the lock, and never removed, so that they can be read without it.
//
// A thread that holds the lock must not call the dynamic linker: a thread that holds the lock of the linker may run the
// constructors of a library, which may call ODE.
pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
const Caller *callers;
constexpr int most_odes = 16;
const Ode *odes[most_odes];
int ode_count;

// The ODE that is served. Only its functions are caught when a program looks them up by dlsym().
const Ode *served_ode;

// Not 0 while the substitute works: its calls are meant for this ODE.
__thread const Ode *inside;

template <std::size_t size> bool path_of_substitute(char (&path)[size])
{
    const link_map *self = object_at(reinterpret_cast<const void *>(&path_of_substitute<size>));
    const char *slash = self ? std::strrchr(self->l_name, '/') : nullptr;
    const int length = slash ? static_cast<int>(slash + 1 - self->l_name) : 0;
    const char *name = self ? self->l_name : "";
    return std::snprintf(path, size, "%.*s%s", length, name, SUBSTITUTE_FILE) < static_cast<int>(size);
}

// Loading the substitute also loads the ODE that it was built with. If the program's ODE were another one, the process would
// have two.
bool is_expected_library(const Ode &ode)
{
    return find_loaded(ODE_SONAME).map == ode.object.map;
}

// The substitute cannot be loaded into such a process: the names of the functions that it is linked with contain the precision.
bool has_other_precision(const Ode &ode)
{
    using Check = int (*)(const char *);
    const auto check = reinterpret_cast<Check>(find_symbol(ode.object.handle, "dCheckConfiguration"));
    return check && !check(sizeof(dReal) == sizeof(double) ? "ODE_double_precision" : "ODE_single_precision");
}

enum class Match
{
    served,
    other_precision,
    other_library
};

Match match_of(const Ode &ode)
{
    if (has_other_precision(ode))
        return Match::other_precision;
    return is_expected_library(ode) ? Match::served : Match::other_library;
}

// Returns 0 when it cannot be loaded; dlerror() then has the reason.
Attach load_substitute(const Ode &ode)
{
    char path[PATH_MAX];
    if (!path_of_substitute(path))
        return nullptr;
    inside = &ode;
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    inside = nullptr;
    return library ? reinterpret_cast<Attach>(find_symbol(library, attach_name)) : nullptr;
}

const Ode *known(const link_map *map)
{
    for (int i = 0; i < ode_count; ++i)
        if (odes[i]->object.map == map)
            return odes[i];
    return nullptr;
}

Ode *new_ode(const Object &object)
{
    auto *ode = static_cast<Ode *>(std::calloc(1, sizeof(Ode)));
    if (!ode)
        std::abort();
    ode->object = object;
    ode->calls = calls_of(object);
    return ode;
}

const char *file_of(const Ode &ode)
{
    return ode.object.map->l_name[0] ? ode.object.map->l_name : program_invocation_name;
}

// Lets the substitute serve it, if that is possible. The caller holds the lock.
const Ode *introduce(Ode *ode, Match match, Attach attach)
{
    if (ode_count == most_odes)
        std::abort();
    if (match == Match::other_precision)
        say("the ODE of this program (%s) has another precision (dSINGLE, dDOUBLE) than the one that the launcher was "
            "built for; the program keeps its own spaces",
            file_of(*ode));
    else if (match == Match::other_library)
        say("the ODE of this program (%s) is not %s, which the launcher was built for; the program keeps its own "
            "spaces",
            file_of(*ode), ODE_SONAME);
    else if (!attach)
        say("a library of the launcher cannot be loaded: %s; the program keeps its own spaces", dlerror());
    else
        ode->hooks = attach(&ode->calls);
    if (ode->hooks)
        __atomic_store_n(&served_ode, ode, __ATOMIC_RELEASE);
    odes[ode_count++] = ode;
    return ode;
}

const char *name_of(const link_map *map)
{
    return map ? map->l_name : "";
}

const Caller *known_caller(const link_map *map)
{
    for (const Caller *caller = __atomic_load_n(&callers, __ATOMIC_ACQUIRE); caller; caller = caller->next)
        if (caller->map == map && std::strcmp(caller->name, name_of(map)) == 0)
            return caller;
    return nullptr;
}

// The caller holds the lock.
const Caller *remember(const link_map *map, const Ode *ode)
{
    auto *caller = static_cast<Caller *>(std::calloc(1, sizeof(Caller)));
    const char *name = strdup(name_of(map));
    if (!caller || !name)
        std::abort();
    *caller = {map, name, ode, callers};
    __atomic_store_n(&callers, caller, __ATOMIC_RELEASE);
    return caller;
}

const Ode *meet_ode(const Object &object)
{
    Ode *met = new_ode(object);
    const Match match = match_of(*met);
    const Attach attach = match == Match::served ? load_substitute(*met) : nullptr;

    pthread_mutex_lock(&lock);
    const Ode *ode = known(object.map);
    if (ode)
        std::free(met);
    else
        ode = introduce(met, match, attach);
    pthread_mutex_unlock(&lock);
    return ode;
}

const Caller *meet_caller(const char *function, const link_map *map)
{
    const Object object = find_definition(function, map);
    const Ode *ode = object.map ? meet_ode(object) : nullptr;
    pthread_mutex_lock(&lock);
    const Caller *caller = remember(map, ode);
    pthread_mutex_unlock(&lock);
    return caller;
}

const Ode *ode_seen_by(const char *function, const link_map *map)
{
    const Caller *caller = known_caller(map);
    return (caller ? caller : meet_caller(function, map))->ode;
}

// The dynamic linker, too, ends a program that calls a function which no library defines.
[[noreturn]] void end_for_lack_of(const char *function)
{
    say("%s() was called, but the process has no ODE, or it has several and the call could be for any of them; the "
        "program ends",
        function);
    std::exit(127);
}

// Finds the ODE for a call that came by a jump: the one whose library has the virtual functions of the geom, or else the only
// one in the process.
const Ode *ode_by_jump(const char *function, const void *geom)
{
    const link_map *maker = geom ? object_at(*static_cast<const void *const *>(geom)) : nullptr;
    const Ode *ode = maker ? ode_seen_by(function, maker) : nullptr;
    if (ode)
        return ode;
    const Object object = find_only_definition(function);
    if (!object.map)
        end_for_lack_of(function);
    return meet_ode(object);
}

// The library of the predictive space makes spaces of ODE to check their layout.
bool is_from_own_library(const void *return_address)
{
    const link_map *map = object_at(return_address);
    const char *slash = map ? std::strrchr(map->l_name, '/') : nullptr;
    return slash && std::strncmp(slash + 1, "libode_predictive_space.so", 26) == 0;
}

// A program may be linked with that library, too. When the library checks ODE at the program's start, the substitute must not
// be loaded, because it would wait for the same check.
const Ode *ode_of_own_library(const char *function, const void *return_address)
{
    static const Ode *seen;
    const Ode *ode = __atomic_load_n(&seen, __ATOMIC_ACQUIRE);
    if (ode)
        return ode;
    const Object object = find_definition(function, object_at(return_address));
    ode = object.map ? new_ode(object) : nullptr;
    __atomic_store_n(&seen, ode, __ATOMIC_RELEASE);
    return ode;
}

// The ODE that a call from this address was meant for.
const Ode &ode_of(const char *function, const void *return_address, const void *geom = nullptr)
{
    const link_map *map = object_at(return_address);
    const Caller *caller = known_caller(map);
    if (caller && caller->ode)
        return *caller->ode;
    if (!caller && inside)
        return *inside;
    const bool is_own = is_from_own_library(return_address);
    const Ode *ode = is_own ? ode_of_own_library(function, return_address) : ode_seen_by(function, map);
    return ode ? *ode : *ode_by_jump(function, geom);
}

template <typename Native> dSpaceID create(const Ode &ode, int space_class, dSpaceID parent, Native native)
{
    if (!ode.hooks || inside)
        return native(ode.calls);
    inside = &ode;
    dSpaceID space = ode.hooks->create(space_class, parent);
    if (!space)
    {
        space = native(ode.calls);
        if (ode.hooks->made)
            ode.hooks->made(space);
    }
    inside = nullptr;
    return space;
}

dSpaceID create_simple(const Ode &ode, dSpaceID parent)
{
    return create(ode, dSimpleSpaceClass, parent, [=](const OdeCalls &calls) { return calls.simple_create(parent); });
}

dSpaceID create_hash(const Ode &ode, dSpaceID parent)
{
    return create(ode, dHashSpaceClass, parent, [=](const OdeCalls &calls) { return calls.hash_create(parent); });
}

dSpaceID create_quadtree(const Ode &ode, dSpaceID parent, const dReal *center, const dReal *extents, int depth)
{
    return create(ode, dQuadTreeSpaceClass, parent,
                  [=](const OdeCalls &calls) { return calls.quadtree_create(parent, center, extents, depth); });
}

dSpaceID create_sap(const Ode &ode, dSpaceID parent, int axis_order)
{
    return create(ode, dSweepAndPruneSpaceClass, parent,
                  [=](const OdeCalls &calls) { return calls.sap_create(parent, axis_order); });
}

void collide(const Ode &ode, dSpaceID space, void *data, dNearCallback *callback)
{
    (ode.hooks && ode.hooks->collide ? ode.hooks->collide : ode.calls.collide)(space, data, callback);
}

void collide2(const Ode &ode, dGeomID first, dGeomID second, void *data, dNearCallback *callback)
{
    (ode.hooks && ode.hooks->collide2 ? ode.hooks->collide2 : ode.calls.collide2)(first, second, data, callback);
}

#define RETURN_ADDRESS __builtin_return_address(0)

// The functions that dlsym() returns to programs. They have the types of ODE's functions and are meant for the ODE that is
// served.
const Ode &looked_up_ode()
{
    return *__atomic_load_n(&served_ode, __ATOMIC_ACQUIRE);
}

dSpaceID looked_up_simple_create(dSpaceID parent)
{
    return create_simple(looked_up_ode(), parent);
}

dSpaceID looked_up_hash_create(dSpaceID parent)
{
    return create_hash(looked_up_ode(), parent);
}

dSpaceID looked_up_quadtree_create(dSpaceID parent, const dReal *center, const dReal *extents, int depth)
{
    return create_quadtree(looked_up_ode(), parent, center, extents, depth);
}

dSpaceID looked_up_sap_create(dSpaceID parent, int axis_order)
{
    return create_sap(looked_up_ode(), parent, axis_order);
}

void looked_up_collide(dSpaceID space, void *data, dNearCallback *callback)
{
    collide(looked_up_ode(), space, data, callback);
}

void looked_up_collide2(dGeomID first, dGeomID second, void *data, dNearCallback *callback)
{
    collide2(looked_up_ode(), first, second, data, callback);
}

const OdeCalls looked_up_calls = {looked_up_simple_create, looked_up_hash_create, looked_up_quadtree_create,
                                  looked_up_sap_create,    looked_up_collide,     looked_up_collide2};

void *function_of(const OdeCalls &calls, CaughtFunction function)
{
    switch (function)
    {
    case simple_space_create:
        return reinterpret_cast<void *>(calls.simple_create);
    case hash_space_create:
        return reinterpret_cast<void *>(calls.hash_create);
    case quadtree_space_create:
        return reinterpret_cast<void *>(calls.quadtree_create);
    case sap_space_create:
        return reinterpret_cast<void *>(calls.sap_create);
    case space_collide:
        return reinterpret_cast<void *>(calls.collide);
    case space_collide2:
        return reinterpret_cast<void *>(calls.collide2);
    case caught_function_count:
        break;
    }
    return nullptr;
}

bool is_asked_for(const char *variable)
{
    const char *value = secure_getenv(variable);
    return value && value[0] && std::strcmp(value, "0") != 0;
}

__attribute__((constructor)) void look_at_program()
{
    if (has_ode_built_in("/proc/self/exe"))
        say("%s has ODE built in, where its calls cannot be caught; it keeps its own spaces", program_invocation_name);
}

// Gives the reason when statistics are wanted and there are none.
__attribute__((destructor)) void tell_when_nothing_was_caught()
{
    if (ode_count == 0 && is_asked_for("ODE_PREDICTIVE_STATS") && find_loaded(ODE_SONAME).map)
        say("%s has loaded %s, but no call that makes a space or collides one was seen; there are no statistics",
            program_invocation_short_name, ODE_SONAME);
}
} // namespace

#define CAUGHT extern "C" __attribute__((visibility("default")))

CAUGHT dSpaceID dSimpleSpaceCreate(dSpaceID parent)
{
    return create_simple(ode_of(__func__, RETURN_ADDRESS), parent);
}

CAUGHT dSpaceID dHashSpaceCreate(dSpaceID parent)
{
    return create_hash(ode_of(__func__, RETURN_ADDRESS), parent);
}

CAUGHT dSpaceID dQuadTreeSpaceCreate(dSpaceID parent, const dVector3 center, const dVector3 extents, int depth)
{
    return create_quadtree(ode_of(__func__, RETURN_ADDRESS), parent, center, extents, depth);
}

CAUGHT dSpaceID dSweepAndPruneSpaceCreate(dSpaceID parent, int axis_order)
{
    return create_sap(ode_of(__func__, RETURN_ADDRESS), parent, axis_order);
}

CAUGHT void dSpaceCollide(dSpaceID space, void *data, dNearCallback *callback)
{
    collide(ode_of(__func__, RETURN_ADDRESS, space), space, data, callback);
}

CAUGHT void dSpaceCollide2(dGeomID first, dGeomID second, void *data, dNearCallback *callback)
{
    collide2(ode_of(__func__, RETURN_ADDRESS, first), first, second, data, callback);
}

bool ode_predictive_space::preload::sees_ode_itself()
{
    return inside;
}

// `found` is one of ours already when the lookup began in the global scope.
void *ode_predictive_space::preload::answer_to_lookup(CaughtFunction function, void *found)
{
    const link_map *map = object_at(found);
    if (!map || map == object_at(reinterpret_cast<const void *>(&answer_to_lookup)))
        return found;
    const Object object = object_of(map);
    const Ode *ode = object.map ? meet_ode(object) : nullptr;
    return ode && ode->hooks ? function_of(looked_up_calls, function) : found;
}
