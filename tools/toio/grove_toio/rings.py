# SPDX-License-Identifier: MIT
"""Robots that follow each other round a circle, each into the cell that the next one leaves.

Were they to drive straight, two would be half a cell from a corner at one time, 0.7 cells apart; and
more so if one lags. So they take the corners wide, four robots of a square their common circle, and
they go in PARTS: nobody begins a part before all have ended the one before. Whether that keeps them
apart is worked out for every ring on its grid before anything moves.
"""
import math

from .geometry import segment_to_segment
from .mat import BODY

PARTS = 4
TOLERANCE = 3.0             # at the ends of parts, units
ERRORS = 1.0                # of each cube's notified position and steering
SPARE = 1.0


def _direction(a, b):
    return (b[0] - a[0], b[1] - a[1])


def _turn(a, b):
    """1 to the right (y is down), -1 to the left, 0 straight on."""
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
    """For the robot on each cell of the ring the ends of its parts, in cells, its own cell first."""
    count = len(cells)
    directions = [_direction(cells[i], cells[(i + 1) % count]) for i in range(count)]
    turns = [_turn(directions[i - 1], directions[i]) for i in range(count)]
    return [_wide_path(cells[i], directions[i], turns[i], turns[(i + 1) % count]) for i in range(count)]


def least_gap(paths):
    """How near two robots on these paths may come, wherever in the same part they are."""
    return min(segment_to_segment(*one[part:part + 2], *other[part:part + 2])
               for i, one in enumerate(paths) for other in paths[:i] for part in range(PARTS))


def least_pitch(cells):
    """The pitch from which on robots may go round this ring."""
    return (BODY + SPARE + 2 * (TOLERANCE + ERRORS)) / least_gap(wide_paths(cells))


def near(cells, others):
    """Whether robots that go round both rings at a time could meet where they take corners wide."""
    return any(max(abs(a[0] - b[0]), abs(a[1] - b[1])) <= 1 for a in cells for b in others)
