/* A program that continues after ODE has refused its arguments. */

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <ode/ode.h>

static jmp_buf refused;

static void on_message(int number, const char *message, va_list arguments)
{
    (void)number;
    vprintf(message, arguments);
    printf("\n");
    longjmp(refused, 1);
}

static void ignore(void *data, dGeomID first, dGeomID second)
{
    (void)data;
    (void)first;
    (void)second;
}

int main(void)
{
    dSpaceID space;
    dInitODE2(0);
    dSetDebugHandler(&on_message);
    dSetErrorHandler(&on_message);
    space = dHashSpaceCreate(0);
    if (!setjmp(refused))
        dSpaceCollide(0, 0, &ignore);
    if (!setjmp(refused))
        dSpaceCollide2(0, (dGeomID)space, 0, &ignore);
    if (!setjmp(refused))
        dSpaceCollide2((dGeomID)space, 0, 0, &ignore);
    dSpaceCollide(space, 0, &ignore);
    dSpaceDestroy(space);
    dCloseODE();
    return 0;
}
