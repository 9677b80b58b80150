#!/usr/bin/env python3
"""Instructions per tick in the worlds of demos/worlds: recorded by record_worlds, counted by ode-predictive replay.

The counts are for dSpaceCollide(), or the world's calls in its place, and for the notices of moves. Two runs of the same
program give the same counts, also on a busy machine.

    worlds_table.py --build build/release --json before.json              # count; then change the library and build it
    worlds_table.py --build build/release --against before.json           # count again, and the change in percent
    worlds_table.py --table docs/results/worlds_instructions.json         # as docs/log/results.md has them
"""

import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

SPACES = {"predictive-box": "box", "predictive-sphere": "sphere", "predictive-shape": "shape", "simple": "simple", "hash": "hash",
          "quadtree": "quadtree", "sap": "sap"}
ODE = ["simple", "hash", "quadtree", "sap"]
TOP = pathlib.Path(__file__).resolve().parents[2]


def version():
    """The commit of the library, with "-dirty" if files are changed."""
    done = subprocess.run(["git", "-C", TOP, "describe", "--always", "--dirty"], capture_output=True, text=True, check=False)
    return done.stdout.strip() or "unknown"


def output_of(*command):
    return subprocess.run(list(map(str, command)), capture_output=True, text=True, check=True).stdout


def spaces_for(row, chosen):
    """In a simulated processor a tick of the slow spaces takes seconds: with 1,000 objects simple and hash are far from the best,
    except for rays. Nested spaces have no bounds in quadtree and sap, which report all of them, and a program would query each;
    the recording has only the queries to a predictive space."""
    if chosen:
        return chosen
    if row["n"] >= 50000:
        return ["predictive-box"]
    if "nested" in row["scene"]:
        return ["predictive-box", "simple", "hash"]
    few = row["n"] < 1000 or row["scene"].startswith("lidar")
    return ["predictive-box"] + (ODE if few else ["quadtree", "sap"])


def window_of(row, first_events):
    """(first event, event after the last, distance between events) of the counted ticks."""
    ticks = [row["first"] + i * row["every"] for i in range(row["ticks"])]
    if row["every"] == 1:
        return first_events[ticks[0]], first_events[ticks[-1] + 1], 1
    assert all(first_events[tick] == tick for tick in ticks), "ticks with several events are counted one after the other"
    return ticks[0], ticks[-1] + 1, row["every"]


def count(build, row, chosen, contacts):
    """A record for each space; raises if a predictive one reports other pairs than a simple space."""
    with tempfile.TemporaryDirectory() as folder:
        recording, result = pathlib.Path(folder) / "world.odehist", pathlib.Path(folder) / "result.json"
        printed = output_of(build / "tests/benchmarks/record_worlds", row["scene"], row["n"], "--ticks", row["to_make"],
                            "--output", recording)
        first, end, every = window_of(row, json.loads(printed)["first_events"])
        spaces = spaces_for(row, chosen)
        kinds = [word for space in spaces for word in ("--space", SPACES[space])]
        if row["n"] >= 5000:  # a simple space would take minutes
            kinds += ["--reference", "box"]
        if contacts:
            kinds.append("--contacts")
        if row["scene"] == "many":  # its worlds are created and destroyed all the time
            kinds.append("--whole-life")
        done = subprocess.run(
            list(map(str, [build / "ode_predictive_space/preload/ode-predictive", "replay", *kinds, "--from", first, "--to", end,
                           "--every", every, "--json", result, recording])), capture_output=True, text=True, check=False)
        if done.returncode == 2 or not result.exists():
            raise RuntimeError(done.stderr)
        counted = json.loads(result.read_text())
    if not counted["counted_events"]:
        raise RuntimeError("valgrind is missing; install Debian's package valgrind")
    records = []
    for space, figures in zip(spaces, counted["spaces"]):
        if figures["instructions_per_event"] is None:
            print(f"{row['scene']} {row['n']}: instructions in {space} could not be counted; the row is left out", file=sys.stderr)
            continue
        if not figures["agrees"]:
            message = f"{row['scene']} {row['n']}: {space} reported other pairs\n{done.stdout}"
            if space not in ODE:
                raise RuntimeError(message)
            print(message, file=sys.stderr)  # hash omits pairs, sap rounds
        records.append({"scene": row["scene"], "n": row["n"], "space": space, "warm_up_ticks": row["first"],
                        "ticks": row["ticks"], "every": row["every"], "pairs": figures["pairs"],
                        "sum": figures["instructions_per_event"] * counted["counted_events"] / row["ticks"]})
    return records


def by_row(records):
    rows = {}
    for record in records:
        rows.setdefault((record["scene"], record["n"]), {})[record["space"]] = record["sum"]
    return rows


def thousands(value):
    if value is None:
        return "–"
    return f"{value / 1000:,.0f}" if value >= 99950 else f"{value / 1000:.1f}"


def print_table(records):
    ratios = []
    print("| scene | n | ours | simple | hash | quadtree | sap | best ODE / ours |")
    print("|---|---:|---:|---:|---:|---:|---:|---:|")
    for (scene, n), spaces in by_row(records).items():
        ours = spaces.get("predictive-box")
        best = min((spaces[space] for space in ODE if space in spaces), default=None)
        ratio = best / ours if best and ours else None
        ratios += [ratio] if ratio else []
        counts = " | ".join(thousands(spaces.get(space)) for space in ["predictive-box", *ODE])
        print(f"| {scene} | {n:,} | {counts} | {f'{ratio:.2f}' if ratio else '–'} |")
    if ratios:
        print(f"\nGeometric mean of the last column: {math.prod(ratios) ** (1 / len(ratios)):.2f}")


def print_changes(before, now):
    earlier, changes = by_row(before), []
    print(f"{'world':24} {'n':>7} {'space':18} {'before':>12} {'now':>12}  now / before")
    for (scene, n), spaces in by_row(now).items():
        for space, value in spaces.items():
            old = earlier.get((scene, n), {}).get(space)
            if old:
                changes.append(value / old)
                print(f"{scene:24} {n:7,} {space:18} {thousands(old):>12} {thousands(value):>12}  {value / old:.4f}")
    if changes:
        print(f"Geometric mean of {len(changes)}: {math.prod(changes) ** (1 / len(changes)):.4f}")


def is_chosen(row, group, worlds):
    if worlds:
        return row["scene"] in worlds or f"{row['scene']}:{row['n']}" in worlds
    return group in (None, row["group"])


def count_all(arguments):
    records, commit = [], version()
    for row in json.loads(output_of(arguments.build / "tests/benchmarks/record_worlds", "--list")):
        if is_chosen(row, arguments.group, arguments.worlds):
            print(f"counting {row['scene']} {row['n']:,}", file=sys.stderr, flush=True)
            records += [record | {"version": commit} for record in count(arguments.build, row, arguments.spaces, arguments.contacts)]
            if arguments.json:
                arguments.json.write_text("[\n" + ",\n".join(map(json.dumps, records)) + "\n]\n")
    return records


def main():
    words = lambda text: text.split(",")
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, default=TOP / "build/release", help="the folder of the build")
    parser.add_argument("--group", choices=["worlds", "scenes"], help="count only in this group of worlds")
    parser.add_argument("--worlds", type=words, help="count only in these worlds, such as floor,heap:500")
    parser.add_argument("--spaces", type=words, help="count only in these spaces: " + ", ".join(SPACES))
    parser.add_argument("--contacts", action="store_true", help="count a dCollide() for each pair, too")
    parser.add_argument("--json", type=pathlib.Path, metavar="FILE", help="write the counts to FILE")
    parser.add_argument("--against", type=pathlib.Path, metavar="FILE", help="compare with the counts in FILE")
    parser.add_argument("--table", type=pathlib.Path, metavar="FILE", help="print the table of the counts in FILE, and count nothing")
    arguments = parser.parse_args()
    if arguments.table:
        print_table(json.loads(arguments.table.read_text()))
        return
    before = json.loads(arguments.against.read_text()) if arguments.against else None
    try:
        records = count_all(arguments)
    except (OSError, RuntimeError, subprocess.CalledProcessError) as error:
        sys.exit(f"worlds_table: {error}")
    print_changes(before, records) if before else print_table(records)


if __name__ == "__main__":
    main()
