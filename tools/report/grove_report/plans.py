# SPDX-License-Identifier: MIT
"""Reads plans of classical MAPF from the plan files that `grove bench --keep-plans` kept.

`grove bench` has already checked the plans, and the rows contain its verdict. This module only requires that a file
contains sequences of moves.
"""
import json
import re

LETTERS = {(1, 0): "r", (-1, 0): "l", (0, -1): "u", (0, 1): "d", (0, 0): "w"}


class BadPlan(Exception):
    """A file has no usable plan. The text is the reason, in one line."""


def _paths(text):
    try:
        return [[tuple(cell) for cell in agent["path"]] for agent in json.loads(text)["agents"]]
    except (ValueError, KeyError, TypeError, RecursionError):
        raise BadPlan("found no plan; expected a plan file of Grove") from None


def _until_rest(path):
    """Returns the path without the waits at its end."""
    end = len(path)
    while end > 1 and path[end - 1] == path[end - 2]:
        end -= 1
    return path[:end]


def _step(before, after):
    """Returns the move (dx, dy) from one cell to the next. Returns None if the arguments are not cells."""
    try:
        (x, y), (to_x, to_y) = before, after
        return to_x - x, to_y - y
    except (TypeError, ValueError):
        return None


def read_plan(path, agents):
    """Returns the path of each agent as its cells (x, y) at times 0, 1, ... until it rests. Raises BadPlan."""
    try:
        paths = _paths(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise BadPlan(f"cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise BadPlan("not UTF-8 text") from None
    if len(paths) != agents or not all(paths):
        raise BadPlan(f"paths of {sum(map(bool, paths))} agents; expected {agents}")
    paths = [_until_rest(each) for each in paths]
    for agent, each in enumerate(paths):
        for time, (before, after) in enumerate(zip(each, each[1:]), 1):
            if _step(before, after) not in LETTERS:
                raise BadPlan(f"agent {agent} jumps at time {time}")
    return paths


def cost_of(paths):
    """Returns the cost of a plan, which is the sum of the times at which the agents come to rest."""
    return sum(len(path) - 1 for path in paths)


def motion_string(path):
    """Returns the moves in run-length encoding: "5r2d" is five moves right, then two down. Up means smaller y."""
    letters = "".join(LETTERS[_step(before, after)] for before, after in zip(path, path[1:]))
    return re.sub(r"(.)\1+", lambda run: f"{len(run[0])}{run[1]}", letters)
