// A library for LD_PRELOAD that counts the work of a program's narrow phase. At exit it writes a line to the file that
// COUNT_CONTACTS names: calls of dCollide(), calls that found contacts, the number of contacts, and a hash of all contacts in
// their order.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <ode/contact.h>

namespace
{
using Collide = int (*)(dGeomID, dGeomID, int, dContactGeom *, int);

// The program's ODE may be private, as that of a Python extension is.
Collide odes_own()
{
    void *const ode = dlopen("libode.so.8", RTLD_LAZY | RTLD_NOLOAD);
    return ode != nullptr ? reinterpret_cast<Collide>(dlsym(ode, "dCollide")) : nullptr;
}

class Counts
{
public:
    ~Counts()
    {
        const char *name = std::getenv("COUNT_CONTACTS");
        std::FILE *file = name != nullptr && calls_ > 0 ? std::fopen(name, "a") : nullptr;
        if (file != nullptr)
        {
            std::fprintf(file, "%llu %llu %llu %016llx\n", calls_, touching_, contacts_, hash_);
            std::fclose(file);
        }
    }

    void add(const dContactGeom *contacts, int count, int skip)
    {
        ++calls_;
        touching_ += count > 0 ? 1 : 0;
        contacts_ += static_cast<unsigned>(count);
        const char *contact = reinterpret_cast<const char *>(contacts);
        for (int i = 0; i < count; ++i, contact += skip)
        {
            const auto *one = reinterpret_cast<const dContactGeom *>(contact);
            for (int axis = 0; axis < 3; ++axis)
            {
                add(one->pos[axis]);
                add(one->normal[axis]);
            }
            add(one->depth);
        }
    }

private:
    void add(dReal number)
    {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &number, sizeof number);
        hash_ = (hash_ ^ bits) * 0x100000001b3u; // FNV-1a, by words
    }

    unsigned long long calls_ = 0, touching_ = 0, contacts_ = 0, hash_ = 0xcbf29ce484222325u;
};
} // namespace

extern "C" [[gnu::visibility("default")]] int dCollide(dGeomID first, dGeomID second, int flags, dContactGeom *contacts,
                                                       int skip)
{
    static const Collide own = odes_own();
    static Counts counts;
    if (own == nullptr)
    {
        std::fputs("count_contacts: there is no libode.so.8 here\n", stderr);
        std::abort();
    }
    const int count = own(first, second, flags, contacts, skip);
    counts.add(contacts, count, skip);
    return count;
}
