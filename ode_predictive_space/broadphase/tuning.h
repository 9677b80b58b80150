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
/// As above, for the two lines per geom that callbacks read; notices and measure have just read most. (floor 500, pile 1,000)
constexpr std::size_t cached_filters = 2000;

/// Prefetch distance in loop iterations. (gas 10,000)
constexpr std::size_t turns_ahead = 8;

/// Scratch arrays of up to this capacity, and spaces of fewer objects, keep their memory.
constexpr std::size_t kept_elements = 1024;

/// Objects per call of the scene: their observations fit into the first-level cache.
constexpr std::size_t objects_per_call = 32;

// --- Predict ---

/// Reach of envelopes, in object sizes: the initial one, varied by a quarter, and the maximum. (heap 500, gas 1,000)
constexpr float first_reach = 0.5f, most_reach = 4;

/// Factor by which the reach grows, or shrinks when its tests cost more than a prediction.
constexpr float reach_step = 1.25f;

/// Instructions of the test of a pair that is apart, and of a prediction. (game 1,000)
constexpr float cost_of_test = 20, cost_of_prediction = 2800;

/// Maximum number of objects for which comparing all boxes costs less than predictions or an index. (many 17, nested 22)
constexpr std::size_t few_objects = 16;

/// Constant part of the deviation, in object sizes, for jitter and for bounding boxes that change by turning. It is also the
/// minimum reach, and the minimum travel before the spread adapts. (heap 500)
constexpr float slack = 0.01f;

/// Spread: deviation per distance travelled. Envelopes use the maximum, as narrow ones break; forecasts adapt it. (heap 500)
constexpr float first_spread = 0.02f, least_spread = 0.002f, most_spread = 0.1f;

/// Ticks in which a review has read the envelopes of all objects. (far: twice as many are a hundred at most)
constexpr std::size_t ticks_per_review = 48;

/// Distances from the origin to the middle of all envelopes beyond which the origin moves: in half extents of the scene, and in
/// mean sums of an envelope's sides, where rounding is some hundredths of an object's size. (1,000 spheres at 1e4 to 5e6 m)
constexpr float far_in_extents = 4, far_in_sizes = 1e4f;

/// Queries after moves, without a tick, after which each further one counts as a tick, as programs may only query. (ask)
constexpr std::uint32_t queries_to_ticks = 16;

/// Collisions of the space without a move after which an object counts as still. Some programs collide more than once per step.
constexpr std::uint64_t still_collisions = 8;

/// Minimum reach of a forecast, in object sizes.
constexpr float forecast_reach = 9;
/// Maximum number of times that its horizon is halved when paths bend. (a hand that goes away)
constexpr int forecast_halvings = 4;

// --- Index ---

/// Maximum number of objects for which a list is faster than a tree. (game 150; ragdolls 20 and rain 200: a tree is better)
constexpr std::size_t small_scene = 192;

/// A batch of more than one part in this many of the scene is swept together with all other objects. (heap 500)
constexpr std::size_t part_of_bulk = 3;

/// Maximum growth of the inner boxes' areas up to which a refitted tree is kept. (another origin; 100 robots that are set back)
constexpr float worse_by_refitting = 1.5f;

/// Queries that walk the tree together, so that their cache misses overlap. (gas 10,000; 32 cost gas 100,000 a sixth)
constexpr std::size_t queries_together = 16;

/// Levels above a leaf that are searched for a box which holds its new envelope. If one does, the leaf stays in its place.
/// (rain 1,000, heap 2,000: more is better; game 1,000: 3 is)
constexpr int levels_nearby = 4;

/// Weight of a tree box's half area, relative to its growth, at insertion. (game 10,000, heap 2,000: 0 and 0.1 are worse)
constexpr float weight_of_size = 0.001f;

// --- Sort and sweep ---

/// Maximum number of boxes of which each is compared with each. (teleport 30; conveyor: 16 cost 5 %)
constexpr std::size_t few_boxes = 40;

/// Sample size for the distribution of boxes. (teleport 1,000)
constexpr std::size_t spread_samples = 24;

/// Standard deviations from the mean of an axis to the ends of its grid.
constexpr double deviations_per_half = 4;

/// Minimum width of a slab in mean box widths, and minimum number of boxes in it. (teleport 3,000 to 40,000)
constexpr double least_widths_per_slab = 4, least_boxes_per_slab = 1000;

// --- Near ---

/// Reports between searches for pairs that may rest; maximum between gap checks of a pair. (gas 100,000, stack 1,000)
constexpr unsigned reports_per_rest = 32;

/// Instructions that an omitted report saves: the least of dCollide() for a pair with costly contacts, less those that bring
/// shapes up to date. (hills 1,300, shelves and room 2,500, drones 5,000; meshes beside meshes 17,000)
constexpr float cost_of_contacts = 1700;
/// Instructions of a gap check without its search, and of the search per unit of Gap::work.
constexpr float cost_of_check = 1200, cost_of_reach = 150;
/// Part of cost_of_contacts that a report without a check pays in for checks, and number of reports whose whole cost is a
/// pair's allowance. After some 500 reports both sums are equal. (drum, meshes in meshes)
constexpr float part_for_checks = 1.0f / 64, allowed_reports = 8;

/// Search distance for the surface of a mesh or heightfield, in radii of the shape. (room 1,000)
constexpr double surface_search = 8;

/// Part of the nearest distance found beyond which triangles are skipped. The gap is underestimated by as much. (room 1,000)
constexpr double near_enough = 0.8;

/// Steps per tick for making hulls and trees while a person drives a geom: some 0.25 ms. (room of 215,000 triangles)
constexpr std::size_t steps_per_tick = 12500;

/// Maximum number of samples of a heightfield, 160 MB. A larger one is represented by its box.
constexpr int most_heights = 1 << 24;

/// Maximum number of points of a hull. A convex or mesh of more is represented by its box in its own axes: it is mostly a
/// landscape, with the other objects inside its hull, and making a hull takes about a millisecond per thousand points.
constexpr std::size_t most_hull_points = 10000;
} // namespace ode_predictive_space::tuning

#endif
