// Errors in ODE and in the system that the sanitizers must ignore. They call these functions when a test program begins.

#define ODE_PREDICTIVE_SPACE_SEEN [[gnu::visibility("default"), gnu::used]]

extern "C" {
ODE_PREDICTIVE_SPACE_SEEN const char *__asan_default_options()
{
    // ODE frees memory from malloc() with operator delete.
    return "alloc_dealloc_mismatch=0";
}

ODE_PREDICTIVE_SPACE_SEEN const char *__lsan_default_suppressions()
{
    return ""
           // ODE loses the position record of a geom with an offset when dGeomSetBody moves it from one body to another. The
           // function that made the record depends on the free memory. Geoms and bodies left behind are still found.
           "leak:^dGeomCreateOffset\n"
           "leak:^dxGeom::dxGeom\n"
           "leak:^dGeomSetBody\n"
           // The hash space's memory for a collide is lost when an exception of the near callback passes through it.
           "leak:dxHashSpace::collide\n";
}

ODE_PREDICTIVE_SPACE_SEEN const char *__tsan_default_suppressions()
{
    return ""
           // ODE is not built with ThreadSanitizer, which sees its locks but not its atomic operations. Accesses that these
           // order look like races:
           // - dGeomSetBody passes freed memory to the constructors of geoms in other threads;
           "race:^dGeomSetBody$\n"
           // - after a step, the caller reads the notices of moved geoms that worker threads sent during it.
           "race:^dGeomMoved$\n"
           // The dynamic linker is not built with it, either. Accesses that its locks order look like races:
           // - an object's description, made by one thread and freed by another;
           "race:^_dl_close_worker$\n"
           // - an object's name, made by one thread and read by another that goes through all objects.
           "race:^dl_iterate_phdr_cb$\n";
}
}
