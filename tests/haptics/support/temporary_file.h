// A file in the folder for temporary files, with a unique name. It is created only with a content, and the test removes it.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_TEMPORARY_FILE_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_TEMPORARY_FILE_H

#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <unistd.h>

namespace ode_predictive_space::haptics
{
class TemporaryFile
{
public:
    TemporaryFile()
    {
        const testing::TestInfo &test = *testing::UnitTest::GetInstance()->current_test_info();
        name_ =
            testing::TempDir() + test.test_suite_name() + "." + test.name() + "." + std::to_string(getpid()) + ".txt";
    }

    explicit TemporaryFile(const std::string &content) : TemporaryFile() { std::ofstream(name_) << content; }

    ~TemporaryFile() { std::remove(name_.c_str()); }
    TemporaryFile(const TemporaryFile &) = delete;
    TemporaryFile &operator=(const TemporaryFile &) = delete;

    const std::string &name() const { return name_; }

    std::string content() const
    {
        std::ifstream file(name_);
        return {std::istreambuf_iterator<char>(file), {}};
    }

private:
    std::string name_;
};
} // namespace ode_predictive_space::haptics

#endif
