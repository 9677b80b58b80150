// A dSpaceCollide() that takes precedence over ODE's in a program, and drops one pair in a hundred of the predictive space.

#include <dlfcn.h>
#include <ode/ode.h>
#include <ode_predictive_space/predictive_space.h>

namespace
{
struct Caller
{
    void *data;
    dNearCallback *callback;
};

int reported = 0;

void pass_most(void *data, dGeomID first, dGeomID second)
{
    const auto *caller = static_cast<Caller *>(data);
    if (++reported % 100 != 0)
        caller->callback(caller->data, first, second);
}
} // namespace

void dSpaceCollide(dSpaceID space, void *data, dNearCallback *callback)
{
    static const auto real = reinterpret_cast<decltype(&dSpaceCollide)>(dlsym(RTLD_NEXT, "dSpaceCollide"));
    Caller caller = {data, callback};
    if (dSpaceIsPredictive(space) != 0)
        real(space, &caller, &pass_most);
    else
        real(space, data, callback);
}
