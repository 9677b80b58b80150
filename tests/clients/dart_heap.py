#!/usr/bin/python3
"""A heap of boxes and spheres in DART's world, from Python, with ODE as its collision detector.

Usage: dart_heap.py [bodies] [steps]. Prints the final positions of the bodies.
"""
import sys

import dartpy as dart
import numpy as np


def shape_of(number):
    if number % 2 == 0:
        return dart.dynamics.BoxShape([0.3, 0.2, 0.25])
    return dart.dynamics.SphereShape(0.12)


def give_shape(body, shape):
    node = body.createShapeNode(shape)
    node.createCollisionAspect()
    node.createDynamicsAspect()


def thing(number):
    skeleton = dart.dynamics.Skeleton(f"thing {number}")
    joint, body = skeleton.createFreeJointAndBodyNodePair()
    give_shape(body, shape_of(number))
    rotation = 0.3 * number
    place = [rotation, 0, 0, 0.45 * (number % 5), 0.45 * (number // 5 % 5), 0.3 + 0.4 * (number // 25)]
    joint.setPositions(np.array(place))
    return skeleton


def ground():
    skeleton = dart.dynamics.Skeleton("ground")
    _, body = skeleton.createWeldJointAndBodyNodePair()
    give_shape(body, dart.dynamics.BoxShape([20, 20, 0.2]))
    return skeleton


def main():
    bodies = int(sys.argv[1]) if len(sys.argv) > 1 else 50
    steps = int(sys.argv[2]) if len(sys.argv) > 2 else 200
    world = dart.simulation.World()
    world.getConstraintSolver().setCollisionDetector(dart.collision.OdeCollisionDetector())
    world.setTimeStep(0.005)
    world.addSkeleton(ground())
    things = [thing(number) for number in range(bodies)]
    for each in things:
        world.addSkeleton(each)
    for _ in range(steps):
        world.step()
    places = [each.getBodyNode(0).getTransform().translation() for each in things]
    mean = np.mean(places, axis=0)
    print(f"{bodies} bodies, mean position {mean[0]!r} {mean[1]!r} {mean[2]!r}")
    return 0 if np.all(np.isfinite(mean)) and mean[2] > 0 else 1


sys.exit(main())
