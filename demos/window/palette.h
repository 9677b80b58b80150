// The colours of the window, so that the same things look alike in the scene, the chart and the text.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_PALETTE_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_PALETTE_H

namespace ode_predictive_space::window
{
/// Each from 0 to 1.
struct Colour
{
    float red, green, blue;
};

namespace palette
{
constexpr Colour still{0.62f, 0.68f, 0.76f};
constexpr Colour moving{0.25f, 0.62f, 0.60f};
constexpr Colour asleep{0.55f, 0.52f, 0.47f};
constexpr Colour touched{0.93f, 0.22f, 0.35f};
constexpr Colour near_probe{0.98f, 0.80f, 0.30f};
constexpr Colour probe{1.00f, 0.50f, 0.05f};
constexpr Colour force{0.95f, 0.10f, 0.55f};
constexpr Colour period{0.30f, 0.75f, 1.00f};
constexpr Colour compute{0.45f, 0.90f, 0.45f};
constexpr Colour above{0.80f, 0.86f, 0.93f};
constexpr Colour below{0.97f, 0.97f, 0.96f};
constexpr Colour room{0.30f, 0.36f, 0.45f};
constexpr Colour pair{0.16f, 0.30f, 0.62f};
constexpr Colour text{0.93f, 0.95f, 0.97f};
constexpr Colour faint_text{0.62f, 0.68f, 0.75f};
constexpr Colour alarm{1.00f, 0.45f, 0.40f};
constexpr Colour panel{0.06f, 0.08f, 0.12f};
} // namespace palette
} // namespace ode_predictive_space::window

#endif
