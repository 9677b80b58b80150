#include "ode_predictive_space/preload/counts_file.h"

#include <cstdio>
#include <set>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <gtest/gtest.h>

namespace ode_predictive_space::preload
{
namespace
{
std::string name_of(int file)
{
    return std::to_string(getpid()) + ":" + std::to_string(file);
}

TEST(CountsFile, IsTheSameForAllThatOpenIt)
{
    const auto created = CountsFile::create();
    ASSERT_TRUE(created);
    const auto first = CountsFile::open(created->name().c_str());
    const auto second = CountsFile::open(created->name().c_str());
    ASSERT_TRUE(first && second);
    SpaceCounts *ours = first->take_page(), *theirs = second->take_page();
    ASSERT_TRUE(ours && theirs);
    ours->number = 5;
    theirs->number = 6;
    ASSERT_EQ(created->pages().size(), 2u);
    EXPECT_EQ(created->pages()[0]->number, 5);
    EXPECT_EQ(created->pages()[1]->number, 6);
    EXPECT_NE(first->new_process(), second->new_process());
}

TEST(CountsFile, HasAnEnd)
{
    const auto file = CountsFile::create();
    ASSERT_TRUE(file);
    std::set<SpaceCounts *> taken;
    while (SpaceCounts *page = file->take_page())
    {
        EXPECT_EQ(page->number, 0);
        page->number = 1;
        ASSERT_TRUE(taken.insert(page).second);
    }
    EXPECT_GT(taken.size(), 4000u);
    EXPECT_EQ(file->take_page(), nullptr);
    EXPECT_EQ(file->pages().size(), taken.size());
}

// Whoever sets the environment may set this.
TEST(CountsFile, WrongNamesLeadToNone)
{
    const auto file = CountsFile::create();
    ASSERT_TRUE(file);
    const std::string name = file->name();
    for (const std::string &wrong :
         {std::string(), std::string(":"), std::string("1"), name + " ", name + "1", name + ":1", "/proc/" + name,
          std::string("99999999999:3"), std::string("0:0"), std::string(100, '1'), name_of(STDERR_FILENO), name_of(-1)})
        EXPECT_FALSE(CountsFile::open(wrong.c_str())) << wrong;
    EXPECT_FALSE(CountsFile::open(nullptr));
    EXPECT_TRUE(CountsFile::open(name.c_str()));
}

// An access beyond the end of a file that another process has made shorter would end the program.
TEST(CountsFile, OtherFilesAreNotUsed)
{
    const auto model = CountsFile::create();
    ASSERT_TRUE(model);
    const off_t size = lseek(model->file(), 0, SEEK_END);
    EXPECT_NE(ftruncate(model->file(), 0), 0);
    char magic[16];
    ASSERT_EQ(pread(model->file(), magic, sizeof magic, 0), 16);

    const int other = memfd_create("other", MFD_CLOEXEC | MFD_ALLOW_SEALING);
    ASSERT_GE(other, 0);
    ASSERT_EQ(ftruncate(other, size), 0);
    ASSERT_EQ(pwrite(other, magic, sizeof magic, 0), 16);
    EXPECT_FALSE(CountsFile::open(name_of(other).c_str())); // it can be made shorter
    ASSERT_EQ(fcntl(other, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL), 0);
    EXPECT_TRUE(CountsFile::open(name_of(other).c_str()));
    ASSERT_EQ(pwrite(other, "X", 1, 0), 1);
    EXPECT_FALSE(CountsFile::open(name_of(other).c_str())); // something else
    close(other);
}
} // namespace
} // namespace ode_predictive_space::preload
