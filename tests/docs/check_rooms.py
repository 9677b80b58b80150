"""The rooms in CONTRIBUTING.md's table include those that it names, and the rooms that these include. There is no cycle.

Usage: check_rooms.py FOLDER, the top folder of the project. The haptics library's public headers belong to its room.
"""

import pathlib
import re
import sys

PAGE = "CONTRIBUTING.md"
ROW = re.compile(r"^\| `([a-z/]+)` \|.*\|([^|]*)\|$", re.MULTILINE)
INCLUDE = re.compile(r'^#include ["<]((?:ode_predictive_space|demos)/[^">]+)[">]', re.MULTILINE)


def table(page):
    """{room: [rooms that it may include]}, in the order of the rows."""
    return {room: re.findall(r"`([a-z/]+)`", uses) for room, uses in ROW.findall(page)}


def room_of(top, path):
    """The room of a file or of an included name; none for a program in demos/."""
    folders = path.split("/")[:-1]
    if folders[0] == "include":
        folders = folders[1:]
    elif (top / "include" / path).is_file():
        return "haptics" if "haptics" in folders else "include"
    if folders[0] == "demos":
        return "/".join(folders[:2]) if len(folders) > 1 else None
    return folders[1] if len(folders) > 1 else "include"


def includes(top):
    """{(from, to): "file includes header"}"""
    arrows = {}
    for folder in ("include", "ode_predictive_space", "demos"):
        for path in sorted((top / folder).rglob("*.*")):
            if path.suffix in (".c", ".cpp", ".h", ".hpp"):
                name = str(path.relative_to(top))
                for header in INCLUDE.findall(path.read_text()):
                    arrows.setdefault((room_of(top, name), room_of(top, header)), f"{name} includes {header}")
    return {(here, there): what for (here, there), what in arrows.items() if here and here != there}


def below(rooms, room):
    """The rooms that a room may include. A row names only rooms of earlier rows, so the recursion ends."""
    return set(rooms[room]).union(*(below(rooms, used) for used in rooms[room]))


def mistakes(top):
    rooms = table((top / PAGE).read_text())
    order = list(rooms)
    arrows = includes(top)
    for room, uses in rooms.items():
        yield from (f"{used} is not named above {room}, which includes it" for used in uses if used not in order[:order.index(room)])
        yield from (f"{room} does not include {used}" for used in uses if (room, used) not in arrows)
    if any(used not in order[:order.index(room)] for room, uses in rooms.items() for used in uses):
        return
    for (here, there), what in sorted(arrows.items()):
        if here not in rooms or there not in below(rooms, here):
            yield f"{here} includes {there}: {what}"


if __name__ == "__main__":
    found = list(mistakes(pathlib.Path(sys.argv[1])))
    for mistake in found:
        print(f"{PAGE}:", mistake)
    sys.exit(1 if found else 0)
