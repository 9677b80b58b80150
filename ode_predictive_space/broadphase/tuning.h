// The numbers that decide speed. No number here decides whether a pair is reported.
//
// Each has its unit, its reason, and the scene in which it was decided; docs/performance_log.md has the measurements.

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

/// The same of their measured boxes, 32 bytes each. (pile 2,000)
constexpr std::size_t cached_boxes = 2000;

/// The same of what the report reads of geoms after their boxes were measured in the same tick. (pile 1,000)
constexpr std::size_t cached_measured = 2000;

/// Turns of a loop over objects in which memory can be fetched. (gas 10,000)
constexpr std::size_t turns_ahead = 8;

/// The same for a loop over near pairs, whose turns are shorter. (game 10,000)
constexpr std::size_t pairs_ahead = 16;

/// Elements up to which an array that is filled anew in each tick keeps its memory whatever happens.
constexpr std::size_t kept_scratch = 1024;

/// Objects from which memory is given back when three quarters of them are gone.
constexpr std::size_t least_trimmed = 1024;

/// Objects about which the scene is asked in one call: so many answers fit into the first-level cache.
constexpr std::size_t objects_per_call = 32;

// --- Verify ---

/// Looks at an object that stopped within its envelope that cost as much as one prediction. (stack 1,000)
constexpr std::uint32_t looks_per_prediction = 32;

// --- Predict ---

/// Ticks for which a first prediction is trusted as long as it holds. Longer ones sweep farther before they break, and cost
/// more in dense contact. (gas 10,000, pile 2,000)
constexpr std::uint32_t first_horizon = 1024;

/// Ticks: an object that needs more of them to use up half of its slack is treated as still. (stack 1,000)
constexpr double still_ticks = 64;

/// How far an envelope may reach along its path, in sizes of its object; the second for objects among others. Longer sweeps
/// find more candidates than they save predictions. (gas 1,000, terrain; pile 500)
constexpr double reach_alone = 9, reach_crowded = 1;

/// How far the deviation may grow by its rate, in sizes. A deviation as wide as the object produces distant candidate pairs,
/// and hides that the path is wrong. (mix 20)
constexpr double most_widening = 0.4;

/// Slack that every object of the environment gets once it has moved, in sizes: for jitter, and for what turning does to a
/// bounding box. (explosion 1,000)
constexpr double slack_of_centre = 0.015, slack_of_bounds = 0.03;

/// Ticks after which an object that has come to rest is looked at once more. If it has not moved at all, it gets no slack any
/// more, which would keep it near its neighbours. (stack 1,000)
constexpr std::uint32_t settling_ticks = 128;

/// Ticks: older samples of an object whose path broke tell nothing about its motion.
constexpr std::int32_t recent_ticks = 8;

/// Times in a row that a body's velocity may fail to explain its motion before positions are trusted instead. (pile 500)
constexpr std::uint8_t patience = 3;

/// Objects recognised as interactive whose position is sampled at each tick: a hand is, a crowd is not.
constexpr std::size_t most_sampled = 64;

/// Ticks that tight bounds must last, with the object's present spin, to be worth their price. (pile 500)
constexpr double least_tight_ticks = 20;

/// Ticks that an object must need to move by its own size to be worth tight bounds among others. (gas 10,000)
constexpr double lingering_ticks = 600;

// --- Index ---

/// Objects up to which a list is looked through more quickly than any tree. (mix 20 to 100, game 100)
constexpr std::size_t small_scene = 128;

/// Objects in a batch from which the trees are built anew, if the batch is also more than half of what they hold: inserting
/// one by one takes twice as long then. (first tick of gas 1,000)
constexpr std::size_t least_bulk = 16;

/// Queries that go down a tree together: no query waits for another's nodes. (gas 10,000; 32 cost gas 100,000 a sixth)
constexpr std::size_t queries_together = 16;

/// Nodes of a tree from which a batch's leaves are prefetched before they move.
constexpr std::size_t uncached_nodes = 256;

// --- Sort and sweep ---

/// Boxes up to which each is compared with each. (teleport 30)
constexpr std::size_t few_boxes = 40;

/// Boxes that tell where most lie. (teleport 1,000)
constexpr std::size_t spread_samples = 24;

/// Standard deviations from the middle of an axis to the ends of its places.
constexpr double deviations_per_half = 4;

/// A slab is at least as wide as so many boxes, so that few boxes are in two slabs, and holds at least so many boxes.
/// (teleport 3,000 to 40,000)
constexpr double least_widths_per_slab = 4, least_boxes_per_slab = 1000;

/// Boxes from which keys are sorted by digits of 11 bits in place of 8.
constexpr std::size_t wide_digits = 4096;

// --- Schedule ---

/// Events at which stale ones are first purged.
constexpr std::size_t least_purge = 4096;

// --- Near ---

/// Reports between two looks for pairs that may rest. (gas 100,000, stack 1,000)
constexpr unsigned reports_per_rest = 32;

/// Reports between two looks at the gap of a pair that has had none for long.
constexpr int longest_pause = 64;

/// Points of a convex or mesh beyond which its box, in its own axes, stands for it. A mesh of more is mostly a landscape, which has
/// the other objects within its hull, and a hull takes about a millisecond per thousand points to make.
constexpr std::size_t most_hull_points = 10000;

// --- Sweeping ---

/// A prediction costs about as much as sweeping so many objects. (explosion 1,000, teleport 1,000)
constexpr std::size_t sweeps_per_prediction = 6;

/// Ticks in a row in which most predictions broke before the scene is swept.
constexpr int tolerated_failures = 3;

/// Ticks in a row that predictions hold before an earlier failure is forgotten.
constexpr int proven_ticks = 64;

/// Ticks of calm motion asked for before all is predicted again; doubled, up to the second number, each time that the calm did
/// not last.
constexpr int first_calm = 4, last_calm = 256;

/// Objects are predicted in so many parts after the scene was swept, unless parts would be smaller than the least one: to
/// predict all takes as long as several sweeps. (explosion 10,000)
constexpr std::size_t parts = 16, least_part = 64;

/// Broken predictions that are repaired in the same tick: this part of the scene, and at least so many. (explosion 1,000)
constexpr std::size_t part_at_once = 16, least_at_once = 64;

/// Objects whose motion is sampled while the scene is swept: an eighth of it within these bounds.
constexpr std::size_t least_samples = 8, most_samples = 32;

/// Looks in a row that find the samples disturbed before sampling pauses, and ticks for which it does: among few objects a
/// look costs as much as sweeping them. (teleport 10)
constexpr int disturbed_looks = 4, pause_ticks = 16;

/// Questions at one tick, each looking at all objects that have no prediction, that cost as much as predicting them.
/// (query without collide)
constexpr int questions_worth_predictions = 50;
} // namespace ode_predictive_space::tuning

#endif
