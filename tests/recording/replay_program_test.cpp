#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include <ode/common.h>

#include "ode_predictive_space/recording/format.h"
#include "tests/support/program.h"
#include "tests/support/scratch.h"

namespace ode_predictive_space::recording
{
namespace
{
const std::string nested = std::string(RECORDINGS) + "/nested.odehist";

TEST(ReplayProgram, ExplainsItself)
{
    const Outcome outcome = run(REPLAYER, "--help");
    EXPECT_EQ(outcome.status, 0);
    for (const char *word : {"--space", "--pairs", "--from", "--json", "Exit status"})
        EXPECT_TRUE(contains(outcome.output, word)) << word;
    EXPECT_EQ(run(TOOL, "replay --help").output, outcome.output) << "a link is a call of the command";
    EXPECT_EQ(run(REPLAYER, "--version").status, 0);
}

TEST(ReplayProgram, RefusesWrongOptions)
{
    for (const char *arguments : {"", "--space octree x", "--speed x", "x y", "--space", "/nonexistent/file"})
    {
        const Outcome outcome = run(REPLAYER, arguments);
        EXPECT_EQ(outcome.status, 2) << arguments;
        EXPECT_EQ(count_of("\n", outcome.output), 1) << outcome.output;
    }
}

std::string bytes_of(const std::string &path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(ReplayProgram, WritesItsFiguresAsJson)
{
    const ScratchFile figures;
    const Outcome outcome = run(REPLAYER, "--pairs --space box --space sap --json " + figures.path() + " " + nested);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    const std::string json = bytes_of(figures.path());
    for (const char *part : {R"("counted_events": 0)", R"({"space": "box", "instructions_per_event": null)",
                             R"({"space": "sap", )", R"("agrees": true)"})
        EXPECT_TRUE(contains(json, part)) << json;
    EXPECT_FALSE(contains(json, R"({"space": "hash")")) << "it was not named";
    EXPECT_EQ(run(REPLAYER, "--pairs --space box --json /no/such/folder/x " + nested).status, 2);
}

TEST(ReplayProgram, RefusesEventsThatItCannotChoose)
{
    for (const char *options : {"--from x", "--from -1", "--to 0", "--every 0", "--every 3.5"})
        EXPECT_EQ(run(REPLAYER, std::string(options) + " " + nested).status, 2) << options;
}

std::string page_about(const std::string &recording)
{
    const ScratchFolder folder;
    const Outcome outcome = run(TOOL, "report " + recording + " " + folder.path());
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    return bytes_of(folder.path() + "/index.html");
}

// The first record is the note, which is shorter than 256 bytes.
std::size_t second_record(const std::string &bytes)
{
    return header_size + record_header_size + static_cast<unsigned char>(bytes[header_size]);
}

TEST(ReplayProgram, RefusesABrokenFileWithItsOffsetAndNothingElse)
{
    std::string bytes = bytes_of(nested);
    bytes[second_record(bytes) + 4] = 77; // no kind of record
    const ScratchFile broken;
    std::ofstream(broken.path(), std::ios::binary) << bytes;
    const Outcome outcome = run(REPLAYER, broken.path());
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(count_of("\n", outcome.output), 1) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, ": byte ")) << outcome.output;
}

TEST(ReplayProgram, SaysOfAFileWithoutAWholeRecordThatItIsNothing)
{
    for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{20}})
    {
        const ScratchFile cut;
        std::ofstream(cut.path(), std::ios::binary) << bytes_of(nested).substr(0, size);
        const Outcome outcome = run(REPLAYER, cut.path());
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(count_of("\n", outcome.output), 1) << outcome.output;
        EXPECT_TRUE(contains(outcome.output, "The recording is empty")) << outcome.output;
    }
}

// Once, it was refused as a whole.
TEST(ReplayProgram, ReplaysARecordingThatIsCutAndSaysWhere)
{
    if (sizeof(dReal) == sizeof(float))
        return;
    const std::string bytes = bytes_of(nested);
    const Outcome whole = run(REPLAYER, "--pairs --space box " + nested);
    EXPECT_TRUE(contains(whole.output, "The recording is whole.")) << whole.output;
    EXPECT_TRUE(contains(whole.output, "\nbox ")) << whole.output;
    EXPECT_TRUE(contains(whole.output, "the same")) << whole.output;
    const ScratchFile cut;
    std::ofstream(cut.path(), std::ios::binary) << bytes.substr(0, bytes.size() / 2);
    const Outcome outcome = run(REPLAYER, "--pairs --space box " + cut.path());
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    const std::string events = outcome.output.substr(outcome.output.find(": ") + 2);
    EXPECT_TRUE(
        contains(outcome.output, "The recording is cut at event " + std::to_string(std::stoi(events)) + ", byte "))
        << outcome.output;
    EXPECT_GT(std::stoi(events), 10);
    EXPECT_TRUE(contains(page_about(cut.path()), "<p>The recording is cut at event "));
}

// Once, the escape sequences of its note reached the terminal.
TEST(ReplayProgram, PrintsWhatAFileSuppliesWithoutControlCharacters)
{
    if (sizeof(dReal) == sizeof(float))
        return;
    const std::string bytes = bytes_of(nested);
    const std::string note = "\x1b[31mred\x1b[0m\nof another line \xc2\xb5";
    const std::string record = std::string(1, static_cast<char>(note.size())) + std::string("\0\0\0\1", 4) + note;
    const ScratchFile file;
    std::ofstream(file.path(), std::ios::binary)
        << bytes.substr(0, header_size) + record + bytes.substr(second_record(bytes));
    const Outcome outcome = run(REPLAYER, "--pairs --space box " + file.path());
    EXPECT_TRUE(contains(outcome.output, "\\x1b[31mred\\x1b[0m\\x0aof another line \xc2\xb5\n")) << outcome.output;
    const Outcome missing = run(REPLAYER, "$(printf '/nonexistent/\\033[31m')");
    EXPECT_EQ(missing.status, 2);
    EXPECT_TRUE(contains(missing.output, "/nonexistent/\\x1b[31m")) << missing.output;
}

TEST(ReplayProgram, WritesAPageThatSaysWhatWouldBeGained)
{
    if (sizeof(dReal) == sizeof(float))
        return;
    const std::string page = page_about(nested);
    for (const char *part : {"class=\"answer\"", "<th>spaces</th>", "Time per collide", "<svg", "</html>"})
        EXPECT_TRUE(contains(page, part)) << part << page;
    EXPECT_EQ(run(TOOL, "report " + nested + " /dev/null/folder").status, 2);
}
} // namespace
} // namespace ode_predictive_space::recording
