#!/usr/bin/python3
"""Boxes of all sizes drop onto a floor one after another, are blown apart once, and are then drawn together: the classic
tutorial of pyode, without its window.

Usage: pyode_boxes.py [boxes] [steps]. Prints the final positions of the boxes.
"""
import random
import sys

import ode

STEP = 0.02


def near_callback(scene, first, second):
    world, contact_group = scene
    for contact in ode.collide(first, second):
        contact.setBounce(0.2)
        contact.setMu(5000)
        joint = ode.ContactJoint(world, contact_group, contact)
        joint.attach(first.getBody(), second.getBody())


def drop_box(world, space, numbers):
    sides = [numbers.uniform(0.1, 1.0) for _ in range(3)]
    body = ode.Body(world)
    mass = ode.Mass()
    mass.setBox(1000, *sides)
    body.setMass(mass)
    body.setPosition((numbers.gauss(0, 0.2), 3.0, numbers.gauss(0, 0.2)))
    geom = ode.GeomBox(space, lengths=sides)
    geom.setBody(body)
    return geom


def push(bodies, strength):
    for body in bodies:
        x, y, z = body.getPosition()
        factor = strength * body.getMass().mass
        body.addForce((factor * x, factor * abs(y), factor * z))


def main():
    boxes = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    steps = int(sys.argv[2]) if len(sys.argv) > 2 else 500
    numbers = random.Random(1)
    world = ode.World()
    world.setGravity((0, -9.81, 0))
    world.setERP(0.8)
    world.setCFM(1e-5)
    space = ode.Space()
    floor = ode.GeomPlane(space, (0, 1, 0), 0)
    contact_group = ode.JointGroup()
    geoms = []
    for step in range(steps):
        if step % 8 == 0 and len(geoms) < boxes:
            geoms.append(drop_box(world, space, numbers))
        bodies = [geom.getBody() for geom in geoms]
        if step == steps // 2:
            push(bodies, 40)
        elif step > steps * 3 // 4:
            push(bodies, -2)
        space.collide((world, contact_group), near_callback)
        world.quickStep(STEP)
        contact_group.empty()
    for geom in geoms[:3]:
        print(*(repr(value) for value in geom.getPosition()))
    heights = [geom.getPosition()[1] for geom in geoms]
    print(f"{len(heights)} boxes on floor {floor.getParams()}, mean height {sum(heights) / len(heights)!r}")


main()
