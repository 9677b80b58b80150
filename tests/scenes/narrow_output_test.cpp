#include "demos/runs/narrow_output.h"

#include <gtest/gtest.h>
#include <sstream>

namespace ode_predictive_space::worlds
{
namespace
{
const std::string words_of_70 = std::string(34, 'a') + ' ' + std::string(35, 'b');

TEST(NarrowOutput, BreaksAtTheLastBlankThatFits)
{
    EXPECT_EQ(folded(words_of_70 + " 123456789 c"), words_of_70 + " 123456789\nc");
    EXPECT_EQ(folded(words_of_70 + " 1234567890 c"), words_of_70 + "\n1234567890 c");
    EXPECT_EQ(folded("  " + words_of_70 + " 1234567890 c"), "  " + words_of_70 + "\n  1234567890 c");
}

TEST(NarrowOutput, FurtherLinesBeginBesideTheLabel)
{
    EXPECT_EQ(folded("Label     " + words_of_70 + " c"), "Label     " + words_of_70 + "\n          c");
    EXPECT_EQ(folded("  --option TEXT:{" + std::string(60, 'x') + "," + std::string(20, 'y') + "}"),
              "  --option TEXT:{" + std::string(60, 'x') + ",\n  " + std::string(20, 'y') + "}");
}

TEST(NarrowOutput, FoldsAStreamUntilItGoes)
{
    std::ostringstream out;
    {
        const NarrowOutput narrow(out);
        out << words_of_70 << ' ' << "1234567890\nshort\n" << std::flush;
        EXPECT_EQ(out.str(), words_of_70 + "\n1234567890\nshort\n");
        out << "last";
    }
    out << " and " << words_of_70 + words_of_70;
    EXPECT_EQ(out.str(), words_of_70 + "\n1234567890\nshort\nlast and " + words_of_70 + words_of_70);
}
/// A buffer that takes some bytes, and at last some lines of them.
class SmallBuffer : public std::stringbuf
{
    std::streamsize xsputn(const char *text, std::streamsize size) override
    {
        room_ -= size;
        return room_ >= 0 ? std::stringbuf::xsputn(text, size) : 0;
    }

    std::streamsize room_ = 10;
};

// The state of the stream went with the folding.
TEST(NarrowOutput, TellsWhetherAllIsWritten)
{
    for (const auto &[text, fits] :
         {std::pair("123456789\n", true), std::pair("1234567890\n", false), std::pair("12345\n6789", true),
          std::pair("12345\n67890", false), std::pair("12345678901\n1\n", false)})
    {
        SmallBuffer buffer;
        std::ostream out(&buffer);
        NarrowOutput narrow(out);
        out << text;
        EXPECT_EQ(narrow.finish(), fits) << text;
    }
}
} // namespace
} // namespace ode_predictive_space::worlds
