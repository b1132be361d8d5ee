# SPDX-License-Identifier: MIT
"""Passing orders for cubes, and drives of them in virtual time."""
import asyncio
import functools

from grove_toio.cells import read_cell_order, size
from grove_toio.clock import VirtualLoop
from grove_toio.driver import Driver
from grove_toio.mat import MATS, make_grid
from grove_toio.simulate import simulate
from grove_toio.simulated import Disturbances
from orders import order_file

PATIENCE = 240                  # virtual seconds

# The simple mat has room for 7 x 5 cells, but not for robots that go round.
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
    """(outcome, world)"""
    return run(simulate(order(name), grid(name), Disturbances(loss, slip, noise), seed, lifts, seconds, kind,
                        **options))


@functools.cache
def calm_drive(name, loss, seed):
    """The same without more, shared by those who only look at how it ended."""
    return drive(name, loss, seed)
