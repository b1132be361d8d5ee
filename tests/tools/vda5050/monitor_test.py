# SPDX-License-Identifier: MIT
"""Tests that the monitor detects planted faults."""
import json
import unittest

from grove_vda5050.protocol import PROTOCOLS, Topics
from grove_vda5050.monitor import Monitor
from vehicle_test import order


class Watching(unittest.TestCase):
    def setUp(self):
        self.topics = Topics(PROTOCOLS["2.1.0"], "uagv", "m")
        self.reports = []
        self.monitor = Monitor(self.topics, self.reports.append)

    def receive(self, serial, name, message):
        self.monitor.on_message(self.topics.topic(serial, name), message if isinstance(message, bytes)
                              else json.dumps({**message, "serialNumber": serial}).encode())

    def state(self, serial, node, order_id="o"):
        return {"headerId": 0, "timestamp": "2026-01-01T00:00:00.00Z", "version": "2.1.0", "manufacturer": "m",
                "orderId": order_id, "orderUpdateId": 0, "lastNodeId": f"n{node}", "lastNodeSequenceId": 2 * node,
                "driving": False, "operatingMode": "AUTOMATIC", "nodeStates": [], "edgeStates": [], "actionStates": [],
                "errors": [], "batteryState": {"batteryCharge": 50, "charging": False},
                "safetyState": {"eStop": "NONE", "fieldViolation": False}}

    def test_correct_messages_are_accepted(self):
        self.receive("a", "order", order(0, 2, 4))
        self.receive("a", "state", self.state("a", 2))
        self.receive("b", "order", order(0, 1, 4))
        self.receive("a", "state", self.state("a", 1))     # an outdated message
        self.assertEqual((self.reports, self.monitor.violations), ([], 0))

    def test_place_released_to_two_vehicles_is_reported(self):
        self.receive("a", "order", order(0, 2, 4))
        self.receive("a", "state", self.state("a", 1))
        self.receive("b", "order", order(0, 1, 4))
        self.assertEqual(self.reports, ["b: order: n1 is released, but a may still be there"])

    def test_vehicle_on_an_unreleased_node_is_reported(self):
        self.receive("a", "order", order(0, 2, 4))
        self.receive("a", "state", self.state("a", 3))
        self.assertEqual(self.reports, ["a: state: is on n3, node 6, which was not released"])

    def test_changed_base_is_reported(self):
        self.receive("a", "order", order(0, 2, 4))
        changed = order(1, 3, 4, update=1)
        changed["nodes"][1]["nodeId"] = "elsewhere"
        self.receive("a", "order", changed)
        self.assertEqual(self.reports, ["a: order: node 4 was n2 and is elsewhere now"])

    def test_late_monitor_ignores_earlier_nodes(self):
        self.receive("a", "state", self.state("a", 0))
        self.receive("a", "order", order(2, 3, 4, update=1))
        self.receive("a", "state", self.state("a", 1))
        self.assertEqual(self.reports, [])
        self.receive("a", "state", self.state("a", 4))
        self.assertEqual(self.reports, ["a: state: is on n4, node 8, which was not released"])

    def test_malformed_messages_are_reported(self):
        self.receive("a", "order", b"{")
        broken = order(0, 1, 1)
        broken["nodes"][1]["released"] = "yes"
        self.receive("a", "order", broken)
        other = order(0, 1, 1)
        other["version"] = "1.0.0"
        self.receive("a", "order", other)
        for text, expected in zip(self.reports, ("invalid JSON", "/nodes/1/released: 'yes' is not of type 'boolean'",
                                             "header has 1.0.0, a")):
            self.assertIn(expected, text)
        self.assertEqual(self.monitor.violations, 3)
