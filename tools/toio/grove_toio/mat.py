# SPDX-License-Identifier: MIT
"""Cells on a mat, and the position tolerance of cubes.

Lengths are in units of the mat's position ids, 1.36 mm each (560 mm are 410 of them on the mat of the toio
COLLECTION). A cube is a square of 32 mm, 23.5 units. Since it turns on the spot, it may occupy the disc over its
diagonal, BODY = 33.3 units. So two cubes never touch while their centres are BODY apart.

A cube stands on the centre of a cell or moves straight to a neighbouring one. It holds both cells until it
has arrived, so two cubes drive on lanes of different cells, which are at least the pitch of the cells apart. Each
of the two may deviate by (pitch - BODY) / 2 from its lane. RESERVE of this is for errors of the notified
positions and of steering, and for the delay of notifications. The rest is the tolerance: a cube has arrived when
it stands this near to the centre, by its notified position.

A 7 x 5 grid on the simple mat has a pitch of 43.2 units (59 mm), 9.9 more than BODY, so the tolerance is 2.9 units
(4 mm). The cube itself treats a target as reached 15 units before it. Two such neighbours would touch
(43.2 - 15 < 33.3). Therefore the response of a cube does not count as arrival, and the driver controls the rest
of the way directly: it turns the cube, then runs the wheels for some hundredths of a second.
"""
import math
from typing import NamedTuple

from grove_driving.bad_input import BadInput

MM = 1.36
CUBE = 32 / MM
BODY = CUBE * math.sqrt(2)
RESERVE = 2.0
LEAST_TOLERANCE, MOST_TOLERANCE = 2.0, 4.0
LEAST_PITCH = BODY + 2 * (RESERVE + LEAST_TOLERANCE)

# Top left and bottom right corner, from the page "Position ID" of the specification; for the twelve development
# sheets, three columns of four, from the toio SDK for Unity.
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
        """Returns the point in cells, as real numbers."""
        return ((point[0] - self.left) / self.pitch, (point[1] - self.top) / self.pitch)

    @property
    def tolerance(self):
        return min(MOST_TOLERANCE, (self.pitch - BODY) / 2 - RESERVE)


def make_grid(mat, width, height, pitch=None):
    """Returns a grid in the middle of the mat. Without `pitch` the cells are as large as the mat allows."""
    x0, y0, x1, y1 = mat
    room = min((x1 - x0) / width, (y1 - y0) / height)
    size = f"{x1 - x0:g} x {y1 - y0:g} units"
    pitch = room if pitch is None else pitch
    if pitch < LEAST_PITCH:
        raise BadInput(f"--mat: found {size} for {width} x {height} cells, {pitch:.1f} units each; expected at least "
                       f"{LEAST_PITCH:.1f} so that cubes do not touch (a larger --mat, or fewer --cells)")
    if (width - 1) * pitch + BODY > x1 - x0 or (height - 1) * pitch + BODY > y1 - y0:
        raise BadInput(f"--pitch: found {pitch:g}; expected at most {room:.1f} for {width} x {height} cells on {size}")
    left, top = (x0 + x1 - (width - 1) * pitch) / 2, (y0 + y1 - (height - 1) * pitch) / 2
    return Grid(mat, width, height, pitch, left, top)
