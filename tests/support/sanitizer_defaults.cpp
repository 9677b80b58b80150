// What the sanitizers are to overlook in ODE and in the system. They call these functions when a test program begins.

#define ODE_PREDICTIVE_SPACE_SEEN [[gnu::visibility("default"), gnu::used]]

extern "C" {
ODE_PREDICTIVE_SPACE_SEEN const char *__asan_default_options()
{
    // ODE frees with operator delete what it has from malloc().
    return "alloc_dealloc_mismatch=0";
}

ODE_PREDICTIVE_SPACE_SEEN const char *__lsan_default_suppressions()
{
    return ""
           // ODE forgets the position record of a geom with an offset when dGeomSetBody moves it from one body to another. Where that
           // record was made depends on what was free. Geoms and bodies that a test leaves behind are still found.
           "leak:^dGeomCreateOffset\n"
           "leak:^dxGeom::dxGeom\n"
           "leak:^dGeomSetBody\n"
           // What the hash space allocates for a collide is lost when an exception of the near callback passes through it.
           "leak:dxHashSpace::collide\n";
}

ODE_PREDICTIVE_SPACE_SEEN const char *__tsan_default_suppressions()
{
    return ""
           // ODE is not built with ThreadSanitizer. Its locks are seen, its atomic operations are not, and what they order looks like
           // a race:
           // - dGeomSetBody hands freed memory to the constructors of geoms in other threads;
           "race:^dGeomSetBody$\n"
           // - the end of a step: what worker threads told of moved geoms during the step, the caller reads after it.
           "race:^dGeomMoved$\n"
           // Nor is the dynamic linker. Its locks are not seen, and what they order looks like a race:
           // - an object's description, made by one thread and freed by another;
           "race:^_dl_close_worker$\n"
           // - an object's name, made by one thread and read by another that goes through all objects.
           "race:^dl_iterate_phdr_cb$\n";
}
}
