# SPDX-License-Identifier: MIT
"""Reads passing orders, as `grove execute --order` writes them (docs/passing-order.md)."""
import json
from typing import NamedTuple

from .bad_input import BadInput, at

FORMAT = "grove passing order 1"
HEADINGS = ("N", "E", "S", "W")
KINDS = ("move", "turn", "work")


class Action(NamedTuple):
    kind: str
    place: tuple            # place after the action: cell (x, y); on roadmaps ("A",) or ("A", "B", k)
    heading: str            # heading after the action ("N", "E", "S", "W") or None
    at: tuple               # centre of that place, (x, y) in metres with y up; None if not in the file
    steps: int              # planned duration, time steps
    after: tuple            # (robot, action) that must be done before this action starts, or None
    ring: int               # ring of which the action is a part, or None
    task: str               # task of a "work" action, or None
    visits: tuple           # tasks without duration that the robot first visits by this action


class Robot(NamedTuple):
    name: str
    start: tuple
    heading: str
    at: tuple
    visits: tuple           # tasks without duration on its start
    actions: tuple

    def place_before(self, action):
        return self.actions[action - 1].place if action else self.start


class Order(NamedTuple):
    robots: tuple
    rings: dict             # {ring: [(robot, action) as indices]}; each enters the place that the next one leaves

    def robot(self, name):
        return next(r for r in self.robots if r.name == name)


def _is_number(value, kinds=int):
    return isinstance(value, kinds) and not isinstance(value, bool)


def is_cell(place):
    return not isinstance(place[0], str)


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

    def place(self, where, holder, key):
        """Reads a place and returns (place, heading)."""
        expected = '[x, y], [x, y, "N"], ["A"] or ["A", "B", k]'
        value = self.key(where, holder, key, list, expected)
        vertices = [v for v in value[:2] if isinstance(v, str)]
        if len(value) in (2, 3, 5) and all(_is_number(n) and n >= 0 for n in value[:2]) and \
                all(h in HEADINGS for h in value[2:4]):
            return tuple(value[:2]), value[2] if len(value) == 3 else None
        if (len(value) == len(vertices) == 1) or (len(value) in (3, 4) and len(vertices) == 2 and
                                                  all(_is_number(n) for n in value[2:])):
            return tuple(value), None
        return self.fail(f"{where}/{key}", value, expected)

    def at(self, where, holder):
        if "at" not in holder:
            return None
        value = self.key(where, holder, "at", list, "[x, y] in metres")
        if len(value) != 2 or not all(_is_number(n, (int, float)) and abs(n) < 1e9 for n in value):
            self.fail(f"{where}/at", value, "[x, y] in metres")
        return tuple(value)

    def visits(self, where, holder):
        expected = "a list of the ids of tasks"
        value = self.key(where, holder, "visits", list, expected) if "visits" in holder else []
        if not all(isinstance(task, str) for task in value):
            self.fail(f"{where}/visits", value, expected)
        return tuple(value)

    def after(self, place, holder):
        if "after" not in holder:
            return None
        expected = '{"robot": ID, "action": NUMBER}'
        value = self.key(place, holder, "after", dict, expected)
        return (self.key(f"{place}/after", value, "robot", str, expected),
                self.natural(f"{place}/after", value, "action"))

    def next_place(self, where, holder, kind, before):
        """Reads the place and heading after a move or turn and returns (place, heading)."""
        place, heading = self.place(where, holder, "to")
        if kind == "turn" and heading is None:
            self.fail(f"{where}/to", holder["to"], '[x, y, "N"]')
        if kind == "turn" and place != before:
            self.fail(f"{where}/to", holder["to"], f"the cell it is on, {list(before)}")
        if kind == "move" and (place == before or is_cell(place) != is_cell(before) or
                               (is_cell(place) and sum(abs(a - b) for a, b in zip(place, before)) != 1)):
            self.fail(f"{where}/to", holder["to"], f"a neighbour of {json.dumps(before)}")
        return place, heading

    def action(self, where, holder, before, heading, at_before):
        if not isinstance(holder, dict):
            self.fail(where, holder, "an object")
        kind = self.key(where, holder, "do", str, f"one of {', '.join(KINDS)}")
        if kind not in KINDS:
            self.fail(f"{where}/do", kind, f"one of {', '.join(KINDS)}")
        place = before
        if kind != "work":
            place, heading = self.next_place(where, holder, kind, before)
        ring = self.natural(where, holder, "ring") if "ring" in holder else None
        if ring is not None and kind != "move":
            self.fail(f"{where}/ring", ring, "no ring, because only moves are in rings")
        task = self.key(where, holder, "task", str, "the id of a task") if kind == "work" else None
        return Action(kind, place, heading, self.at(where, holder) if kind == "move" else at_before,
                      self.natural(where, holder, "steps"), self.after(where, holder), ring, task,
                      self.visits(where, holder))

    def robot(self, where, holder):
        if not isinstance(holder, dict):
            self.fail(where, holder, "an object")
        name = self.key(where, holder, "id", str, "a text")
        start = place, heading = self.place(where, holder, "start")
        first = at = self.at(where, holder)
        actions = []
        for i, each in enumerate(self.key(where, holder, "actions", list, "a list of actions")):
            action = self.action(f"{where}/actions/{i}", each, place, heading, at)
            place, heading, at = action.place, action.heading, action.at
            actions.append(action)
        return Robot(name, *start, first, self.visits(where, holder), tuple(actions))


def _check_names(reader, robots):
    starts = {}
    for i, robot in enumerate(robots):
        if robot.name in (r.name for r in robots[:i]):
            reader.fail(f"/robots/{i}/id", robot.name, "ids that differ")
        if robot.start in starts:
            reader.fail(f"/robots/{i}/start", list(robot.start),
                        f"a start that differs from that of {starts[robot.start]}")
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
    """Returns the members of a ring, sorted so that each enters the place that the next one leaves.

    Returns None if they do not form a single ring of at least three members.
    """
    leaves = {robots[i].place_before(k): (i, k) for i, k in members}
    chain = [members[0]]
    while len(chain) <= len(members):
        i, k = chain[-1]
        following = leaves.get(robots[i].actions[k].place)
        if following == chain[0]:
            break
        if following is None:
            return None
        chain.append(following)
    return chain if len(chain) == len(members) >= 3 else None


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
                        "moves into the places that the others of the ring leave")
    return rings


def _completable(order):
    """Simulates actions until no further action can start. Returns {robot: number of its completed actions}."""
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
                     "actions that wait for each other in a cycle", "an order without such a cycle")


def parse_order(file, text):
    reader = _Reader(file)
    try:
        holder = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise at(file, "", "invalid JSON" + (f" ({error})" if isinstance(error, ValueError) else ""),
                 "the output of grove execute --order") from None
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
        raise at(file, "", "invalid UTF-8", "the output of grove execute --order") from None
    return parse_order(file, text)
