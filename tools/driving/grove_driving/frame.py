# SPDX-License-Identifier: MIT
"""Converts positions in metres to cells, by a transformation that it derives from a passing order."""
from .order import is_cell


class Frame:
    def __init__(self, order):
        """Derives the transformation from the first robot's start and the first move of any robot.

        On a roadmap the transformation is the identity.
        """
        robot = order.robots[0]
        self.cell, self.x, self.y = 1.0, 0.0, 0.0
        self.is_grid = is_cell(robot.start)
        if not self.is_grid:
            return
        self.cell = next((abs(a[0] - b[0]) + abs(a[1] - b[1]) for a, b in self._moves(order)), 1.0)
        self.x = robot.at[0] - robot.start[0] * self.cell
        self.y = robot.at[1] + robot.start[1] * self.cell

    @staticmethod
    def _moves(order):
        for robot in order.robots:
            at = robot.at
            for action in robot.actions:
                if action.at != at:
                    yield at, action.at
                at = action.at

    def cells(self, at):
        """Converts a point in metres with y up to (x, y) in cells with y down; on a roadmap, returns it unchanged."""
        return ((at[0] - self.x) / self.cell, (self.y - at[1]) / self.cell) if self.is_grid else at
