// dlsym(), caught: it comes before that of the C library.
//
// With RTLD_NEXT and RTLD_DEFAULT, the result of dlsym() depends on its caller, which it derives from its return address. A lookup of
// any other function than a caught one of ODE is therefore passed on by a jump, which keeps that address. This takes a few lines
// of assembler for each processor. On other processors dlsym() is not caught.
//
// Sanitizers call dlsym() before any constructor has run, so nothing in this file is instrumented. It must not be optimised together
// with other files: the compiler does not see the calls between the assembler and the rest.

#include "ode_predictive_space/preload/looked_up.h"

#include <cstring>

#include <dlfcn.h>

namespace ode_predictive_space::preload
{
namespace
{
using Lookup = void *(*)(void *handle, const char *name);

#if defined(__x86_64__) && !defined(__ILP32__)
#define ODE_PREDICTIVE_SPACE_CATCHES_DLSYM 1
constexpr const char *first_version = "GLIBC_2.2.5";
#elif defined(__aarch64__)
#define ODE_PREDICTIVE_SPACE_CATCHES_DLSYM 1
constexpr const char *first_version = "GLIBC_2.17";
#endif

#ifdef ODE_PREDICTIVE_SPACE_CATCHES_DLSYM
// Two threads may both look it up, with the same result.
Lookup next_lookup()
{
    static Lookup next;
    Lookup known = __atomic_load_n(&next, __ATOMIC_RELAXED);
    if (!known)
    {
        known = reinterpret_cast<Lookup>(dlvsym(RTLD_NEXT, "dlsym", first_version));
        __atomic_store_n(&next, known, __ATOMIC_RELAXED);
    }
    return known;
}

CaughtFunction caught_function(const char *name)
{
    static const char *const names[] = {"dSimpleSpaceCreate",        "dHashSpaceCreate", "dQuadTreeSpaceCreate",
                                        "dSweepAndPruneSpaceCreate", "dSpaceCollide",    "dSpaceCollide2"};
    int number = 0;
    // At the start of a process strcmp() may be a sanitizer's that is not ready yet.
    if (!name || name[0] != 'd')
        return caught_function_count;
    while (number < caught_function_count && std::strcmp(name, names[number]) != 0)
        ++number;
    return static_cast<CaughtFunction>(number);
}

void *look_up_for_program(void *handle, const char *name)
{
    void *found = find_symbol(handle, name);
    if (!found)
        return nullptr;
    void *answer = answer_to_lookup(caught_function(name), found);
    dlerror(); // clears errors of our own lookups
    return answer;
}
#endif
} // namespace

#ifdef ODE_PREDICTIVE_SPACE_CATCHES_DLSYM
void *find_symbol(void *handle, const char *name)
{
    return next_lookup()(handle, name);
}
#else
void *find_symbol(void *handle, const char *name)
{
    return dlsym(handle, name);
}
#endif
} // namespace ode_predictive_space::preload

#ifdef ODE_PREDICTIVE_SPACE_CATCHES_DLSYM
/// Returns the function that the assembler below jumps to for a call of dlsym().
extern "C" __attribute__((visibility("hidden"), used)) void *ode_predictive_lookup(void *handle, const char *name)
{
    using namespace ode_predictive_space::preload;
    // In the global scope our functions come first.
    const bool is_one_library = handle != RTLD_NEXT && handle != RTLD_DEFAULT;
    const bool is_ours = is_one_library && caught_function(name) != caught_function_count && !sees_ode_itself();
    return reinterpret_cast<void *>(is_ours ? &look_up_for_program : next_lookup());
}
#endif

#if defined(__x86_64__) && !defined(__ILP32__)
asm(R"(
    .text
    .p2align 4
    .globl dlsym
    .type dlsym, @function
dlsym:
    .cfi_startproc
    endbr64
    push %rdi
    .cfi_adjust_cfa_offset 8
    push %rsi
    .cfi_adjust_cfa_offset 8
    sub $8, %rsp
    .cfi_adjust_cfa_offset 8
    call ode_predictive_lookup
    add $8, %rsp
    .cfi_adjust_cfa_offset -8
    pop %rsi
    .cfi_adjust_cfa_offset -8
    pop %rdi
    .cfi_adjust_cfa_offset -8
    jmp *%rax
    .cfi_endproc
    .size dlsym, .-dlsym
)");
#elif defined(__aarch64__)
asm(R"(
    .text
    .p2align 4
    .globl dlsym
    .type dlsym, %function
dlsym:
    .cfi_startproc
    hint 34
    stp x29, x30, [sp, -32]!
    .cfi_def_cfa_offset 32
    .cfi_offset 29, -32
    .cfi_offset 30, -24
    stp x0, x1, [sp, 16]
    bl ode_predictive_lookup
    mov x16, x0
    ldp x0, x1, [sp, 16]
    ldp x29, x30, [sp], 32
    .cfi_restore 29
    .cfi_restore 30
    .cfi_def_cfa_offset 0
    br x16
    .cfi_endproc
    .size dlsym, .-dlsym
)");
#endif
