// Random inputs for property tests, determined by a seed.

#ifndef ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_RANDOM_NUMBERS_H
#define ODE_PREDICTIVE_SPACE_TESTS_HAPTICS_SUPPORT_RANDOM_NUMBERS_H

#include "ode_predictive_space/haptics/touch.h"

#include <random>

namespace ode_predictive_space::haptics
{
class RandomNumbers
{
public:
    explicit RandomNumbers(unsigned seed) : engine_(seed) {}

    double between(double least, double most) { return std::uniform_real_distribution<double>(least, most)(engine_); }
    int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(engine_); }
    bool one_in(int count) { return below(count) == 0; }

    Vector3 direction()
    {
        Vector3 vector;
        do
            vector = in_cube(1);
        while (vector.norm() > 1 || vector.norm() < 0.1);
        return vector.normalized();
    }

    Vector3 in_cube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }

    Quaternion rotation() { return Quaternion(Eigen::AngleAxisd(between(-M_PI, M_PI), direction())); }

    ToolState tool()
    {
        ToolState tool;
        tool.position = in_cube(1);
        tool.orientation = rotation();
        tool.linear_velocity = in_cube(1);
        tool.angular_velocity = in_cube(3);
        return tool;
    }

    /// Touches of the objects 1 to `count`, up to 5 mm deep.
    std::vector<Touch> touches(int count)
    {
        std::vector<Touch> result(static_cast<std::size_t>(count));
        for (Touch &touch : result)
        {
            touch.point = in_cube(1);
            touch.normal = direction();
            touch.depth = between(0, 0.005);
            touch.surface_velocity = in_cube(0.5);
            touch.object = static_cast<std::uintptr_t>(&touch - result.data() + 1);
        }
        return result;
    }

private:
    std::mt19937_64 engine_;
};
} // namespace ode_predictive_space::haptics

#endif
