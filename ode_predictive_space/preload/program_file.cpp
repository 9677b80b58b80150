#include "ode_predictive_space/preload/program_file.h"

#include <cstddef>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace ode_predictive_space::preload
{
namespace
{
// A file in memory. Nothing in it is trusted: every range is checked before it is read.
class MappedFile
{
public:
    explicit MappedFile(const char *path)
    {
        const int file = open(path, O_RDONLY | O_CLOEXEC);
        struct stat status;
        if (file < 0)
            return;
        if (fstat(file, &status) == 0 && status.st_size > 0)
        {
            size_ = static_cast<std::size_t>(status.st_size);
            void *memory = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, file, 0);
            bytes_ = memory == MAP_FAILED ? nullptr : static_cast<const char *>(memory);
        }
        close(file);
    }
    MappedFile(const MappedFile &) = delete;
    MappedFile &operator=(const MappedFile &) = delete;
    ~MappedFile()
    {
        if (bytes_)
            munmap(const_cast<char *>(bytes_), size_);
    }

    template <typename T> const T *array(std::size_t offset, std::size_t count) const
    {
        if (!bytes_ || offset > size_ || count > (size_ - offset) / sizeof(T) || offset % alignof(T) != 0)
            return nullptr;
        return reinterpret_cast<const T *>(bytes_ + offset);
    }

private:
    const char *bytes_ = nullptr;
    std::size_t size_ = 0;
};

bool equals(const char *names, std::size_t size, std::size_t offset, const char *name)
{
    const std::size_t length = std::strlen(name) + 1;
    return offset <= size && length <= size - offset && std::memcmp(names + offset, name, length) == 0;
}

// Calls `visit` for each section that has names in another one, with both, until it returns true.
//
// @return whether it did.
template <typename Visit> bool any_section_with_names(const MappedFile &file, Visit visit)
{
    const auto *header = file.array<ElfW(Ehdr)>(0, 1);
    if (!header || std::memcmp(header->e_ident, ELFMAG, SELFMAG) != 0)
        return false;
    const auto *sections = file.array<ElfW(Shdr)>(header->e_shoff, header->e_shnum);
    if (!sections)
        return false;
    for (std::size_t i = 0; i < header->e_shnum; ++i)
        if (sections[i].sh_link < header->e_shnum && visit(sections[i], sections[sections[i].sh_link]))
            return true;
    return false;
}

// Defined, not only called: a call leaves a symbol without a section.
bool defines_function(const MappedFile &file, const ElfW(Shdr) & symbols, const ElfW(Shdr) & strings, const char *name)
{
    const std::size_t count = symbols.sh_size / sizeof(ElfW(Sym));
    const auto *symbol = file.array<ElfW(Sym)>(symbols.sh_offset, count);
    const char *names = file.array<char>(strings.sh_offset, strings.sh_size);
    if (!symbol || !names)
        return false;
    for (std::size_t i = 0; i < count; ++i)
        if (symbol[i].st_shndx != SHN_UNDEF && ELF64_ST_TYPE(symbol[i].st_info) == STT_FUNC &&
            equals(names, strings.sh_size, symbol[i].st_name, name))
            return true;
    return false;
}

// The name of the first such library; 0 when there is none, or a name that does not end within the section.
const char *needed_library(const MappedFile &file, const ElfW(Shdr) & dynamic, const ElfW(Shdr) & strings,
                           const char *beginning)
{
    const std::size_t count = dynamic.sh_size / sizeof(ElfW(Dyn));
    const auto *entry = file.array<ElfW(Dyn)>(dynamic.sh_offset, count);
    const char *names = file.array<char>(strings.sh_offset, strings.sh_size);
    for (std::size_t i = 0; entry && names && i < count; ++i)
    {
        const std::size_t offset = entry[i].d_un.d_val;
        if (entry[i].d_tag == DT_NEEDED && offset < strings.sh_size &&
            std::memchr(names + offset, 0, strings.sh_size - offset) &&
            std::strncmp(names + offset, beginning, std::strlen(beginning)) == 0)
            return names + offset;
    }
    return nullptr;
}
} // namespace

bool has_ode_built_in(const char *program_file)
{
    const MappedFile file(program_file);
    return any_section_with_names(file, [&](const ElfW(Shdr) & section, const ElfW(Shdr) & strings) {
        return (section.sh_type == SHT_SYMTAB || section.sh_type == SHT_DYNSYM) &&
               defines_function(file, section, strings, "dSpaceCollide");
    });
}

void find_needed_library(const char *program_file, const char *beginning, char *name, std::size_t size)
{
    const MappedFile file(program_file);
    name[0] = 0;
    any_section_with_names(file, [&](const ElfW(Shdr) & section, const ElfW(Shdr) & strings) {
        const char *found =
            section.sh_type == SHT_DYNAMIC ? needed_library(file, section, strings, beginning) : nullptr;
        if (found)
        {
            const std::size_t length = strnlen(found, size - 1);
            std::memcpy(name, found, length);
            name[length] = 0;
        }
        return found != nullptr;
    });
}
} // namespace ode_predictive_space::preload
