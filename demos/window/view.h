// The contents of the window: the state of a run at one moment, as plain data without ODE.

#ifndef ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_VIEW_H
#define ODE_PREDICTIVE_SPACE_DEMOS_WINDOW_VIEW_H

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace ode_predictive_space::window
{
using Vector3 = Eigen::Vector3d;

/// The triangles of a mesh in its own frame, in metres: nine numbers each, counter-clockwise from outside.
using Triangles = std::vector<double>;

/// How a geom can be drawn.
enum class Solid
{
    sphere,   ///< size: radius
    box,      ///< size: the three sides
    capsule,  ///< size: radius, length without the caps
    cylinder, ///< size: radius, length
    mesh,     ///< triangles
    bounds    ///< its bounding box alone, in the scene's frame; size: the three sides
};

/// The kind of a geom in the scene, which gives its colour.
enum class Part
{
    still,
    moving,
    asleep, ///< its body is disabled
    ground, ///< below all: drawn in one colour, whatever touches it
    wall    ///< of the room: it would hide what is inside
};

/// A drawn geom. Metres.
struct DrawnGeom
{
    std::uintptr_t id = 0; ///< the same from view to view
    Solid solid = Solid::sphere;
    Part part = Part::still;
    std::array<double, 3> size{};
    std::array<double, 3> position{};
    std::array<double, 12> rotation{}; ///< as ODE has it: three rows of four
    std::array<double, 3> velocity{};  ///< m/s; of its body
    double radius = 0;                 ///< of a sphere around it
    std::shared_ptr<const Triangles> triangles{};
};

/// Something that the probe can meet.
struct Meeting
{
    std::uintptr_t id = 0; ///< of the geom
    double seconds = 0;    ///< from now; 0 when it is near now
};

/// A piece of a predicted path: a sphere that the geom does not leave as long as the prediction holds.
struct EnvelopeBall
{
    Vector3 centre = Vector3::Zero();
    double radius = 0; ///< m
};

/// The probe and its force.
struct ProbeView
{
    Vector3 position = Vector3::Zero();
    double radius = 0;                   ///< m
    double max_force = 0;                ///< N; of the device; 0 when it is not known
    Vector3 force = Vector3::Zero();     ///< N; on the hand
    std::vector<EnvelopeBall> path;      ///< from now on
    std::vector<std::uintptr_t> touched; ///< ids of the geoms that it touches
    std::vector<Meeting> meetings;       ///< soonest first
};

/// One column of the strip chart: the largest values of some ticks.
struct ChartColumn
{
    float force = 0;   ///< N
    float period = 0;  ///< ms; from one tick to the next
    float compute = 0; ///< ms; of a tick
};

/// Two geoms whose bounding boxes overlap, by their centres.
struct NearPair
{
    std::array<float, 6> ends{}; ///< m
    bool with_probe = false;
};

/// A line of text: a name and a value.
struct Reading
{
    std::string name;
    std::string value;
    bool alarming = false;
};

/// A key and its effect.
struct KeyHelp
{
    std::string key;
    std::string meaning;
    bool on = true; ///< of a switch
};

/// The scene at one moment.
struct SceneView
{
    double time = 0;                                       ///< simulated seconds
    Vector3 low = Vector3::Zero(), high = Vector3::Zero(); ///< corners of the room, m
    std::vector<DrawnGeom> geoms;                          ///< without the probe
    std::vector<NearPair> near_pairs;
    ProbeView probe;
};

/// The whole contents of the window.
struct View : SceneView
{
    std::vector<ChartColumn> chart; ///< the latest last
    double chart_seconds = 0;       ///< in one column
    double nominal_period = 0;      ///< ms; 0 when time is simulated, and no periods are shown
    std::vector<Reading> readings;
    std::string heading;
    std::string notice; ///< the last event that the person should know
};
} // namespace ode_predictive_space::window

#endif
