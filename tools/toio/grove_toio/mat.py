# SPDX-License-Identifier: MIT
"""Defines the cells on a mat and the position tolerance of cubes.

Lengths are in units of the mat's position ids. A unit is 1.36 mm (the mat of the toio COLLECTION has 410 units on
560 mm). A cube is a square with a side of 32 mm or 23.5 units. Since it turns on the spot, it can occupy the disc whose
diameter is its diagonal, BODY = 33.3 units. Two cubes never touch while their centres are at least BODY apart.

A cube stands on the centre of a cell or moves straight to a neighbouring cell. It holds both cells until it has
arrived. Therefore two cubes drive on lanes of different cells, and these lanes are at least the pitch of the cells
apart. Each of the two cubes may deviate from its lane by (pitch - BODY) / 2. RESERVE of this covers errors of the
notified positions and of steering, and the delay of notifications. The rest is the tolerance: a cube has arrived when
its notified position is within the tolerance of the centre.

For example, a 7 x 5 grid on the simple mat has a pitch of 43.2 units (59 mm). This is 9.9 units more than BODY, so the
tolerance is 2.9 units (4 mm). The cube itself treats a target as reached when it is 15 units away, where it could touch
a neighbour (43.2 - 15 < 33.3). Therefore the response of a cube does not count as arrival, and the driver
controls the rest of the way directly: it turns the cube and then runs the wheels for some hundredths of a second.
"""
import math
from typing import NamedTuple

from grove_driving.bad_input import BadInput

MM = 1.36
CUBE = 32 / MM
BODY = CUBE * math.sqrt(2)
RESERVE = 2.0
MIN_TOLERANCE, MAX_TOLERANCE = 2.0, 4.0
MIN_PITCH = BODY + 2 * (RESERVE + MIN_TOLERANCE)

# Top left and bottom right corners, from the page "Position ID" of the specification. The corners for the twelve
# development sheets (three columns of four) are from the toio SDK for Unity.
MATS = {"simple": (98, 142, 402, 358),
        "collection": (45, 45, 455, 455),
        "development": (34, 35, 949, 898)}


class Grid(NamedTuple):
    """A grid on a mat. Cell [x, y] has its centre at (left + x * pitch, top + y * pitch)."""
    mat: tuple
    width: int
    height: int
    pitch: float
    left: float
    top: float

    def centre(self, cell):
        return (self.left + cell[0] * self.pitch, self.top + cell[1] * self.pitch)

    def cell(self, point):
        """Converts a point in units to cell coordinates, as real numbers."""
        return ((point[0] - self.left) / self.pitch, (point[1] - self.top) / self.pitch)

    @property
    def tolerance(self):
        return min(MAX_TOLERANCE, (self.pitch - BODY) / 2 - RESERVE)


def make_grid(mat, width, height, pitch=None):
    """Returns a Grid in the middle of the mat. Without `pitch` the cells are as large as the mat allows."""
    x0, y0, x1, y1 = mat
    room = min((x1 - x0) / width, (y1 - y0) / height)
    size = f"{x1 - x0:g} x {y1 - y0:g} units"
    pitch = room if pitch is None else pitch
    if pitch < MIN_PITCH:
        raise BadInput(f"--mat: found {size} for {width} x {height} cells, {pitch:.1f} units each; expected at least "
                       f"{MIN_PITCH:.1f} so that cubes do not touch (a larger --mat, or fewer --cells)")
    if (width - 1) * pitch + BODY > x1 - x0 or (height - 1) * pitch + BODY > y1 - y0:
        raise BadInput(f"--pitch: found {pitch:g}; expected at most {room:.1f} for {width} x {height} cells on {size}")
    left, top = (x0 + x1 - (width - 1) * pitch) / 2, (y0 + y1 - (height - 1) * pitch) / 2
    return Grid(mat, width, height, pitch, left, top)
