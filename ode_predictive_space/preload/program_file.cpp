#include "ode_predictive_space/preload/program_file.h"

#include <cstddef>
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
} // namespace

bool has_ode_built_in(const char *program_file)
{
    const MappedFile file(program_file);
    const auto *header = file.array<ElfW(Ehdr)>(0, 1);
    if (!header || std::memcmp(header->e_ident, ELFMAG, SELFMAG) != 0)
        return false;
    const auto *sections = file.array<ElfW(Shdr)>(header->e_shoff, header->e_shnum);
    for (std::size_t i = 0; sections && i < header->e_shnum; ++i)
    {
        const ElfW(Shdr) &section = sections[i];
        const bool has_symbols = section.sh_type == SHT_SYMTAB || section.sh_type == SHT_DYNSYM;
        if (has_symbols && section.sh_link < header->e_shnum &&
            defines_function(file, section, sections[section.sh_link], "dSpaceCollide"))
            return true;
    }
    return false;
}
} // namespace ode_predictive_space::preload
