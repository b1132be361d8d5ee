# SPDX-License-Identifier: MIT
"""Plans the motion of robots in a ring, in which each robot enters the cell that the next one leaves.

If the robots drove straight, two of them would be half a cell from a corner at the same time. Then they are only 0.7
cells apart, and even less if one lags. Therefore they take the corners wide (four robots in a square drive on one
circle), and they drive in PARTS parts: no robot starts a part before all have completed the previous part. Before any
robot moves, the program checks that the pitch of the grid is at least the least_pitch() of each ring.
"""
import math

from .geometry import segment_to_segment
from .mat import BODY

PARTS = 4
TOLERANCE = 3.0             # tolerance of positions at the ends of parts, units
ERRORS = 1.0                # error of each cube's notified position and steering, units
SPARE = 1.0                 # additional distance, units


def _direction(a, b):
    return (b[0] - a[0], b[1] - a[1])


def _turn(a, b):
    """Returns the turn from direction a to direction b: 1 for right (y is down), -1 for left, 0 for none."""
    return a[0] * b[1] - a[1] * b[0]


def _wide_path(cell, direction, turn_before, turn_after):
    points = []
    for part in range(PARTS + 1):
        share = part / PARTS
        angle = (share - 0.5) * math.pi / 2
        ahead = 0.5 + math.sin(angle) / math.sqrt(2)
        left = (turn_before * (1 - share) + turn_after * share) * (math.cos(angle) / math.sqrt(2) - 0.5)
        points.append((cell[0] + ahead * direction[0] + left * direction[1],
                       cell[1] + ahead * direction[1] - left * direction[0]))
    return points


def wide_paths(cells):
    """Returns a path for the robot on each cell of the ring: its cell, then the end point of each part, in cells."""
    count = len(cells)
    directions = [_direction(cells[i], cells[(i + 1) % count]) for i in range(count)]
    turns = [_turn(directions[i - 1], directions[i]) for i in range(count)]
    return [_wide_path(cells[i], directions[i], turns[i], turns[(i + 1) % count]) for i in range(count)]


def least_gap(paths):
    """Returns the least distance, in cells, that two robots on these paths can have while both are in the same part."""
    return min(segment_to_segment(*one[part:part + 2], *other[part:part + 2])
               for i, one in enumerate(paths) for other in paths[:i] for part in range(PARTS))


def least_pitch(cells):
    """Returns the least pitch of the grid, in units, with which robots can drive this ring."""
    return (BODY + SPARE + 2 * (TOLERANCE + ERRORS)) / least_gap(wide_paths(cells))


def near(cells, others):
    """Returns whether robots in two rings could meet where they take corners wide, if both rings drive concurrently."""
    return any(max(abs(a[0] - b[0]), abs(a[1] - b[1])) <= 1 for a in cells for b in others)
