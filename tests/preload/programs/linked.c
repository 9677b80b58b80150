/* A program that is linked with ODE. */

#include "scene.h"

int main(void)
{
    run_scene();
    return 0;
}
