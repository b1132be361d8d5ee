# SPDX-License-Identifier: MIT
"""Plans of classical MAPF, of the plan files that grove bench kept.

It re-checked them; here what can be seen without the map is looked at once more, since files may have changed.
"""
import json
import re

LETTERS = {(1, 0): "r", (-1, 0): "l", (0, -1): "u", (0, 1): "d", (0, 0): "w"}


class BadPlan(Exception):
    """Why it is none. One line."""


def _paths(text):
    try:
        return [[tuple(cell) for cell in agent["path"]] for agent in json.loads(text)["agents"]]
    except (ValueError, KeyError, TypeError, RecursionError):
        raise BadPlan("no plan is in it; expected a plan file of Grove") from None


def _until_rest(path):
    """Without the waits at the end."""
    end = len(path)
    while end > 1 and path[end - 1] == path[end - 2]:
        end -= 1
    return path[:end]


def _step(before, after):
    """None: they are no cells."""
    try:
        (x, y), (to_x, to_y) = before, after
        return to_x - x, to_y - y
    except (TypeError, ValueError):
        return None


def read_plan(path, agents):
    """The path of each agent, a cell (x, y) for each step until it rests."""
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


def recounted(paths):
    """The sum of the times at which agents come to rest. Refuses paths that collide."""
    for time in range(max(map(len, paths))):
        here = [path[min(time, len(path) - 1)] for path in paths]
        at = {cell: agent for agent, cell in enumerate(here)}
        if len(at) < len(here):
            raise BadPlan(f"two agents are on one cell at time {time}")
        if time == 0:
            before = here
            continue
        for agent, (old, new) in enumerate(zip(before, here)):
            other = at.get(old)
            if old != new and other is not None and before[other] == new:
                raise BadPlan(f"agents {min(agent, other)} and {max(agent, other)} swap places at time {time}")
        before = here
    return sum(len(path) - 1 for path in paths)


def motion_string(path):
    """"5r2d" for five steps to the right and two down; up is where y is smaller."""
    letters = "".join(LETTERS[_step(before, after)] for before, after in zip(path, path[1:]))
    return re.sub(r"(.)\1+", lambda run: f"{len(run[0])}{run[1]}", letters)
