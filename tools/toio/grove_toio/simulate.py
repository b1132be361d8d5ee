# SPDX-License-Identifier: MIT
"""Simulates cubes on a mat. Each starts near the centre of the cell where its robot starts."""
import asyncio
import random

from .driver import Driver
from .simulated import Disturbances, SimulatedCube
from .world import Lift, World

PUT_DOWN = 2.0              # error of manual placement, units from the centre


def make_world(order, grid, disturbances, seed):
    """Makes the simulated world and its cubes and returns (world, {robot: cube})."""
    world = World(grid.mat, seed)
    hand = random.Random(f"start {seed}")
    cubes = {}
    for robot in order.robots:
        x, y = grid.centre(robot.start)
        cubes[robot.name] = SimulatedCube(robot.name, world, x + hand.uniform(-PUT_DOWN, PUT_DOWN),
                                          y + hand.uniform(-PUT_DOWN, PUT_DOWN), hand.uniform(0, 360), disturbances,
                                          seed)
    return world, cubes


async def simulate(order, grid, disturbances=Disturbances(), seed=0, lifts=(), seconds=float("inf"), kind=Driver,
                   **options):
    """Drives simulated cubes along the order and returns (outcome, world).

    A lift is (robot, at, seconds), or (robot, at, seconds, point) to put the cube down at `point`.
    """
    world, cubes = make_world(order, grid, disturbances, seed)
    world.lifts = [Lift(cubes[robot], *those) for robot, *those in lifts]
    running = asyncio.create_task(world.run())
    try:
        return await kind(order, cubes, grid, **options).drive(seconds), world
    finally:
        running.cancel()
