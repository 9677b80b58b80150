/* A program whose ODE reports another precision: the definitions of a program come before those of a library. */

#include "scene.h"

__attribute__((visibility("default"))) int dCheckConfiguration(const char *token)
{
    (void)token;
    return 0;
}

int main(void)
{
    run_scene();
    return 0;
}
