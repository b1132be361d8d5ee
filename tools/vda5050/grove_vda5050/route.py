# SPDX-License-Identifier: MIT
"""Converts a robot's part of the passing order to nodes, edges and actions of VDA 5050.

Each place of the robot becomes a node, and each move an edge. Task executions and visits on a place before the next
move become actions of its node. They do not wait for other robots (only moves do), so a vehicle that may drive to a
node may do all actions there. Turns do not become actions, because VDA 5050 has no action for them. Instead, each edge
of a robot with headings has `orientation` 0 (tangential), which the vehicle must reach on the node before the edge, and
the last node has the final heading as `theta`.

Nodes have even and edges odd sequence numbers, as VDA 5050 requires.
"""
import math
from typing import NamedTuple

from grove_driving.bad_input import at
from grove_driving.order import is_cell

THETA = {"E": 0.0, "N": math.pi / 2, "W": math.pi, "S": -math.pi / 2}  # radians
ALLOWED = set("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-.:")


class NodeAction(NamedTuple):
    id: str
    kind: str               # "work" (task with duration) or "visit"
    task: str
    steps: int


class Node(NamedTuple):
    id: str
    place: tuple            # place in the passing order
    at: tuple               # (x, y) in metres
    begin: int              # index of the first action of the passing order that is done on the node
    end: int                # index after that of the last such action
    node_actions: tuple     # VDA 5050 actions on the node, in order
    done_after: tuple       # for each action from begin to end, the number of node actions done after it
    theta: float            # final heading, radians; None if it is not the last node, or without headings


class Route(NamedTuple):
    robot: str
    serial: str
    nodes: tuple
    turns: bool             # whether the robot has headings

    @property
    def last(self):
        return len(self.nodes) - 1


def readable(text):
    """Replaces characters that VDA 5050 does not recommend for ids."""
    return "".join(c if c in ALLOWED else "_" for c in text)


def node_id(place):
    return f"{place[0]}_{place[1]}" if is_cell(place) else ":".join(readable(str(part)) for part in place)


def _node_actions(number, visits, actions):
    """Returns (actions of a node, number of them done after each of its passing-order actions)."""
    those = [("visit", task, 0) for task in visits]
    done = []
    for action in actions:
        if action.kind == "work":
            those.append(("work", action.task, action.steps))
        done.append(len(those))
    return tuple(NodeAction(f"{number}.{i}-{readable(those[i][1])}", *those[i]) for i in range(len(those))), tuple(done)


def make_route(robot, serial):
    moves = [k for k, action in enumerate(robot.actions) if action.kind == "move"]
    headings = [robot.heading] + [a.heading for a in robot.actions if a.kind != "work"]
    nodes = []
    for number, (arrival, end) in enumerate(zip([-1] + moves, moves + [len(robot.actions)])):
        there = robot if arrival < 0 else robot.actions[arrival]
        node_actions, done = _node_actions(number, there.visits, robot.actions[arrival + 1:end])
        place = robot.start if arrival < 0 else there.place
        is_last = end == len(robot.actions)
        nodes.append(Node(node_id(place), place, there.at, arrival + 1, end, node_actions, done,
                          THETA[headings[-1]] if is_last and headings[-1] else None))
    return Route(robot.name, serial, tuple(nodes), headings[-1] is not None)


def actions_done(route, reached, finished):
    """Returns the number of passing-order actions that a vehicle has completed.

    reached: last node that it reached. finished: ids of its finished node actions. A turn counts as completed as soon
    as a later node action is finished or a later node is reached; on the last node, also when all node actions are
    finished.
    """
    node = route.nodes[reached]
    count = 0
    while count < len(node.node_actions) and node.node_actions[count].id in finished:
        count += 1
    if reached == route.last and count == len(node.node_actions):
        return node.end
    done = node.begin
    for k, needed in enumerate(node.done_after):
        added = needed - (node.done_after[k - 1] if k else 0)
        if added and needed <= count:
            done = node.begin + k + 1
    return done


def check_order(file, order):
    """Raises BadInput if vehicles cannot drive along the order."""
    places = {}
    for i, robot in enumerate(order.robots):
        if robot.at is None or any(action.at is None for action in robot.actions):
            raise at(file, f"/robots/{i}", "no key 'at'", "places in metres, from grove execute --order")
        for k, action in enumerate(robot.actions):
            if action.ring is not None:
                names = ", ".join(order.robots[j].name for j, _ in order.rings[action.ring])
                raise at(file, f"/robots/{i}/actions/{k}/ring", f"a ring of {names}, which move at the same time",
                         "no rings, because each vehicle drives at its own pace (grove solve --no-following makes "
                         "plans without rings)")
        for place in [robot.start] + [a.place for a in robot.actions]:
            if places.setdefault(node_id(place), place) != place:
                raise at(file, f"/robots/{i}", f"the places {list(places[node_id(place)])} and {list(place)}",
                         f"places with different node ids; both would be {node_id(place)}")
