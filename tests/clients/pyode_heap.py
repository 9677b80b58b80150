#!/usr/bin/python3
"""A larger scene in pyode: boxes, spheres and capsules are poured into a yard with walls, in a hash space or a quadtree; the
walls are in a nested simple space.

Usage: pyode_heap.py [hash|quadtree] [height of the ground] [bodies] [steps]. Prints the final positions of the bodies.
"""
import random
import sys

import ode

STEP = 0.01
HALF_YARD = 4.0


def make_space(kind):
    if kind == "quadtree":
        return ode.QuadTreeSpace((0, 0, 0), (2 * HALF_YARD, 2 * HALF_YARD, 2 * HALF_YARD), 5)
    return ode.HashSpace()


def near_callback(scene, first, second):
    if first.isSpace() or second.isSpace():
        ode.collide2(first, second, scene, near_callback)
        return
    world, contact_group = scene
    for contact in ode.collide(first, second):
        contact.setMu(2)
        joint = ode.ContactJoint(world, contact_group, contact)
        joint.attach(first.getBody(), second.getBody())


def build_walls(space, ground):
    walls = ode.SimpleSpace(space)
    sides = [(2 * HALF_YARD, 0.5, 4.0), (0.5, 2 * HALF_YARD, 4.0)]
    geoms = []
    for x, y, lengths in [(0, -1, sides[0]), (0, 1, sides[0]), (-1, 0, sides[1]), (1, 0, sides[1])]:
        wall = ode.GeomBox(walls, lengths=lengths)
        wall.setPosition((x * HALF_YARD, y * HALF_YARD, ground + 2.0))
        geoms.append(wall)
    return [walls, *geoms]


def make_thing(world, space, ground, number, numbers):
    body = ode.Body(world)
    mass = ode.Mass()
    mass.setSphere(500, 0.2)
    body.setMass(mass)
    layer, place = divmod(number, 100)
    row, column = divmod(place, 10)
    body.setPosition((0.7 * column - 3.2, 0.7 * row - 3.2, ground + 0.5 + 0.7 * layer))
    body.setLinearVel([numbers.uniform(-1, 1) for _ in range(3)])
    if number % 3 == 0:
        geom = ode.GeomBox(space, lengths=(0.4, 0.3, 0.3))
    elif number % 3 == 1:
        geom = ode.GeomSphere(space, 0.2)
    else:
        geom = ode.GeomCapsule(space, 0.12, 0.25)
    geom.setBody(body)
    return geom


def main():
    kind = sys.argv[1] if len(sys.argv) > 1 else "hash"
    height = float(sys.argv[2]) if len(sys.argv) > 2 else 0.0
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 400
    steps = int(sys.argv[4]) if len(sys.argv) > 4 else 200
    numbers = random.Random(2)
    world = ode.World()
    world.setGravity((0, 0, -9.81))
    space = make_space(kind)
    ground = ode.GeomPlane(space, (0, 0, 1), height)
    walls = build_walls(space, height)
    things = [make_thing(world, space, height, number, numbers) for number in range(count)]
    contact_group = ode.JointGroup()
    for _ in range(steps):
        space.collide((world, contact_group), near_callback)
        world.quickStep(STEP)
        contact_group.empty()
    mean = [sum(thing.getPosition()[axis] for thing in things) / count for axis in range(3)]
    print(f"{count} bodies, {len(walls) - 1} walls, ground {ground.getParams()}, mean position {mean!r}")


main()
