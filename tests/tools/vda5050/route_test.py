# SPDX-License-Identifier: MIT
"""Tests the routes made from a passing order: nodes, edges, tasks at nodes, and completed actions."""
import json
import math
import unittest

import air
import orders
from grove_driving.bad_input import BadInput
from grove_driving.order import parse_order, read_order
from grove_vda5050.route import actions_done, check_order, make_route, readable

TURNING = {"format": "grove passing order 1", "robots": [
    {"id": "red one", "start": [0, 0, "E"], "at": [0.5, 1.5], "visits": ["shelf"], "actions": [
        {"do": "move", "to": [1, 0, "E"], "at": [1.5, 1.5], "steps": 1},
        {"do": "work", "task": "press", "steps": 5},
        {"do": "turn", "to": [1, 0, "S"], "steps": 1},
        {"do": "work", "task": "cut", "steps": 2},
        {"do": "move", "to": [1, 1, "S"], "at": [1.5, 0.5], "steps": 1},
        {"do": "turn", "to": [1, 1, "W"], "steps": 1}]}]}


def turning():
    return parse_order("o.json", json.dumps(TURNING)).robots[0]


class Routes(unittest.TestCase):
    def test_route_has_nodes_with_places_and_tasks(self):
        route = make_route(turning(), "red")
        self.assertEqual([n.id for n in route.nodes], ["0_0", "1_0", "1_1"])
        self.assertEqual([n.at for n in route.nodes], [(0.5, 1.5), (1.5, 1.5), (1.5, 0.5)])
        self.assertEqual([[(w.kind, w.task, w.steps) for w in n.node_actions] for n in route.nodes],
                         [[("visit", "shelf", 0)], [("work", "press", 5), ("work", "cut", 2)], []])
        self.assertEqual([n.theta for n in route.nodes], [None, None, math.pi])
        self.assertTrue(route.turns)

    def test_routes_without_headings_have_no_orientation(self):
        for route in air.routes("dense", False).values():
            self.assertFalse(route.turns)
            self.assertEqual({n.theta for n in route.nodes}, {None})

    def test_every_action_and_task_has_a_node(self):
        for name in ("dense", "work", "many", "roads"):
            for robot in air.order(name, False).robots:
                nodes = air.routes(name, False)[robot.name].nodes
                self.assertEqual([n.place for n in nodes],
                                 [robot.start] + [a.place for a in robot.actions if a.kind == "move"])
                covered = [k for n in nodes for k in range(n.begin - (n is not nodes[0]), n.end)]
                self.assertEqual(covered, list(range(len(robot.actions))))
                tasks = [w.task for n in nodes for w in n.node_actions]
                self.assertEqual(sorted(tasks), sorted([a.task for a in robot.actions if a.task] + list(robot.visits) +
                                                       [v for a in robot.actions for v in a.visits]))

    def test_completed_actions_follow_from_nodes_and_tasks(self):
        route = make_route(turning(), "red")
        shelf, press, cut = (w.id for n in route.nodes for w in n.node_actions)
        for reached, finished, done in ((0, [], 0), (0, [shelf], 0), (1, [shelf], 1), (1, [shelf, press], 2),
                                        (1, [shelf, cut], 1), (1, [shelf, press, cut], 4), (2, [], 6)):
            self.assertEqual(actions_done(route, reached, set(finished)), done, (reached, finished))

    def test_ids_are_readable(self):
        self.assertEqual(readable("red one/2"), "red_one_2")
        self.assertEqual(air.routes("roads")["r1"].nodes[1].id, "W:C:1")

    def test_rings_are_refused_by_name(self):
        with self.assertRaises(BadInput) as caught:
            check_order("o.json", read_order(orders.order_file("round")))
        text = str(caught.exception)
        for name in ("a", "b", "c", "d"):
            self.assertRegex(text, rf"ring of .*\b{name}\b")
        self.assertIn("--no-following", text)
        check_order("o.json", read_order(orders.order_file("round", False)))

    def test_orders_without_metres_are_refused(self):
        holder = json.loads(json.dumps(TURNING))
        del holder["robots"][0]["at"]
        with self.assertRaisesRegex(BadInput, "o.json: /robots/0: found no key 'at'"):
            check_order("o.json", parse_order("o.json", json.dumps(holder)))

    def test_ids_that_would_coincide_are_refused(self):
        text = json.dumps({"format": "grove passing order 1", "robots": [
            {"id": r, "start": [vertex], "at": [0, 0], "actions": []} for r, vertex in (("r", "a b"), ("s", "a_b"))]})
        with self.assertRaisesRegex(BadInput, "a_b"):
            check_order("o.json", parse_order("o.json", text))
