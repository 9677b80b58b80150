#include "ode_predictive_space/recording/printable.h"

#include <gtest/gtest.h>

namespace ode_predictive_space
{
namespace
{
TEST(Printable, TextsOfUtf8StayAsTheyAre)
{
    for (const std::string text : {"", "plain text, C:\\path", "12 \u00b5s \u2026 \u4e16 \U0001F600", "\u00a0"})
        EXPECT_EQ(printable(text), text);
}

TEST(Printable, BytesThatAreNoCharacterAreEscaped)
{
    EXPECT_EQ(printable("\x9b"
                        "31m"),
              "\\x9b31m")
        << "an escape sequence of one byte";
    EXPECT_EQ(printable("\xc3"), "\\xc3") << "cut";
    EXPECT_EQ(printable("\xe2\x80z"), "\\xe2\\x80z");
    EXPECT_EQ(printable("\xf5\x80\x80\x80\xff"), "\\xf5\\x80\\x80\\x80\\xff");
    EXPECT_EQ(printable("\xc0\x9b\xe0\x82\x9b\xf0\x80\x82\x9b"), "\\xc0\\x9b\\xe0\\x82\\x9b\\xf0\\x80\\x82\\x9b")
        << "longer forms of a control character";
}
} // namespace
} // namespace ode_predictive_space
