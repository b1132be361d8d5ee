# SPDX-License-Identifier: MIT
"""Reads passing orders on grids; cubes cannot drive on roadmaps."""
import json

from grove_driving.bad_input import at
from grove_driving.order import is_cell, read_order

HEADINGS = {"E": 0, "S": 90, "W": 180, "N": 270}  # degrees clockwise from the x axis, as cubes use them


def read_cell_order(file):
    """Reads a passing order. Raises BadInput if it is on a roadmap."""
    order = read_order(file)
    for i, robot in enumerate(order.robots):
        if not is_cell(robot.start):
            raise at(file, f"/robots/{i}/start", json.dumps(robot.start),
                     "[x, y]: cubes drive on grids, not on roadmaps")
    return order


def size(order):
    """Returns (width, height) of the smallest grid from cell (0, 0) that contains all cells of the order."""
    cells = [c for r in order.robots for c in (r.start, *(a.place for a in r.actions))]
    return max(x for x, _ in cells) + 1, max(y for _, y in cells) + 1
