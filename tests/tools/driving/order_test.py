# SPDX-License-Identifier: MIT
"""Tests the reader of passing orders: the parsed values, and the position named in each error message."""
import copy
import json
import unittest

import orders
from grove_driving.bad_input import BadInput
from grove_driving.order import parse_order, read_order

GOOD = {"format": "grove passing order 1",
        "robots": [{"id": "red", "start": [0, 0], "actions": [
                       {"do": "move", "to": [1, 0], "steps": 1, "planned": 0},
                       {"do": "work", "task": "press", "steps": 5, "planned": 1}]},
                   {"id": "blue", "start": [2, 0, "W"], "actions": [
                       {"do": "turn", "to": [2, 0, "N"], "steps": 1, "planned": 0,
                        "after": {"robot": "red", "action": 1}}]}]}


def read(holder):
    return parse_order("o.json", holder if isinstance(holder, str) else json.dumps(holder))


class Reading(unittest.TestCase):
    def test_order_is_read(self):
        red, blue = read(GOOD).robots
        self.assertEqual((red.name, red.start, red.heading, blue.heading), ("red", (0, 0), None, "W"))
        self.assertEqual([a.kind for a in red.actions + blue.actions], ["move", "work", "turn"])
        self.assertEqual((red.actions[1].place, red.actions[1].task, red.actions[1].steps), ((1, 0), "press", 5))
        self.assertEqual((blue.actions[0].heading, blue.actions[0].after), ("N", ("red", 1)))

    def test_members_of_a_ring_are_sorted(self):
        order = read_order(orders.order_file("round"))
        (members,) = order.rings.values()
        self.assertEqual(len(members), 4)
        for (i, k), (j, m) in zip(members, members[1:] + members[:1]):
            self.assertEqual(order.robots[i].actions[k].place, order.robots[j].place_before(m))

    def test_order_on_a_roadmap_is_read(self):
        one, other = read_order(orders.order_file("roads")).robots
        self.assertEqual((one.start, one.at, one.actions[0].place), (("W",), (0, 0), ("W", "C", 1)))
        self.assertEqual([a.task for r in (one, other) for a in r.actions if a.kind == "work"], ["press", "press"])
        self.assertEqual([a.visits for a in other.actions if a.visits], [("look",)])

    def test_all_kinds_of_actions_are_read(self):
        kinds = {a.kind for name in ("dense", "work", "round") for r in read_order(orders.order_file(name)).robots
                 for a in r.actions}
        self.assertEqual(kinds, {"move", "turn", "work"})

    def refuse(self, change, place, *texts):
        holder = copy.deepcopy(GOOD)
        change(holder, holder["robots"][0], holder["robots"][0]["actions"])
        with self.assertRaises(BadInput) as caught:
            read(holder)
        text = str(caught.exception)
        self.assertTrue(text.startswith(f"o.json: {place}: found "), text)
        for each in ("; expected ", *texts):
            self.assertIn(each, text)
        self.assertNotIn("\n", text)

    def test_malformed_orders_are_refused(self):
        self.refuse(lambda o, r, a: o.update(format="x"), "/format")
        self.refuse(lambda o, r, a: o.update(robots=[]), "/robots")
        self.refuse(lambda o, r, a: o.update(robots=[3]), "/robots/0")
        self.refuse(lambda o, r, a: r.update(id="blue"), "/robots/1/id", "differ")
        self.refuse(lambda o, r, a: r.update(start=[3, 0]), "/robots/0/actions/0/to")
        self.refuse(lambda o, r, a: r.update(start=["gate"]), "/robots/0/actions/0/to", "neighbour")
        self.refuse(lambda o, r, a: r.update(start=["gate", "hall"]), "/robots/0/start")
        self.refuse(lambda o, r, a: r.update(at=[1]), "/robots/0/at", "metres")
        self.refuse(lambda o, r, a: a[0].update(at=[1, "x"]), "/robots/0/actions/0/at", "metres")
        self.refuse(lambda o, r, a: a[0].update(visits=[1]), "/robots/0/actions/0/visits", "ids of tasks")
        self.refuse(lambda o, r, a: r.update(start=[0, -1]), "/robots/0/start")
        self.refuse(lambda o, r, a: r.update(start=[0, 0, "Q"]), "/robots/0/start")
        self.refuse(lambda o, r, a: r.pop("actions"), "/robots/0", "no key 'actions'")
        self.refuse(lambda o, r, a: a[0].update(do="fly"), "/robots/0/actions/0/do", "move, turn, work")
        self.refuse(lambda o, r, a: a[0].update(to=[1, 1]), "/robots/0/actions/0/to", "neighbour")
        self.refuse(lambda o, r, a: a[0].update(ring=3), "/robots/0/actions/0/ring")
        self.refuse(lambda o, r, a: a[0].update(steps=True), "/robots/0/actions/0/steps")
        self.refuse(lambda o, r, a: a[0].update(steps=-1), "/robots/0/actions/0/steps")
        self.refuse(lambda o, r, a: a[1].pop("task"), "/robots/0/actions/1", "no key 'task'")
        self.refuse(lambda o, r, a: a[1].update(ring=3), "/robots/0/actions/1/ring")
        self.refuse(lambda o, r, a: a[0].update(after={"robot": "x", "action": 0}), "/robots/0/actions/0/after/robot")
        self.refuse(lambda o, r, a: a[0].update(after={"robot": "blue", "action": 1}),
                   "/robots/0/actions/0/after/action", "1 actions of blue")
        self.refuse(lambda o, r, a: a[0].update(after=4), "/robots/0/actions/0/after")
        self.refuse(lambda o, r, a: o["robots"][1].update(start=[0, 0]), "/robots/1/actions/0/to")

    def test_cyclic_waits_are_refused(self):
        self.refuse(lambda o, r, a: a[0].update(after={"robot": "blue", "action": 0}), "/robots/0/actions/0", "cycle")

    def test_invalid_json_is_refused(self):
        for text in ("", "{", "[" * 100000, "[]", "null"):
            with self.assertRaises(BadInput):
                read(text)
