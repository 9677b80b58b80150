/* Two libraries have a function of the same name, and the first looks up that of the second. */

#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <dlfcn.h>

#define VISIBLE __attribute__((visibility("default")))

VISIBLE const char *which_library(void)
{
    return WHICH;
}

#ifdef LOOKS_FOR_NEXT
VISIBLE void *next_function_of_first_library(const char *name)
{
    void *volatile found = dlsym(RTLD_NEXT, name); /* a call, which returns here */
    return found;
}
#endif
