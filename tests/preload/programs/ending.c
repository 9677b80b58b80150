/* A program that collides three times and ends in a given way.
 * Usage: ending WAY: return, exit, _exit, abort, crash, a signal's number; many: after it has made 1099 more spaces; or
 * wait: it prints its process id, then waits for signals. SIGINT and SIGUSR1 are counted, and SIGTERM ends it with their
 * number as status. After two minutes it prints a message and ends. With become the
 * process executes the program again, without a way. */

#define _GNU_SOURCE

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <ode/ode.h>

static volatile sig_atomic_t counted;
static volatile int *volatile nowhere;

static void say(const char *text)
{
    if (write(1, text, strlen(text)) < 0)
        _exit(100);
}

static void on_signal(int number)
{
    if (number == SIGTERM)
        _exit(counted);
    if (number == SIGALRM)
    {
        say("late\n");
        _exit(101);
    }
    ++counted;
    say("counted\n");
}

static void wait_for_signals(void)
{
    signal(SIGINT, &on_signal);
    signal(SIGUSR1, &on_signal);
    signal(SIGTERM, &on_signal);
    signal(SIGALRM, &on_signal);
    alarm(120);
    printf("%d\n", (int)getpid());
    fflush(stdout);
    for (;;)
        pause();
}

static void ignore(void *data, dGeomID first, dGeomID second)
{
    (void)data;
    (void)first;
    (void)second;
}

static void make_spaces(int count)
{
    while (count-- > 0)
    {
        dSpaceID space = dHashSpaceCreate(0);
        dSpaceCollide(space, 0, &ignore);
        dSpaceDestroy(space);
    }
}

static void end(const char *way)
{
    if (strcmp(way, "exit") == 0)
        exit(4);
    if (strcmp(way, "_exit") == 0)
        _exit(5);
    if (strcmp(way, "abort") == 0)
        abort();
    if (strcmp(way, "crash") == 0)
        *nowhere = 0;
    if (strcmp(way, "become") == 0)
        execl("/proc/self/exe", "ending", (char *)0);
    if (strcmp(way, "many") == 0)
        make_spaces(1099);
    if (strcmp(way, "wait") == 0)
        wait_for_signals();
    if (atoi(way) > 0)
        kill(getpid(), atoi(way));
}

int main(int argc, char **argv)
{
    dSpaceID space;
    int i;
    dInitODE2(0);
    space = dHashSpaceCreate(0);
    dCreateSphere(space, 1);
    dCreateSphere(space, 1);
    for (i = 0; i < 3; ++i)
        dSpaceCollide(space, 0, &ignore);
    if (argc > 1)
        end(argv[1]);
    dSpaceDestroy(space);
    dCloseODE();
    return 0;
}
