#include "ode_predictive_space/preload/find_ode.h"

#include <cstdlib>
#include <cstring>

#include <dlfcn.h>

#include "ode_predictive_space/preload/looked_up.h"

namespace ode_predictive_space::preload
{
namespace
{
Object opened(const char *name)
{
    // The main program has an empty name, for which dlopen wants a null pointer.
    Object object;
    object.handle = dlopen(name && name[0] ? name : nullptr, RTLD_LAZY | RTLD_NOLOAD);
    if (object.handle && dlinfo(object.handle, RTLD_DI_LINKMAP, &object.map) != 0)
        object.map = nullptr;
    return object;
}

const link_map *ourselves()
{
    return object_at(reinterpret_cast<const void *>(&find_definition));
}

// Looks a function up, beginning at an object. Returns the object that defines it; 0 when none but this library does.
link_map *defined_below(const Object &object, const char *function)
{
    const void *symbol = object.handle ? find_symbol(object.handle, function) : nullptr;
    link_map *map = symbol ? object_at(symbol) : nullptr;
    return map == ourselves() ? nullptr : map;
}

struct Name
{
    char *text;
    Name *next;
};

int collect_name(dl_phdr_info *info, size_t, void *data)
{
    auto *name = static_cast<Name *>(std::malloc(sizeof(Name)));
    if (!name)
        std::abort();
    auto **names = static_cast<Name **>(data);
    *name = {strdup(info->dlpi_name ? info->dlpi_name : ""), *names};
    *names = name;
    return 0;
}

template <typename Function> void look_up(void *handle, const char *name, Function *&function)
{
    function = reinterpret_cast<Function *>(find_symbol(handle, name));
}
} // namespace

// Older C libraries search the symbols, too, and wait while another thread loads an object.
link_map *object_at(const void *address)
{
#if __GLIBC_PREREQ(2, 35)
    dl_find_object object;
    return _dl_find_object(const_cast<void *>(address), &object) == 0 ? object.dlfo_link_map : nullptr;
#else
    Dl_info symbol;
    void *map = nullptr;
    return dladdr1(address, &symbol, &map, RTLD_DL_LINKMAP) != 0 ? static_cast<link_map *>(map) : nullptr;
#endif
}

Object find_definition(const char *function, const link_map *caller)
{
    const void *next = find_symbol(RTLD_NEXT, function);
    link_map *map = next ? object_at(next) : nullptr;
    if (!map && caller)
    {
        const Object from = opened(caller->l_name);
        map = defined_below(from, function);
        if (from.handle)
            dlclose(from.handle);
    }
    return map ? opened(map->l_name) : Object();
}

// The names are collected first and opened afterwards. Opening an object waits for threads that load one, and these wait until
// the iteration over all objects has ended.
Object find_only_definition(const char *function)
{
    Name *names = nullptr;
    dl_iterate_phdr(collect_name, &names);
    link_map *found = nullptr;
    bool several = false;
    while (names)
    {
        const Object object = opened(names->text);
        link_map *map = defined_below(object, function);
        several |= map && found && map != found;
        found = map ? map : found;
        if (object.handle)
            dlclose(object.handle);
        Name *next = names->next;
        std::free(names->text);
        std::free(names);
        names = next;
    }
    return found && !several ? opened(found->l_name) : Object();
}

OdeCalls calls_of(const Object &ode)
{
    OdeCalls calls;
    look_up(ode.handle, "dSimpleSpaceCreate", calls.simple_create);
    look_up(ode.handle, "dHashSpaceCreate", calls.hash_create);
    look_up(ode.handle, "dQuadTreeSpaceCreate", calls.quadtree_create);
    look_up(ode.handle, "dSweepAndPruneSpaceCreate", calls.sap_create);
    look_up(ode.handle, "dSpaceCollide", calls.collide);
    look_up(ode.handle, "dSpaceCollide2", calls.collide2);
    return calls;
}

Object object_of(const link_map *map)
{
    return opened(map->l_name);
}

Object find_loaded(const char *soname)
{
    return opened(soname);
}
} // namespace ode_predictive_space::preload
