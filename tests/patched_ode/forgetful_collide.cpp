// A dSpaceCollide for --wrap=dSpaceCollide that drops every tenth pair, to see that a demo notices a faulty space.

#include <ode/ode.h>

extern "C" void __real_dSpaceCollide(dSpaceID space, void *data, dNearCallback *callback);

namespace
{
struct Call
{
    void *data;
    dNearCallback *callback;
};

void pass_most_on(void *data, dGeomID first, dGeomID second)
{
    static int pairs = 0;
    const Call *call = static_cast<Call *>(data);
    if (++pairs % 10 != 0)
        call->callback(call->data, first, second);
}
} // namespace

extern "C" void __wrap_dSpaceCollide(dSpaceID space, void *data, dNearCallback *callback)
{
    Call call{data, callback};
    __real_dSpaceCollide(space, &call, &pass_most_on);
}
