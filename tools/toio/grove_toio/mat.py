# SPDX-License-Identifier: MIT
"""Cells on a mat, and how exactly cubes must keep to them.

Lengths are in units of the mat's position ids, 1.36 mm each (560 mm are 410 of them on the mat of the toio
COLLECTION). A cube is a square of 32 mm, 23.5 units; since it turns on the spot, the room it may take up is
a disc over its diagonal: 33.3 units, BODY. So two cubes never touch while their centres are BODY apart.

A cube stands on the centre of a cell or moves to a neighbouring one, straight. It holds both cells until it
has arrived, so two cubes drive on lanes of different cells, never nearer than the pitch of the cells. What
is left of the pitch, (pitch - BODY) / 2, is what each of the two may be off its lane. RESERVE of it are
for errors of the notified positions, of steering and for what happens until they are heard; the rest is the
tolerance: a cube has arrived when it stands so near to the centre, by its notified position.

A 7 x 5 grid on the simple mat has a pitch of 43.2 units (59 mm): 9.9 to spare, so a tolerance of 2.9 units
(4 mm). A cube by itself holds a target for reached 15 units before it: those near neighbours would touch
(43.2 - 15 < 33.3). That is why arrival is not what a cube responds, and why cubes are moved the rest
of the way by hand, so to say: turned, then wheels for some hundredths of a second.
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

# Top left and bottom right: the specification's page "Position ID"; of the twelve sheets for development, three
# beside and four below each other, what the toio SDK for Unity has.
MATS = {"simple": (98, 142, 402, 358),
        "collection": (45, 45, 455, 455),
        "development": (34, 35, 949, 898)}


class Grid(NamedTuple):
    """Cell [x, y] has its centre at (left + x * pitch, top + y * pitch)."""
    mat: tuple
    width: int
    height: int
    pitch: float
    left: float
    top: float

    def centre(self, cell):
        return (self.left + cell[0] * self.pitch, self.top + cell[1] * self.pitch)

    def cell(self, point):
        """In cells, real numbers."""
        return ((point[0] - self.left) / self.pitch, (point[1] - self.top) / self.pitch)

    @property
    def tolerance(self):
        return min(MOST_TOLERANCE, (self.pitch - BODY) / 2 - RESERVE)


def make_grid(mat, width, height, pitch=None):
    """Cells in the middle of the mat; as far apart as it has room for if that is not said."""
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
