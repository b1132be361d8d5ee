# SPDX-License-Identifier: MIT
"""Simulates the mat: the true positions of the cubes, lifts, and the least distance between two cubes."""
import asyncio
import math
import random

from .geometry import distance
from .mat import BODY, MM

TICK = 0.01
SPREAD = 12                 # maximum distance per axis at which a hand puts a cube back, units
MAX_TICKS = 20              # maximum number of late ticks that are run at once on a busy machine


class Lift:
    """A disturbance: a hand lifts the cube at time `at` and puts it back after at least `seconds`.

    It puts the cube back as soon as there is room at `where` or, if that is None, near the cube's last position.
    """

    def __init__(self, cube, at, seconds, where=None):
        self.cube, self.at, self.until, self.where = cube, at, at + seconds, where


class World:
    def __init__(self, mat, seed=0):
        self.mat = mat
        self.cubes = []
        self.lifts = []
        self.least = math.inf       # least distance between two centres, units
        self.least_pair = None
        self.least_at = None
        self.random = random.Random(f"world {seed}")

    @property
    def least_mm(self):
        return self.least * MM

    @property
    def touched(self):
        return self.least < BODY

    async def run(self):
        loop = asyncio.get_running_loop()
        begin = then = loop.time()
        while True:
            await asyncio.sleep(TICK)
            now = loop.time()
            for _ in range(min(MAX_TICKS, round((now - then) / TICK) or 1)):
                self.tick(TICK, now, now - begin)
            then = now

    def tick(self, seconds, now, since_begin):
        self._hands(since_begin)
        for cube in self.cubes:
            cube.tick(seconds, now)
        self._measure(since_begin)

    def on_mat(self, x, y):
        x0, y0, x1, y1 = self.mat
        return x0 <= x <= x1 and y0 <= y <= y1

    def _measure(self, since_begin):
        standing = [c for c in self.cubes if not c.lifted]
        for i, one in enumerate(standing):
            for other in standing[:i]:
                apart = math.hypot(one.x - other.x, one.y - other.y)
                if apart < self.least:
                    self.least, self.least_pair, self.least_at = apart, (other.name, one.name), since_begin

    def _hands(self, since_begin):
        for lift in list(self.lifts):
            if since_begin >= lift.at and not lift.cube.lifted:
                lift.cube.lift()
            if since_begin >= lift.until and lift.cube.lifted and self._put_back(lift):
                self.lifts.remove(lift)

    def _put_back(self, lift):
        """Puts the cube back at a free position. Returns False if 20 tries find none."""
        for _ in range(20):
            x, y = lift.where or [at + self.random.uniform(-SPREAD, SPREAD) for at in (lift.cube.x, lift.cube.y)]
            if self.on_mat(x, y) and all(distance((x, y), (c.x, c.y)) > BODY + 6
                                         for c in self.cubes if c is not lift.cube and not c.lifted):
                lift.cube.put_down(x, y, self.random.uniform(0, 360))
                return True
        return False
