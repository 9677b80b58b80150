/* A second copy of ODE is recognised only by another definition of its functions in the process. */

__attribute__((visibility("default"))) void dSpaceGetNumGeoms(void) {}
