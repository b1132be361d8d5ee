# SPDX-License-Identifier: MIT
"""Generates passing orders for cubes and executes them in virtual time."""
import asyncio
import functools

from grove_toio.cells import read_cell_order, size
from grove_toio.clock import VirtualLoop
from grove_toio.driver import Driver
from grove_toio.mat import MATS, make_grid
from grove_toio.simulate import simulate
from grove_toio.simulated import Disturbances
from orders import order_file

PATIENCE = 240                  # time limit in virtual seconds

# The simple mat has room for 7 x 5 cells. The map of "many" is larger, and robots in a ring need larger cells.
MAT = {"round": "collection", "many": "collection"}


@functools.cache
def order(name):
    return read_cell_order(order_file(name))


def grid(name):
    width, height = map(max, size(order(name)), (7, 5))
    return make_grid(MATS[MAT.get(name, "simple")], width, height)


def run(coroutine):
    with asyncio.Runner(loop_factory=VirtualLoop) as runner:
        return runner.run(coroutine)


def drive(name, loss=0.0, seed=0, lifts=(), seconds=PATIENCE, kind=Driver, slip=0.05, noise=1.0, **options):
    """Simulates an execution and returns (outcome, world)."""
    return run(simulate(order(name), grid(name), Disturbances(loss, slip, noise), seed, lifts, seconds, kind,
                        **options))


@functools.cache
def calm_drive(name, loss, seed):
    """Returns drive(name, loss, seed), cached for tests that only read the result."""
    return drive(name, loss, seed)
