# SPDX-License-Identifier: MIT
"""Plans of classical MAPF as files hold them: a plan file of Grove, path lists ("Agent 0: (row,column)->..."), or the
text of lacam ("solution=", then a line "TIME:(x,y),(x,y),..." for each step).

Grove bench re-checked them when it kept them; here what can be seen without the map is looked at once more, since files
may have changed.
"""
import json
import re

CELL = re.compile(r"\(([0-9]+),([0-9]+)\)")
LETTERS = {(1, 0): "r", (-1, 0): "l", (0, -1): "u", (0, 1): "d", (0, 0): "w"}


class BadPlan(Exception):
    """Why it is none. One line."""


def _grove_paths(text):
    try:
        return [[tuple(cell) for cell in agent["path"]] for agent in json.loads(text)["agents"]]
    except (ValueError, KeyError, TypeError, RecursionError):
        raise BadPlan("no plan is in it") from None


def _listed_paths(lines):
    return [[(int(column), int(row)) for row, column in CELL.findall(line)] for line in lines if line.strip()]


def _stepped_paths(lines):
    steps = [[(int(x), int(y)) for x, y in CELL.findall(line)] for line in lines[lines.index("solution=") + 1:] if line]
    if len(set(map(len, steps))) > 1:
        raise BadPlan("not every step has as many agents")
    return [list(path) for path in zip(*steps)]


def _paths(text):
    lines = text.splitlines()
    if text.lstrip().startswith("{"):
        return _grove_paths(text)
    if lines and lines[0].startswith("Agent "):
        return _listed_paths(lines)
    if "solution=" in lines:
        return _stepped_paths(lines)
    raise BadPlan("expected a plan file of Grove, path lists, or lacam's text")


def _until_rest(path):
    """Without the waits at the end."""
    end = len(path)
    while end > 1 and path[end - 1] == path[end - 2]:
        end -= 1
    return path[:end]


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
            if len(after) != 2 or (after[0] - before[0], after[1] - before[1]) not in LETTERS:
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
    letters = "".join(LETTERS[after[0] - before[0], after[1] - before[1]] for before, after in zip(path, path[1:]))
    return re.sub(r"(.)\1+", lambda run: f"{len(run[0])}{run[1]}", letters)
