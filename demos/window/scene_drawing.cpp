#include "demos/window/scene_drawing.h"

#include "demos/window/gl_shapes.h"
#include "demos/window/palette.h"

#include <algorithm>
#include <cmath>
#include <drawstuff/drawstuff.h>

namespace ode_predictive_space::window
{
namespace
{
constexpr double palest = 0.13;           // opacity of objects far from the probe
constexpr double arrow_at_full_force = 8; // radii of the probe
const double upright[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

Vector3 place_of(const DrawnGeom &geom)
{
    return {geom.position[0], geom.position[1], geom.position[2]};
}

bool contains(const std::vector<std::uintptr_t> &ids, std::uintptr_t id)
{
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

bool may_be_met_soon(const ProbeView &probe, std::uintptr_t id)
{
    constexpr double soon = 0.3; // s
    return std::any_of(probe.meetings.begin(), probe.meetings.end(),
                       [id](const Meeting &meeting) { return meeting.id == id && meeting.seconds <= soon; });
}

Colour colour_of(const DrawnGeom &geom, const ProbeView &probe)
{
    if (geom.part == Part::ground)
        return palette::still;
    if (contains(probe.touched, geom.id))
        return palette::touched;
    if (may_be_met_soon(probe, geom.id))
        return palette::near_probe;
    switch (geom.part)
    {
    case Part::moving:
        return palette::moving;
    case Part::asleep:
        return palette::asleep;
    case Part::still:
    case Part::ground:
    case Part::wall:
        break;
    }
    return palette::still;
}

/// From 1 beside the probe to `palest` far away, seen against the size of the room.
double opacity_of(const DrawnGeom &geom, const SceneView &view)
{
    const double clear = 4 * view.probe.radius;
    const double pale = std::max(2 * clear, 0.35 * (view.high - view.low).norm());
    const double distance = (place_of(geom) - view.probe.position).norm() - geom.radius;
    const double share = std::clamp((distance - clear) / (pale - clear), 0.0, 1.0);
    return 1 - (1 - palest) * std::sqrt(share);
}

void draw_geom(const DrawnGeom &geom, const Vector3 &shift)
{
    const Vector3 position = place_of(geom) + shift;
    const auto &size = geom.size;
    switch (geom.solid)
    {
    case Solid::sphere:
        dsDrawSphereD(position.data(), geom.rotation.data(), static_cast<float>(size[0]));
        break;
    case Solid::box:
    case Solid::bounds:
        dsDrawBoxD(position.data(), geom.rotation.data(), size.data());
        break;
    case Solid::capsule:
        dsDrawCapsuleD(position.data(), geom.rotation.data(), static_cast<float>(size[1]), static_cast<float>(size[0]));
        break;
    case Solid::cylinder:
        dsDrawCylinderD(position.data(), geom.rotation.data(), static_cast<float>(size[1]),
                        static_cast<float>(size[0]));
        break;
    case Solid::mesh:
        dsDrawTrianglesD(position.data(), geom.rotation.data(), geom.triangles->data(),
                         static_cast<int>(geom.triangles->size() / 9), 1);
        break;
    }
}

/// The far ones first: translucent objects are drawn from back to front.
std::vector<const DrawnGeom *> from_far_to_near(const SceneView &view, const Vector3 &eye)
{
    std::vector<std::pair<double, const DrawnGeom *>> keyed;
    for (const DrawnGeom &geom : view.geoms)
    {
        if (geom.part != Part::wall)
            keyed.emplace_back((place_of(geom) - eye).squaredNorm(), &geom);
    }
    std::sort(keyed.begin(), keyed.end(), [](const auto &a, const auto &b) { return a.first > b.first; });
    std::vector<const DrawnGeom *> result;
    for (const auto &[distance, geom] : keyed)
        result.push_back(geom);
    return result;
}

void draw_geoms(const SceneView &view, const Layers &layers, const Vector3 &eye, const Vector3 &shift)
{
    for (const DrawnGeom *geom : from_far_to_near(view, eye - shift))
    {
        const Colour colour = colour_of(*geom, view.probe);
        const double opacity = layers.only_nearby ? opacity_of(*geom, view) : 1;
        dsSetColorAlpha(colour.red, colour.green, colour.blue, static_cast<float>(opacity));
        draw_geom(*geom, shift);
    }
}

/// The twelve edges of a box.
std::vector<Segment> edges_between(const Vector3 &low, const Vector3 &high)
{
    std::vector<Segment> edges;
    for (int corner = 0; corner < 8; ++corner)
    {
        for (int axis = 0; axis < 3; ++axis)
        {
            if ((corner >> axis & 1) == 0)
            {
                const auto place = [&](int number) {
                    return Vector3((number & 1) != 0 ? high.x() : low.x(), (number & 2) != 0 ? high.y() : low.y(),
                                   (number & 4) != 0 ? high.z() : low.z());
                };
                edges.push_back({place(corner), place(corner | 1 << axis)});
            }
        }
    }
    return edges;
}

/// A grid on the floor, about half a metre wide.
std::vector<Segment> grid_on_floor(const Vector3 &low, const Vector3 &high)
{
    std::vector<Segment> lines;
    for (int axis = 0; axis < 2; ++axis)
    {
        const int cells = std::max(2, static_cast<int>(std::lround(2 * (high[axis] - low[axis]))));
        for (int i = 1; i < cells; ++i)
        {
            Vector3 from = low;
            Vector3 to(high.x(), high.y(), low.z());
            from[axis] = to[axis] = low[axis] + (high[axis] - low[axis]) * i / cells;
            lines.push_back({from, to});
        }
    }
    return lines;
}

void draw_room(const Vector3 &low, const Vector3 &high)
{
    draw_background(palette::above, palette::below);
    draw_lines(grid_on_floor(low, high), palette::room, 0.18f, 1);
    draw_lines(edges_between(low, high), palette::room, 0.5f, 1.5f);
}

void draw_near_pairs(const SceneView &view, const Vector3 &shift)
{
    std::vector<Segment> of_objects;
    std::vector<Segment> of_probe;
    for (const NearPair &pair : view.near_pairs)
    {
        const auto &e = pair.ends;
        (pair.with_probe ? of_probe : of_objects)
            .push_back({Vector3(e[0], e[1], e[2]) + shift, Vector3(e[3], e[4], e[5]) + shift});
    }
    draw_lines(of_objects, palette::pair, 0.6f, 1.5f);
    draw_lines(of_probe, palette::near_probe, 1, 3);
}

/// The moving objects around the probe over the time for which its own envelope is drawn.
std::vector<EnvelopeBall> envelopes_of_objects(const SceneView &view, const Vector3 &shift)
{
    std::vector<EnvelopeBall> balls;
    const double reach = 12 * view.probe.radius;
    for (const DrawnGeom &geom : view.geoms)
    {
        if (geom.part != Part::moving || (place_of(geom) - view.probe.position).norm() > reach)
            continue;
        const Vector3 velocity(geom.velocity[0], geom.velocity[1], geom.velocity[2]);
        for (double time = 0.05; time < 0.16; time += 0.05)
            balls.push_back({place_of(geom) + time * velocity + shift, geom.radius});
    }
    return balls;
}

void draw_envelopes(const SceneView &view, const Layers &layers, const Vector3 &shift)
{
    if (layers.object_envelopes)
        draw_glass_balls(envelopes_of_objects(view, shift), palette::moving, 0.5f);
    if (layers.envelopes)
    {
        std::vector<EnvelopeBall> balls = view.probe.path;
        for (EnvelopeBall &ball : balls)
            ball.centre += shift;
        draw_glass_balls(balls, palette::probe, 0.8f);
    }
}

void draw_probe(const SceneView &view, const Layers &layers, const Vector3 &shift)
{
    const Vector3 position = view.probe.position + shift;
    const double radius = view.probe.radius;
    const Vector3 &force = view.probe.force;
    dsSetColor(palette::probe.red, palette::probe.green, palette::probe.blue);
    dsDrawSphereD(position.data(), upright, static_cast<float>(radius));
    if (layers.force && force.norm() > 0 && view.probe.max_force > 0)
    {
        const double length = radius * (1 + arrow_at_full_force * force.norm() / view.probe.max_force);
        draw_arrow(position, length * force.normalized(), 0.3 * radius, palette::force);
    }
}
} // namespace

Vector3 shift_onto_floor(const SceneView &view)
{
    return {0, 0, -view.low.z()};
}

void draw_scene(const SceneView &view, const Layers &layers, const Vector3 &eye)
{
    const Vector3 shift = shift_onto_floor(view);
    draw_room(view.low + shift, view.high + shift);
    draw_probe(view, layers, shift);
    draw_geoms(view, layers, eye, shift);
    if (layers.near_pairs)
        draw_near_pairs(view, shift);
    draw_envelopes(view, layers, shift);
}
} // namespace ode_predictive_space::window
