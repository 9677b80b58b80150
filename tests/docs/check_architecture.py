"""docs/the_tick.md names each file of some rooms once and no other, and no include goes against its order.

Usage: check_architecture.py FOLDER, the top folder of the project.
"""

import pathlib
import re
import sys

ROOMS = ("prediction", "broadphase", "ode", "space")  # for the others, single files are named
HEADING = "## The code in reading order"
IS_FILE = re.compile(r"[a-z0-9_/]+\.(h|cpp|\*)")


def files_named(token):
    """`x.*` stands for a header and its source."""
    if not IS_FILE.fullmatch(token):
        return []
    return [token[:-1] + "h", token[:-1] + "cpp"] if token.endswith(".*") else [token]


def reading_order(section):
    """The files. **room/** begins a room, each item of a list is in that room itself, and `folder/` enters a folder of it."""
    room = folder = ""
    for begins_room, begins_item, token in re.findall(r"\*\*([a-z]+/)\*\*|^(\d+\.) |`([^`]+)`", section, re.MULTILINE):
        if begins_room:
            room, folder = begins_room, ""
        elif begins_item:
            folder = ""
        elif room and token.endswith("/"):
            folder = token
        elif room:
            yield from (room + folder + name for name in files_named(token))


def step_of(name):
    """A room or a folder of broadphase/. In broadphase/ itself it is a header with its source."""
    path = pathlib.Path(name)
    return str(path.with_suffix("") if path.parent.name == "broadphase" else path.parent)


def includes_against(order, sources):
    steps = list(dict.fromkeys(map(step_of, order)))
    for name in order:
        for included in re.findall(r'^#include "ode_predictive_space/(.*)"', (sources / name).read_text(), re.MULTILINE):
            if included in order and steps.index(step_of(included)) > steps.index(step_of(name)):
                yield f"{name} includes {included}, which is named after it"


def mistakes(top):
    sources = top / "ode_predictive_space"
    page = (top / "docs" / "the_tick.md").read_text()
    text, section = page.split(HEADING)
    order = list(reading_order(section))
    elsewhere = [name for token in re.findall(r"`([^`\s]+/[^`\s]+)`", text) for name in files_named(token)]
    absent = {name for name in order + elsewhere if not (sources / name).is_file()}
    yield from (f"{name} does not exist" for name in sorted(absent))
    for room in ROOMS:
        for path in sorted((sources / room).rglob("*.*")):
            name = str(path.relative_to(sources))
            if order.count(name) != 1:
                yield f"{name} is named {order.count(name)} times"
    yield from includes_against([name for name in order if name not in absent], sources)


if __name__ == "__main__":
    found = list(mistakes(pathlib.Path(sys.argv[1])))
    for mistake in found:
        print("docs/the_tick.md:", mistake)
    sys.exit(1 if found else 0)
