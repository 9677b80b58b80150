#!/usr/bin/env python3
"""Draws the diagrams of the pages: no data, only what the text says.

    draw.py [--output FOLDER]

path.svg       a predicted path, its deviation and envelope, the place, and the true path (docs/how_it_works.md)
proximity.svg  two envelopes and their time of proximity (docs/how_it_works.md)
chord.svg      an encounter that the paper's error of a chord misses (docs/how_it_works.md)
gap.svg        the gap between two shapes along an axis (docs/how_it_works.md)
tick.svg       the stages of a tick (docs/the_tick.md)
servo.svg      the two threads of the servo (docs/haptics/method.md)
rooms.svg      the rooms of the haptics library (docs/haptics/method.md)
includes.svg   the rooms of the project and what they include: the table of CONTRIBUTING.md

The same matplotlib makes the same pictures, byte by byte.
"""

import argparse
import pathlib
import sys

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Circle, FancyBboxPatch, Polygon, Rectangle

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(TOP / "tests" / "docs"))
import check_rooms

# The colours of docs/plots: predictive is blue, what really happens is orange.
BLACK, ORANGE, BLUE, RED, GREY = "#000000", "#E69F00", "#0072B2", "#D55E00", "#777777"
PALE_BLUE, PALE_ORANGE, PALE_GREY = "#DCEBF5", "#FBEFD5", "#F0F0F0"

STYLE = {
    "svg.hashsalt": "ode_predictive_space",
    "svg.fonttype": "path",
    "font.family": "DejaVu Sans",
    "font.size": 11,
    "mathtext.fontset": "dejavusans",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
}
INCH = 72.0  # points


def sheet(width, height):
    """Axes without ticks whose unit is a point; (0, 0) is at the bottom left."""
    figure = plt.figure(figsize=(width / INCH, height / INCH))
    axes = figure.add_axes([0, 0, 1, 1])
    axes.set(xlim=(0, width), ylim=(0, height))
    axes.axis("off")
    return figure, axes


def save(figure, folder, name):
    path = folder / name
    figure.savefig(path, metadata={"Date": None, "Creator": None})
    plt.close(figure)
    print(path)


def arrow(axes, start, end, style="-|>", colour=BLACK, dashed=False):
    axes.annotate(
        "",
        end,
        start,
        arrowprops={
            "arrowstyle": style,
            "color": colour,
            "linewidth": 1.3,
            "linestyle": "--" if dashed else "-",
            "shrinkA": 0,
            "shrinkB": 0,
            "mutation_scale": 13,
        },
    )


def route(axes, *points, colour=BLACK, dashed=False):
    """An arrow with corners."""
    if len(points) > 2:
        line = "--" if dashed else "-"
        axes.plot(*zip(*points[:-1]), color=colour, linewidth=1.3, linestyle=line, solid_joinstyle="miter")
    arrow(axes, points[-2], points[-1], colour=colour, dashed=dashed)


def box(axes, left, bottom, width, height, title, text="", fill=PALE_BLUE, edge=BLUE):
    axes.add_patch(
        FancyBboxPatch((left, bottom), width, height, boxstyle="round,pad=0,rounding_size=5", fc=fill, ec=edge, lw=1.2)
    )
    middle = left + width / 2
    if text:
        axes.text(middle, bottom + height - 9, title, ha="center", va="top", weight="bold", fontsize=11)
        axes.text(middle, bottom + 8, text, ha="center", va="bottom", fontsize=9, linespacing=1.25)
    else:
        axes.text(middle, bottom + height / 2, title, ha="center", va="center", weight="bold", fontsize=11)


def note(axes, x, y, text, ha="left", va="center", colour=BLACK, size=9, **options):
    axes.text(x, y, text, ha=ha, va=va, color=colour, fontsize=size, linespacing=1.25, **options)


def normals(points):
    """Unit vectors to the left of a curve."""
    tangents = np.gradient(points, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1, keepdims=True)
    return np.stack([-tangents[:, 1], tangents[:, 0]], axis=1)


def tube(axes, points, radius, **options):
    sides = normals(points) * radius[:, None]
    axes.add_patch(Polygon(np.concatenate([points + sides, (points - sides)[::-1]]), **options))


def draw_path(folder):
    figure, axes = sheet(680, 330)
    m = np.linspace(0, 1, 121)
    path = np.array([75, 85]) + m[:, None] * [500, 210] + m[:, None] ** 2 * [0, -150]
    deviation = 8 + 34 * m
    radius = 26
    reach = (deviation + radius)[:, None]
    low, high = np.min(path - reach, axis=0), np.max(path + reach, axis=0)
    axes.add_patch(Rectangle(low, *(high - low), fc=PALE_GREY, ec=BLACK, lw=1.6))
    tube(axes, path, deviation + radius, fc="none", ec=BLUE, ls="--", lw=1.2)
    for end in (0, -1):
        axes.add_patch(Circle(path[end], deviation[end] + radius, fc="white", ec=BLUE, ls="--", lw=1.2))
    tube(axes, path, deviation + radius - 0.7, fc="white", ec="none")
    tube(axes, path, deviation, fc=PALE_BLUE, ec="none")
    for end in (0, -1):
        axes.add_patch(Circle(path[end], deviation[end], fc=PALE_BLUE, ec="none"))
    axes.plot(*path.T, color=BLUE, lw=2)
    true = path + normals(path) * (0.72 * deviation * np.sin(7.2 * m) * (0.4 + 0.6 * m))[:, None]
    ticks = np.arange(0, 121, 12)
    axes.plot(*true.T, color=ORANGE, lw=2)
    axes.plot(*true[ticks].T, color=ORANGE, marker="o", ms=4.5, ls="")
    now = 66
    axes.add_patch(Circle(true[now], radius, fc="none", ec=ORANGE, lw=1.6))
    edge = true[now] + radius * np.array([0.5, -0.866])
    axes.plot(*np.array([true[now], edge]).T, color=ORANGE, lw=1)
    note(axes, *(edge + [-14, 10]), "$r$", size=11, colour="#9a6a00")
    where = 98
    arrow(axes, path[where], path[where] + normals(path)[where] * deviation[where], "<|-|>")
    note(axes, *(path[where] + normals(path)[where] * deviation[where] * 0.5 + [6, 2]), "$R(t)$", size=11)
    note(axes, *(path[0] + [-1, -50]), "$t_{init}$", ha="center", size=11)
    note(axes, *(path[-1] + [0, -84]), "$t_{final}$", ha="center", size=11)
    note(axes, 30, 313, "predicted path $s(t)$ of the object's centre", colour=BLUE, size=10)
    note(axes, 30, 294, "true path, a dot per tick", colour="#9a6a00", size=10)
    note(axes, 30, 275, "shaded: deviation, at most $R(t)$ from $s(t)$", size=10)
    note(axes, 30, 256, "dashed: the paper's envelope $S'(t)$, with the object's radius $r$", size=10)
    note(axes, 30, 237, "box: the envelope here, a place at any time", size=10)
    save(figure, folder, "path.svg")


def draw_proximity(folder):
    figure = plt.figure(figsize=(680 / INCH, 320 / INCH))
    axes = figure.add_axes([0.055, 0.12, 0.93, 0.85])
    t = np.linspace(0, 100, 201)
    lower, upper = 8 + 0.32 * t - 0.0008 * t**2, 72 - 0.12 * t - 0.0009 * t**2
    reach, growth = 6.5, 0.115
    tops, bottoms = lower + reach + growth * t, upper - reach - growth * t
    near = t[np.argmax(tops >= bottoms)]
    wave = 2.6 * np.sin(t / 13) * (0.3 + t / 130)
    for centre, colour, pale in ((lower, BLUE, PALE_BLUE), (upper, GREY, PALE_GREY)):
        axes.fill_between(t, centre - reach - growth * t, centre + reach + growth * t, color=pale, lw=0)
        axes.plot(t, centre, color=colour, lw=2)
        for side in (-1, 1):
            axes.plot(t, centre + side * (reach + growth * t), color=colour, lw=1.2, ls="--")
    axes.plot(t[t <= near], (lower - wave)[t <= near], color=ORANGE, lw=1.8)
    axes.plot(t[t <= near], (upper + 0.8 * wave)[t <= near], color=ORANGE, lw=1.8)
    height = np.interp(near, t, tops)
    axes.plot([near, near], [-9, height], color=BLACK, lw=1, ls=":")
    axes.plot(near, height, marker="o", color=RED, ms=8)
    axes.annotate(
        "time of proximity:\nthe envelopes touch",
        (near, height),
        (36, 43),
        color=RED,
        fontsize=10,
        arrowprops={"arrowstyle": "-", "color": RED, "shrinkB": 5, "lw": 1},
        va="center",
        ha="center",
    )
    arrow(axes, (near, -5), (0, -5), "<|-|>")
    axes.text(near / 2, -7.5, "proven apart", ha="center", va="top", fontsize=10)
    arrow(axes, (near, -5), (100, -5))
    axes.text((near + 100) / 2, -7.5, "may be near", ha="center", va="top", fontsize=10)
    axes.text(2.5, 85.5, "envelope of object 2", color="#555555", fontsize=10)
    axes.text(2.5, 25, "envelope of object 1", color=BLUE, fontsize=10)
    axes.text(9, 66.2, "true motion", color="#9a6a00", fontsize=10, ha="left")
    axes.text(99.3, 89, "$t_{final}$", ha="right", fontsize=11)
    axes.axvline(100, color=BLACK, lw=1, ls=":")
    axes.set(xlim=(0, 100.4), ylim=(-20, 95), yticks=[], ylabel="place along a line")
    axes.set_xlabel("ticks from the query on", labelpad=2)
    axes.set_xticks([0, 20, 40, 60, 80, 100])
    save(figure, folder, "proximity.svg")


def draw_chord(folder):
    figure = plt.figure(figsize=(680 / INCH, 250 / INCH))
    axes = figure.add_axes([0.06, 0.17, 0.92, 0.8])
    end, ball = 80, 20
    t = np.linspace(0, end, 161)
    path = t - t**2 / 100
    first = 50 - np.sqrt(50**2 - 100 * ball)
    axes.axhline(ball, color=GREY, lw=1.2, ls="--")
    axes.text(0.6, ball + 0.6, "here it touches a ball", color="#555555", fontsize=10)
    axes.plot(t, t / end * path[-1], color=ORANGE, lw=2)
    axes.text(48, 48 / end * path[-1] - 1.2, "chord: never gets as far as the ball", color="#9a6a00", fontsize=10, va="top")
    axes.plot(t, path, color=BLUE, lw=2)
    axes.text(63, 24.4, "path: $t - t^2/100$", color=BLUE, fontsize=10)
    axes.plot(first, ball, color=RED, marker="o", ms=8)
    axes.text(first + 1.6, ball - 0.8, f"first contact,\n$t = {first:.1f}$", color=RED, fontsize=10, va="top")
    arrow(axes, (end / 2, path[-1] / 2), (end / 2, path[80]), "<|-|>")
    axes.text(end / 2 + 0.8, 13.5, r"error of the chord, at most $\frac{1}{8} |a| T^2$", fontsize=10, va="center")
    axes.set(xlim=(0, end + 0.4), ylim=(0, 27), xlabel="ticks", ylabel="distance")
    axes.set_yticks([0, ball, 25])
    save(figure, folder, "chord.svg")


def draw_gap(folder):
    figure, axes = sheet(590, 315)
    direction = np.radians(8)
    n = np.array([np.cos(direction), np.sin(direction)])
    across = np.array([-n[1], n[0]])
    first, second = np.array([140, 170.0]), np.array([460, 225.0])
    turn = np.radians(28)
    sides = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    half = np.array([82, 48])
    corners = np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]]) * half @ sides + first
    axes.add_patch(Polygon(corners, fc=PALE_BLUE, ec=BLUE, lw=1.8))
    lean = np.radians(118)
    rod, radius = 52 * np.array([np.cos(lean), np.sin(lean)]), 34
    rim = np.radians(np.linspace(-90, 90, 40)) + lean
    cap = radius * np.stack([np.cos(rim), np.sin(rim)], axis=1)
    axes.add_patch(Polygon(np.concatenate([second + rod + cap, second - rod - cap]), fc=PALE_ORANGE, ec=ORANGE, lw=1.8))
    h1 = np.max((corners - first) @ n)
    h2 = abs(rod @ n) + radius
    distance = n @ (second - first)
    ends = [first, first + n * h1, first + n * (distance - h2), first + n * distance]
    base = -118  # where the dimensions are, across n
    low = [end + across * (base - (end - first) @ across) for end in ends]
    to_second = 118 + (second - first) @ across
    reach = ((BLUE, 32, 118), (BLUE, 6, 215), (ORANGE, 6, 215), (ORANGE, 32, to_second))
    for end, (colour, down, up) in zip(low, reach):
        axes.plot(*np.array([end - across * down, end + across * up]).T, color=colour, lw=1, ls="--")
    for start, end, text, colour in (
        (low[0], low[1], "$h_1(n)$", BLUE),
        (low[1], low[2], "gap $g$", RED),
        (low[2], low[3], "$h_2(-n)$", "#9a6a00"),
    ):
        arrow(axes, start, end, "<|-|>", colour)
        axes.text(*((start + end) / 2 + across * 10), text, ha="center", va="center", color=colour, fontsize=11,
                  bbox={"fc": "white", "ec": "none", "pad": 1.5}, zorder=4)
    arrow(axes, low[0] - across * 26, low[3] - across * 26, "<|-|>")
    axes.text(*((low[0] + low[3]) / 2 - across * 26), "$n \\cdot (c_2 - c_1)$", ha="center", va="center", fontsize=11,
              bbox={"fc": "white", "ec": "none", "pad": 2}, zorder=4)
    for centre, name in ((first, "$c_1$"), (second, "$c_2$")):
        axes.plot(*centre, color=BLACK, marker="o", ms=5)
        axes.text(*(centre + [-9, 7]), name, ha="right", va="bottom", fontsize=12)
    start = (ends[1] + ends[2]) / 2 + across * 70 - n * 25
    arrow(axes, start, start + n * 62)
    axes.text(*(start + n * 70), "$n$", ha="left", va="center", fontsize=12)
    save(figure, folder, "gap.svg")


def draw_tick(folder):
    figure, axes = sheet(700, 276)
    width, height = 160, 62
    left, right = 270, 520
    stages = (
        (left, 202, "measure", "is the tight box inside\nthe envelope?"),
        (left, 108, "predict", "path, deviation, reach:\na new envelope"),
        (left, 14, "index", "list, tree or sweep:\nwhose envelopes overlap?"),
        (right, 108, "report", "exact test of the boxes\n(or shapes) of now"),
    )
    for x, y, title, text in stages:
        box(axes, x, y, width, height, title, text)
    box(axes, right, 14, width, height, "near set", "pairs of envelopes\nthat overlap", PALE_GREY, GREY)
    box(axes, 20, 202, width, height, "notice", "a move that ODE reports,\nagainst one cache line", PALE_ORANGE, ORANGE)
    middle, end = left + width / 2, right + width / 2
    arrow(axes, (180, 233), (left, 233))
    note(axes, 225, 238, "outside, or\nin doubt", ha="center", va="bottom")
    arrow(axes, (100, 202), (100, 158))
    note(axes, 100, 152, "in its envelope:\nno further work", ha="center", va="top", colour=GREY)
    arrow(axes, (left + width, 233), (490, 233))
    note(axes, 496, 233, "inside: no further work", colour=GREY)
    arrow(axes, (middle, 202), (middle, 170))
    note(axes, middle + 7, 186, "outside; its pairs\nare dropped")
    arrow(axes, (middle, 108), (middle, 76))
    note(axes, middle + 7, 92, "batch of new envelopes")
    arrow(axes, (left + width, 45), (right, 45))
    note(axes, (left + width + right) / 2, 50, "pairs, each\nonce", ha="center", va="bottom")
    arrow(axes, (end, 76), (end, 108))
    arrow(axes, (end, 170), (end, 196))
    note(axes, end, 200, "ODE's filters, near callback", ha="center", va="bottom")
    save(figure, folder, "tick.svg")


def draw_servo(folder):
    figure, axes = sheet(700, 350)
    for x, title, colour in ((15, "scene's thread, at physics_rate", GREY), (495, "servo's thread, at rate", BLUE)):
        round_corners = "round,pad=0,rounding_size=8"
        axes.add_patch(FancyBboxPatch((x, 72), 190, 250, boxstyle=round_corners, fc="none", ec=colour, lw=1, ls="--"))
        note(axes, x + 95, 333, title, ha="center", colour=colour, size=10, weight="bold")
    scene = ["push the bodies", "step the world", "pose the probe", "collide", "roll out, sleep"]
    servo = ["read the device", "move what is touched", "proxy and touches", "law, safety, write", "sleep"]
    rows = [284, 234, 184, 134, 84]
    for steps, x, fill, edge in ((scene, 30, PALE_GREY, GREY), (servo, 510, PALE_BLUE, BLUE)):
        for text, y in zip(steps, rows):
            box(axes, x, y, 160, 30, text, "", fill, edge)
        for y, below in zip(rows, rows[1:]):
            arrow(axes, (x + 80, y), (x + 80, below + 30))
    between = (
        (rows[0] + 15, "impulses: object, point, N s", "ring: all of them", False),
        (rows[2] + 15, "tool, proxy, rendered touches", "triple buffer: the latest", False),
        (rows[4] + 15, "geoms around the probe, forecast", "triple buffer: the latest", True),
    )
    for y, what, how, to_the_right in between:
        ends = ((190, y), (495, y))
        arrow(axes, *(ends if to_the_right else ends[::-1]))
        note(axes, 350, y + 5, what, ha="center", va="bottom", size=10)
        note(axes, 350, y - 5, how, ha="center", va="top", colour=GREY)
    box(axes, 270, 14, 160, 44, "guard's thread, 1 kHz", "", PALE_ORANGE, ORANGE)
    route(axes, (430, 36), (590, 36), (590, 72), colour=ORANGE)
    note(axes, 600, 36, "no tick in time:\nzero force", size=9)
    save(figure, folder, "servo.svg")


def draw_rooms(folder):
    figure, axes = sheet(700, 300)
    width, height = 140, 44
    for middle, y, title, text in (
        (350, 244, "loop/", "one thread, two threads"),
        (350, 166, "probe, renderer", "of one device in a world"),
        (110, 88, "contact/", "what is touched"),
        (270, 88, "law/", "forces of touches"),
        (430, 88, "safety/", "limits, zero at the end"),
        (590, 88, "record/", "runs, replay"),
    ):
        box(axes, middle - width / 2, y, width, height, title, text)
    box(axes, 40, 14, 620, 40, "device/", "", PALE_GREY, GREY)
    arrow(axes, (350, 244), (350, 210))
    for start, middle in ((300, 110), (335, 270), (365, 430), (400, 590)):
        arrow(axes, (start, 166), (middle + (20 if middle < 350 else -20), 132))
    route(axes, (280, 266), (80, 266), (80, 132))
    route(axes, (420, 266), (470, 266), (470, 132))
    arrow(axes, (200, 110), (180, 110))
    for middle in (110, 270, 430, 590):
        arrow(axes, (middle, 88), (middle, 54))
    note(axes, 690, 188, "loop/, probe and renderer\nuse device/, too", ha="right", colour=GREY)
    save(figure, folder, "rooms.svg")


# The middle of each room. The arrows are those of the table in CONTRIBUTING.md.
ROOMS = {
    "preload": (95, 362),
    "demos/haptic": (440, 362),
    "recording": (95, 294),
    "demos/window": (615, 294),
    "space": (95, 226),
    "demos/worlds": (440, 260),
    "demos/ode": (615, 226),
    "broadphase": (95, 158),
    "ode": (265, 158),
    "haptics": (440, 158),
    "surface": (95, 90),
    "include": (265, 90),
    "prediction": (95, 22),
}


def draw_includes(folder):
    figure, axes = sheet(700, 390)
    half_width, half_height = 75, 16
    rooms = check_rooms.table((TOP / check_rooms.PAGE).read_text(encoding="utf-8"))
    for room in rooms:
        x, y = ROOMS[room]
        is_ours = not room.startswith("demos")
        colours = (PALE_BLUE, BLUE) if is_ours else (PALE_GREY, GREY)
        box(axes, x - half_width, y - half_height, 2 * half_width, 2 * half_height, room, "", *colours)
    for room, uses in rooms.items():
        for used in uses:
            (x, y), (to_x, to_y) = ROOMS[room], ROOMS[used]
            aside = 0 if x == to_x else 45 if to_x > x else -45
            arrow(axes, (x + aside, y - half_height), (to_x - aside, to_y + half_height))
    note(axes, 690, 40, "An arrow leads to what a room includes;\nrooms further along the arrows are included, too.", ha="right")
    save(figure, folder, "includes.svg")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument(
        "--output",
        type=pathlib.Path,
        default=pathlib.Path(__file__).resolve().parent,
        metavar="FOLDER",
        help="where to write the drawings (default: beside this script)",
    )
    folder = parser.parse_args().output
    folder.mkdir(parents=True, exist_ok=True)
    with plt.rc_context(STYLE):
        for draw in (draw_path, draw_proximity, draw_chord, draw_gap, draw_tick, draw_servo, draw_rooms, draw_includes):
            draw(folder)


if __name__ == "__main__":
    main()
