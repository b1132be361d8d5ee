# SPDX-License-Identifier: MIT
"""The passing order, as `grove execute --order` writes it (docs/passing-order.md)."""
import json
from typing import NamedTuple

from .bad_input import BadInput, at

FORMAT = "grove passing order 1"
HEADINGS = {"E": 0, "S": 90, "W": 180, "N": 270}  # as cubes count angles
KINDS = ("move", "turn", "work")


class Action(NamedTuple):
    kind: str
    cell: tuple             # where the robot then is
    heading: str            # "N", ... or None
    steps: int
    after: tuple            # (robot, action) or None
    ring: int               # or None
    task: str               # or None


class Robot(NamedTuple):
    name: str
    start: tuple
    heading: str
    actions: tuple

    def cell_before(self, action):
        return self.actions[action - 1].cell if action else self.start


class Order(NamedTuple):
    robots: tuple
    rings: dict             # ring: [(robot, action)] as they follow each other, by indices

    def robot(self, name):
        return next(r for r in self.robots if r.name == name)

    def size(self):
        """Width and height of the cells in use."""
        cells = [c for r in self.robots for c in (r.start, *(a.cell for a in r.actions))]
        return max(x for x, _ in cells) + 1, max(y for _, y in cells) + 1


class _Reader:
    def __init__(self, file):
        self.file = file

    def fail(self, place, found, expected):
        text = json.dumps(found, ensure_ascii=True)
        raise at(self.file, place, text if len(text) <= 60 else text[:57] + "...", expected)

    def key(self, place, holder, key, kind, expected):
        if key not in holder:
            raise at(self.file, place, f"no key '{key}'", expected)
        value = holder[key]
        if not isinstance(value, kind) or isinstance(value, bool):
            self.fail(f"{place}/{key}", value, expected)
        return value

    def natural(self, place, holder, key):
        value = self.key(place, holder, key, int, "an integer of at least 0")
        if value < 0:
            self.fail(f"{place}/{key}", value, "an integer of at least 0")
        return value

    def cell(self, place, holder, key):
        """(cell, heading)"""
        value = self.key(place, holder, key, list, '[x, y] or [x, y, "N"]')
        if value and isinstance(value[0], str):
            self.fail(f"{place}/{key}", value, "[x, y]: cubes drive on grids, not on roadmaps")
        numbers = [n for n in value[:2] if isinstance(n, int) and not isinstance(n, bool) and n >= 0]
        if len(numbers) != 2 or len(value) > 3 or (len(value) == 3 and value[2] not in HEADINGS):
            self.fail(f"{place}/{key}", value, '[x, y] or [x, y, "N"]')
        return tuple(numbers), value[2] if len(value) == 3 else None

    def after(self, place, holder):
        if "after" not in holder:
            return None
        expected = '{"robot": ID, "action": NUMBER}'
        value = self.key(place, holder, "after", dict, expected)
        return (self.key(f"{place}/after", value, "robot", str, expected),
                self.natural(f"{place}/after", value, "action"))

    def action(self, place, holder, before, heading):
        if not isinstance(holder, dict):
            self.fail(place, holder, "an object")
        kind = self.key(place, holder, "do", str, f"one of {', '.join(KINDS)}")
        if kind not in KINDS:
            self.fail(f"{place}/do", kind, f"one of {', '.join(KINDS)}")
        cell = before
        if kind != "work":
            cell, heading = self.cell(place, holder, "to")
            apart = abs(cell[0] - before[0]) + abs(cell[1] - before[1])
            if apart != (1 if kind == "move" else 0):
                self.fail(f"{place}/to", holder["to"], f"a neighbour of {list(before)}" if kind == "move"
                          else f"the cell it is on, {list(before)}")
            if kind == "turn" and heading is None:
                self.fail(f"{place}/to", holder["to"], '[x, y, "N"]')
        ring = self.natural(place, holder, "ring") if "ring" in holder else None
        if ring is not None and kind != "move":
            self.fail(f"{place}/ring", ring, "no ring: only moves are in rings")
        task = self.key(place, holder, "task", str, "the id of a task") if kind == "work" else None
        return Action(kind, cell, heading, self.natural(place, holder, "steps"),
                      self.after(place, holder), ring, task)

    def robot(self, place, holder):
        if not isinstance(holder, dict):
            self.fail(place, holder, "an object")
        name = self.key(place, holder, "id", str, "a text")
        start = cell, heading = self.cell(place, holder, "start")
        actions = []
        for i, each in enumerate(self.key(place, holder, "actions", list, "a list of actions")):
            action = self.action(f"{place}/actions/{i}", each, cell, heading)
            cell, heading = action.cell, action.heading
            actions.append(action)
        return Robot(name, *start, tuple(actions))


def _check_names(reader, robots):
    starts = {}
    for i, robot in enumerate(robots):
        if robot.name in (r.name for r in robots[:i]):
            reader.fail(f"/robots/{i}/id", robot.name, "ids that differ")
        if robot.start in starts:
            reader.fail(f"/robots/{i}/start", list(robot.start), f"another cell than {starts[robot.start]} starts on")
        starts[robot.start] = robot.name


def _check_after(reader, robots):
    counts = {r.name: len(r.actions) for r in robots}
    for i, robot in enumerate(robots):
        for k, action in enumerate(robot.actions):
            if action.after and action.after[0] not in counts:
                reader.fail(f"/robots/{i}/actions/{k}/after/robot", action.after[0], "the id of a robot")
            if action.after and action.after[1] >= counts[action.after[0]]:
                reader.fail(f"/robots/{i}/actions/{k}/after/action", action.after[1],
                            f"one of the {counts[action.after[0]]} actions of {action.after[0]}")


def _follow_each_other(robots, members):
    """The members of a ring, each before the one whose cell it enters; None if they are no ring."""
    leaves = {robots[i].cell_before(k): (i, k) for i, k in members}
    chain = [members[0]]
    while len(chain) <= len(members):
        i, k = chain[-1]
        following = leaves.get(robots[i].actions[k].cell)
        if following == chain[0]:
            break
        if following is None:
            return None
        chain.append(following)
    return chain if len(chain) == len(members) >= 4 else None


def _rings(reader, robots):
    members = {}
    for i, robot in enumerate(robots):
        for k, action in enumerate(robot.actions):
            if action.ring is not None:
                members.setdefault(action.ring, []).append((i, k))
    rings = {}
    for ring, those in members.items():
        rings[ring] = _follow_each_other(robots, those)
        if rings[ring] is None:
            i, k = those[0]
            reader.fail(f"/robots/{i}/actions/{k}/ring", ring,
                        "moves into the cells that the others of the ring leave")
    return rings


def _completable(order):
    """How many actions of each robot are done when none can be begun any more."""
    done = {r.name: 0 for r in order.robots}

    def may(robot, k):
        after = robot.actions[k].after
        return done[robot.name] == k and (after is None or done[after[0]] > after[1])

    moved = True
    while moved:
        moved = False
        for robot in order.robots:
            k = done[robot.name]
            if k == len(robot.actions):
                continue
            ring = robot.actions[k].ring
            those = order.rings[ring] if ring is not None else [(order.robots.index(robot), k)]
            if all(may(order.robots[i], j) for i, j in those):
                for i, _ in those:
                    done[order.robots[i].name] += 1
                moved = True
    return done


def _check_completable(reader, order):
    done = _completable(order)
    for i, robot in enumerate(order.robots):
        if done[robot.name] < len(robot.actions):
            raise at(reader.file, f"/robots/{i}/actions/{done[robot.name]}",
                     "actions that wait for each other in a circle", "an order that can be driven")


def parse_order(file, text):
    reader = _Reader(file)
    try:
        holder = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise at(file, "", "no JSON" + (f" ({error})" if isinstance(error, ValueError) else ""),
                 "what grove execute --order writes") from None
    if not isinstance(holder, dict) or holder.get("format") != FORMAT:
        reader.fail("/format", holder.get("format") if isinstance(holder, dict) else holder, f'"{FORMAT}"')
    those = reader.key("", holder, "robots", list, "a list of robots")
    robots = tuple(reader.robot(f"/robots/{i}", each) for i, each in enumerate(those))
    if not robots:
        reader.fail("/robots", [], "at least one robot")
    _check_names(reader, robots)
    _check_after(reader, robots)
    order = Order(robots, _rings(reader, robots))
    _check_completable(reader, order)
    return order


def read_order(file):
    try:
        with open(file, encoding="utf-8") as stream:
            text = stream.read()
    except OSError as error:
        raise BadInput(f"{file}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise at(file, "", "no UTF-8", "what grove execute --order writes") from None
    return parse_order(file, text)
