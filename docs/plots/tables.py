#!/usr/bin/env python3
"""Prints tables in Markdown, as docs/performance.md has them, from what `predictive_bench` wrote with `--json FILE`.

    tables.py FILE             of `all`, `stepped`, `contact` or `instructions --whole`
    tables.py FILE BEFORE      of `instructions`, beside the counts of another version
"""

import json
import sys

SPACES = ["predictive-box", "predictive-sphere", "simple", "hash", "quadtree", "sap", "bullet-dbvt", "bullet-sap", "sweep",
          "floor-boxes", "floor"]
ODE = ["simple", "hash", "quadtree", "sap"]
PAPER = {"brute": "brute force", "sap": "sweep & prune", "quadtree": "quadtree", "hash": "uniform grid"}


def number(value):
    """Three digits that mean something."""
    if value is None:
        return "–"
    if value >= 100:
        return f"{value:,.0f}"
    return f"{value:.1f}" if value >= 10 else f"{value:.2f}"


def row(cells):
    return "| " + " | ".join(cells) + " |"


def print_table(head, rows):
    print(row(head))
    print(row(["---"] * len(head)))
    for cells in rows:
        print(row(cells))
    print()


def text(value):
    """A cell: a name, a figure, a figure with the space that it is of, or two figures and their sum."""
    if isinstance(value, str):
        return value
    if not isinstance(value, tuple):
        return number(value)
    if isinstance(value[1], str):
        return f"{number(value[0])} ({value[1]})"
    return "{} + {} = {}".format(*map(number, value))


def print_rows(rows):
    """Rows as the functions without `print` in their names return them: {column: value}, all with the same columns."""
    if rows:
        print_table(list(rows[0]), [list(map(text, cells.values())) for cells in rows])


def print_requirements(records):
    rows = []
    for record in records:
        if "limit" not in record:
            continue
        unit = " " + record["unit"]
        rows.append([record["line"], record["what"], number(record["value"]) + unit,
                     record["bound"].replace("<=", "≤").replace(">=", "≥") + " " + number(record["limit"]) + unit,
                     "met" if record["met"] else "**not met**"])
    print_table(["line", "what", "measured", "asked", ""], rows)


def scenes_of(records):
    """Timings by scene, number of objects and share of moving ones; of several runs the first, which compares all spaces."""
    scenes = {}
    for record in records:
        if not all(key in record for key in ("scene", "space", "mean_us", "best_ode_ratio", "measured_ticks")):
            continue
        key = (record["scene"], record["n"], record.get("moving"))
        scenes.setdefault(key, {}).setdefault(record["space"], record)
    return scenes


def print_means(scenes):
    rows = []
    for (scene, n, moving), spaces in sorted(scenes.items(), key=lambda item: (item[0][0], item[0][1], item[0][2] or 0)):
        name = scene + (f", {moving:.0%} moving" if moving is not None else "")
        rows.append([name, f"{n:,}"] + [number(spaces[space]["mean_us"]) if space in spaces else "–" for space in SPACES])
    print_table(["scene", "n"] + SPACES, rows)


def print_distributions(scenes):
    rows = []
    for (scene, n, moving), spaces in sorted(scenes.items(), key=lambda item: (item[0][0], item[0][1], item[0][2] or 0)):
        ours = spaces.get("predictive-box")
        if ours is None:
            continue
        name = scene + (f", {moving:.0%} moving" if moving is not None else "")
        rows.append([name, f"{n:,}"] +
                    [number(ours[key]) for key in ("mean_us", "median_us", "p99_us", "p999_us", "max_us")] +
                    [f"{ours['pairs']:,}", ours["pair_hash"], number(ours["bytes_per_geom"])])
    print_table(["scene", "n", "mean", "median", "p99", "p99.9", "max", "pairs", "pair hash", "bytes per geom"], rows)


def print_table1(records):
    blocks = {}
    for record in records:
        if record.get("table") == "table1":
            blocks.setdefault(record["block"], {}).setdefault(record["n"], {})[record["other"]] = record
    for block, lines in blocks.items():
        print(f"**{block}**\n")
        rows = []
        for n, others in sorted(lines.items()):
            rows.append([str(n)] + [f"{others[o]['gain_percent']:.1f} / {others[o]['paper_gain_percent']:.1f}" for o in PAPER])
        print_table(["objects"] + list(PAPER.values()), rows)


def stepped(records):
    scenes = {}
    for record in records:
        scenes.setdefault((record["scene"], record["n"], record["begin_s"], record["end_s"]), {})[record["space"]] = record
    rows = []
    for (scene, n, begin, end), spaces in scenes.items():
        ours = spaces["predictive-box"]
        best_name = min((name for name in ODE if name in spaces), key=lambda name: spaces[name]["mean_us"])
        tails = [spaces[name]["p99_us"] for name in ODE if name in spaces]
        rows.append({
            "scene": scene + (f", {begin} to {end} s" if end is not None else ""),
            "objects": f"{n:,}",
            "best ODE space, mean": (spaces[best_name]["mean_us"], best_name),
            "predictive, mean": ours["mean_us"],
            "ratio": ours["best_ode_ratio"],
            "median": ours["median_us"],
            "p99": ours["p99_us"],
            "p99.9": ours["p999_us"],
            "ratio of p99": min(tails) / ours["p99_us"],
            "ratio of whole ticks": ours["best_ode_ratio_of_wholes"],
        })
    return rows


def contact(records):
    scenes = {}
    for record in records:
        if record.get("table") == "contact":
            scenes.setdefault((record["scene"], record["n"]), {})[record["space"]] = record
    rows = []
    for (scene, n), spaces in scenes.items():
        boxes, shapes = spaces["predictive-box"], spaces["predictive-shape"]
        best = min((name for name in ODE if name in spaces), key=lambda name: spaces[name]["sum_us"])
        by_box, by_shape = ((one["collide_us"], one["dcollide_us"], one["sum_us"]) for one in (boxes, shapes))
        rows.append({
            "scene": scene,
            "objects": f"{n:,}",
            "best ODE space": (spaces[best]["sum_us"], best),
            "by box": by_box,
            "by shape": by_shape,
            "best ODE / by box": spaces[best]["sum_us"] / boxes["sum_us"],
            "best ODE / by shape": shapes["best_ode_ratio"],
            "by box / by shape": shapes["box_ratio"],
            "best ODE / by shape, whole tick": shapes["best_ode_ratio_of_wholes"],
            "calls by box": boxes["calls_per_tick"],
            "calls by shape": shapes["calls_per_tick"],
            "touching": shapes["touching_per_tick"],
            "calls per touching": shapes["calls_per_touching"],
        })
    return rows


def print_whole_ticks(records):
    if not any(record.get("count") == "whole ticks" for record in records):
        return
    scenes = {}
    for record in records:
        if record.get("count") == "whole ticks":
            scenes.setdefault((record["scene"], record["n"], record["ticks"]), {})[record["space"]] = record
    rows = []
    for (scene, n, ticks), spaces in scenes.items():
        boxes, shapes = spaces["predictive-box"], spaces["predictive-shape"]
        rows.append([scene, f"{n:,}", f"{ticks:,}"] +
                    [f"{one[part]:,.0f}" for part in ("both", "whole") for one in (boxes, shapes)] +
                    [f"{shapes[part] / boxes[part]:.3f}" for part in ("both", "whole")])
    print_table(["scene", "objects", "ticks", "collide + dCollide by box", "by shape", "whole tick by box", "by shape",
                 "shape / box, collide + dCollide", "shape / box, whole tick"], rows)


def instructions(records, before):
    key = lambda record: (record["scene"], record["n"], record["space"])
    earlier = {key(record): record for record in before}
    rows = []
    for record in records:
        if record["space"] == "predictive-box" and key(record) in earlier:
            old = earlier[key(record)]
            cells = {"scene": record["scene"], "objects": f"{record['n']:,}"}
            for part in ("collide", "notices", "sum"):
                cells |= {f"{part} before": old[part], f"{part} now": record[part]}
            rows.append(cells | {"now / before": f"{record['sum'] / old['sum']:.3f}"})
    return rows


def read(name):
    with open(name, encoding="utf-8") as file:
        return json.load(file)


def main():
    records = read(sys.argv[1])
    if len(sys.argv) > 2:
        print_rows(instructions(records, read(sys.argv[2])))
        return
    if records[0].get("table") == "stepped":
        print_rows(stepped(records))
        return
    if records[0].get("table") == "contact":
        print_requirements(records)
        print_rows(contact(records))
        print_whole_ticks(records)
        print_table1(records)
        return
    if records[0].get("count") == "whole ticks":
        print_requirements(records)
        print_whole_ticks(records)
        return
    print("<!-- requirements -->\n")
    print_requirements(records)
    print("<!-- table 1 -->\n")
    print_table1(records)
    print("<!-- means -->\n")
    scenes = scenes_of(records)
    print_means(scenes)
    print("<!-- distributions -->\n")
    print_distributions(scenes)


if __name__ == "__main__":
    main()
