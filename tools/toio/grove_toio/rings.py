# SPDX-License-Identifier: MIT
"""Motion of robots in a ring: each enters the cell that the next one leaves.

If the robots drove straight, two of them would be half a cell from a corner at the same time, only 0.7 cells apart,
and even closer if one lags. So they take the corners wide (four robots of a square drive on one circle), and they
drive in PARTS: no robot begins a part before all have ended the one before. least_pitch() determines for every
ring whether this keeps the robots apart, before any robot moves.
"""
import math

from .geometry import segment_to_segment
from .mat import BODY

PARTS = 4
TOLERANCE = 3.0             # of positions at the ends of parts, units
ERRORS = 1.0                # error of each cube's notified position and steering, units
SPARE = 1.0


def _direction(a, b):
    return (b[0] - a[0], b[1] - a[1])


def _turn(a, b):
    """Returns 1 for right (y is down), -1 for left, 0 for straight on."""
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
    """Returns for the robot on each cell of the ring the ends of its parts, in cells, starting with its own cell."""
    count = len(cells)
    directions = [_direction(cells[i], cells[(i + 1) % count]) for i in range(count)]
    turns = [_turn(directions[i - 1], directions[i]) for i in range(count)]
    return [_wide_path(cells[i], directions[i], turns[i], turns[(i + 1) % count]) for i in range(count)]


def least_gap(paths):
    """Returns the least distance between two robots on these paths that are anywhere in the same part."""
    return min(segment_to_segment(*one[part:part + 2], *other[part:part + 2])
               for i, one in enumerate(paths) for other in paths[:i] for part in range(PARTS))


def least_pitch(cells):
    """Returns the least pitch of the grid with which robots may drive this ring."""
    return (BODY + SPARE + 2 * (TOLERANCE + ERRORS)) / least_gap(wide_paths(cells))


def near(cells, others):
    """Returns whether robots of two rings, driven at the same time, could meet where they take corners wide."""
    return any(max(abs(a[0] - b[0]), abs(a[1] - b[1])) <= 1 for a in cells for b in others)
