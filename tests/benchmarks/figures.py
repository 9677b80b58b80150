#!/usr/bin/env python3
"""Measures all figures of docs/results again, or those of the named files. Times need an idle host, and hours.

    figures.py --build build/release                    # all
    figures.py --build build/release stepped.json       # these
"""

import argparse
import csv
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

from worlds_table import ODE, TOP, version

RESULTS = TOP / "docs" / "results"
STEPPED = ["gas_stepped", "game_stepped/10000", "pile/500", "terrain_stepped", "dart/10000"]
CONTACT = ["mix"]
REPETITIONS = 5
LIFE_NAMES = {"gas": "many", "spaces_in_spaces": "nested", "spaces_side_by_side": "beside", "planes_all": "planes-all",
              "planes_apart": "planes-apart"}


def clocked(build, kinds, worlds, ours="predictive-box"):
    """{(kind, world, n): {space: its benchmark}}: the fastest of the repetitions, which alternate with those of other spaces.
    (Other guests of a host slow some of the repetitions down, and speed none up.)"""
    rows = f"^({kinds})/({'|'.join(worlds)})/(.*/)?({'|'.join([ours, *ODE])})(/|$)"
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out.json"
        subprocess.run([build / "tests/benchmarks/predictive_bench", f"--benchmark_filter={rows}",
                        f"--benchmark_repetitions={REPETITIONS}", "--benchmark_enable_random_interleaving=true",
                        f"--benchmark_out={out}"], check=False, stdout=sys.stderr)
        benchmarks = json.loads(out.read_text())["benchmarks"]
    found = {}
    for one in benchmarks:
        if one.get("error_occurred"):  # hash omits pairs; the row is left out
            if "predictive" in one["name"]:
                raise RuntimeError(f"{one['name']}: {one['error_message']}")
        elif one["run_type"] == "iteration":
            kind, world, n, space = one["name"].split("/")[:4]
            spaces = found.setdefault((kind, world, int(n)), {})
            spaces[space] = min(spaces.get(space, one), one, key=lambda each: each["real_time"])
    return dict(sorted(found.items()))


def rounded(value):
    return f"{value:.4g}"


def best_of_ode(spaces, key=lambda one: one["real_time"]):
    return min((key(spaces[name]) for name in ODE if name in spaces), default=None)


def ratio(best, value):
    return best / value if best else None


def part_of(world):
    """"settling:0.5s" is settling from 0.5 to 1.0 s."""
    name, _, begin = world.partition(":")
    seconds = float(begin[:-1]) if begin else None
    return name, seconds, None if seconds is None else seconds + 0.5


def timing(spaces, ticks, space):
    """The figures of collide/ and tick/ in one space."""
    one = spaces[space]
    return {"space": space, "mean_us": one["real_time"], "median_us": one["p50"], "p99_us": one["p99"], "p999_us": one["p99.9"],
            "max_us": one["max"], "whole_us": ticks[space]["real_time"],
            "best_ode_ratio": ratio(best_of_ode(spaces), one["real_time"]),
            "best_ode_ratio_of_wholes": ratio(best_of_ode(ticks), ticks[space]["real_time"])}


def stepped(build):
    found = clocked(build, "collide|tick", STEPPED)
    for (kind, world, n), spaces in found.items():
        if kind == "collide":
            scene, begin, end = part_of(world)
            ticks = found["tick", world, n]
            for space in ticks:  # some contenders are not spaces that a program can use
                yield {"table": "stepped", "scene": scene.replace("_stepped", ""), "n": n, "begin_s": begin, "end_s": end,
                       **timing(spaces, ticks, space)}
    for (_, world, n), spaces in clocked(build, "query", ["ask"]).items():
        for space in spaces:
            yield {"table": "stepped", "scene": world, "n": n, "begin_s": None, "end_s": None, **timing(spaces, spaces, space)}


def contact(build):
    found = clocked(build, "contact|tick", CONTACT, "predictive-(box|shape)")
    for (kind, world, n), spaces in found.items():
        if kind != "contact":
            continue
        ticks = found["tick", world, n]
        for space, one in spaces.items():
            total, collide = one["real_time"], one["collide_us"]
            yield {"table": "contact", "scene": world.replace("_stepped", ""), "n": n, "space": space, "collide_us": collide,
                   "dcollide_us": total - collide, "sum_us": total, "whole_us": ticks[space]["real_time"],
                   "calls_per_tick": one["calls"], "touching_per_tick": one["touching"],
                   "calls_per_touching": ratio(one["calls"], one["touching"]) if one["touching"] else None,
                   "best_ode_ratio": ratio(best_of_ode(spaces), total),
                   "best_ode_ratio_of_wholes": ratio(best_of_ode(ticks), ticks[space]["real_time"]),
                   "box_ratio": spaces["predictive-box"]["real_time"] / total}


def limits(build):
    for (_, world, n), spaces in clocked(build, "life", [".*"]).items():
        sap = spaces.get("sap")
        for space, one in spaces.items():
            record = {"table": "limits", "scene": LIFE_NAMES.get(world, world), "n": n, "space": space, "collide_ms": one["real_time"]}
            record |= {name: one[name] for name in ("fill_ms", "first_ms", "move_ms", "empty_ms", "bytes_per_object", "pairs")}
            for name, key in (("first", "first_ms"), ("collide", "real_time"), ("empty", "empty_ms")):
                record[f"sap_ratio_{name}"] = ratio(sap and sap[key], one[key])
            yield record


def worlds_times(build):
    """The row "all" has the geometric means of whole worlds, without the half seconds of some."""
    worlds = json.loads(subprocess.run([build / "tests/benchmarks/record_worlds", "--list"], capture_output=True, check=True).stdout)
    names = sorted({row["scene"] for row in worlds if row["group"] == "worlds"} | {"heap:.*"})
    found = clocked(build, "collide|tick", names)
    rows, whole = [], []
    for (kind, world, n), spaces in found.items():
        if kind == "collide":
            scene, begin, end = part_of(world)
            ours, ticks, best = spaces["predictive-box"], found["tick", world, n], best_of_ode(spaces)
            rows.append({"scene": scene if end is None else f"{scene} {begin} to {end} s", "n": n, "best ODE": best,
                         "predictive": ours["real_time"], "ratio": best / ours["real_time"], "p99": ours["p99"],
                         "ratio of p99": best_of_ode(spaces, lambda one: one["p99"]) / ours["p99"],
                         "ratio of whole ticks": best_of_ode(ticks) / ticks["predictive-box"]["real_time"]})
            whole += [rows[-1]] if end is None else []
    ratios = ("ratio", "ratio of whole ticks")
    means = {name: statistics.geometric_mean(row[name] for row in whole) for name in ratios}
    return [*rows, {name: "all" if name == "scene" else means.get(name, "") for name in rows[0]}]


def small_program(build, name):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out.json"
        subprocess.run([build / "tests/benchmarks" / name, "--json", out], check=True, stdout=sys.stderr)
        return json.loads(out.read_text())


def table1(build):
    names = {"brute": "brute force", "sap": "sweep & prune", "quadtree": "quadtree", "hash": "uniform grid"}
    for record in small_program(build, "bench_table1"):
        yield {"block": record["block"], "objects": record["n"], "other": names[record["other"]],
               "gain measured (%)": f"{record['gain_percent']:.1f}", "gain in the paper (%)": record["paper_gain_percent"]}


def haptic_loop(build):
    for record in small_program(build, "bench_servo"):
        if record["table"] == "servo" and not record["decoupled"]:
            yield {"space": record["space"], "collide and force": record["collide_and_force_mean_us"],
                   "median": record["collide_and_force_p50_us"], "p99.9": record["collide_and_force_p999_us"],
                   "tick's computing": record["servo_mean_us"], "ticks in time": f"{100 * record['share_in_time']:.1f} %",
                   "real-time factor": record["real_time_factor"]}


def counted(build, *options):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out.json"
        subprocess.run([sys.executable, TOP / "tests/benchmarks/worlds_table.py", "--build", build, "--json", out, *options],
                       check=True, stdout=sys.stderr)
        return json.loads(out.read_text())


def by_shape(build):
    rows = {}
    worlds = "floor:500,ragdolls,chain,heap:500,drones:300,room,hills,city,moon"
    for record in counted(build, "--contacts", "--worlds", worlds, "--spaces", ",".join(["predictive-box", "predictive-shape", *ODE])):
        rows.setdefault((record["scene"], record["n"]), {})[record["space"]] = record
    for (scene, n), spaces in rows.items():
        box, shape = spaces["predictive-box"], spaces["predictive-shape"]
        yield {"scene": scene, "n": n, "best ODE": best_of_ode(spaces, lambda one: one["sum"]) / 1000, "by box": box["sum"] / 1000,
               "by shape": shape["sum"] / 1000, "calls by box": box["pairs"] / box["ticks"], "calls by shape": shape["pairs"] / shape["ticks"]}


FIGURES = {
    "worlds_instructions.json": lambda build: counted(build, "--group", "worlds"),
    "scenes_instructions.json": lambda build: counted(build, "--group", "scenes"),
    "worlds_by_shape.csv": by_shape,
    "stepped.json": stepped,
    "contact.json": contact,
    "worlds_times.csv": worlds_times,
    "limits.json": limits,
    "table1.csv": table1,
    "haptic_loop.csv": haptic_loop,
}


def write(path, records, commit):
    if path.suffix == ".json":
        path.write_text("[\n" + ",\n".join(json.dumps(record | {"version": commit}) for record in records) + "\n]\n")
        return
    with path.open("w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow([*records[0], "version"])
        for record in records:
            table.writerow([rounded(cell) if isinstance(cell, float) else cell for cell in record.values()] + [commit])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=TOP / "build/release", help="the folder of the build")
    parser.add_argument("--output", type=pathlib.Path, default=RESULTS, help="where to write the files")
    parser.add_argument("files", nargs="*", metavar="FILE", help="the files to measure (default: all): " + ", ".join(FIGURES))
    arguments = parser.parse_args()
    unknown = [name for name in arguments.files if name not in FIGURES]
    if unknown:
        parser.error(f"there is no file {unknown[0]}; there are {', '.join(FIGURES)}")
    for name in arguments.files or FIGURES:
        print(f"measuring {name}", file=sys.stderr, flush=True)
        write(arguments.output / name, list(FIGURES[name](arguments.build.resolve())), version())


if __name__ == "__main__":
    main()
