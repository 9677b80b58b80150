#include <array>
#include <cairo.h>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "demos/window/palette.h"
#include "tests/support/program.h"
#include "tests/support/scratch.h"

namespace ode_predictive_space::window
{
namespace
{
class Picture
{
public:
    explicit Picture(const std::string &file)
        : surface_(cairo_image_surface_create_from_png(file.c_str()), &cairo_surface_destroy)
    {}

    int width() const { return cairo_image_surface_get_width(surface_.get()); }
    int height() const { return cairo_image_surface_get_height(surface_.get()); }

    /// Number of pixels of an area with about this colour, compared by direction, as shading makes it darker.
    int count(const Colour &colour, int left, int top, int right, int bottom) const
    {
        int found = 0;
        for (int y = top; y < bottom; ++y)
        {
            for (int x = left; x < right; ++x)
            {
                found += is_like(pixel(x, y), colour) ? 1 : 0;
            }
        }
        return found;
    }

    int count(const Colour &colour) const { return count(colour, 0, 0, width(), height()); }

private:
    std::array<double, 3> pixel(int x, int y) const
    {
        const unsigned char *data = cairo_image_surface_get_data(surface_.get());
        const unsigned char *place = data + y * cairo_image_surface_get_stride(surface_.get()) + 4 * x;
        return {place[2] / 255.0, place[1] / 255.0, place[0] / 255.0};
    }

    static bool is_like(const std::array<double, 3> &pixel, const Colour &colour)
    {
        const std::array<double, 3> wanted = {colour.red, colour.green, colour.blue};
        double product = 0;
        double pixel_square = 0;
        double wanted_square = 0;
        for (std::size_t i = 0; i < 3; ++i)
        {
            product += pixel[i] * wanted[i];
            pixel_square += pixel[i] * pixel[i];
            wanted_square += wanted[i] * wanted[i];
        }
        return pixel_square > 0.15 && product > 0.98 * std::sqrt(pixel_square * wanted_square);
    }

    std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> surface_;
};

class HapticDemoWindow : public testing::Test
{
protected:
    /// A picture of a run in simulated time: always the same moment of the same run.
    Picture picture(const std::string &options)
    {
        const std::string file = folder_.path() + "/picture.png";
        const Outcome outcome = run_on_display("--fast --screenshot '" + file + "' " + options);
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_TRUE(contains(outcome.output, "Picture of")) << outcome.output;
        return Picture(file);
    }

    /// On a display of its own, which is drawn into memory.
    static Outcome run_on_display(const std::string &options)
    {
        setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
        return run("xvfb-run", "-a -s '-screen 0 1400x1000x24 -nolisten tcp' '" HAPTIC_DEMO "' " + options);
    }

    const ScratchFolder folder_;
};

TEST_F(HapticDemoWindow, ShowsProbeObjectsTextAndChart)
{
    const Picture shown = picture("--objects 60 --at 0.9");
    ASSERT_EQ(shown.width(), 1280);
    ASSERT_EQ(shown.height(), 800);
    const int all = shown.width() * shown.height();
    EXPECT_GT(shown.count(palette::probe), 200) << "the probe, and its envelope";
    EXPECT_GT(shown.count(palette::moving), 500) << "moving objects";
    EXPECT_GT(shown.count(palette::below), all / 10) << "the background";
    EXPECT_GT(shown.count(palette::text, 12, 12, 342, 234), 300) << "the readings";
    EXPECT_GT(shown.count(palette::near_probe, 1058, 12, 1120, 260), 100) << "the keys";
    EXPECT_GT(shown.count(palette::force, 12, 598, 652, 788), 100) << "the chart of the force";
}

TEST_F(HapticDemoWindow, ShowsAnotherScene)
{
    const Picture shown = picture("--scene pile --objects 40 --at 0.2");
    EXPECT_GT(shown.count(palette::moving), 2000);
    EXPECT_GT(shown.count(palette::probe), 100);
}

TEST_F(HapticDemoWindow, EndsByItselfWithASummary)
{
    const std::string file = folder_.path() + "/results.json";
    const Outcome outcome = run_on_display("--objects 30 --seconds 0.3 --json '" + file + "'");
    ASSERT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "real-time factor")) << outcome.output;
    EXPECT_FALSE(contains(outcome.output, "Ctrl-")) << "drawstuff's keys beside ours: " << outcome.output;
    const nlohmann::json results = nlohmann::json::parse(std::ifstream(file));
    EXPECT_GT(results.at("loop").at("ticks").get<int>(), 0);
    EXPECT_GT(results.at("pairs").get<int>(), 0);
}

TEST_F(HapticDemoWindow, SaysWhatAPictureCannotBeWrittenTo)
{
    const Outcome outcome = run_on_display("--fast --objects 5 --at 0.01 --screenshot /no/such/folder/a.png");
    EXPECT_EQ(outcome.status, 2) << outcome.output;
    EXPECT_TRUE(contains(outcome.output, "/no/such/folder/a.png cannot be written")) << outcome.output;
}
} // namespace
} // namespace ode_predictive_space::window
