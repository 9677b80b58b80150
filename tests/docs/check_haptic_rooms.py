"""docs/haptics/method.md names for each room of the haptics library the rooms that it includes. This holds, and has no cycle.

Usage: check_haptic_rooms.py FOLDER, the top folder of the project. A public header belongs to the room of the source that begins by
including it, and one without a source to the room below.
"""

import pathlib
import re
import sys

LIBRARY = "ode_predictive_space/haptics"
WITHOUT_SOURCE = {"exchange.h": "device/"}
HEADING = "## The code in rooms"
ROW = re.compile(r"^\| `([a-z]+/|\*)` \|.*\|([^|]*)\|$", re.MULTILINE)
INCLUDE = re.compile(rf'^#include "{LIBRARY}/(.*)"', re.MULTILINE)


def room_of(path):
    """`*` is the library's folder itself, above its rooms."""
    return path.split("/")[0] + "/" if "/" in path else "*"


def arrows_between(top):
    """{(from, to): ["file includes header", ...]}"""
    library, headers = top / LIBRARY, top / "include" / LIBRARY
    texts = {str(path.relative_to(library)): path.read_text() for path in library.rglob("*.*") if path.suffix in (".h", ".cpp")}
    home = {path.name: WITHOUT_SOURCE.get(path.name) for path in headers.glob("*.h")}
    for name, text in sorted(texts.items()):
        first = INCLUDE.search(text)
        if first and first.group(1) in home and name.endswith(".cpp"):
            home[first.group(1)] = home[first.group(1)] or room_of(name)
    homeless = [name for name, room in home.items() if room is None]
    arrows = {}
    for name, text in list(texts.items()) + [(name, (headers / name).read_text()) for name in home]:
        here = home.get(name) or room_of(name)
        for included in INCLUDE.findall(text):
            there = home.get(included) or room_of(included)
            if there != here:
                arrows.setdefault((here, there), []).append(f"{name} includes {included}")
    return arrows, homeless


def mistakes(top):
    arrows, homeless = arrows_between(top)
    yield from (f"{name} belongs to no room: no source begins with it" for name in homeless)
    section = (top / "docs/haptics/method.md").read_text().split(HEADING)[1].split("\n## ")[0]
    rows = ROW.findall(section)
    listed = {(room, used) for room, uses in rows for used in re.findall(r"`([a-z]+/|\*)`", uses)}
    order = [room for room, _ in rows]
    yield from (f"{room} is listed after {here}, which includes it" for here, room in listed if order.index(room) > order.index(here))
    yield from (f"{arrow}: {arrows[arrow][0]}" for arrow in sorted(arrows.keys() - listed))
    yield from (f"{arrow} is listed and is none" for arrow in sorted(listed - arrows.keys()))


if __name__ == "__main__":
    found = list(mistakes(pathlib.Path(sys.argv[1])))
    for mistake in found:
        print("docs/haptics/method.md:", mistake)
    sys.exit(1 if found else 0)
