#!/usr/bin/env python3
"""Prints tables in Markdown, as docs/log/results.md has them, from files of docs/results.

    tables.py stepped.json | contact.json
"""

import json
import sys

ODE = ["simple", "hash", "quadtree", "sap"]


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


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        records = json.load(file)
    print_rows((contact if records[0].get("table") == "contact" else stepped)(records))


if __name__ == "__main__":
    main()
