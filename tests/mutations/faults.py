"""The deliberate faults: for each stage of the tick, and for recorded histories, mistakes that the code could have.

`find` stands in the file exactly once. `first` names the tests that are likely to notice: (suite, GoogleTest filter), in
the order in which they are run; a suite is one of run_mutations.SUITES. A fault that they do not notice goes on to all tests
of all suites. A fault with a text in `equivalent` changes nothing that a program can see: it says why, and no test may fail.
"""

import dataclasses

STAGES = ("notices", "predict", "index", "proximity", "near", "shapes", "sweep", "space", "history", "replay", "haptics")
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


def notice_faults():
    place = BROADPHASE + "objects/place.h"
    entry = BROADPHASE + "broadphase.h"
    tick = BROADPHASE + "broadphase.cpp"
    places = (("broadphase", "Place.*:Origin.*"),)
    reports = (("broadphase", "*AnyWorld*:Tick.*"), ("contract", "Notice.*:UnchangedPose.*"))
    yield Fault(
        "tight_box_without_margin", "notices", place,
        "half + ((abs(centre) + half) * Float4::all(unit) + doubt);", "half;", places)
    yield Fault(
        "turn_about_z_ignored", "notices", place,
        "abs(Float4::nearest_of_stored(rotation + 1, 4)) * Float4::all(half_y_))", "Float4::all(half_y_))", places)
    yield Fault(
        "capsule_without_its_radius", "notices", place, "return along_z + Float4::all(half_x_);", "return along_z;", places)
    yield Fault(
        "centre_allowed_up_to_the_envelope", "notices", place,
        "        Float4::all(radius) + ((abs(low())", "        Float4::all(0) + ((abs(low())", places)
    yield Fault(
        "rounding_of_centres_forgotten", "notices", place,
        "        Float4::all(radius) + ((abs(low()) + abs(high())) + Float4::all(radius)) * Float4::all(unit) + doubt;",
        "        Float4::all(radius);\n    (void)unit;", places)
    yield Fault(
        "one_side_of_the_envelope", "notices", place,
        "return (((inner_low >= low()) & (inner_high <= high())).bits() & three_lanes) == three_lanes;",
        "return ((inner_low >= low()).bits() & three_lanes) == three_lanes && inner_high.largest_of_three() < infinity;", places)
    yield Fault(
        "repeated_box_taken_for_a_move", "notices", place, "return outcome(is_inside, changed);\n    }\n\n    /// follow() for",
        "return outcome(is_inside, true);\n    }\n\n    /// follow() for", reports + places)
    yield Fault(
        "another_size_of_what_has_left", "notices", place, "if (!is_inside & changed && is_finite(box))",
        "if (!is_inside && is_finite(box))", reports)
    yield Fault(
        "what_has_left_is_not_listed", "notices", entry, "listing_.listed.insert(id);\n            followed =",
        "followed =", reports)
    yield Fault(
        "repeated_centre_taken_for_a_move", "notices", place,
        "return outcome((allowed.bits() & three_lanes) == three_lanes, changed);",
        "(void)changed;\n        return outcome((allowed.bits() & three_lanes) == three_lanes, true);", reports + places)
    yield Fault(
        "digest_of_one_coordinate", "notices", place, "centre * Float4(0.25f, 0.34293f, 0.43478f, 0)", "centre * Float4(0.25f, 0, 0, 0)",
        (("times", "Times.OfAGeomThatTheProgramMovesAreNeverLate"),))
    yield Fault(
        "lost_notices", "notices", entry, "if (followed == Followed::moved)\n            note_move(place);", "", (("broadphase", "Tick.*:*AnyWorld*"),))
    yield Fault(
        "left_in_another_size", "notices", entry, "is_finite(place.tight_lanes()) && same_size())",
        "is_finite(place.tight_lanes()))", reports)
    yield Fault(
        "same_size_assumed", "notices", entry, "place.solid() == object.solid();", "true;", reports)
    yield Fault(
        "growth_of_a_sphere_ignored", "notices", entry, "object.radius() <= place.watched_radius()", "true", reports)
    yield Fault(
        "doubtful_moves_ignored", "notices", entry, "place.note_doubtful_move(clock_.update);\n    listing_.any_doubtful = true;", "",
        (("histories", "*breathing*"),))
    yield Fault(
        "stretched_on_its_body", "notices", SOURCES + "space/noticed_geom.h",
        "return geom_->type == dSphereClass || keeps_within_sphere(rotation());", "return geom_->type == dSphereClass || geom_->body;",
        (("contract", "Notice.*"), HISTORIES))
    carried = SOURCES + "space/noticed_geom.h"
    offsets = (("contract", "Offset.*"), HISTORIES)
    yield Fault(
        "stretched_at_an_offset", "notices", carried, "is_identity(turned) || lengthens_nothing(turned)", "turned != nullptr", offsets)
    yield Fault(
        "rounding_of_offsets_forgotten", "notices", carried, "4 * double{round_off} * (radius + 3 * largest)",
        "0 * largest", offsets)
    yield Fault(
        "body_stretched_at_an_offset", "notices", carried, "short_rows(rotation_) & (abs", "(abs", offsets)
    yield Fault(
        "offset_of_any_length", "notices", SOURCES + "space/predictive_space.cpp",
        "carried.turns_safely(place.allowed_offset())", "carried.turns_safely(most_offset)", offsets)
    yield Fault(
        "centre_of_an_offset_rounded_in_two_ways", "notices", BROADPHASE + "predict/predictor.cpp",
        "place.watch_carried(carried->centre,", "place.watch_carried(record.position,", offsets)
    yield Fault(
        "matrix_that_is_nearly_the_identity", "notices", SOURCES + "space/rotation.h", "row < 3; ++row)", "row < 1; ++row)", offsets)
    yield Fault(
        "rows_that_are_not_orthogonal", "notices", SOURCES + "space/rotation.h",
        "return in_three_lanes(abs(products) <= Float4::all(round_off));", "return products.sum_of_three() < 4;", offsets)
    yield Fault(
        "rows_of_a_matrix_forgotten", "notices", SOURCES + "space/rotation.h", ".bits() & three_lanes) == three_lanes;",
        ".bits() & 1) == 1;", (("contract", "Notice.*"), HISTORIES))
    yield Fault(
        "skew_of_bodies_forgotten", "notices", SOURCES + "space/geom_scene.cpp",
        "if (!(geom->gflags & GEOM_PLACEABLE) || geom->type == dSphereClass)",
        "if (!(geom->gflags & GEOM_PLACEABLE) || geom->type == dSphereClass || geom->body)", CONTACT_HISTORIES)
    yield Fault(
        "turns_unsafely", "notices", entry, " || (watch == Watch::centre && !object.turns_safely())", "",
        (("contract", "Notice.*"), HISTORIES))
    yield Fault(
        "skip_verify", "notices", tick, "const bool holds = place.holds() && !place.is_boundless();", "const bool holds = place.has_envelope();",
        (("broadphase", "Tick.*:Resting.*:*AnyWorld*"),))
    yield Fault(
        "enabled_unnoticed", "notices", tick,
        "        if (!idle_.contains(id))\n            request(id);\n",
        "        (void)id;\n", (("broadphase", "*Idle*"),))


def predict_faults():
    predictor = BROADPHASE + "predict/predictor.cpp"
    tick = BROADPHASE + "broadphase.cpp"
    predictions = (("broadphase", "Predictor.*:*AnyWorld*"),)
    yield Fault(
        "no_step_before_the_first_sample", "predict", SOURCES + "prediction/step_estimate.h", "double step_ = 0.01;",
        "double step_ = 0;", predictions)
    yield Fault(
        "a_tick_ends_no_row_of_questions", "predict", tick, "clock_.queries = is_tick ? 0 : clock_.queries + (clock_.moves > 0);",
        "clock_.queries += !is_tick && clock_.moves > 0;", (("times", "Times.*"),))
    yield Fault(
        "margin_left_out_of_times", "predict", tick, "touching_distance(one, other, shape_margin_)", "touching_distance(one, other, 0)",
        (("times", "Times.*"),))
    yield Fault(
        "doubt_of_a_far_origin_forgotten", "predict", BROADPHASE + "base/origin.h", "const Vector3 lost = 4 *",
        "const Vector3 lost = 0 *", (("broadphase", "Origin.*"),))
    yield Fault(
        "origin_never_moves", "predict", tick, "        next_origin_ = origin_.place() + *middle;\n", "        (void)0;\n",
        (("broadphase", "Origin.*"),))
    yield Fault(
        "origin_moves_for_large_objects", "predict", predictor, " && distance * count > tuning::far_in_sizes * sizes", "",
        (("broadphase", "Origin.*"),))
    yield Fault(
        "path_without_its_end", "predict", predictor, "high = max(end, zero);", "high = zero;", predictions)
    yield Fault(
        "turning_point_left_out_of_an_envelope", "predict", predictor, "high = max(high, extreme);", "", predictions,
        "an envelope that is left early is made anew: it costs a prediction and no pair")
    yield Fault(
        "leap_not_noted_as_farthest", "predict", predictor,
        "    note_farthest(place.envelope_lanes());\n    centre.store_three(record.position);\n    record.since",
        "    centre.store_three(record.position);\n    record.since", (("broadphase", "Predictor.TheFarthest*"),))
    yield Fault(
        "farthest_of_all_is_that_of_a_part", "predict", predictor, "    if (end < size)\n        return std::nullopt;\n    farthest_ = reviewed_.farthest;",
        "    farthest_ = reviewed_.farthest;", (("broadphase", "Predictor.TheFarthest*"),))
    yield Fault(
        "farthest_of_predictions_left_to_the_review", "predict", predictor,
        "max(reviewed_.farthest, max(abs(finite_or_zero(box.low)), abs(finite_or_zero(box.high))))",
        "max(abs(finite_or_zero(box.low)), abs(finite_or_zero(box.high)))",
        (("broadphase", "Predictor.TheFarthest*"),))
    yield Fault(
        "farthest_is_never_reviewed", "predict", tick, "        review(scene);\n", "        (void)0;\n",
        (("broadphase", "Predictor.TheFarthest*"),))
    yield Fault("farthest_in_an_endless_envelope_forgotten", "predict", predictor, "    note_farthest(tight);\n    centre", "    centre",
        (("broadphase", "Predictor.TheFarthest*"),))
    yield Fault(
        "predicted_again_and_again", "predict", tick, "    listing_.requested.clear();\n", "", (("broadphase", "Tick.*:Predictor.*"),))
    yield Fault(
        "envelope_taken_along_to_the_wrong_place", "predict", predictor, "    if (!place.holds() || !place.has_end())\n        return false;\n", "",
        (("broadphase", "Predictor.*"),))
    yield Fault(
        "envelope_of_far_away_taken_along", "predict", predictor, "record.predicted || record.is_rounded ||", "record.predicted ||",
        (("broadphase", "Predictor.TheFarthest*"),))
    yield Fault(
        "path_beyond_any_reach_extrapolated", "predict", predictor, "speed + bend < tuning::most_reach * record.size", "speed + bend < 1e15f",
        (("broadphase", "Predictor.*"),))
    yield Fault(
        "reach_never_shrinks", "predict", predictor, "too_long ? record.reach / tuning::reach_step : record.reach * tuning::reach_step", "record.reach * tuning::reach_step",
        (("broadphase", "Predictor.*"),))
    yield Fault(
        "all_leave_together", "predict", predictor, "(0.75f + 0.5f * scrambled(id))", "(1 + 0 * scrambled(id))",
        (("broadphase", "Predictor.*:Tick.*"),))
    yield Fault(
        "samples_outlive_the_object", "predict", tick, "shapes_.forget(id);\n    predictor_.forget(id);",
        "shapes_.forget(id);", (("times", "Times.OfANewGeomAreNotThoseOfTheOneBefore"),))
    yield Fault(
        "tightened_too_far", "predict", BROADPHASE + "objects/place.h",
        "max(Float4::all(radius) - half - margin, Float4::all(0))", "Float4::all(radius) - Float4::all(0.9f) * half - margin",
        (("broadphase", "Place.*:*AnyWorld*"),))
    yield Fault(
        "tightened_without_margin", "predict", BROADPHASE + "objects/place.h",
        "max(Float4::all(radius) - half - margin, Float4::all(0))", "max(Float4::all(radius) - half + margin, Float4::all(0))",
        (("broadphase", "Place.*"),))
    yield Fault(
        "watched_by_the_centre_beside_others", "predict", tick,
        "place.watches_centre())", "place.watches_centre() && id % 2 == 0)",
        (("broadphase", "*AnyWorld*"),))
    yield Fault(
        "step_from_one_object", "predict", SOURCES + "prediction/step_estimate.cpp",
        "step_ = sorted[count_ / 2];", "step_ = sample;", (("prediction", "StepEstimate.*"),))
    yield Fault(
        "forecast_sphere_about_the_body_of_an_offset_geom", "predict", SOURCES + "broadphase/predict/predictor.cpp",
        "seen.centre == pivot && std::isfinite(seen.radius);",
        "seen.centre.has_value() && std::isfinite(seen.radius);", (("times", "*OfAGeomWithAnOffset*"),))


def index_faults():
    tree = BROADPHASE + "index/envelope_tree.cpp"
    index = BROADPHASE + "index/envelope_index.cpp"
    trees = (("broadphase", "*AnyTree*:EnvelopeTree.*"),)
    indices = (("broadphase", "*AnyWorld*:Tick.*"),)
    yield Fault(
        "stale_ancestors", "index", tree,
        "        index = place / width;\n        node_of(place).boxes.set(place % width, box);",
        "        index = place / width;", trees)
    yield Fault(
        "lost_link_of_a_leaf", "index", tree,
        "leaf_place_[static_cast<ProxyId>(~entry.content)] = place;", ";", trees)
    yield Fault(
        "entry_lost_when_a_node_is_cut", "index", tree,
        "fill(sibling, entries.data() + size, entries.data() + entries.size());",
        "fill(sibling, entries.data() + size, entries.data() + entries.size() - 1);", trees)
    yield Fault(
        "last_place_lost_on_removal", "index", tree, "put(place, {node.boxes[last], node.content[last]});", ";", trees)
    yield Fault(
        "large_query_cut_off", "index", BROADPHASE + "index/envelope_tree.h",
        "walk_below(step.node, probe, [&](ProxyId proxy) { visit(step.probe, proxy); });", ";", trees)
    yield Fault(
        "places_without_a_box_met", "index", BROADPHASE + "index/envelope_tree.h",
        "probe.overlaps(node.boxes) & ~(~0u << node.count)", "probe.overlaps(node.boxes)",
        (("broadphase", "RayProbe.*:EnvelopeTree.*"),))
    yield Fault(
        "boxes_above_refitted_leaves_stale", "index", tree, "node.boxes.set(place % width, nodes_[below].boxes.merged());", ";", trees)
    yield Fault(
        "tree_not_asked", "index", index,
        "find_in_tree(boxes_.data() + i, std::min(boxes_.size() - i, EnvelopeTree::most_together), batch, idle, pairs);", ";",
        indices)
    yield Fault("list_not_asked", "index", index, "list_.walk(BoxProbe(swept.box), [&](ProxyId other) {",
                "BoxList().walk(BoxProbe(swept.box), [&](ProxyId other) {", indices)
    yield Fault(
        "pairs_within_the_batch_left_out", "index", index, "if (boxes_.size() > 1)\n        sort_and_sweep_",
        "if (boxes_.empty())\n        sort_and_sweep_", indices)
    yield Fault("missed_removal_from_a_tree", "index", index, "tree_.remove(id);", "", indices)
    yield Fault(
        "stale_box_in_the_list", "index", index, "list_.put(swept);\n    else", "{\n        if (tree_kind != wanted)\n            list_.put(swept);\n    }\n    else",
        indices)
    yield Fault(
        "bulk_drops_pairs_with_others", "index", index,
        "!batch.contains(pair.first) && !batch", "!batch.contains(pair.first) || !batch", indices)
    yield Fault(
        "tree_taken_for_current_after_a_sweep", "index", index, " || is_bulk(proxies, batch.size());\n    if (is_stale_)\n        return;",
        ";\n    if (is_stale_ || is_bulk(proxies, batch.size()))\n        return;", indices)
    yield Fault(
        "list_left_out_when_the_index_is_built", "index", index, "list_.add(swept);\n        else", ";\n        else", indices)
    yield Fault(
        "rounded_to_the_wrong_side", "index", BROADPHASE + "base/float_box.h",
        "Float4::rounded_down(box.max().data(), -1)", "-Float4::rounded_down(box.max().data(), 1)",
        (("contract", "Contract.01_*:Contract.09_*"), ("broadphase", "FloatBox.*:Rounding.*")))
    yield Fault(
        "touching_boxes_apart", "index", BROADPHASE + "base/four_boxes.h",
        "(low_[axis] <= boxes.highs(axis))", "(low_[axis] < boxes.highs(axis))",
        (("contract", "Contract.01_*:Contract.09_*"), ("broadphase", "EnvelopeTree.*")))
    yield Fault(
        "refit_keeps_old_unbounded_boxes", "index", SOURCES + "broadphase/index/envelope_index.cpp",
        "        else if (tree_kind == TreeKind::list)\n            list_.put(swept);",
        "        else if (tree_kind == TreeKind::list && is_small_)\n            list_.put(swept);", (("contract", "*APlaneIsFoundWhereItWent*"),))
    yield Fault(
        "margin_of_a_ray_from_its_middle_alone", "index", BROADPHASE + "index/ray_probe.h",
        "rounding * (std::abs(centre) + std::abs(span))", "rounding * std::abs(centre)", (("broadphase", "RayProbe.*"),))
    yield Fault(
        "bounded_boxes_take_no_memory", "index", BROADPHASE + "index/sort_and_sweep.cpp", "list_.bytes() + bytes_of(bounded_)",
        "list_.bytes()", (("soak", "Stats.*"),))


def proximity_faults():
    proximity = SOURCES + "prediction/proximity.cpp"
    never_late = (("prediction", "NeverLate.*:TimeOfProximity.*"),)
    yield Fault("late_root", "proximity", proximity, "overlap.enter * (1 - rounding_per_size)", "overlap.enter * 1.001", never_late)
    yield Fault(
        "what_has_no_position_rests", "proximity", SOURCES + "prediction/track.cpp", "    if (!pose.is_rigid)\n        history_ = {};\n", "",
        (("times", "Times.*"),))
    yield Fault(
        "chord_error_left_out", "proximity", proximity, "deviation.a + 0.125 * duration * duration *",
        "deviation.a + 0 * duration * duration *", never_late)
    yield Fault(
        "deviation_left_out", "proximity", proximity, "overlap.narrow(below - reach, -chord[axis] - growth);",
        "overlap.narrow(below - reach, -chord[axis]);", never_late)
    yield Fault(
        "rounding_of_boxes_left_out", "proximity", proximity,
        "rounding_per_size * (std::isfinite(terms) ? terms : 0);", "0 * (std::isfinite(terms) ? terms : 0);", never_late)
    yield Fault(
        "infinite_sides_are_near", "proximity", proximity, "(std::isfinite(terms) ? terms : 0)", "terms", never_late)
    yield Fault(
        "chord_error_of_spheres_left_out", "proximity", proximity,
        "const double error = sphere_chord_error(first, second, duration) + ", "const double error = ", never_late)
    yield Fault(
        "turning_of_one_tick", "proximity", BROADPHASE + "predict/predictor.cpp", "on.deviation.b += turning;",
        "on.deviation.a += turning;", (("times", "Times.*"),))
    yield Fault(
        "apart_until_the_later_of_two_ends", "proximity", SOURCES + "space/forecast_query.cpp",
        "*apart_until = std::min(first.ticks, second.ticks);", "*apart_until = std::max(first.ticks, second.ticks);",
        (("times", "Times.*"),))
    yield Fault(
        "rotations_shifted_by_each_question", "proximity", SOURCES + "prediction/track.cpp",
        "    if (!replaces)\n        std::copy_backward(rotations_.begin(), rotations_.end() - 1, rotations_.end());\n",
        "    std::copy_backward(rotations_.begin(), rotations_.end() - 1, rotations_.end());\n", (("times", "Times.*"),))


def near_faults():
    near = BROADPHASE + "near/near_set.cpp"
    tick = BROADPHASE + "broadphase.cpp"
    place = BROADPHASE + "objects/place.h"
    sets = (("broadphase", "Resting*:*AnyWorld*"),)
    yield Fault(
        "lost_retire", "near", tick, "near_.retire(id);\n        batch_.add(id);", "batch_.add(id);",
        (("broadphase", "Broadphase.*:Tick.*:*AnyWorld*"),))
    yield Fault(
        "pairs_of_the_gone_kept", "near", tick, "near_.retire(id);\n        index_", "index_", (("broadphase", "Broadphase.*:*AnyWorld*"),))
    yield Fault("moves_of_resting_pairs_ignored", "near", tick, "return near_.disturb(id);", "return;", sets)
    yield Fault(
        "rests_unwatched", "near", near, "        places[id].stop_watching();\n", "", sets)
    yield Fault("lost_when_disturbed", "near", near, "            active.push_back(pair);\n", "            (void)pair;\n", sets)
    numbers = (("broadphase", "UpdateNumber*:Resting*"),)
    yield Fault("rests_an_update_early", "near", tick, "(clock_.update - 1) & Place::last_update", "clock_.update & Place::last_update", numbers)
    yield Fault("rests_an_update_late", "near", tick, "(clock_.update - 1) & Place::last_update", "(clock_.update - 2) & Place::last_update", sets)
    yield Fault("old_numbers_taken_for_new", "near", tick, "clock_.update % half_of_all == 0", "half_of_all == 0", numbers)
    yield Fault("old_numbers_taken_for_later", "near", tick, "clock_.update % half_of_all == 0", "clock_.update % (2 * half_of_all) == 0", numbers)
    yield Fault("a_question_leaves_a_number_out", "near", tick, "    interrupted_ = false; // not finish(): the update number must not advance\n", "    finish();\n", numbers)
    yield Fault(
        "update_number_that_is_no_number", "near", place, "last_update = ~UpdateNumber{0} >> 6;", "last_update = ~UpdateNumber{0} >> 5;",
        (("broadphase", "Place.NoUpdateNumber*"),))
    yield Fault(
        "times_beyond_the_second_forecast", "near", tick, "std::min(first.ticks, second.ticks);\n    const double duration",
        "first.ticks;\n    const double duration", (("broadphase", "Broadphase.Times*"),))
    yield Fault(
        "times_of_contact_beyond_the_second_forecast", "near", tick, "std::min(first.ticks, second.ticks));\n    };", "first.ticks);\n    };",
        (("times", "Times.*"),))
    yield Fault("gone_awaits_its_pairs", "near", tick, "    pairing_.waiting.erase(id);\n", "", (("broadphase", "*AnyWorld*"),))
    yield Fault(
        "rests_while_one_moves", "near", BROADPHASE + "near/near_set.h", "rests(pair.first) && rests(pair.second);",
        "rests(pair.first) || rests(pair.second);", sets)
    yield Fault(
        "rests_as_it_was", "near", near, "rest(test(pair) ? by_box_.overlapping : by_box_.separated, pair, test.places);",
        "rest(by_box_.separated, pair, test.places);", sets)
    yield Fault(
        "resting_pairs_not_reported", "near", near,
        "    end = std::copy(by_box_.overlapping.begin(), by_box_.overlapping.end(), end);\n", "", sets)
    yield Fault(
        "settings_ignored_at_rest", "near", tick, "    interrupted_ = true; // pair states belong to the former margin\n", "",
        (("shape_contract", "ShapeProximity.*"),))
    yield Fault(
        "retired_for_ever", "near", BROADPHASE + "near/near_set.h",
        "std::fill(is_retired_.begin(), is_retired_.end(), std::uint8_t{0});\n    has_retired_ = false;\n}\n} //",
        "has_retired_ = false;\n}\n} //", sets)
    yield Fault(
        "boxes_enough_by_sphere", "near", BROADPHASE + "broadphase.cpp",
        "by_sphere ? std::numeric_limits<float>::infinity()", "by_sphere ? 0.0f",
        (("broadphase", "*"), ("contract", "*phere*")))
    yield Fault(
        "unsure_taken_for_apart", "near", BROADPHASE + "near/overlap_test.h",
        ") ||\n               scene.overlap(pair.first, pair.second);", ") ||\n               (by_sphere && scene.overlap(pair.first, pair.second));",
        (("broadphase", "*AnyWorld*"), ("contract", "Contract.01_*")))
    yield Fault(
        "sure_of_what_touches", "near", place, "sizes * Float4::all(unit) +", "sizes * Float4::all(-unit) +",
        (("broadphase", "Place.*:*AnyWorld*"),))
    yield Fault(
        "sure_of_what_overflows", "near", place, "if ((one.state_ | other.state_) & Place::doubt_bit)",
        "if ((one.state_ & other.state_) & 0u)", (("broadphase", "Place.*"),))
    yield Fault(
        "touching_taken_for_apart", "near", place, "((low > other_high) | (other_low > high))",
        "((low > other_high - Float4::all(1e-3f)) | (other_low > high))", (("broadphase", "Place.*:*AnyWorld*"),))


def shape_faults():
    test = BROADPHASE + "near/shape_test.cpp"
    gap = BROADPHASE + "shape/gap.cpp"
    hulls, maker = SOURCES + "space/hull_store.cpp", SOURCES + "space/hull_maker.cpp"
    geoms = SOURCES + "space/geom_shape.cpp"
    proximity = (("shape_contract", "ShapeProximity.*"),)
    contacts = (("shape_contract", "ShapeContacts.AreThose*"),)
    hull_data = (("shape_contract", "HullData.*"),)
    yield Fault(
        "shapes_kept_when_all_is_forgotten", "shapes", BROADPHASE + "broadphase.cpp",
        "    if (shapes_.in_use())\n        shapes_.start(proxies_.size());\n    proxies_.members()", "    proxies_.members()",
        (("broadphase", "UpdateNumberByShape.*"),))
    yield Fault(
        "vertices_taken_for_packed", "shapes", SOURCES + "surface/triangle_arrays.h", "(vertices, vertex_stride, index)",
        "(vertices, 3 * sizeof(Real), index)", contacts)
    yield Fault(
        "dropped_margin", "shapes", test, "reach = touching_distance(first, second, margin)", "reach = touching_distance(first, second, 0)",
        proximity)
    yield Fault(
        "dropped_slack_of_contacts", "shapes", test, " + contact_slack * std::min(first.size, second.size)", "", proximity)
    yield Fault(
        "postponed_past_the_margin", "shapes", test, "(gap.length - reach)", "(gap.length + reach)", proximity + contacts)
    yield Fault(
        "gap_of_the_second_too_large", "shapes", gap, "- second.reach(-axis);", "- 0.9 * second.reach(-axis);",
        (("shapes", "Gap.*"),))
    yield Fault(
        "wrong_pair_of_a_gap", "shapes", BROADPHASE + "near/near_set.h", "gaps_[kept++] = gaps_[i];", "gaps_[kept++] = gaps_[0];",
        proximity + contacts)
    yield Fault(
        "look_outlives_the_shape", "shapes", BROADPHASE + "near/near_set.cpp",
        "            gaps_[i] = test.new_gap_cache(by_shape_.active[i]);\n", "            continue;\n", proximity + hull_data)
    yield Fault(
        "lost_travel", "shapes", BROADPHASE + "objects/measured_shapes.cpp",
        "rounds_up * (travels_[id] + move)", "rounds_up * (travels_[id] + 0.5 * move)",
        proximity + contacts)
    yield Fault(
        "ignored_turn_of_a_shape", "shapes", geoms,
        "return shape.moved_from(before);", "return (shape.centre - before.centre).norm();", contacts)
    yield Fault(
        "stale_size_of_a_sphere", "shapes", geoms, "return shape.radius == sizes[0];\n    case dBox",
        "return true;\n    case dBox", proximity)
    yield Fault(
        "capsules_and_cylinders_by_shape", "shapes", geoms,
        "return cylinders | convexes;\n    case dCylinderClass:\n        return boxes | capsules | cylinders | convexes;",
        "return type == dBoxClass ? cylinders | convexes : convexes;\n    case dCylinderClass:\n"
        "        return boxes | cylinders | convexes;", (("colliders", "*"),))
    yield Fault(
        "stale_hull", "shapes", hulls, "return made.outdated || made.key != key_of(geom);",
        "return made.outdated || !geom;", hull_data)
    yield Fault(
        "changed_data_ignored", "shapes", hulls, "return made.outdated || made.key != key_of(geom);",
        "return made.key != key_of(geom);", hull_data)
    yield Fault(
        "slices_go_on_with_other_data", "shapes", hulls, "if (!maker || maker->key() != key)", "if (!maker)",
        (("colliders", "SlicedHull.*"),))
    yield Fault(
        "slices_go_on_with_changed_data", "shapes", hulls, "            own.maker.reset();\n}", "            void();\n}",
        (("colliders", "SlicedHull.*"),))
    yield Fault(
        "slices_go_on_without_the_geom", "shapes", SOURCES + "space/predictive_space.cpp", "    hulls_.release(id);\n    geom->next_ex",
        "    geom->next_ex", (("shape_contract", "SurfaceBuilding.*"),))
    yield Fault(
        "hulls_are_made_as_a_whole_beside_a_hand", "shapes", SOURCES + "space/spatial_query.cpp",
        "broadphase_.proxies().any_hand() ? tuning::steps_per_tick : HullMaker::all_steps", "HullMaker::all_steps",
        (("shape_contract", "SurfaceBuilding.*"),))
    yield Fault(
        "a_hand_that_is_gone_counts", "shapes", BROADPHASE + "objects/proxy_store.h",
        "        set_role(id, Role::environment);\n", "", (("shape_contract", "SurfaceBuilding.*"),))
    yield Fault(
        "hulls_are_made_again_after_a_pause", "shapes", hulls, "    return {own.hull, !is_done};",
        "    return {std::exchange(own.hull, nullptr), !is_done};", (("shape_contract", "SurfaceBuilding.*"),))
    yield Fault(
        "offset_of_heights_is_no_other_hull", "shapes", maker, "word(heights.scale),\n            word(heights.offset)};",
        "word(heights.scale)};", (("shape_contract", "HullOfHeights.*"),))
    yield Fault(
        "half_of_a_hull_not_searched", "shapes", BROADPHASE + "shape/vertex_hull.cpp",
        "if (less > best.reach)\n        search(nearer, direction, absolute, best);", "", (("shapes", "Gap.*"),))
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
        "- 2 * deviation.a;\n    return at_least_next_tick(left, gap", "- deviation.a;\n    return at_least_next_tick(left, gap",
        CONTACT_HISTORIES)
    yield Fault(
        "deviation_beside_a_surface_along_axes_alone", "shapes", BROADPHASE + "near/contact_forecast.cpp",
        "std::sqrt(3.0) * (surface", "1.0 * (surface", (("shapes", "ContactForecast.*"),))
    yield Fault(
        "margin_does_not_grow_with_slivers", "shapes", test,
        "if (!beside_half_space)\n        of_sizes *= first.sliver_factor * second.sliver_factor;", "(void)beside_half_space;",
        (("shape_contract", "ShapeSlivers.*"),))
    terrain = BROADPHASE + "shape/surface_gap.cpp"
    heightfields = (("colliders", "*Heightfields*"),)
    yield Fault(
        "old_box_of_a_mesh_ignored", "shapes", SOURCES + "space/geom_shape.cpp",
        "if (geom->type == dTriMeshClass && has_old_box(shape))", "if (false && has_old_box(shape))",
        (("shape_contract", "ShapeProximity.*"),))
    query = SOURCES + "space/spatial_query.cpp"
    yield Fault(
        "rays_by_shape_meet_envelopes", "shapes", query, "if (query.line && ", "if (false && ",
        (("shape_contract", "ShapeQuery.*"),))
    yield Fault(
        "data_not_noticed_by_questions", "shapes", query, "tuning::few_objects && !tests_shapes())", "tuning::few_objects)",
        (("shape_contract", "ShapeQuery.*"),))
    yield Fault(
        "rests_by_shapes_out_of_date", "shapes", BROADPHASE + "near/near_set.cpp",
        "rest(gaps_[i].due == 0 && test(pair) ? by_shape_", "rest(test(pair) ? by_shape_",
        (("shape_contract", "ShapeProximity.*"),))
    yield Fault(
        "a_gap_that_closed_counts_at_rest", "shapes", BROADPHASE + "near/near_set.cpp", "    cache.due = 0;\n    cache.pause", "    cache.pause",
        (("shape_contract", "GapCheckCost.*"),))
    yield Fault(
        "planes_for_all_shapes_on_a_heightfield", "shapes", terrain,
        "if (shape_.kind != ShapeKind::rounded)", "if (shape_.kind == ShapeKind::half_space)", heightfields)
    yield Fault(
        "upper_triangles_of_a_heightfield_ignored", "shapes", terrain,
        "std::min({low, high, until_below})", "std::min(low + 0 * high, until_below)", heightfields)
    yield Fault(
        "last_column_of_a_heightfield_that_repeats", "shapes", SOURCES + "surface/height_grid.cpp",
        "            column %= size_.columns - 1;\n", "", heightfields)
    yield Fault(
        "pyramid_without_the_last_square", "shapes", SOURCES + "surface/height_grid.cpp",
        "j < std::min(2 * row + 2, below.rows)", "j < std::min(2 * row + 1, below.rows)", heightfields)
    yield Fault(
        "heights_changed_in_place_ignored", "shapes", hulls, "return made.outdated || made.key != key_of(geom);",
        "return (made.outdated && geom->type != dHeightfieldClass) || made.key != key_of(geom);",
        (("shape_contract", "ShapeQuery.*"),))
    yield Fault(
        "looks_that_do_not_pay_go_on", "shapes", BROADPHASE + "near/gap_budget.h",
        "accounts_[id].balance -= tuning::cost_of_check + tuning::cost_of_reach * work;", "accounts_[id].balance -= work / 4;",
        (("broadphase", "GapBudgets.*"),))
    yield Fault(
        "what_looks_have_spared_is_saved_for_good", "shapes", BROADPHASE + "near/gap_budget.h",
        "std::min(account.balance + 1, account.most)", "account.balance + 1",
        (("broadphase", "GapBudgets.*"),))
    yield Fault(
        "landscapes_are_looked_at", "shapes", BROADPHASE + "objects/proxy_store.h",
        "return one.can_move() || other.can_move();", "return true;", (("shape_contract", "GapCheckCost.*"),))
    yield Fault(
        "meshes_are_not_looked_at_beside_meshes", "shapes", BROADPHASE + "objects/proxy_store.h",
        "return one.can_move() || other.can_move();", "return false;", (("shape_contract", "GapCheckCost.*"),))
    yield Fault(
        "pairs_that_rest_apart_keep_old_data", "shapes", BROADPHASE + "near/near_set.cpp",
        "            apart_.insert(id);", "            apart_.erase(id);", (("shape_contract", "HullData.*"),))
    yield Fault(
        "pairs_that_touch_keep_old_data", "shapes", BROADPHASE + "near/near_set.cpp",
        "    if (all_shapes)\n        test.shapes.add_owners_to(wanted_);\n", "", (("shape_contract", "HullData.*"),))
    yield Fault(
        "data_of_what_has_not_moved_are_not_compared", "shapes", BROADPHASE + "objects/measured_shapes.cpp",
        "return !(shape.hull || shape.awaits_hull) || !scene.hull_is_outdated(id, shape);",
        "return !shape.awaits_hull || !scene.hull_is_outdated(id, shape);", (("shape_contract", "HullData.*"),))
    yield Fault(
        "excluded_pairs_are_looked_at", "shapes", SOURCES + "space/geom_scene.cpp",
        "return !bits_agree(one, other) || (one->body && one->body == other->body);", "return one == other;",
        (("shape_contract", "GapCheckCost.*"),))
    surface = BROADPHASE + "shape/surface_gap.cpp"
    yield Fault(
        "triangles_beside_the_nearest_ignored", "shapes", surface,
        "        reach = gap + shape.radius();\n        return gap > least;", "        reach = gap;\n        return gap > least;",
        (("colliders", "*Surfaces*"),))
    yield Fault(
        "capsule_beside_triangles_is_not_blunt", "shapes", surface,
        "other.blunt_beside & surface->group ? gap_between(*surface, other.blunt(), least)\n", "false ? Gap{}\n",
        (("colliders", "*Surfaces*"),))
    yield Fault(
        "triangle_in_the_box_of_its_middle", "shapes", SOURCES + "surface/triangle_tree.cpp",
        "    for (const Vector3 &corner : corners)\n        box.extend(corner);",
        "    box.extend((corners[0] + corners[1] + corners[2]) / 3);", (("surface", "*"),))
    yield Fault(
        "surface_of_the_data_before", "shapes", maker, "hull_->surface = std::make_shared<TriangleTree>(*mesh_data_of(geom_));",
        "static const auto first_mesh = std::make_shared<TriangleTree>(*mesh_data_of(geom_));\n        hull_->surface = first_mesh;",
        hull_data + contacts)
    yield Fault(
        "axis_of_a_second_half_space_points_back", "shapes", SOURCES + "broadphase/shape/gap.cpp",
        "return {gap.length, -gap.axis, gap.work};",
        "return {gap.length, gap.axis, gap.work};", (("shapes", "Gap.*"),))
    yield Fault(
        "depths_below_zero_are_not_rounded", "shapes", SOURCES + "surface/height_grid.cpp",
        "std::max(largest_, std::abs(height))", "std::max(largest_, height)", (("surface", "HeightGrids.*"),))
    yield Fault(
        "braking_counts_twice_in_times_of_contact", "shapes", BROADPHASE + "near/contact_forecast.cpp",
        "0.5 * gap.axis.dot(relative.acceleration) - deviation.c",
        "gap.axis.dot(relative.acceleration) - deviation.c", (("shapes", "ContactForecast.*"),))
    yield Fault(
        "budget_of_a_removed_object_is_inherited", "shapes", BROADPHASE + "broadphase.cpp",
        "    near_.close_account(id);\n", "", (("shape_contract", "GapCheckCost.*"),))
    yield Fault(
        "hulls_that_are_gone_stay_listed", "shapes", SOURCES + "space/hull_store.cpp",
        "    if (hulls_.size() >= 2 * used_)",
        "    if (used_ > 0 && hulls_.size() >= 2 * used_)", (("shape_contract", "HullData.*"),))
    yield Fault(
        "points_behind_the_most_of_a_hull_dropped", "shapes", SOURCES + "space/hull_maker.cpp",
        "    if (points_.size() <= tuning::most_hull_points)\n        points_.push_back(point);",
        "    if (points_.size() < tuning::most_hull_points)\n        points_.push_back(point);", (("shape_contract", "HullData.*"),))
    yield Fault(
        "repeating_terrain_without_the_copy_ahead", "shapes", SOURCES + "surface/height_grid.h",
        "last_z = static_cast<int>(std::floor((box.max().z() + distance) / depth()));",
        "last_z = static_cast<int>(std::floor(box.max().z() / depth()));", (("surface", "HeightGrids.*"),))
    yield Fault(
        "coinciding_corners_make_a_sliver", "shapes", SOURCES + "space/hull_maker.cpp",
        "if (!one.isZero(0) && !other.isZero(0) && one != other)", "if ((!one.isZero(0) && !other.isZero(0)) || one != other)",
        (("shape_contract", "ShapeSlivers.OfNoHeight*"),))
    yield Fault(
        "another_axis_than_the_normal_of_a_triangle", "shapes", BROADPHASE + "shape/surface_gap.cpp",
        "normal = (corners[1] - corners[0])", "normal = (corners[1] + corners[0])", (("shape_contract", "*SeesAGapAlongTheNormal*"),))


def sweep_faults():
    rows = BROADPHASE + "index/sort_and_sweep_rows.cpp"
    sorts = BROADPHASE + "index/sort_and_sweep.cpp"
    pairs = (("broadphase", "SortAndSweep.*"),)
    yield Fault("row_ends_early", "sweep", rows, "j = i + 1; keys_[j] <= end; j", "j = i + 1; keys_[j] < end; j", pairs)
    yield Fault(
        "pair_counts_in_the_wrong_slab", "sweep", rows,
        "std::max(low_y_[i], low_y_[j])", "std::min(low_y_[i], low_y_[j])", pairs)
    yield Fault("met_itself", "sweep", rows, "unsigned itself = 1u << row;", "unsigned itself = 0;", pairs)
    yield Fault("last_slab_left_out", "sweep", sorts, "slab <= last; ++slab", "slab < last || slab == 0; ++slab", pairs)
    yield Fault(
        "end_taken_for_begin", "sweep", sorts,
        "static_cast<std::uint32_t>(highs[x_])};", "static_cast<std::uint32_t>(low[x_])};", pairs)
    yield Fault(
        "unbounded_boxes_meet_nothing", "sweep", sorts,
        "std::size_t comparisons = compare_each_with_each(unbounded_, pairs) +", "std::size_t comparisons =", pairs)
    yield Fault(
        "idle_objects_swept", "sweep", BROADPHASE + "index/envelope_index.cpp",
        "if (!idle.contains(id))\n            boxes_.push_back({id, proxies.places[id].envelope()});\n    });",
        "boxes_.push_back({id, proxies.places[id].envelope()});\n    });", (("broadphase", "*Idle*"),))


def space_faults():
    space = SOURCES + "space/predictive_space.cpp"
    query = SOURCES + "space/spatial_query.cpp"
    filters = SOURCES + "ode/pair_filter.h"
    scene = SOURCES + "space/geom_scene.cpp"
    contract = lambda pattern: (("contract", pattern),)
    yield Fault(
        "a_change_in_place_told_one_level_up", "space", space,
        "    for (dxSpace *moved = this; moved; moved = moved->parent_space)\n",
        "    for (dxSpace *moved = this; moved; moved = nullptr)\n", (("shape_contract", "HullData.*"),))
    far = (("differential", "*SamePairs*far*:*NoContact*far*"),)
    yield Fault(
        "question_counted_from_another_origin", "space", query, "origin.around(to_box(query.geom->aabb))", "to_box(query.geom->aabb)",
        far)
    yield Fault(
        "ray_counted_from_another_origin", "space", query, "line_of_ray(query.geom, origin)", "line_of_ray(query.geom, Origin())",
        contract("Contract.09_*"))
    yield Fault(
        "validated_from_another_origin", "space", SOURCES + "space/validation.cpp", ".translate(-broadphase_.origin().place())", "", far)
    yield Fault(
        "deviation_of_c_alone_set_free", "space", SOURCES + "space/c_api.cpp", "a == 0 && b == 0 && c == 0 ?", "a == 0 && b == 0 ?",
        (("space", "PredictiveSpace.*"),))
    yield Fault(
        "mark_of_a_lost_offset_kept", "space", space, "        geom->gflags &= ~GEOM_POSR_BAD;\n", "", contract("Offset.*"))
    yield Fault(
        "pose_not_computed_when_a_geom_leaves", "space", space, "    if (geom->offset_posr)\n        geom->recomputePosr();\n", "",
        contract("Offset.*"))
    yield Fault(
        "bytes_with_a_sign", "shapes", SOURCES + "ode/height_data.cpp", "element<unsigned char>(samples, index)",
        "element<char>(samples, index)", CONTACT_HISTORIES)
    yield Fault(
        "unknown_counters_not_written", "space", SOURCES + "space/c_api.cpp", "    std::memset(counters, 0, size);\n", "",
        (("space", "PredictiveSpace.*"),))
    yield Fault(
        "an_old_box_of_other_data", "shapes", SOURCES + "space/hull_maker.cpp", "word(mesh.triangle_stride),\n            word(&mesh)};",
        "word(mesh.triangle_stride),\n            word(&mesh) - word(&mesh)};", (("shape_contract", "HullData.*"),))
    yield Fault(
        "libccd_judged_by_spheres", "space", scene, "return found_by_libccd(one, other) || JudgedSphere(one)", "return JudgedSphere(one)",
        contract("ReportBySphere.*"))
    yield Fault(
        "deaf_after_the_first_move", "space", space, "return follow_closely(geom, followed);\n    listen_to(geom);",
        "return follow_closely(geom, followed);", contract("Contract.01_*:Notice.*"))
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
        "leaves_clean_with_a_bad_box", "space", space, "    geom->gflags |= GEOM_DIRTY;\n}",
        "    geom->gflags |= IS_SPACE(geom) ? GEOM_DIRTY : 0;\n}", contract("Contract.05_*:Contract.06_*") + (HISTORIES,))
    yield Fault(
        "leaves_clean_with_a_good_box", "space", space, "    geom->gflags |= GEOM_DIRTY;\n}",
        "    geom->gflags |= (geom->gflags & GEOM_AABB_BAD) || IS_SPACE(geom) ? GEOM_DIRTY : 0;\n}", contract("Contract.11_A*"))
    yield Fault(
        "meshes_not_polled", "space", space, "if (geoms_[id]->type == dTriMeshClass || IS_SPACE(geoms_[id]))",
        "if (IS_SPACE(geoms_[id]))", contract("Contract.12_*"))
    yield Fault(
        "new_geoms_missed_by_queries", "space", space, "unclassified_.insert(id);\n    access_.forget_catching_up();", "unclassified_.insert(id);",
        contract("Contract.09_*"))
    yield Fault(
        "query_reports_what_is_apart", "space", query, "if (aabbs_overlap(other, query.geom) && bits_agree",
        "if (bits_agree", contract("Contract.09_*"))
    yield Fault(
        "query_with_a_stale_box", "space", query,
        "if (flags_beside_others(geom) & GEOM_AABB_BAD)\n        compute_box_of_probe(geom);\n    const bool as_line",
        "const bool as_line", contract("Contract.09_*"))
    yield Fault(
        "tick_within_a_tick", "space", space, "const bool nested_call = lock_count > 0;",
        "const bool nested_call = false;", contract("Contract.08_*"))
    yield Fault(
        "reports_without_the_lock", "space", space, "const Lock lock(this);\n    ticks_ += !nested_call;", "ticks_ += !nested_call;",
        contract("Contract.07_*"))
    yield Fault(
        "outer_list_overwritten", "space", query,
        "std::vector<ProxyId> found = lock.is_only_one ? std::exchange(found_, {}) : std::vector<ProxyId>();",
        "std::vector<ProxyId> &found = found_;", contract("Contract.08_*"))
    yield Fault(
        "other_data_unnoticed_by_shape", "space", query, ": polled_.empty());", ": true);",
        (("shape_contract", "ShapeQuery.*"),))
    yield Fault(
        "size_of_a_cylinder_unknown", "space", scene,
        "{Watch::cylinder, static_cast<float>(sizes[0]), 0, static_cast<float>(sizes[1] / 2)}",
        "{Watch::cylinder, static_cast<float>(sizes[0]), 0, static_cast<float>(sizes[0])}",
        contract("*EveryPlaceableClass*") + (HISTORIES,))
    yield Fault(
        "sphere_of_a_box_too_small", "space", scene, "std::sqrt(x * x + y * y + z * z) / 2", "std::sqrt(x * x + 0 * y + z * z) / 2",
        contract("*EveryPlaceableClass*:Notice.*") + (HISTORIES,))
    nests = contract("Contract.11_*")
    yield Fault(
        "nested_spaces_not_cleaned", "space", SOURCES + "ode/geom_access.h",
        "if (IS_SPACE(geom))\n        static_cast<dxSpace *>(geom)->cleanGeoms();\n    compute_box_beside_others(geom);",
        "compute_box_beside_others(geom);", nests)
    yield Fault(
        "new_spaces_stay_dirty_when_cleaned", "space", space, "    poll_moves();\n    for (dxGeom *geom = first;",
        "    const IdSet unclassified = unclassified_;\n    unclassified_.clear();\n    poll_moves();\n    unclassified_ = unclassified;\n"
        "    for (dxGeom *geom = first;", nests)
    yield Fault(
        "moved_spaces_stay_dirty_when_cleaned", "space", space, "    poll_moves();\n    for (dxGeom *geom = first;",
        "    if (!unclassified_.empty())\n        prepare();\n    for (dxGeom *geom = first;", nests)
    yield Fault(
        "cleaned_without_the_spaces_inside", "space", space,
        "for (dxGeom *geom = first; geom; geom = geom->next)\n        valid_aabb(geom);",
        "for (dxGeom *geom = first; geom; geom = geom->next)\n        compute_box_beside_others(geom);", nests)
    # Spaces of few geoms.
    yield Fault(
        "few_geoms_stay_dirty", "space", space, "valid_aabb(geom);\n            listen_to(geom);",
        "valid_aabb(geom);", contract("*"))
    yield Fault(
        "few_geoms_forgotten", "space", space, "tuning::few_objects)\n        start_predicting();",
        "tuning::few_objects)\n        predicts_ = true;", contract("FewGeoms.*"))
    yield Fault(
        "dear_contacts_among_few_geoms_not_noticed", "space", space, "if (!predicts_ && tests_shapes())\n        start_predicting();", "",
        contract("FewGeoms.*"))
    yield Fault(
        "few_geoms_by_box_alone", "space", space, "if (test == ProximityTest::sphere)\n        start_predicting();", "",
        contract("FewGeoms.*"))
    yield Fault(
        "lines_unknown_after_another_test", "space", space,
        "    if (predicts_ && !by_box())\n        for (dxGeom *geom = first; geom; geom = geom->next)\n"
        "            note_changed_line(geom);\n", "", (("shape_contract", "ShapeQuery.*"),))
    # Exceptions in the middle of an update.
    faults = lambda pattern: (("faults", pattern),)
    yield Fault(
        "trusts_a_tick_that_was_broken_off", "space", BROADPHASE + "broadphase.cpp", "if (interrupted_ || clock_.update % half_of_all == 0)", "if (clock_.update % half_of_all == 0)",
        faults("*EveryCall*:*EverySituation*"))
    yield Fault(
        "linked_before_there_is_room", "space", space,
        "    if (predicts_)\n    {\n        broadphase_.make_room(1);\n        fit_to_proxies();\n    }\n    dxSpace::add(geom);",
        "    dxSpace::add(geom);\n    if (predicts_)\n    {\n        broadphase_.make_room(1);\n        fit_to_proxies();\n    }\n",
        faults("*EverySituation*"))
    yield Fault(
        "broken_off_unnoticed", "space", BROADPHASE + "broadphase.cpp", "interrupted_ = true;\n    counters_.moved", "counters_.moved",
        (("faults", "*EveryCall*:*EverySituation*"),))
    yield Fault(
        "envelopes_survive_starting_over", "space", BROADPHASE + "broadphase.cpp",
        "proxies_.places[id].forget_envelope();\n        list(id);", "list(id);",
        (("faults", "*EveryCall*:*EverySituation*"),))
    yield Fault(
        "lost_resize", "space", space, "set->resize(size);", "(void)set;", contract("Contract.02_*"))
    # The sphere test of proximity.
    yield Fault(
        "skewed_geoms_judged_by_spheres", "space", scene,
        "return skew <= most_skew ? radius_ * (1 + skew) + rounding_at(bounds_)", "return skew < 1e300 ? radius_ + rounding_at(bounds_)", CONTACT_HISTORIES)
    yield Fault(
        "skewed_rays_judged_by_lines", "space", scene,
        "touched_off_line(geom) || is_skewed(probe))",
        "touched_off_line(geom))", CONTACT_HISTORIES)
    yield Fault(
        "spheres_never_turn", "space", SOURCES + "space/geom_scene.cpp",
        "const bool turning_shows = geom->type != dSphereClass || geom->offset_posr;",
        "const bool turning_shows = geom->type != dSphereClass;", (("times", "Times.*"),))
    yield Fault(
        "nested_collide_that_broke_off_goes_on", "space", BROADPHASE + "broadphase.cpp",
        "    catch_up(scene);\n    interrupted_ = true;\n    find_pairs(scene);\n",
        "    catch_up(scene);\n    find_pairs(scene);\n", (("faults", "*collide_within*"),))
    yield Fault(
        "turn_ends_with_a_nested_collide", "space", SOURCES + "space/access.h",
        "            if (taken_)\n                holder_.store",
        "            if (granted_)\n                holder_.store", (("contract", "Contract.16_*"),))
    yield Fault(
        "forecast_of_libccd_pairs_by_spheres", "space", SOURCES + "space/forecast_query.cpp",
        "by_sphere() && !found_by_libccd(geoms_[pair.first], geoms_[pair.second]);", "by_sphere();", (("times", "Times.*"),))
    yield Fault(
        "heights_of_another_scale_share_a_grid", "space", SOURCES + "space/hull_maker.cpp",
        "            word(heights.scale),\n", "", (("shape_contract", "HullOfHeights.*"),))
    yield Fault(
        "pose_of_an_offset_geom_is_its_own", "space", SOURCES + "space/geom_scene.cpp",
        "    const dReal *position = geom->body ? dBodyGetPosition(geom->body) : geom->final_posr->pos;",
        "    const dReal *position = geom->final_posr->pos;", (("times", "Times.*Offset*"),))


def history_faults():
    recorder = SOURCES + "recording/recorder.cpp"
    state = SOURCES + "recording/state.cpp"
    data = SOURCES + "recording/shape_data.cpp"
    check = SOURCES + "recording/recording_check.cpp"
    file = SOURCES + "recording/history_file.cpp"
    recorded = (("recordings", "RecorderTest.*"),)
    read = (("recordings", "Recording.*"),)
    yield Fault(
        "parent_looked_at_before_the_outermost_space", "history", recorder, "        while (begin->parent_space)\n",
        "        if (begin->parent_space)\n", (("recordings", "Recorded*"),))
    yield Fault(
        "strides_not_in_the_key_of_a_mesh", "history", data,
        "std::tie(first, second, third, numbers, sizes) <\n           std::tie(other.first, other.second, other.third, other.numbers, other.sizes);",
        "std::tie(first, second, third, numbers[0], numbers[1], sizes) <\n           std::tie(other.first, other.second, other.third, other.numbers[0], other.numbers[1], other.sizes);",
        recorded)
    yield Fault(
        "levels_that_change_not_recorded", "history", state, "when(differ(before.space, now.space), geom_field::space) |", "", recorded)
    yield Fault(
        "a_convex_cannot_be_cut", "history", check, "    case RecordKind::convex:\n    case RecordKind::heights:", "    case RecordKind::heights:", read)
    yield Fault(
        "spaces_within_asked_spaces_recorded", "history", SOURCES + "recording/recorded_space.cpp", "        if (!recorder || IS_SPACE(geom))\n",
        "        if (!recorder)\n", (("recordings", "*Recorded*"),))
    yield Fault(
        "another_class_at_the_address_known", "history", recorder,
        "return known != geoms_.end() && known->second.state.geom_class == geom->type;", "return known != geoms_.end();", recorded)
    yield Fault(
        "recorded_from_the_first_to_the_last", "history", recorder,
        "for (auto geom = members.rbegin(); geom != members.rend(); ++geom)",
        "for (auto geom = members.begin(); geom != members.end(); ++geom)", recorded)
    yield Fault(
        "geoms_that_left_still_recorded", "history", recorder, "has_absent_ |= member_counts_[id + 1] != members.size();",
        "(void)id;", recorded)
    yield Fault(
        "no_room_for_the_end", "history", recorder, "(unfinished_ + 1) * (pairs_size + times_size) + end_size;",
        "(unfinished_ + 1) * (pairs_size + times_size);", recorded)
    yield Fault(
        "no_room_for_pairs_to_come", "history", recorder, "(unfinished_ + 1) * (pairs_size + times_size) + end_size;", "end_size;", recorded)
    yield Fault(
        "half_of_a_tick_at_the_limit", "history", recorder, "buffer_.resize(before);\n        Record(", "(void)before;\n        Record(", recorded)
    yield Fault(
        "pose_with_an_offset_left_to_the_body", "history", recorder,
        "    if (body_changed && has_own_pose(state))\n        fields |= geom_field::pose;\n", "", recorded)
    yield Fault(
        "half_of_an_event_without_memory", "history", recorder, "buffer_.resize(before);\n        cut();", "(void)before;\n        cut();",
        recorded)
    yield Fault(
        "closed_as_whole_without_memory", "history", recorder, "file_.give_up(ENOMEM);\n    over_ = true;", "", recorded)
    yield Fault(
        "pairs_hashed_in_their_order", "history", SOURCES + "recording/format.cpp",
        "std::uint64_t{std::min(first, second)} << 32 | std::max(first, second);",
        "std::uint64_t{first} << 32 | std::max(second, std::min(first, second));", recorded)
    yield Fault(
        "collide_bits_alone_unnoticed", "history", state, "when(before.bits != now.bits, geom_field::bits)",
        "when(before.bits[0] != now.bits[0], geom_field::bits)", recorded)
    yield Fault(
        "half_of_the_velocity", "history", state,
        "std::copy_n(dBodyGetAngularVel(body), 3, state.velocity.begin() + 3);", "", recorded)
    yield Fault("changed_vertices_unnoticed", "history", data, "(collide == 0 || known->second.looked_at == collide || is_sampled_once(geom))",
                "(collide == 0 || known->second.looked_at <= collide || is_sampled_once(geom))", recorded)
    yield Fault(
        "meshes_told_apart_by_their_first_bytes", "history", data, "i < content.size(); i += sizeof(std::uint64_t)",
        "i < 1; i += sizeof(std::uint64_t)", recorded)
    yield Fault(
        "part_of_a_record_left_in_a_full_file", "history", file,
        "ftruncate(file_, static_cast<off_t>(size_));", "0;", (("recordings", "HistoryFile.*"),))
    yield Fault(
        "emptied_under_another_recording", "history", file, "return EBUSY;", "return 0;", (("recordings", "HistoryFile.*"),))
    yield Fault(
        "versions_below_the_first_accepted", "history", check, "if (version < oldest_version || version > format_version)", "if (version > format_version)", read)
    yield Fault(
        "any_length_taken_for_a_cut", "history", check, "record.kind <= RecordKind::last && record.size <= most_of_other_kinds",
        "record.kind <= RecordKind::last", read)
    yield Fault(
        "corner_behind_the_last_vertex", "history", check, "mesh.triangles.end()) >= vertices)",
        "mesh.triangles.end()) > vertices)", read)
    yield Fault(
        "any_levels", "history", check,
        "state.min_level < -most || state.min_level > state.max_level || state.max_level > most",
        "state.min_level < -most || state.max_level > most", read)
    yield Fault(
        "body_of_a_plane", "history", check, "|| (state.body != 0 && !may_have))", "|| !(may_have || !may_have))", read)
    yield Fault("offset_without_a_body", "history", check, "(!geom.has_body || !is_placeable_class(geom.geom_class)))",
                "!is_placeable_class(geom.geom_class))", read)
    yield Fault(
        "moved_to_another_space", "history", check, "if ((change.fields & geom_field::parent) && !is_new)", "if (!is_new && is_new)",
        read)
    yield Fault(
        "pairs_of_an_event_twice", "history", check, " || recording_.events_[number].has_pairs)", ")", read)
    yield Fault(
        "a_pose_set_to_what_it_was_is_no_notice", "history", recorder, "if (number != usual)", "if (number < usual)", recorded)
    yield Fault(
        "a_new_geom_has_a_notice", "history", recorder, "other_pose && !(fields & geom_field::is_new) ? 1 : 0", "other_pose ? 1 : 0", recorded)
    yield Fault(
        "nested_predictive_spaces_not_listened_to", "history", recorder, "    ode_predictive_space_listen(space, &notices_);\n",
        "    if (!space->parent_space)\n        ode_predictive_space_listen(space, &notices_);\n", recorded)
    yield Fault(
        "functions_of_a_recorded_space_kept", "history", SOURCES + "recording/recorded_space.cpp",
        "    recorded_spaces().all.erase(place);\n    give_functions_of<dxPredictiveSpace>(space);\n",
        "    recorded_spaces().all.erase(place);\n", (("recordings", "RecorderTest.*"),))
    yield Fault(
        "a_callback_sampled_at_every_collide", "history", data, "height_data_of(geom)->source == HeightSamples::callback", "false", recorded)
    yield Fault(
        "bounds_of_a_heightfield_not_recorded", "history", SOURCES + "recording/stage.cpp", "            known->lowest = field.lowest;\n", "", recorded)
    yield Fault(
        "a_sizeless_geom_in_a_transform_recorded", "history", state, "(GEOM_PLACEABLE | GEOM_ZERO_SIZED)) == GEOM_PLACEABLE", "GEOM_PLACEABLE) != 0",
        (("recordings", "*RecordedHistories*"),))
    yield Fault(
        "notices_of_a_geom_that_does_not_exist", "history", check, "count.id >= geoms_.size() || geoms_[count.id].gone", "count.id > geoms_.size()", read)
    yield Fault(
        "asked_before_it_is_collided", "history", check,
        "if (is_collide ? !has_collide_ : !has_collide_ && !has_query_)", "if (!has_collide_ && !has_query_)", read)
    yield Fault(
        "more_notices_recorded_than_a_reader_takes", "history", SOURCES + "recording/recorder.cpp",
        "std::min(notices_.take(geom), most_notices)",
        "notices_.take(geom)", (("recordings", "*MoreOftenThan*"),))
    yield Fault(
        "children_of_the_program_keep_the_file", "history", SOURCES + "recording/history_file.cpp",
        "O_WRONLY | O_CREAT | O_CLOEXEC | (only_new ? O_EXCL : 0)",
        "O_WRONLY | O_CREAT | (only_new ? O_EXCL : 0)", (("recordings", "HistoryFile.*"),))
    yield Fault(
        "room_for_pairs_is_never_given_back", "history", SOURCES + "recording/recorder.cpp",
        "    --recorder_->unfinished_;\n", "", (("recordings", "RecorderTest.*"),))
    yield Fault(
        "the_lock_stays_taken_in_a_child", "history", SOURCES + "recording/recorded_space.cpp",
        "                           each.second.listeners.clear();\n                       recorded_spaces().mutex.unlock();\n",
        "                           each.second.listeners.clear();\n", (("recordings", "RecorderTest.*"),))
    yield Fault(
        "child_unlocks_the_file_of_its_parent", "history", SOURCES + "recording/history_file.cpp",
        "    ::close(std::exchange(file_, -1));\n}\n} // namespace", "    close();\n}\n} // namespace", (("recordings", "HistoryFile.*"),))
    yield Fault(
        "notices_of_a_removed_geom_kept", "history", SOURCES + "recording/recorder.cpp",
        "            notices_.take(place->first);\n", "", (("recordings", "*CameBackHasNoNotices"),))
    yield Fault(
        "stand_in_keeps_its_offset", "history", SOURCES + "recording/state.cpp", "    state.has_offset = 0;\n", "",
        (("recordings", "RecorderTest.AMesh*"),))


def advice_faults():
    advice = SOURCES + "recording/advice.cpp"
    advised = (("recordings", "Advice.*"),)
    yield Fault(
        "the_tick_of_the_recording_taken_for_that_of_the_program", "replay", advice,
        "findings.tick->whole + median(own->costs) - median(recorded->costs)", "findings.tick->whole", advised)
    yield Fault("spared_callbacks_not_counted", "replay", advice, " + other->spared - own->spared)", ")", advised)
    yield Fault("any_spread_is_clear", "replay", advice, "return gain.share >= 2 * gain.spread;", "return gain.share > 0;", advised)
    yield Fault("ends_of_the_program_count_as_fast", "replay", advice, "space.kind == kind && !space.costs.empty()", "space.kind == kind", advised)


def replay_faults():
    stage = SOURCES + "recording/stage.cpp"
    geom = SOURCES + "recording/geom_of_state.cpp"
    replay = SOURCES + "recording/replay.cpp"
    check = SOURCES + "recording/check.cpp"
    child = SOURCES + "recording/child.cpp"
    staged = (("recordings", "RecorderTest.*"),)
    replayed = (("recordings", "Replay.*"),)
    yield Fault(
        "offset_kept_with_another_body", "replay", stage, "fields |= geom_field::offset | geom_field::pose;", "fields |= geom_field::pose;",
        (("recordings", "Recorded*"),))
    yield Fault(
        "mark_of_the_offset_left", "replay", stage, "if (dGeomIsOffset(geom.geom))\n            dGeomClearOffset(geom.geom);\n        dGeomSetBody", "dGeomSetBody",
        (("recordings", "*Recorded*"),))
    yield Fault(
        "plane_scaled_again", "replay", geom,
        "std::copy_n(size.begin(), 4, static_cast<dxPlane *>(geom)->p); // it has scaled them", "", staged)
    yield Fault(
        "offset_without_its_rotation", "replay", stage, "dGeomSetOffsetRotation(geom.geom, rotation);", "", staged)
    yield Fault(
        "velocities_swapped", "replay", stage, "dBodySetAngularVel(body, velocity[3], velocity[4], velocity[5]);",
        "dBodySetAngularVel(body, velocity[0], velocity[1], velocity[2]);", staged)
    yield Fault(
        "old_mesh_kept", "replay", stage, "if (geom.geom && (fields & geom_field::data) && has_data(state.geom_class))",
        "if (geom.geom && (fields & geom_field::data) && !has_data(state.geom_class))", staged)
    yield Fault("levels_forgotten", "replay", geom, "dHashSpaceSetLevels(space, state.space.min_level, state.space.max_level);",
                ";", staged)
    yield Fault("sublevel_forgotten", "replay", geom,
                "dSpaceSetSublevel(space, state.space.sublevel);", ";", staged)
    yield Fault("inner_simple_spaces_replaced", "replay", stage, "state.geom_class == dSimpleSpaceClass && state.parent != 0;",
                "state.geom_class == dSimpleSpaceClass && state.parent == 0;", staged + replayed)
    yield Fault(
        "one_event_too_many", "replay", replay, "if (number >= most_events || start - begin > most_seconds)",
        "if (number > most_events || start - begin > most_seconds)", replayed)
    yield Fault(
        "boxes_found_nothing_everywhere", "replay", replay, "        if (touch(stage, pair))\n            continue;\n        const double end", "        const double end", replayed)
    yield Fault(
        "every_callback_found_nothing_is_spared", "replay", replay, "if (!std::binary_search(by_shape.begin(), by_shape.end(), pair))\n            ",
        "", replayed)
    yield Fault(
        "stand_ins_collided", "replay", replay,
        "return !stage.is_stand_in(pair.first) && !stage.is_stand_in(pair.second) &&", "return", replayed)
    yield Fault(
        "predictive_spaces_may_have_more", "replay", check, "kind == SpaceKind::own || kind == SpaceKind::quadtree ||",
        "kind == SpaceKind::own || kind == SpaceKind::box || kind == SpaceKind::quadtree ||", replayed)
    yield Fault(
        "failure_of_a_child_forgotten", "replay", child, "return WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) :",
        "return WIFSIGNALED(status) ? \"\" :", replayed)
    yield Fault(
        "cut_notices_are_taken_for_nonsense", "replay", SOURCES + "recording/recording_check.cpp",
        "    case RecordKind::heights:\n    case RecordKind::notices:\n        return true;\n",
        "    case RecordKind::heights:\n        return true;\n", (("recordings", "Recording.*"),))
    yield Fault(
        "nested_space_counts_as_bounded", "replay", SOURCES + "recording/replay.cpp",
        "    return !dGeomIsSpace(geom) && std::none_of(box,", "    return std::none_of(box,",
        (("recordings", "Replay.*"),))


def haptic_faults():
    safety = SOURCES + "haptics/safety/"
    passivity = (("haptics", "Passivity.*"),)
    renderer = (("haptics", "Renderer.*"),)
    yield Fault(
        "force_from_before_the_guard", "haptics", safety + "safety.cpp", "    last_ = Wrench();\n    ramp_ = 0;",
        "    ramp_ = 0;", renderer)
    yield Fault(
        "observer_ignores_what_was_written", "haptics", SOURCES + "haptics/renderer.cpp",
        "passivity->written(tick.wrench.force);", "passivity->damping();", renderer)
    yield Fault(
        "release_of_the_clutch_forgotten", "haptics", SOURCES + "haptics/law/rendered_touches.h",
        "            manifold_.release();", "            (void)0;", renderer)
    yield Fault(
        "passivity_delay_off_by_one", "haptics", safety + "passivity.h",
        "written_[(newest_ + written_.size() - delay_) % written_.size()]",
        "written_[(newest_ + written_.size() + 1 - std::max<std::size_t>(delay_, 1)) % written_.size()]", passivity)
    tracker = SOURCES + "haptics/contact/contact_tracker.cpp"
    slide = SOURCES + "haptics/contact/sphere_slide.cpp"
    law = SOURCES + "haptics/law/proxy_law.cpp"
    sensor = SOURCES + "haptics/contact/touch_sensor.cpp"
    yield Fault(
        "sphere_over_heightfields_without_bound", "haptics", sensor,
        "std::min(whole, widest_sphere * geom.radius() + tracker->margin());", "whole;", (("haptics", "TouchSensorTest.*"),))
    yield Fault(
        "region_without_drift", "haptics", tracker, "std::max(around * step, farthest) + 2 * drift;",
        "std::max(around * step, farthest);", (("haptics", "CarriedProxy.*"),))
    yield Fault(
        "contact_ends_with_the_region", "haptics", tracker,
        "!carries_on_ && !near_.has(reported.geom) &&\n           (reported.touch.point - searched.centre).norm() < searched.radius;",
        "!near_.has(reported.geom);",
        (("haptics", "*ReleasedForceTest.Fades*"),))
    yield Fault(
        "budget_of_triangles_not_spent", "haptics", slide, "left_ -= most - budget.left();", "", (("haptics", "*SlideBudgetTest.*:ScrubbingTest.*"),))
    yield Fault(
        "seams_block_friction", "haptics", law, "along += std::max(0.0, entry_of(along, lift, touch)) * touch.normal;", "(void)touch;",
        (("haptics", "*FrictionSeamTest.*"),))
    loop = SOURCES + "haptics/loop/"
    yield Fault(
        "impulses_a_tick_late", "haptics", loop + "decoupled_servo.h", "give(tick_, due);", "give(tick_, due - tick_);",
        (("haptics", "DecoupledLoopTest.*"),))
    yield Fault(
        "roll_out_pushes_bystanders", "haptics", loop + "island_roll_out.cpp",
        "        if (known_.count(push.body) == 0)\n            continue;\n", "", (("haptics", "IslandRollOutTest.*"),))
    yield Fault(
        "touches_beyond_the_capacity_not_told", "haptics", SOURCES + "haptics/contact/held_geoms.cpp", "exceeds_ = true;", "exceeds_ = false;",
        (("haptics", "*ManyTouches*"),))
    yield Fault(
        "what_takes_over_counts_as_appeared", "haptics", SOURCES + "haptics/contact/contact_manifold.cpp",
        "return jump_ <= usual(std::max(speed, fastest_before(tool))) ? risen(least_part_before(), dt) : 0;", "return 0;",
        (("haptics", "ContactManifoldTest.*"),))
    yield Fault(
        "proxy_that_bodies_hold_lags", "haptics", SOURCES + "haptics/contact/contact_tracker.cpp",
        "nullptr && !held_by_body() && !released_", "nullptr && !released_", (("haptics", "ManyBodies.*"),))
    yield Fault(
        "share_of_opposed_bodies_has_no_bound", "haptics", SOURCES + "haptics/contact/yielding_place.cpp",
        "if (plane.yield <= rigid_yield)", "if (plane.yield > 0)", (("haptics", "Bounce.*"),))
    yield Fault(
        "a_hanging_driver_told_of_again", "haptics", loop + "loop_guard.cpp", "std::exchange(busy_beat_, beat) == beat",
        "std::exchange(busy_beat_, beat) == -1", (("haptics", "LoopGuardTest.*"),))
    yield Fault(
        "the_shallowest_contact_of_an_object", "haptics", SOURCES + "haptics/contact/touch_sensor.cpp",
        "touch.depth > known->touch_at(place.centre).depth", "touch.depth < known->touch_at(place.centre).depth", (("haptics", "TouchSensorTest.*"),))
    yield Fault(
        "fast_loop_with_a_delay_exceeds_the_stiffness_of_the_device", "haptics", SOURCES + "haptics/safety/stability.cpp",
        "return capabilities.max_stiffness * std::min(1.0, part);",
        "return capabilities.max_stiffness * part;", (("haptics", "Stability.*"),))
    yield Fault(
        "slopes_weighted_by_their_own_leg", "haptics", SOURCES + "haptics/record/replay_device.cpp",
        "return (seconds_after * before + seconds_before * after) / (seconds_before + seconds_after);",
        "return (seconds_before * before + seconds_after * after) / (seconds_before + seconds_after);", (("haptics", "ReplayDevice.*"),))
    yield Fault(
        "forces_before_a_restart_count_in_the_energy", "haptics", SOURCES + "haptics/safety/passivity.h",
        "        written_.fill(Vector3::Zero());\n        last_position_.reset();",
        "        last_position_.reset();", (("haptics", "Passivity.*"),))
    yield Fault(
        "lateness_of_the_servo_by_the_rate_of_the_scene", "haptics", SOURCES + "haptics/safety/watchdog.cpp",
        "limits.late_after = std::max(least, 1 / servo_rate + overdue);",
        "limits.late_after = std::max(least, 1 / physics_rate + overdue);", (("haptics", "Watchdog.*"),))
    yield Fault(
        "any_doubt_is_short", "haptics", SOURCES + "haptics/safety/device_link.cpp",
        "    if (!failed_)\n        doubted_since_ = time_;\n", "    doubted_since_ = time_;\n", (("haptics", "ProbeFaultTest.*"),))
    yield Fault(
        "former_forces_go_to_any_touch_of_the_object", "haptics", SOURCES + "haptics/law/force_shares.cpp",
        "return now.object == share.object && now.touch == share.touch;",
        "return now.object == share.object;", (("haptics", "ForceSplit.*"),))
    yield Fault(
        "last_digit_of_a_file_without_a_final_newline", "haptics", SOURCES + "haptics/record/recording.cpp",
        "stream.eof() ? taken : taken - 1", "taken - 1", (("haptics", "Recording.*"),))
    yield Fault(
        "former_target_moves_a_base_that_was_placed", "haptics", SOURCES + "haptics/device/hand_workspace.h",
        "        aims_.take();\n        left_ = 0;\n", "        left_ = 0;\n", (("haptics", "MovingBase.*"),))
    yield Fault(
        "probes_meet_by_one_side_of_their_bits", "haptics", SOURCES + "haptics/contact/other_probes.cpp",
        "((a.category & b.collides) != 0 || (b.category & a.collides) != 0);", "(a.category & b.collides) != 0;",
        (("haptics", "TwoProbes.*"),))
    yield Fault(
        "holds_of_a_law_that_was_set_aside", "haptics", SOURCES + "haptics/law/penalty_law.cpp",
        "    holds_.clear(); // the next tick's last_holds_\n", "", (("haptics", "PenaltyLaw.*"),))
    yield Fault(
        "probe_stays_guarded_after_its_loop", "haptics", SOURCES + "haptics/loop/loop_guard.cpp",
        "    if (watch_) // afterwards the device's gate may be gone\n        gate_.set_guarded(false);\n", "",
        (("haptics", "LoopGuardTest.*"),))
    yield Fault(
        "joints_that_the_program_disabled_come_back", "haptics", SOURCES + "haptics/loop/island_roll_out.cpp",
        "if (dJointIsEnabled(joint) == 0 || within.count(other_body(joint, body)) != 0)",
        "if (within.count(other_body(joint, body)) != 0)", (("haptics", "*LongRow*"),))
    yield Fault(
        "torque_on_the_tool_ignores_the_watchdog", "haptics", SOURCES + "haptics/renderer.cpp",
        "given.torque = parts_->watchdog->factor() * requested.torque;", "given.torque = requested.torque;",
        (("haptics", "HapticProbeTest.ATorque*"),))
    yield Fault(
        "static_friction_alone_is_none", "haptics", SOURCES + "haptics/law/penalty_law.cpp",
        "        if (std::max(material.friction, material.static_friction) > 0)\n", "        if (material.friction > 0)\n",
        (("haptics", "PenaltyLaw.*"),))
    yield Fault(
        "rest_of_the_impulses_is_lost_at_the_end", "haptics", SOURCES + "haptics/loop/scene_motion.cpp",
        "    push_now(rest_, h);\n    push_now(waiting_, h);\n", "    push_now(waiting_, h);\n",
        (("haptics", "DecoupledLoopTest.*"),))
    yield Fault(
        "shares_outlive_the_force", "haptics", SOURCES + "haptics/renderer.cpp",
        "    parts_->touched.give(Vector3::Zero());\n", "", (("haptics", "DecoupledLoopTest.*"),))


FAULTS = tuple(
    fault
    for faults in (notice_faults, predict_faults, index_faults, proximity_faults, near_faults, shape_faults, sweep_faults,
                   space_faults, history_faults, advice_faults, replay_faults, haptic_faults)
    for fault in faults())
