/* The result of dlsym() depends on the library that calls it: this program is linked with a library that has which_library()
 * and looks for the next one. */

#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <dlfcn.h>
#include <stdio.h>

void *next_function_of_first_library(const char *name);

static const char *known(const void *function)
{
    return function ? "found" : "none";
}

int main(void)
{
    const char *(*next)(void) = 0;
    *(void **)&next = next_function_of_first_library("which_library");
    printf("%s\n", next ? next() : "none");
    printf("%s\n", known(dlsym(RTLD_DEFAULT, "no_such_function_of_any_library")));
    printf("%s\n", known(dlsym(RTLD_NEXT, "main")));
    dlerror();
    printf("%s\n", dlsym(RTLD_DEFAULT, "which_library") && !dlerror() ? "no error" : "an error");
    return 0;
}
