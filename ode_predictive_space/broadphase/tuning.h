// The numbers that decide speed. No number here decides whether a pair is reported.
//
// Each has its unit, its reason, and the scene in which it was decided; docs/log/performance.md has the measurements.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_TUNING_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_TUNING_H

#include <cstddef>
#include <cstdint>

namespace ode_predictive_space::tuning
{
// --- Memory ---

/// Objects up to which everything that a tick reads of them stays in a cache from one tick to the next: prefetching would
/// cost more than it saves. (gas 1,000, pile 1,000)
constexpr std::size_t cached_objects = 300;
/// The same of what is read of geoms for their callbacks, two lines each, most of which the notice or the measuring has just read.
/// (floor 500, pile 1,000)
constexpr std::size_t cached_filters = 2000;

/// Turns of a loop over objects in which memory can be fetched. (gas 10,000)
constexpr std::size_t turns_ahead = 8;

/// Elements up to which an array keeps its memory whatever happens, and objects up to which the space does.
constexpr std::size_t kept_elements = 1024;

/// Objects about which the scene is asked in one call: so many answers fit into the first-level cache.
constexpr std::size_t objects_per_call = 32;

// --- Predict ---

/// How far envelopes reach ahead, in sizes of their objects: at first, varied by a quarter, at least, and at most. (heap 500, gas 1,000)
constexpr float first_reach = 0.5f, most_reach = 4;

/// The reach is divided by this when it costs more than the predictions that it saves, and multiplied when it does not.
constexpr float reach_step = 1.25f;

/// Instructions to test a pair and find it apart, and to predict. (game 1,000)
constexpr float cost_of_test = 20, cost_of_prediction = 2800;

/// Objects up to which to compare all boxes costs less than anything else: a space predicts nothing unless it has to, and a query reads
/// each geom. (many 17, nested 22)
constexpr std::size_t few_objects = 16;

/// Slack that every object gets that has moved or will, in sizes: for jitter, and for what turning does to a bounding box. An envelope
/// reaches at least as far, and less travel does not show how closely an object keeps to its path. (heap 500)
constexpr float slack = 0.01f;

/// How far an object may be off its path, as a part of the way: in an envelope the most. A forecast is as close as the last
/// predictions were. (heap 500: narrower envelopes break more often)
constexpr float first_spread = 0.02f, least_spread = 0.002f, most_spread = 0.1f;

/// Ticks in which all objects are reviewed for the farthest one. (far: twice as many are a hundred at most)
constexpr std::size_t ticks_per_review = 48;

/// The origin is moved when the middle of all envelopes is farther from it than so many half extents of the scene, and than so many
/// times the sum of an envelope's sides: rounding is then some hundredths of an object's size. (1,000 spheres at 1e4 to 5e6 m)
constexpr float far_in_extents = 4, far_in_sizes = 1e4f;

/// Questions after moves, one after the other without a tick, from which each such question counts as one: the program only asks, and
/// its objects must be predicted, too. (ask)
constexpr std::uint32_t queries_to_ticks = 16;

/// Collisions of the space without any move after which objects count as still. Some programs collide more than once per step.
constexpr std::uint64_t still_collisions = 8;

/// How far a forecast that a program asks for reaches, in sizes.
constexpr float forecast_reach = 9;
/// And how often its horizon is halved where paths bend. (a hand that goes away)
constexpr int forecast_halvings = 4;

// --- Index ---

/// Objects up to which a list is looked through more quickly than any tree. (game 150; ragdolls 20 and rain 200: a tree is better)
constexpr std::size_t small_scene = 192;

/// A batch of more than this part of the scene, one over the number, is swept with all others. (heap 500)
constexpr std::size_t part_of_bulk = 3;

/// A tree whose leaves got new boxes in place is kept if the areas of the boxes above them have grown by no more than this factor.
/// (another origin; 100 robots that are set back)
constexpr float worse_by_refitting = 1.5f;

/// Queries that go down a tree together: no query waits for another's nodes. (gas 10,000; 32 cost gas 100,000 a sixth)
constexpr std::size_t queries_together = 16;

/// Levels above an envelope in a tree: when a branch so small holds the envelope and its next one, that stays in its place.
/// (rain 1,000, heap 2,000: more is better; game 1,000: 3 is)
constexpr int levels_nearby = 4;

/// How much the half area of a box in a tree counts beside that by which it grows. (game 10,000, heap 2,000: 0 and 0.1 are worse)
constexpr float weight_of_size = 0.001f;

// --- Sort and sweep ---

/// Boxes up to which each is compared with each. (teleport 30; conveyor: 16 cost 5 %)
constexpr std::size_t few_boxes = 40;

/// Boxes that tell where most lie. (teleport 1,000)
constexpr std::size_t spread_samples = 24;

/// Standard deviations from the middle of an axis to the ends of its places.
constexpr double deviations_per_half = 4;

/// A slab is at least as wide as so many boxes, so that few boxes are in two slabs, and holds at least so many boxes.
/// (teleport 3,000 to 40,000)
constexpr double least_widths_per_slab = 4, least_boxes_per_slab = 1000;

// --- Near ---

/// Reports between two looks for pairs that may rest, and between two looks at the gap of a pair that has had none for long.
/// (gas 100,000, stack 1,000)
constexpr unsigned reports_per_rest = 32;

/// Instructions that a report less saves: the least of dCollide() for a pair whose contacts are costly to find, without those that bring
/// shapes up to date. (hills 1,300, shelves and room 2,500, drones 5,000; meshes beside meshes 17,000)
constexpr float cost_of_contacts = 1700;
/// Instructions of a look, beside the search for a gap; and of the search for each unit of Gap::work.
constexpr float cost_of_check = 1200, cost_of_reach = 150;
/// The part of that which reports pay in for looks; and reports whose whole cost an account begins with, for each pair. In the first
/// 500 reports, the one is as much as the other. (drum, meshes in meshes)
constexpr float part_for_checks = 1.0f / 64, allowed_reports = 8;

/// How far from a shape the nearest triangle of a mesh is looked for, in radii of the shape. (room 1,000)
constexpr double surface_search = 8;

/// Triangles farther away than this part of the distance of the nearest one that was found are not looked at: the gap is less by
/// as much. (room 1,000)
constexpr double near_enough = 0.8;

/// Steps in which hulls and trees are made at each tick, beside a geom that a person drives: some 0.25 ms. (room of 215,000 triangles)
constexpr std::size_t steps_per_tick = 12500;

/// Samples of a heightfield beyond which its box stands for it: 160 MB.
constexpr int most_heights = 1 << 24;

/// Points of a convex or mesh beyond which its box, in its own axes, stands for it. A mesh of more is mostly a landscape, which has
/// the other objects within its hull, and a hull takes about a millisecond per thousand points to make.
constexpr std::size_t most_hull_points = 10000;
} // namespace ode_predictive_space::tuning

#endif
