/* A program whose ODE says that it has another precision: what a program defines comes before what a library does. */

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
