#!/usr/bin/env python3
"""Draws the pictures of README.md and docs/performance.md from docs/results. The same data give the same pictures, byte by byte.

speed.svg   five worlds, the predictive space beside the best of ODE's (worlds_times.csv)
table1.svg  the gains of the paper's Table 1, the paper's and those measured here (table1.csv)
"""

import argparse
import csv
import pathlib

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

# Colours of Okabe and Ito, which people who are colour-blind can tell apart; markers differ as well.
BLACK, ORANGE, BLUE = "#000000", "#E69F00", "#0072B2"

LOWEST_GAIN = -50  # percent; a picture that went on to -200 would show nothing of the rest

PAPER_COLUMNS = ["brute force", "sweep & prune", "quadtree", "uniform grid"]

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
}


RESULTS = pathlib.Path(__file__).resolve().parents[1] / "results"


def read_results(name):
    with open(RESULTS / name, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


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


def draw_speed(folder):
    """Bars as parts of the time of the best ODE space, so that worlds of any size fit beside one another."""
    rows = {(row["scene"], row["n"]): row for row in read_results("worlds_times.csv")}
    best = [float(rows[world]["best ODE"]) for world in SPEED_WORLDS]
    ours = [float(rows[world]["predictive"]) for world in SPEED_WORLDS]
    places = range(len(SPEED_WORLDS))
    figure, axes = plt.subplots(figsize=(7.2, 3.4))
    figure.subplots_adjust(left=0, right=1, bottom=0, top=1)
    texts = list(map(microseconds, best))
    draw_bars(axes, [place - 0.2 for place in places], [100] * len(best), texts, color="#bbbbbb", label="the best of ODE's spaces")
    shares = [100 * mine / theirs for mine, theirs in zip(ours, best)]
    ratios = [float(rows[world]["ratio"]) for world in SPEED_WORLDS]
    texts = [f"{microseconds(mine)}: {ratio:.1f} times as fast" for mine, ratio in zip(ours, ratios)]
    draw_bars(axes, [place + 0.2 for place in places], shares, texts, color=BLUE, label="predictive")
    axes.set_yticks(list(places), list(SPEED_WORLDS.values()))
    axes.invert_yaxis()
    axes.set(xlim=(0, 112), xlabel="time of dSpaceCollide() per tick (% of the best ODE space)")
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1), ncols=2)
    save(figure, folder, "speed.svg")


def gains(rows, block, other):
    """{objects: (gain here, gain in the paper)}, in percent."""
    return {
        row["objects"]: (float(row["gain measured (%)"]), float(row["gain in the paper (%)"]))
        for row in rows
        if row["block"] == block and row["other"] == other
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


def draw_gains(axes, rows, other):
    broad = gains(rows, "broad phase", other)
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
        series = gains(rows, block, other)
        known = [(place, series[objects][0]) for place, objects in zip(right, broad) if objects in series]
        draw_markers(axes, [place for place, _ in known], [gain for _, gain in known], marker, colour, label)
    axes.set_title(f"against {other}")
    axes.set_xticks(list(places), list(broad))
    axes.set_xlabel("objects")
    axes.axhline(0, color=BLACK, linewidth=0.8)
    axes.grid(axis="x", visible=False)


def draw_table1(folder):
    rows = read_results("table1.csv")
    figure, all_axes = plt.subplots(1, len(PAPER_COLUMNS), figsize=(12, 4.4), sharey=True)
    figure.subplots_adjust(left=0, right=1, bottom=0, top=1, wspace=0.06)
    for axes, other in zip(all_axes, PAPER_COLUMNS):
        draw_gains(axes, rows, other)
    all_axes[0].set_ylabel("gain (T other − T ours) / T other (%)")
    lowest = min(float(row["gain measured (%)"]) for row in rows)
    all_axes[0].set_ylim(max(LOWEST_GAIN, min(0, lowest - 5)), 102)
    order = ["paper", "here, broad phase", "here, with narrow phase", "here, whole tick with the step of the world"]
    legend_of_all(figure, order, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=4)
    save(figure, folder, "table1.svg")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parent, metavar="FOLDER",
                        help="where to write the pictures (default: beside this script)")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    with plt.rc_context(STYLE):
        for draw in (draw_speed, draw_table1):
            draw(arguments.output)


if __name__ == "__main__":
    main()
