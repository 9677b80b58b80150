/* All that tells a second copy of ODE: one more definition of its functions in the process. */

__attribute__((visibility("default"))) void dSpaceGetNumGeoms(void) {}
