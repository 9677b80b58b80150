// The numbers that decide speed. No number here decides whether a pair is reported.
// Scenes in brackets are those in which a number was chosen; docs/log/performance.md has the measurements.

#ifndef ODE_PREDICTIVE_SPACE_BROADPHASE_TUNING_H
#define ODE_PREDICTIVE_SPACE_BROADPHASE_TUNING_H

#include <cstddef>
#include <cstdint>

namespace ode_predictive_space::tuning
{
// --- Memory ---

/// Maximum number of objects whose working set stays cached between ticks: prefetching does not pay. (gas 1,000, pile 1,000)
constexpr std::size_t cached_objects = 300;
/// As above, for the two lines per geom that callbacks read; notices and measure have just read most. (floor 500, lidar_nested)
constexpr std::size_t cached_filters = 2000;

/// Prefetch distance in loop iterations. (gas 10,000)
constexpr std::size_t prefetch_distance = 8;

/// Objects per call of the scene: their observations fit into the first-level cache.
constexpr std::size_t objects_per_call = 32;

// --- Predict ---

/// Reach of envelopes, in object sizes: of a new object, spread by +- 25 % so that not all leave theirs together, and the maximum.
/// (heap 500, gas 1,000)
constexpr float first_reach = 0.5f, most_reach = 4;

/// Factor by which a prediction lengthens the reach; it shortens it if the tests since the last prediction cost more than one.
constexpr float reach_step = 1.25f;

/// Tests of pairs that are apart that cost as much as a prediction. (game 1,000)
constexpr float tests_per_prediction = 140;

/// Maximum number of objects for which comparing all boxes costs less than predictions or an index. (many 17, nested 22)
constexpr std::size_t few_objects = 16;

/// Constant part of the deviation, in object sizes, for jitter and for bounding boxes that change by turning. It is also the
/// minimum reach, the minimum travel before the spread adapts, and the first spread. (heap 500)
constexpr float slack = 0.01f;

/// Maximum spread: deviation per distance travelled. Envelopes use it, as narrow ones break; forecasts adapt theirs. (heap 500)
constexpr float most_spread = 0.1f;

/// Ticks in which a review has read the envelopes of all objects. (far: twice as many are a hundred at most; shelves 10,000: 32 cost 4 %)
constexpr std::size_t ticks_per_review = 48;

/// Distance from the origin to the middle of all envelopes, in mean sums of an envelope's sides, beyond which the origin moves if
/// the middle is also farther away than half the extent of all: rounding is then some hundredths of an object's size. (1,000 spheres at 1e4 to 5e6 m)
constexpr float far_in_sizes = 1e4f;

/// Calls in a row that show a habit of the program. After so many queries after moves, without a tick, each further one counts as
/// a tick. After so many collisions without a move, an object counts as still: some programs collide more than once per step. (ask)
constexpr std::uint32_t calls_of_a_habit = 8;

// --- Index ---

/// Maximum number of objects for which a list is faster than a tree. (game 150; ragdolls 20 and rain 200: a tree is better)
constexpr std::size_t small_scene = 192;

/// A batch of more than one part in this many of the scene is swept together with all other objects. (heap 500)
constexpr std::size_t part_of_bulk = 3;

/// Maximum growth of the inner boxes' areas up to which a refitted tree is kept. (lidar_nested: + 27 % without refitting)
constexpr float worse_by_refitting = 1.5f;

/// Queries that walk the tree together, so that their cache misses overlap. (gas 10,000; 32 cost gas 100,000 a sixth)
constexpr std::size_t queries_together = 16;

/// Levels above a leaf that are searched for a box which holds its new envelope. If one does, the leaf stays in its place.
/// (rain 1,000, heap 2,000: more is better; game 1,000: 3 is)
constexpr int levels_nearby = 4;

// --- Sort and sweep ---

/// Maximum number of boxes of which each is compared with each; more boxes are sampled by as many, for the layout.
/// (teleport 30; conveyor: 16 cost 5 %)
constexpr std::size_t few_boxes = 40;

/// Standard deviations from the mean of an axis to the ends of its grid.
constexpr double deviations_per_half = 4;

/// Minimum number of boxes in a slab. (teleport 3,000 to 40,000)
constexpr double least_boxes_per_slab = 1000;

// --- Near ---

/// Reports between searches for pairs that may rest; maximum between gap checks of a pair. (gas 100,000, stack 1,000)
constexpr unsigned reports_per_rest = 32;

/// Costs of a gap check without its search, and of the search per unit of Gap::work. The unit is what an omitted report saves at
/// least: some 1,700 instructions of dCollide(). (hills 1,300, shelves and room 2,500, drones 5,000; meshes beside meshes 17,000)
constexpr float cost_of_check = 0.7f, cost_of_reach = 0.09f;
/// Income of an account per report without a check, and its allowance for each pair, in the same unit. After some 500 reports both
/// sums are equal. (drum, meshes in meshes)
constexpr float part_for_checks = 1.0f / 64, allowed_reports = 8;

/// Search distance for the surface of a mesh or heightfield, in radii of the shape. (room 1,000)
constexpr double surface_search = 8;

/// Part of a distance up to which a search for a gap goes on: farther triangles are skipped, and a larger gap ends the search between
/// hulls. The gap is underestimated by as much. (room 1,000)
constexpr double near_enough = 0.8;

// --- Limits. They bound answers, memory and the time of a tick, and are not for speed. ---

/// Reach of a forecast, in object sizes.
constexpr float forecast_reach = 9;
/// Maximum number of times that its horizon is halved when paths bend. (a hand that goes away)
constexpr int forecast_halvings = 4;

/// Scratch arrays of up to this capacity, and spaces of fewer objects, keep their memory.
constexpr std::size_t kept_elements = 1024;

/// Steps per tick for making hulls and trees while a person drives a geom: some 0.25 ms. (room of 215,000 triangles)
constexpr std::size_t steps_per_tick = 12500;

/// Maximum number of samples of a heightfield, 160 MB. A larger one is represented by its box.
constexpr int most_heights = 1 << 24;

/// Maximum number of points of a hull. A convex or mesh of more is represented by its box in its own axes: it is mostly a
/// landscape, with the other objects inside its hull, and making a hull takes about a millisecond per thousand points.
constexpr std::size_t most_hull_points = 10000;
} // namespace ode_predictive_space::tuning

#endif
