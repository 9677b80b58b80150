#!/usr/bin/env python3
"""Draws the pictures of README.md and docs/performance.md from what the benchmarks wrote.

    plots.py [--output FOLDER] FILE...

speed.svg   five worlds, the predictive space beside the best of ODE's (docs/results/worlds_times.csv)
cost.svg    cost per tick against the number of objects, all contenders (predictive_bench --benchmark_out=FILE, of collide/gas, collide/game)
table1.svg  the gains of the paper's Table 1, the paper's and those measured here (bench_table1 --json FILE)

A picture is drawn when the files have what it shows. The same files give the same pictures, byte by byte.
"""

import argparse
import csv
import json
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FuncFormatter, NullFormatter

# The colours of Okabe and Ito, which people who are colour-blind can tell apart; markers and dashes differ as well.
BLACK, ORANGE, SKY, GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
YELLOW, BLUE, RED, PINK, GREY = "#B8A800", "#0072B2", "#D55E00", "#CC79A7", "#777777"

# name in the files: (name in the picture, colour, marker, line)
CONTENDERS = {
    "predictive-box": ("predictive", BLUE, "o", "-"),
    "predictive-sphere": ("predictive, spheres", SKY, "o", "--"),
    "simple": ("simple", GREY, "x", "-"),
    "hash": ("hash", PINK, "s", "-"),
    "quadtree": ("quadtree", ORANGE, "^", "-"),
    "sap": ("sweep and prune", RED, "v", "-"),
    "bullet-dbvt": ("Bullet, btDbvt", GREEN, "D", "--"),
    "bullet-sap": ("Bullet, btAxisSweep3", YELLOW, "P", "--"),
    "sweep": ("plain SIMD sweep", BLACK, "+", ":"),
    "floor": ("floor", BLACK, "", "-."),
}

LOWEST_GAIN = -50  # percent; a picture that went on to -200 would show nothing of the rest

PAPER_COLUMNS = {"brute": "brute force", "sap": "sweep and prune", "quadtree": "quadtree", "hash": "uniform grid"}

STYLE = {
    "svg.hashsalt": "ode_predictive_space",
    "svg.fonttype": "path",
    "font.family": "DejaVu Sans",
    "font.size": 11,
    "axes.titlesize": 12,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "legend.frameon": False,
    "lines.linewidth": 1.8,
    "lines.markersize": 6,
}


def records_of(benchmarks):
    """Of Google Benchmark's results, the times of dSpaceCollide(): of repetitions, the median."""
    for one in benchmarks:
        kind, scene, objects, space = (one["name"].split("/") + [""] * 4)[:4]
        if kind == "collide" and one.get("aggregate_name", "median") == "median":
            yield {"scene": scene, "n": int(objects), "space": space, "mean_us": one["real_time"], "ticks": one["iterations"]}


def read_records(files):
    """All records of these files in one list."""
    records = []
    for name in files:
        with open(name, encoding="utf-8", newline="") as file:
            if str(name).endswith(".csv"):
                records += csv.DictReader(file)
                continue
            content = json.load(file)
        records += records_of(content["benchmarks"]) if isinstance(content, dict) else content
    return records


# Panels are placed by numbers: matplotlib's own layout engines now and then end in another last digit.
def save(figure, folder, name):
    path = folder / name
    figure.savefig(path, bbox_inches="tight", metadata={"Date": None, "Creator": None})
    plt.close(figure)
    print(path)


def legend_of_all(figure, order, **options):
    """One legend for all panels, each label once, in this order."""
    handles = {}
    for axes in figure.axes:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    labels = sorted(handles, key=order.index)
    figure.legend([handles[label] for label in labels], labels, **options)


def plain_number(value, _=None):
    """1,000 and 0.1, not 10^3."""
    return f"{value:,.0f}" if value >= 1 else f"{value:g}"


def label_in_full(axis):
    axis.set_major_formatter(FuncFormatter(plain_number))
    axis.set_minor_formatter(NullFormatter())


# Worlds of docs/results/worlds_times.csv, from top to bottom.
SPEED_WORLDS = {
    ("shelves", "10000"): "10,000 boxes on shelves, 50 robots",
    ("heap", "500"): "500 bodies that fall into a pit",
    ("floor", "500"): "500 bodies that roll on a floor",
    ("city", "100"): "100 vehicles among trees on a heightfield",
    ("drones", "1000"): "1,000 drones in a room that is one mesh",
}


def microseconds(value):
    """Three digits, as the tables of the pages."""
    return f"{value:,.0f} µs" if value >= 100 else f"{value:.1f} µs" if value >= 10 else f"{value:.2f} µs"


def draw_bars(axes, places, shares, texts, **options):
    axes.barh(places, shares, 0.38, **options)
    for place, share, text in zip(places, shares, texts):
        axes.annotate(text, (share, place), xytext=(5, 0), textcoords="offset points", va="center")


def draw_speed(records, folder):
    """Bars as parts of the time of the best ODE space, so that worlds of any size fit beside one another."""
    rows = {(record["scene"], record["n"]): record for record in records if "best ODE" in record}
    if not all(world in rows for world in SPEED_WORLDS):
        return
    best = [float(rows[world]["best ODE"]) for world in SPEED_WORLDS]
    ours = [float(rows[world]["predictive"]) for world in SPEED_WORLDS]
    places = range(len(SPEED_WORLDS))
    figure, axes = plt.subplots(figsize=(7.2, 3.4))
    figure.subplots_adjust(left=0, right=1, bottom=0, top=1)
    texts = list(map(microseconds, best))
    draw_bars(axes, [place - 0.2 for place in places], [100] * len(best), texts, color="#bbbbbb", label="the best of ODE's spaces")
    shares = [100 * mine / theirs for mine, theirs in zip(ours, best)]
    ratios = [float(rows[world]["ratio"]) for world in SPEED_WORLDS]  # medians of several runs, as the times are
    texts = [f"{microseconds(mine)}: {ratio:.1f} times as fast" for mine, ratio in zip(ours, ratios)]
    draw_bars(axes, [place + 0.2 for place in places], shares, texts, color=BLUE, label="predictive")
    axes.set_yticks(list(places), list(SPEED_WORLDS.values()))
    axes.invert_yaxis()
    axes.set(xlim=(0, 112), xlabel="mean time in dSpaceCollide() per tick (% of the best ODE space)")
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=2)
    save(figure, folder, "speed.svg")


def cost_curves(records, scene):
    """{contender: {objects: mean microseconds}}; of several measurements of the same the longest counts."""
    best = {}
    for record in records:
        if record.get("scene") == scene and record.get("mean_us", 0) > 0 and "ticks" in record:
            key = (record["space"], record["n"])
            if key not in best or record["ticks"] > best[key]["ticks"]:
                best[key] = record
    curves = {}
    for (space, objects), record in best.items():
        curves.setdefault(space, {})[objects] = record["mean_us"]
    return {space: dict(sorted(points.items())) for space, points in curves.items() if len(points) > 1}


def draw_curves(axes, curves):
    for space, (label, colour, marker, line) in CONTENDERS.items():
        if space not in curves:
            continue
        points = curves[space]
        ours = space.startswith("predictive")
        axes.plot(
            list(points.keys()),
            list(points.values()),
            color=colour,
            marker=marker,
            linestyle=line,
            linewidth=2.8 if space == "predictive-box" else None,
            zorder=3 if ours else 2,
            label=label,
        )


def draw_cost(records, folder):
    panels = [
        ("gas, half of the objects moving", cost_curves(records, "gas")),
        ("game, all moving fast", cost_curves(records, "game")),
    ]
    panels = [(title, curves) for title, curves in panels if curves]
    if not panels:
        return
    widths = [max(1, len(set().union(*curves.values())) - 0.5) for _, curves in panels]
    figure, all_axes = plt.subplots(
        1, len(panels), figsize=(13, 5.6), sharey=True, squeeze=False, width_ratios=widths
    )
    figure.subplots_adjust(left=0, right=1, bottom=0, top=1, wspace=0.14)
    for axes, (title, curves) in zip(all_axes[0], panels):
        axes.set(xscale="log", yscale="log", title=title, xlabel="objects")
        draw_curves(axes, curves)
        axes.set_xticks(sorted(set().union(*curves.values())))
        label_in_full(axes.xaxis)
        label_in_full(axes.yaxis)
    all_axes[0][0].set_ylabel("mean time in dSpaceCollide() per tick (µs)")
    order = [contender[0] for contender in CONTENDERS.values()]
    legend_of_all(figure, order, loc="center left", bbox_to_anchor=(1.01, 0.5), labelspacing=0.9)
    save(figure, folder, "cost.svg")


def gains(records, block, other):
    """{objects: (gain here, gain in the paper)}, in percent."""
    return {
        record["n"]: (record["gain_percent"], record["paper_gain_percent"])
        for record in records
        if record.get("table") == "table1" and record["block"] == block and record["other"] == other
    }


def draw_markers(axes, places, values, marker, colour, label):
    """One marker per gain; what is below the picture is written at its lower edge, beside the marker."""
    side = -1 if marker == "D" else 1
    axes.plot(
        places,
        [max(value, LOWEST_GAIN) for value in values],
        linestyle="",
        marker=marker,
        color=colour,
        markeredgecolor="white",
        markersize=8,
        clip_on=False,
        zorder=3,
        label=label,
    )
    for place, value in zip(places, values):
        if value < LOWEST_GAIN:
            axes.annotate(
                f"{value:.0f}",
                (place, LOWEST_GAIN),
                xytext=(6 * side, 3),
                textcoords="offset points",
                ha="right" if side < 0 else "left",
                fontsize=9,
                color=colour,
            )


def draw_gains(axes, records, other):
    broad = gains(records, "broad phase", other)
    places = range(len(broad))
    width = 0.4
    left = [place - width / 2 for place in places]
    right = [place + width / 2 for place in places]
    axes.bar(left, [gain[1] for gain in broad.values()], width, color="#cccccc", edgecolor="white", label="paper")
    axes.bar(
        right, [gain[0] for gain in broad.values()], width, color=BLUE, edgecolor="white", label="here, broad phase"
    )
    for block, marker, colour, label in (
        ("broad and narrow phase", "D", ORANGE, "here, with narrow phase"),
        ("whole tick", "o", BLACK, "here, whole tick with the step of the world"),
    ):
        series = gains(records, block, other)
        known = [(place, series[objects][0]) for place, objects in zip(right, broad) if objects in series]
        draw_markers(axes, [place for place, _ in known], [gain for _, gain in known], marker, colour, label)
    axes.set_title(f"against {PAPER_COLUMNS[other]}")
    axes.set_xticks(list(places), [str(objects) for objects in broad])
    axes.set_xlabel("objects")
    axes.axhline(0, color=BLACK, linewidth=0.8)
    axes.grid(axis="x", visible=False)


def draw_table1(records, folder):
    others = [other for other in PAPER_COLUMNS if gains(records, "broad phase", other)]
    if not others:
        return
    figure, all_axes = plt.subplots(1, len(others), figsize=(12, 4.4), sharey=True, squeeze=False)
    figure.subplots_adjust(left=0, right=1, bottom=0, top=1, wspace=0.06)
    for column, other in enumerate(others):
        draw_gains(all_axes[0][column], records, other)
    all_axes[0][0].set_ylabel("gain (T other − T ours) / T other (%)")
    lowest = min((record["gain_percent"] for record in records if record.get("table") == "table1"), default=0)
    all_axes[0][0].set_ylim(max(LOWEST_GAIN, min(0, lowest - 5)), 102)
    order = ["paper", "here, broad phase", "here, with narrow phase", "here, whole tick with the step of the world"]
    legend_of_all(figure, order, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=4)
    save(figure, folder, "table1.svg")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", metavar="FILE", help="JSON written by predictive_bench or bench_table1, or worlds_times.csv")
    parser.add_argument(
        "--output",
        type=pathlib.Path,
        default=pathlib.Path(__file__).resolve().parent,
        metavar="FOLDER",
        help="where to write the pictures (default: beside this script)",
    )
    arguments = parser.parse_args()
    try:
        records = read_records(arguments.files)
    except (OSError, ValueError) as error:
        sys.exit(f"plots: {error}")
    arguments.output.mkdir(parents=True, exist_ok=True)
    with plt.rc_context(STYLE):
        for draw in (draw_speed, draw_cost, draw_table1):
            draw(records, arguments.output)


if __name__ == "__main__":
    main()
