# SPDX-License-Identifier: MIT
"""A robot's part of the passing order as nodes, edges and actions of VDA 5050.

Each place that the robot is on is a node, each move an edge. What it does on a place, before it moves on,
are actions of that node: work and visits. They wait for nobody - only moves do - so who may go to a node may do
all that is to be done there. Turns are no actions, VDA 5050 has none: a robot with headings has on each edge
`orientation` 0, tangential, to be taken on the node before; and on its last node `theta`, the heading
in which it ends.

Nodes have the even sequence numbers, edges the odd ones, as the interface wants it."""
import math
from typing import NamedTuple

from grove_driving.bad_input import at
from grove_driving.order import is_cell

THETA = {"E": 0.0, "N": math.pi / 2, "W": math.pi, "S": -math.pi / 2}  # radians
ALLOWED = set("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.:")


class Work(NamedTuple):
    id: str
    kind: str               # work or visit
    task: str
    steps: int


class Node(NamedTuple):
    id: str
    place: tuple            # as the order has it
    at: tuple               # metres
    begin: int              # of the actions of the order that are done on it: the first,
    end: int                # and the one after the last
    works: tuple            # what is done on it, in turn
    works_at: tuple         # by action from begin to end: how many of the works are done by its end
    theta: float            # in which it ends there; None: it goes on, or has no headings


class Route(NamedTuple):
    robot: str
    serial: str
    nodes: tuple
    turns: bool             # has headings

    @property
    def last(self):
        return len(self.nodes) - 1


def readable(text):
    """With the characters alone that the interface recommends for ids."""
    return "".join(c if c in ALLOWED else "_" for c in text)


def node_id(place):
    return f"{place[0]}_{place[1]}" if is_cell(place) else ":".join(readable(str(part)) for part in place)


def _works(number, visits, actions):
    """What is done on a node, and by action how much of that its end means."""
    those = [("visit", task, 0) for task in visits]
    done = []
    for action in actions:
        if action.kind == "work":
            those.append(("work", action.task, action.steps))
        done.append(len(those))
    return tuple(Work(f"{number}.{i}-{readable(those[i][1])}", *those[i]) for i in range(len(those))), tuple(done)


def make_route(robot, serial):
    moves = [k for k, action in enumerate(robot.actions) if action.kind == "move"]
    headings = [robot.heading] + [a.heading for a in robot.actions if a.kind != "work"]
    nodes = []
    for number, (arrival, end) in enumerate(zip([-1] + moves, moves + [len(robot.actions)])):
        there = robot if arrival < 0 else robot.actions[arrival]
        works, done = _works(number, there.visits, robot.actions[arrival + 1:end])
        place = robot.start if arrival < 0 else there.place
        is_last = end == len(robot.actions)
        nodes.append(Node(node_id(place), place, there.at, arrival + 1, end, works, done,
                          THETA[headings[-1]] if is_last and headings[-1] else None))
    return Route(robot.name, serial, tuple(nodes), headings[-1] is not None)


def actions_done(route, reached, finished):
    """How many actions of the order a vehicle has completed that has reached a node and finished those works.
    Turns on the way are known when what comes after them is."""
    node = route.nodes[reached]
    count = 0
    while count < len(node.works) and node.works[count].id in finished:
        count += 1
    if reached == route.last and count == len(node.works):
        return node.end
    done = node.begin
    for k, needed in enumerate(node.works_at):
        works = needed - (node.works_at[k - 1] if k else 0)
        if works and needed <= count:
            done = node.begin + k + 1
    return done


def check_order(file, order):
    """That vehicles can drive it."""
    places = {}
    for i, robot in enumerate(order.robots):
        if robot.at is None or any(action.at is None for action in robot.actions):
            raise at(file, f"/robots/{i}", "no key 'at'", "places in metres, as grove execute --order writes them")
        for k, action in enumerate(robot.actions):
            if action.ring is not None:
                names = ", ".join(order.robots[j].name for j, _ in order.rings[action.ring])
                raise at(file, f"/robots/{i}/actions/{k}/ring", f"a ring of {names}, that move all at once",
                         "no rings: vehicles drive each at its own pace (grove solve --no-following makes plans "
                         "without)")
        for place in [robot.start] + [a.place for a in robot.actions]:
            if places.setdefault(node_id(place), place) != place:
                raise at(file, f"/robots/{i}", f"the places {list(places[node_id(place)])} and {list(place)}",
                         f"names that differ; as nodes both would be {node_id(place)}")
