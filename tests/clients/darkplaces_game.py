#!/usr/bin/env python3
"""Writes a game for the engine DarkPlaces: a closed room and 60 boxes that fall into a heap by ODE. No file of any game is needed.

The program of a game (progs.dat, version 6) is a header and tables. This one has the functions that the engine calls, each of which
returns at once; only physics happens. The room is a model in Wavefront's format, and its content is a list beside it.

Usage: darkplaces_game.py FOLDER
"""
import struct
import sys
from pathlib import Path

FUNCTIONS = ["worldspawn", "box", "info_player_start", "main", "StartFrame", "PlayerPreThink", "PlayerPostThink", "ClientKill",
             "ClientConnect", "PutClientInServer", "ClientDisconnect", "SetNewParms"]
# Fields that the engine expects at the beginning of every entity, in its order, with their types.
STRING, NUMBER, VECTOR, ENTITY, FUNCTION = 1, 2, 3, 4, 6
FIELDS = [("modelindex", NUMBER), ("absmin", VECTOR), ("absmax", VECTOR), ("ltime", NUMBER), ("movetype", NUMBER),
          ("solid", NUMBER), ("origin", VECTOR), ("oldorigin", VECTOR), ("velocity", VECTOR), ("angles", VECTOR),
          ("avelocity", VECTOR), ("punchangle", VECTOR), ("classname", STRING), ("model", STRING), ("frame", NUMBER),
          ("skin", NUMBER), ("effects", NUMBER), ("mins", VECTOR), ("maxs", VECTOR), ("size", VECTOR), ("touch", FUNCTION),
          ("use", FUNCTION), ("think", FUNCTION), ("blocked", FUNCTION), ("nextthink", NUMBER), ("groundentity", ENTITY)]
WORDS_OF_AN_ENTITY = 105
WORDS_OF_GLOBALS = 200
LOCALS_BEGIN = 28
CHECKSUM_OF_SYSTEM_FIELDS = 5927
PHYSICS, PHYSICS_BOX = 32, 32  # the engine's movetype and solid of a box that ODE moves


def program():
    strings = bytearray(b"\0")

    def string(text):
        strings.extend(text.encode() + b"\0")
        return len(strings) - len(text) - 1

    functions = struct.pack("<7i8B", *[0] * 15)
    for name in FUNCTIONS:
        functions += struct.pack("<7i8B", 1, LOCALS_BEGIN, 0, 0, string(name), string("game.qc"), 0, *[0] * 8)
    fields, offset = struct.pack("<HHi", 0, 0, 0), 0
    for name, kind in FIELDS:
        fields += struct.pack("<HHi", kind, offset, string(name))
        offset += 3 if kind == VECTOR else 1
    strings.extend(bytes(-len(strings) % 4))
    statements = struct.pack("<H3h", 0, 0, 0, 0) * 2
    tables = [(statements, 2), (struct.pack("<HHi", 0, 0, 0), 1), (fields, len(FIELDS) + 1), (functions, len(FUNCTIONS) + 1),
              (bytes(strings), len(strings)), (bytes(4 * WORDS_OF_GLOBALS), WORDS_OF_GLOBALS)]
    header, begin = [6, CHECKSUM_OF_SYSTEM_FIELDS], 60
    for table, count in tables:
        header += [begin, count]
        begin += len(table)
    return struct.pack("<15i", *header, WORDS_OF_AN_ENTITY) + b"".join(table for table, _ in tables)


def room():
    corners = [(x, y, z) for z in (-32, 1024) for y in (-1024, 1024) for x in (-1024, 1024)]
    sides = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    lines = [f"v {x} {y} {z}" for x, y, z in corners] + ["vt 0 0", "vn 0 0 1", "usemtl stone"]
    return "\n".join(lines + ["f " + " ".join(f"{corner}/1/1" for corner in side) for side in sides]) + "\n"


def entity(**values):
    return "{\n" + "".join(f'"{key}" "{value}"\n' for key, value in values.items()) + "}\n"


def entities():
    text = entity(classname="worldspawn") + entity(classname="info_player_start", origin="0 0 64")
    for i in range(60):
        text += entity(classname="box", origin=f"{i % 4 * 36} {i // 4 % 4 * 36} {40 + i // 16 * 40}", mins="-16 -16 -16",
                       maxs="16 16 16", movetype=PHYSICS, solid=PHYSICS_BOX)
    return text


def main():
    game = Path(sys.argv[1]) / "id1"
    (game / "maps").mkdir(parents=True, exist_ok=True)
    (game / "progs.dat").write_bytes(program())
    (game / "maps/room.obj").write_text(room())
    (game / "maps/room.ent").write_text(entities())


if __name__ == "__main__":
    main()
