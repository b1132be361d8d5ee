# SPDX-License-Identifier: MIT
"""The one who looks on sees planted faults."""
import json
import unittest

from grove_vda5050.protocol import PROTOCOLS, Topics
from grove_vda5050.monitor import Monitor
from vehicle_test import order


class Watching(unittest.TestCase):
    def setUp(self):
        self.topics = Topics(PROTOCOLS["2.1.0"], "uagv", "m")
        self.said = []
        self.monitor = Monitor(self.topics, self.said.append)

    def tell(self, serial, name, message):
        self.monitor.on_message(self.topics.topic(serial, name), message if isinstance(message, bytes)
                              else json.dumps({**message, "serialNumber": serial}).encode())

    def state(self, serial, node, order_id="o"):
        return {"headerId": 0, "timestamp": "2026-01-01T00:00:00.00Z", "version": "2.1.0", "manufacturer": "m",
                "orderId": order_id, "orderUpdateId": 0, "lastNodeId": f"n{node}", "lastNodeSequenceId": 2 * node,
                "driving": False, "operatingMode": "AUTOMATIC", "nodeStates": [], "edgeStates": [], "actionStates": [],
                "errors": [], "batteryState": {"batteryCharge": 50, "charging": False},
                "safetyState": {"eStop": "NONE", "fieldViolation": False}}

    def test_nothing_wrong(self):
        self.tell("a", "order", order(0, 2, 4))
        self.tell("a", "state", self.state("a", 2))
        self.tell("b", "order", order(0, 1, 4))
        self.tell("a", "state", self.state("a", 1))     # an old one
        self.assertEqual((self.said, self.monitor.violations), ([], 0))

    def test_a_place_that_two_may_be_on(self):
        self.tell("a", "order", order(0, 2, 4))
        self.tell("a", "state", self.state("a", 1))
        self.tell("b", "order", order(0, 1, 4))
        self.assertEqual(self.said, ["b: order: n1 is released, but a may still be there"])

    def test_a_node_that_was_not_released(self):
        self.tell("a", "order", order(0, 2, 4))
        self.tell("a", "state", self.state("a", 3))
        self.assertEqual(self.said, ["a: state: is on n3, node 6, which was not released"])

    def test_a_base_that_changes(self):
        self.tell("a", "order", order(0, 2, 4))
        changed = order(1, 3, 4, update=1)
        changed["nodes"][1]["nodeId"] = "elsewhere"
        self.tell("a", "order", changed)
        self.assertEqual(self.said, ["a: order: node 4 was n2 and is elsewhere now"])

    def test_who_comes_late_says_nothing_of_what_was_before(self):
        self.tell("a", "state", self.state("a", 0))
        self.tell("a", "order", order(2, 3, 4, update=1))
        self.tell("a", "state", self.state("a", 1))
        self.assertEqual(self.said, [])
        self.tell("a", "state", self.state("a", 4))
        self.assertEqual(self.said, ["a: state: is on n4, node 8, which was not released"])

    def test_messages_that_are_none(self):
        self.tell("a", "order", b"{")
        broken = order(0, 1, 1)
        broken["nodes"][1]["released"] = "yes"
        self.tell("a", "order", broken)
        other = order(0, 1, 1)
        other["version"] = "1.0.0"
        self.tell("a", "order", other)
        for text, expected in zip(self.said, ("invalid JSON", "/nodes/1/released: 'yes' is not of type 'boolean'",
                                             "header has 1.0.0, a")):
            self.assertIn(expected, text)
        self.assertEqual(self.monitor.violations, 3)
