"""The deliberate faults: for each stage of the tick, mistakes that its code could have.

`find` stands in the file exactly once. `first` names the tests that are likely to notice: (suite, GoogleTest filter), in
the order in which they are run; a suite is one of run_mutations.SUITES. A fault that they do not notice goes on to all tests
of all suites. A fault with a text in `equivalent` changes nothing that a program can see: it says why, and no test may fail.
"""

import dataclasses

STAGES = ("verify", "predict", "index", "schedule", "near", "shapes", "sweep", "space")
SOURCES = "ode_predictive_space/"
BROADPHASE = SOURCES + "broadphase/"

# Worlds of plain structs, compared with brute force at each tick.
ANY_WORLD = ("broadphase", "*AnyWorld*")
HISTORIES = ("differential", "*SamePairs*")
CONTACT_HISTORIES = (("histories", "*"),)


@dataclasses.dataclass(frozen=True)
class Fault:
    name: str
    stage: str
    file: str
    find: str
    replace: str
    first: tuple = ()
    equivalent: str = ""


def verify_faults():
    verifier = BROADPHASE + "verify/verifier.cpp"
    yield Fault(
        "skip_verify", "verify", verifier,
        "if (!holds || has_stopped(moved_, id, now.now))", "if (check == Check::none || has_stopped(moved_, id, now.now))",
        (("broadphase", "Verifier.*:Tick.*:Resting.*:*AnyWorld*"),))
    yield Fault(
        "ignored_growth", "verify", verifier,
        "return location.squared_radius <= radius * radius && centre_inside",
        "return (radius >= 0) & centre_inside",
        (("broadphase", "Verifier.*"), ("contract", "Notice.*:*GrowsWhileFarAndMoving*")))
    yield Fault(
        "ignored_stop", "verify", verifier,
        "stopped = now.time_passed ? now.moving.word(i) & ~moved_.word(i) & included : 0", "stopped = 0",
        (("broadphase", "Tick.*:*AnyWorld*"), ("contract", "Notice.*")))
    yield Fault(
        "trusted_at_another_tick", "verify", verifier,
        "(now.as_expected ? doubtful_.word(i) & included : moved) | stopped",
        "(doubtful_.word(i) & moved) | stopped",
        (("broadphase", "Tick.*:*AnyWorld*"), ("contract", "Notice.*")))
    yield Fault(
        "unbounded_trusted", "verify", verifier,
        "return !record.placement.unbounded && (surely_inside", "return (surely_inside", (("broadphase", "Verifier.*"),))
    yield Fault(
        "one_side_of_the_bounds", "verify", BROADPHASE + "verify/checks.h",
        "return box.inside(low + rounding, high - rounding) && !record.placement.unbounded;",
        "return box.inside(low + rounding, high + high - low) && !record.placement.unbounded;",
        (("contract", "Notice.*:EveryPlaceableClass*"), HISTORIES))
    yield Fault(
        "repeated_pose_trusted", "verify", BROADPHASE + "verify/verifier.h",
        "if (repeated && stamp.is_kept() && object.is_as_remembered(id))", "if (repeated && stamp.is_kept())",
        (("contract", "UnchangedPose.*"),))
    yield Fault(
        "lost_notices", "verify", BROADPHASE + "verify/notice_board.h",
        "first < per_word; first += 16", "first + 16 < per_word; first += 16", (("contract", "Contract.01_*:Notice.*"),))
    yield Fault(
        "enabled_unnoticed", "verify", BROADPHASE + "broadphase.cpp",
        "idle_.drop_enabled(scene, [this](ProxyId id) { predictor_.request(id); });",
        "idle_.drop_enabled(scene, [](ProxyId) {});", (("broadphase", "*Idle*"),))


def predict_faults():
    predictor = BROADPHASE + "predict/predictor.cpp"
    extent = BROADPHASE + "predict/extent.cpp"
    yield Fault(
        "generation_kept", "predict", predictor,
        "record.learned.horizon = 0;\n    ++proxies.generations[id];", "record.learned.horizon = 0;",
        (("broadphase", "Predictor.*:*AnyWorld*"),))
    yield Fault(
        "path_a_tick_late", "predict", predictor, "packed.since = now;", "packed.since = now + 1;",
        (("broadphase", "Predictor.*:*AnyWorld*"),))
    yield Fault(
        "still_while_moving", "predict", predictor,
        "record.kind.still = !is_bounded(record.prediction) || motion.stays_within(0.5 * slack.a);",
        "record.kind.still = true;", (("broadphase", "Predictor.*"),))
    yield Fault(
        "dropped_request", "predict", predictor,
        "requested_.for_each([&](ProxyId id) { batch.add(id); });", "(void)batch;",
        (("broadphase", "Predictor.*:Resting.*:Teleports.*:Tick.*"),))
    yield Fault(
        "movers_forgotten", "predict", predictor, "moving_.insert(id);\n    const bool", "moving_.erase(id);\n    const bool",
        (("broadphase", "Predictor.*:Tick.*:Clock*"),))
    yield Fault(
        "leap_extrapolated", "predict", predictor,
        "if (motion.leaps(reach_of(record) * size))", "if (motion.leaps(1e30))", (("broadphase", "Predictor.*"),))
    yield Fault(
        "radius_too_small", "predict", extent,
        ": seen.bounds ? farthest_corner(box)", ": seen.bounds ? 0.9 * farthest_corner(box)",
        (("broadphase", "EnvelopeSize.*:*AnyWorld*:Predictor.*"), ("differential", "*BySpheres*")))
    yield Fault(
        "stale_cube", "predict", extent,
        "was_in_cube && farthest_side <= last_half ?", "was_in_cube && farthest_side >= 0 ?", (("broadphase", "EnvelopeSize.*"),))
    yield Fault(
        "turning_point_left_out", "predict", SOURCES + "prediction/envelope.cpp",
        "if (turn > 0 && turn < duration)", "if (turn > duration)", (("prediction", "Envelope.*"),))
    yield Fault(
        "no_margin_for_verification", "predict", BROADPHASE + "objects/proxy_store.h",
        "outer.b += rounding * (outer.b + path.velocity.lpNorm<Eigen::Infinity>());", "",
        (("broadphase", "Verifier.*:ProxyStore.*:PairProximity.*"),))
    yield Fault(
        "step_from_one_object", "predict", SOURCES + "prediction/step_estimate.cpp",
        "step_ = sorted[count_ / 2];", "step_ = sample;", (("prediction", "StepEstimate.*"),))


def index_faults():
    tree = BROADPHASE + "index/envelope_tree.cpp"
    index = BROADPHASE + "index/envelope_index.cpp"
    trees = (("broadphase", "*AnyTree*:EnvelopeTree.*"),)
    indices = (("broadphase", "*AnyIndex*:EnvelopeIndex.*:*AnyWorld*"),)
    yield Fault(
        "stale_ancestors", "index", tree,
        "rotate(index);\n        if (unchanged)\n            return;", "rotate(index);\n        if (unchanged || index != 0)\n            return;", trees)
    yield Fault(
        "stale_box_after_rotation", "index", tree,
        "changed.box = nodes_[changed.content].box.merged(nodes_[changed.content + 1].box);", "(void)changed;", trees)
    yield Fault("lost_link_of_a_leaf", "index", tree, "adopt(pair + 1);\n    adopt(place);", "adopt(place);", trees)
    yield Fault(
        "sibling_lost_on_removal", "index", tree, "move_node(leaf ^ 1, parent);", "move_node(leaf, parent);", trees)
    yield Fault(
        "large_query_cut_off", "index", BROADPHASE + "index/envelope_tree.h",
        "postponed.resize(postponed.size() - end);", "postponed.clear();",
        (("contract", "Contract.09_*"), ("broadphase", "EnvelopeTree.*")))
    yield Fault(
        "moving_tree_not_asked", "index", index, "moving_.walk_together(probes_.data(), count, visit);", "", indices)
    yield Fault(
        "pairs_within_the_batch_twice", "index", index,
        "if (in_batch.contains(other))\n            return;", "if (in_batch.contains(other) && other == ~0u)\n            return;", indices)
    yield Fault("missed_removal_from_a_tree", "index", index, "tree(shelf).remove(id);", "", indices)
    yield Fault(
        "stale_box_in_the_list", "index", index,
        "list_.put(swept);\n        placement.unbounded", "placement.unbounded", indices)
    yield Fault(
        "bulk_drops_pairs_with_others", "index", index,
        "!in_batch.contains(pair.first) && !in_batch", "!in_batch.contains(pair.first) || !in_batch", indices)
    yield Fault(
        "grafted_part_lost", "index", index, "moving_.graft(moving);", "",
        (("broadphase", "Filling.*:*AnyIndex*:EnvelopeIndex.*"),))
    yield Fault(
        "query_misses_the_idle", "index", BROADPHASE + "index/envelope_index.h", "idle_.walk(probe, visit);", "",
        (("contract", "Contract.01_*:Contract.09_*"), ("broadphase", "*Idle*")))
    yield Fault(
        "rounded_to_the_wrong_side", "index", BROADPHASE + "base/float_box.h",
        "Float4::rounded_down(box.max().data(), -1)", "-Float4::rounded_down(box.max().data(), 1)",
        (("contract", "Contract.01_*:Contract.09_*"), ("broadphase", "FloatBox.*")))
    yield Fault(
        "touching_boxes_apart", "index", BROADPHASE + "base/float_box.h",
        "(low_ <= Float4::load(other.low + 2))", "(low_ < Float4::load(other.low + 2))",
        (("contract", "Contract.01_*:Contract.09_*"), ("broadphase", "BoxProbe.*:EnvelopeTree.*")))


def schedule_faults():
    schedule = BROADPHASE + "schedule/schedule.cpp"
    proximity = BROADPHASE + "schedule/pair_proximity.cpp"
    wheel = BROADPHASE + "schedule/event_wheel.cpp"
    schedules = (("broadphase", "Schedule.*:*AnyWorld*"),)
    never_late = (("prediction", "NeverLate.*:NeverEarly.*"), ("broadphase", "PairProximity.*"))
    wheels = (("broadphase", "EventWheel.*"),)
    yield Fault(
        "late_root", "schedule", schedule,
        "static_cast<std::int32_t>(std::ceil(interval->enter));",
        "static_cast<std::int32_t>(std::ceil(interval->enter)) + 1;", schedules)
    yield Fault(
        "parted_a_tick_early", "schedule", schedule,
        "std::floor(interval->leave)) - begin", "std::floor(interval->leave)) - begin - 1", schedules)
    yield Fault(
        "stale_event_wakes_a_pair", "schedule", schedule,
        "(event.is_end_of_horizon() || proxies.current(event.second, event.second_generation))", "true", schedules)
    yield Fault(
        "dropped_wake", "schedule", schedule,
        "if (!event.is_end_of_horizon() && is_current(proxies, event))\n            near",
        "if (event.is_end_of_horizon() && is_current(proxies, event))\n            near", schedules)
    yield Fault("horizon_outlived", "schedule", schedule, "batch.add(event.first);", "(void)batch;", schedules)
    yield Fault(
        "purge_of_what_is_current", "schedule", schedule,
        "wheel_.purge([&](const Event &event) { return is_current(proxies, event); });",
        "wheel_.purge([&](const Event &event) { return !is_current(proxies, event); });", schedules)
    yield Fault(
        "gap_rounded_up", "schedule", proximity,
        "const Float4 above = low - unit * abs(low) - high_ - rounding -",
        "const Float4 above = low - unit * abs(low) - high_ + rounding -", never_late)
    yield Fault(
        "chord_error_left_out", "schedule", proximity, " - quarter * max(half_bend - half_reach_bend, none)", "", never_late)
    yield Fault(
        "deviation_of_one_left_out", "schedule", proximity, ".with_fourth(reach_ + path.deviation_base)",
        ".with_fourth(path.deviation_base)", never_late)
    yield Fault(
        "sphere_without_its_corner", "schedule", proximity, "root_of_3 = 1.7320508075688774", "root_of_3 = 1",
        (("prediction", "NeverLate.*"), ("broadphase", "Schedule.*:PairProximity.*:*AnyWorld*")))
    yield Fault(
        "chord_error_of_spheres_left_out", "schedule", SOURCES + "prediction/proximity.cpp",
        "const double error = sphere_chord_error(first, second, duration) + ", "const double error = ",
        (("prediction", "NeverLate.*:TimeOfProximity.*"),))
    yield Fault("lost_far_events", "schedule", wheel, "link_all_beyond();\n    spread", "spread", wheels)
    yield Fault("wheel_a_turn_early", "schedule", wheel, "turns_ahead < 2 ?", "turns_ahead < 3 ?", wheels)


def near_faults():
    near = BROADPHASE + "near/near_set.cpp"
    tick = BROADPHASE + "broadphase.cpp"
    sets = (("broadphase", "NearSetTest.*:Resting*:*AnyWorld*"),)
    yield Fault(
        "lost_retire", "near", tick, "near_.retire(id, now());\n    }\n    predictor_", "}\n    predictor_",
        (("broadphase", "Broadphase.*:Tick.*:*AnyWorld*"),))
    yield Fault("moves_of_resting_pairs_ignored", "near", tick, "near_.note_moves(moved);", "", sets)
    yield Fault("lost_when_disturbed", "near", near, "else\n            pairs_.push_back(pair);", "else\n            (void)pair;", sets)
    yield Fault(
        "rests_while_one_moves", "near", near,
        "moved_.contains(pair.first) || moved_.contains(pair.second)",
        "moved_.contains(pair.first) && moved_.contains(pair.second)", sets)
    yield Fault("left_a_tick_early", "near", near, "ticks_left < 0 || ((i", "ticks_left <= 0 || ((i", sets)
    yield Fault(
        "resting_pairs_not_reported", "near", near,
        "OverlapCollector(test, room)).end();\n    end = std::copy(overlapping_.begin(), overlapping_.end(), end);",
        "OverlapCollector(test, room)).end();", sets)
    yield Fault(
        "settings_ignored_at_rest", "near", near, "disturbed_ |= resting_;", "", (("shape_contract", "ShapeProximity.*"),))
    yield Fault(
        "new_pairs_taken_for_old", "near", BROADPHASE + "near/near_set.h",
        "if (settled_ != pairs_.size())\n            drop_stale(now);", "(void)now;",
        (("contract", "Contract.01_*"), HISTORIES, ("broadphase", "NearSetTest.*")))
    yield Fault(
        "unsure_taken_for_apart", "near", BROADPHASE + "near/overlap_test.h",
        "if (compared.unsure() || (by_sphere && compared.overlap()))", "if (by_sphere && compared.overlap())",
        (("contract", "Contract.01_*"),))
    yield Fault(
        "error_of_a_box_forgotten", "near", BROADPHASE + "base/measured_box.h",
        "unit = 4 * std::numeric_limits<float>::epsilon()", "unit = 0",
        (("contract", "Contract.01_*"), ("broadphase", "MeasuredBox.*")))
    yield Fault(
        "stale_box", "near", tick, "boxes_.invalidate(moved);", "", (("broadphase", "*AnyWorld*:Resting.*:Tick.*"),))


def shape_faults():
    test = BROADPHASE + "near/shape_test.cpp"
    gap = BROADPHASE + "shape/gap.cpp"
    hulls = SOURCES + "space/hull_store.cpp"
    geoms = SOURCES + "space/geom_shape.cpp"
    proximity = (("shape_contract", "ShapeProximity.*"),)
    contacts = (("shape_contract", "ShapeContacts.AreThose*"),)
    hull_data = (("shape_contract", "HullData.*"),)
    yield Fault(
        "dropped_margin", "shapes", test, "touching_distance(first, second, margin_)", "touching_distance(first, second, 0)",
        proximity)
    yield Fault(
        "dropped_slack_of_contacts", "shapes", test, " + contact_slack * std::min(first.size, second.size)", "", proximity)
    yield Fault(
        "postponed_past_the_margin", "shapes", test, "(gap.length - margin)", "(gap.length + margin)", proximity + contacts)
    yield Fault(
        "gap_of_the_second_too_large", "shapes", gap, "- second.reach(-axis);", "- 0.9 * second.reach(-axis);",
        (("shapes", "Gap.*"),))
    yield Fault(
        "wrong_pair_of_a_gap", "shapes", BROADPHASE + "near/near_set.cpp",
        "drop_stale(now, ignore, ignore, keep_beside(looks_));", "drop_stale(now, ignore, ignore, keep_nothing);",
        proximity + contacts)
    yield Fault(
        "look_outlives_the_shape", "shapes", BROADPHASE + "near/near_set.cpp",
        "if (test.shapes().renewed(pairs_[i]))\n            looks_[i] = {};", ";", proximity + hull_data)
    yield Fault(
        "lost_travel", "shapes", BROADPHASE + "objects/measured_shapes.cpp",
        "rounds_up * (travels_[id] + move)", "rounds_up * (travels_[id] + 0.5 * move)",
        (("shapes", "Travel.*"),) + proximity + contacts)
    yield Fault(
        "ignored_turn_of_a_shape", "shapes", geoms,
        "return shape.moved_from(before);", "return (shape.centre - before.centre).norm();", contacts)
    yield Fault(
        "stale_size_of_a_sphere", "shapes", geoms, "return shape.radius == sizes[0];\n    case dBox",
        "return true;\n    case dBox", proximity)
    yield Fault(
        "capsules_and_cylinders_by_shape", "shapes", geoms,
        "return spheres | boxes | capsules | planes | meshes;\n    case dCylinderClass:\n        return spheres | planes | meshes;",
        "return spheres | boxes | capsules | cylinders | planes | meshes;\n    case dCylinderClass:\n"
        "        return spheres | capsules | planes | meshes;", (("colliders", "*"),))
    yield Fault(
        "stale_hull", "shapes", hulls, "return made.outdated || made.key != key_of(geom);",
        "return made.outdated || !geom;", hull_data)
    yield Fault(
        "changed_data_ignored", "shapes", hulls, "return made.outdated || made.key != key_of(geom);",
        "return made.key != key_of(geom);", hull_data)
    yield Fault(
        "half_of_a_hull_not_searched", "shapes", BROADPHASE + "shape/vertex_hull.cpp",
        "if (less > best.reach)\n        search(nearer, direction, absolute, best);", "", (("shapes", "VertexHull.*"),))
    yield Fault(
        "travel_without_the_cylinder_around", "shapes", BROADPHASE + "shape/convex_shape.h",
        "if (kind == ShapeKind::cylinder || blunt_beside)\n        {\n            const double half",
        "if (kind == ShapeKind::cylinder)\n        {\n            const double half", (("shapes", "Travel.*"),))
    yield Fault(
        "capsules_beside_coherent_meshes", "shapes", geoms,
        "return !dGeomTriMeshIsTCEnabled(mesh, dBoxClass) &&\n           dGeomTriMeshDataGet2",
        "return dGeomTriMeshDataGet2", proximity)
    yield Fault(
        "growth_of_a_sphere_is_no_travel", "shapes", geoms,
        "return shape.moved_from(before) + growth_and_margin * std::max(0.0, shape.radius - radius_before);",
        "return shape.moved_from(before) + 0 * radius_before;", CONTACT_HISTORIES)
    yield Fault(
        "second_is_not_blunt", "shapes", gap,
        "if (second.blunt_beside & first.group)\n        return find_gap(first, second.blunt(), axis, least);", "",
        CONTACT_HISTORIES)
    yield Fault(
        "deviation_counted_once", "shapes", BROADPHASE + "near/contact_forecast.cpp",
        "- 2 * deviation.a;", "- deviation.a;", CONTACT_HISTORIES)
    yield Fault(
        "margin_does_not_grow_with_slivers", "shapes", test,
        "if (!beside_half_space)\n        of_sizes *= first.sliver_factor * second.sliver_factor;", "(void)beside_half_space;",
        (("shape_contract", "ShapeSlivers.*"),))


def sweep_faults():
    rows = BROADPHASE + "index/sort_and_sweep_rows.cpp"
    sorts = BROADPHASE + "index/sort_and_sweep.cpp"
    sweeping = BROADPHASE + "sweep/sweeping.cpp"
    tick = BROADPHASE + "broadphase.cpp"
    pairs = (("broadphase", "SortAndSweep.*"),)
    modes = (("broadphase", "Filling.*:Teleports.*:*AnyWorld*"),)
    yield Fault("row_ends_early", "sweep", rows, "j = i + 1; keys_[j] <= end; j", "j = i + 1; keys_[j] < end; j", pairs)
    yield Fault(
        "pair_counts_in_the_wrong_slab", "sweep", rows,
        "std::max(low_y_[i], low_y_[j])", "std::min(low_y_[i], low_y_[j])", pairs)
    yield Fault("met_itself", "sweep", rows, "unsigned itself = 1u << row;", "unsigned itself = 0;", pairs)
    yield Fault("last_slab_left_out", "sweep", sorts, "slab <= last; ++slab", "slab < last || slab == 0; ++slab", pairs)
    yield Fault(
        "end_taken_for_begin", "sweep", sorts,
        "layout.place_along(box.high[layout.along.axis])", "layout.place_along(box.low[layout.along.axis])", pairs)
    yield Fault(
        "unbounded_boxes_meet_nothing", "sweep", sorts,
        "std::size_t comparisons = compare_each_with_each(unbounded_, pairs) +", "std::size_t comparisons =", pairs)
    yield Fault(
        "waits_for_ever", "sweep", sweeping, "waiting_.erase(id);\n    --waiting_count_;", "waiting_.erase(id);", modes)
    yield Fault(
        "idle_objects_left_waiting", "sweep", sweeping,
        "idle.for_each([this](ProxyId id) { queue_.push_back(id); });", "(void)idle;",
        (("broadphase", "Filling.*:*Idle*:Teleports.*"),))
    yield Fault(
        "near_pairs_survive_the_sweep", "sweep", tick,
        "schedule_.restart(now());\n    near_.clear();", "schedule_.restart(now());",
        (("broadphase", "Teleports.*:Filling.*"), ("faults", "*removing_most")))
    yield Fault(
        "events_survive_the_sweep", "sweep", tick,
        "schedule_.restart(now());\n    near_.clear();", "near_.clear();",
        (("broadphase", "Teleports.*:Filling.*:Exceptions.*:*Trim.*"),),
        "the wheel begins anew when sweeping ends, and what an event wakes is retired when its objects are predicted")
    yield Fault(
        "stale_generation_of_the_waiting", "sweep", tick, "++proxies_.generations[id];\n        sweeping_.wait(id);",
        "sweeping_.wait(id);", modes,
        "a sweep reports meanwhile, and what an event wakes is retired when its objects are predicted")
    yield Fault(
        "swept_by_old_boxes", "sweep", BROADPHASE + "objects/measured_boxes.h",
        "scene.measure(stale_.data(), stale_.size(), boxes_.data());\n        valid_", "(void)scene;\n        valid_",
        (("contract", "Contract.01_*"),))


def space_faults():
    space = SOURCES + "space/predictive_space.cpp"
    query = SOURCES + "space/query.cpp"
    filters = SOURCES + "space/pair_filter.h"
    scene = SOURCES + "space/geom_scene.cpp"
    contract = lambda pattern: (("contract", pattern),)
    yield Fault(
        "deaf_after_the_first_move", "space", space, "return look_closely(geom);\n    listen_to(geom);",
        "return look_closely(geom);", contract("Contract.01_*:Notice.*"))
    yield Fault(
        "swapped_bits", "space", filters,
        "((first->category_bits & second->collide_bits) | (second->category_bits & first->collide_bits))",
        "((first->category_bits & second->category_bits) | (second->collide_bits & first->collide_bits))",
        contract("Contract.01_*"))
    yield Fault(
        "pairs_of_one_body", "space", filters, "if (first->body == second->body && first->body)",
        "if (first == second && first->body)", contract("Contract.01_*"))
    yield Fault("missed_removal", "space", space, "broadphase_.remove(id);", "", contract("Contract.03_*:Notice.*"))
    yield Fault(
        "leaves_clean_with_a_bad_box", "space", space, "if ((geom->gflags & GEOM_AABB_BAD) || IS_SPACE(geom))",
        "if (IS_SPACE(geom))", contract("Contract.05_*:Contract.06_*") + (HISTORIES,))
    yield Fault(
        "meshes_not_polled", "space", space, "if (geoms_[id]->type == dTriMeshClass || IS_SPACE(geoms_[id]))",
        "if (IS_SPACE(geoms_[id]))", contract("Contract.12_*"))
    yield Fault(
        "new_geoms_missed_by_queries", "space", space, "unprepared_ = true;\n    forget_catching_up();", "unprepared_ = true;",
        contract("Contract.09_*"))
    yield Fault(
        "query_reports_what_is_apart", "space", query, "if (now.overlap(other, geom) && wants_callback(other, geom))",
        "if (wants_callback(other, geom))", contract("Contract.09_*"))
    yield Fault(
        "query_with_a_stale_box", "space", query,
        "if (flags_beside_others(geom) & GEOM_AABB_BAD)\n        compute_box_of_probe(geom);\n    const bool as_line",
        "const bool as_line", contract("Contract.09_*"))
    yield Fault(
        "tick_within_a_tick", "space", space, "const bool nested_call = lock_count > 0;",
        "const bool nested_call = false;", contract("Contract.08_*"))
    yield Fault(
        "reports_without_the_lock", "space", space, "const Lock lock(this);\n    std::size_t count = 0;", "std::size_t count = 0;",
        contract("Contract.07_*"))
    yield Fault(
        "outer_list_overwritten", "space", query,
        "std::vector<ProxyId> found = lock.is_only_one ? std::exchange(found_, {}) : std::vector<ProxyId>();",
        "std::vector<ProxyId> &found = found_;", contract("Contract.08_*"))
    yield Fault(
        "ignored_turn", "space", scene,
        "turns_safely(geom) ? squared_sphere_radius(geom) : std::numeric_limits<double>::quiet_NaN();",
        "squared_sphere_radius(geom);", contract("Notice.*"))
    yield Fault(
        "sphere_of_a_box_too_small", "space", scene, "std::sqrt(x * x + y * y + z * z) / 2", "std::sqrt(x * x + 0 * y + z * z) / 2",
        contract("EveryPlaceableClass*:Notice.*") + (HISTORIES,))
    yield Fault(
        "nested_spaces_not_cleaned", "space", scene,
        "if (IS_SPACE(geom))\n        static_cast<dxSpace *>(geom)->cleanGeoms();\n    compute_box_beside_others(geom);",
        "compute_box_beside_others(geom);", contract("Contract.11_*"))
    # What throws in the middle.
    faults = lambda pattern: (("faults", pattern),)
    yield Fault(
        "trusts_a_tick_that_was_broken_off", "space", BROADPHASE + "broadphase.cpp", "if (interrupted_)\n        recover();", "",
        faults("*EveryCall*:*EverySituation*"))
    yield Fault(
        "linked_before_there_is_room", "space", space,
        "broadphase_.make_room();\n    fit_to_proxies();\n    dxSpace::add(geom);",
        "dxSpace::add(geom);\n    broadphase_.make_room();\n    fit_to_proxies();", faults("*EverySituation*"))
    yield Fault(
        "history_noted_before_there_is_room", "space", BROADPHASE + "predict/predictor.cpp",
        "histories_.emplace_back();\n        number = static_cast<std::uint32_t>(histories_.size() - 1);",
        "number = static_cast<std::uint32_t>(histories_.size());\n        histories_.emplace_back();", faults("*EverySituation*"))
    yield Fault(
        "lost_resize", "space", space, "set->resize(size);", "(void)set;", contract("Contract.02_*"))
    # By the sphere test of proximity.
    yield Fault(
        "skewed_geoms_judged_by_spheres", "space", scene,
        "if (judged_by_box_alone(geom) || !(skew <= most_skew))\n            radius = std::numeric_limits<double>::infinity();\n"
        "        else if (std::isfinite(radius))\n            radius *= 1 + skew;",
        "(void)skew;\n        if (judged_by_box_alone(geom))\n            radius = std::numeric_limits<double>::infinity();\n"
        "        else if (std::isfinite(radius))\n            ;", CONTACT_HISTORIES)
    yield Fault(
        "skewed_rays_judged_by_lines", "space", scene,
        "if (ray->type != dRayClass || touched_off_line(other) || is_skewed(ray))",
        "if (ray->type != dRayClass || touched_off_line(other))", CONTACT_HISTORIES)
    yield Fault(
        "deviation_of_a_sphere_along_an_axis", "space", BROADPHASE + "schedule/pair_proximity.cpp",
        "root_of_3 = 1.7320508075688774", "root_of_3 = 1", CONTACT_HISTORIES)


FAULTS = tuple(
    fault
    for faults in (verify_faults, predict_faults, index_faults, schedule_faults, near_faults, shape_faults, sweep_faults,
                   space_faults)
    for fault in faults())
