#include "ode_predictive_space/preload/counts_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include "ode_predictive_space/preload/output_file.h"

namespace ode_predictive_space::preload
{
namespace
{
constexpr std::uint32_t page_count = 4095;
constexpr char expected_magic[16] = "ode_counts 0.3";
constexpr int fixed_size = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL;
} // namespace

struct CountsFile::Layout
{
    struct alignas(counts_page_size) Page
    {
        SpaceCounts counts;
    };

    char magic[16];
    std::atomic<std::uint32_t> processes;
    std::atomic<std::uint32_t> taken;       // may exceed the number of pages
    std::atomic<std::uint32_t> lost_output; // not 0: yes
    Page pages[page_count];
};

namespace
{
void *map(int file, std::size_t size)
{
    void *memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    return memory != MAP_FAILED ? memory : nullptr;
}

bool has_fixed_size(int file, std::size_t size)
{
    struct stat status;
    const int seals = fcntl(file, F_GET_SEALS);
    return fstat(file, &status) == 0 && status.st_size == static_cast<off_t>(size) && seals >= 0 &&
           (seals & fixed_size) == fixed_size;
}

// A file of another process; -1 when there is none by this name.
int open_entry(const char *name)
{
    unsigned process = 0, file = 0;
    int end = 0;
    char path[64];
    if (!name || std::strlen(name) > 20 || std::sscanf(name, "%10u:%9u%n", &process, &file, &end) != 2 ||
        name[end] != 0)
        return -1;
    std::snprintf(path, sizeof path, "/proc/%u/fd/%u", process, file);
    return ::open(path, O_RDWR | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
}
} // namespace

std::unique_ptr<CountsFile> CountsFile::create()
{
    const NoSignalOfWriting quiet; // a limit for sizes of files holds for this one too
    const int file = memfd_create("ode_predictive_counts", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    if (file < 0)
        return nullptr;
    void *memory = nullptr;
    if (fallocate(file, 0, 0, sizeof(Layout)) == 0 && fcntl(file, F_ADD_SEALS, fixed_size) == 0)
        memory = map(file, sizeof(Layout));
    if (!memory)
    {
        const int reason = errno;
        close(file);
        errno = reason;
        return nullptr;
    }
    auto *layout = static_cast<Layout *>(memory);
    std::memcpy(layout->magic, expected_magic, sizeof expected_magic);
    return std::unique_ptr<CountsFile>(new CountsFile(file, layout));
}

std::unique_ptr<CountsFile> CountsFile::open(const char *name)
{
    const int file = open_entry(name);
    if (file < 0)
        return nullptr;
    void *memory = has_fixed_size(file, sizeof(Layout)) ? map(file, sizeof(Layout)) : nullptr;
    close(file);
    if (!memory)
        return nullptr;
    std::unique_ptr<CountsFile> opened(new CountsFile(-1, static_cast<Layout *>(memory)));
    const bool is_ours = std::memcmp(opened->layout_->magic, expected_magic, sizeof expected_magic) == 0;
    return is_ours ? std::move(opened) : nullptr;
}

CountsFile::~CountsFile()
{
    munmap(layout_, sizeof(Layout));
    if (file_ >= 0)
        close(file_);
}

std::string CountsFile::name() const
{
    return std::to_string(getpid()) + ":" + std::to_string(file_);
}

std::uint32_t CountsFile::new_process()
{
    return ++layout_->processes;
}

SpaceCounts *CountsFile::take_page()
{
    std::uint32_t number = layout_->taken;
    while (number < page_count && !layout_->taken.compare_exchange_weak(number, number + 1))
        continue;
    return number < page_count ? &layout_->pages[number].counts : nullptr;
}

void CountsFile::note_lost_output()
{
    layout_->lost_output = 1;
}

bool CountsFile::has_lost_output() const
{
    return layout_->lost_output != 0;
}

std::vector<SpaceCounts *> CountsFile::pages()
{
    std::vector<SpaceCounts *> all(std::min<std::uint32_t>(layout_->taken, page_count));
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = &layout_->pages[i].counts;
    return all;
}
} // namespace ode_predictive_space::preload
