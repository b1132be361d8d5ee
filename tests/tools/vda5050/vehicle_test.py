# SPDX-License-Identifier: MIT
"""Tests the simulated vehicle: which orders it accepts and refuses, and that it stops at the end of its base."""
import copy
import math
import unittest

import air
from grove_vda5050.fleet import World
from grove_vda5050.protocol import PROTOCOLS, Header
from grove_vda5050.vehicle import SimulatedVehicle

NODES = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (2.0, 2.0)]


def order(first, released, shown, order_id="o", update=0, works=()):
    nodes = [{"nodeId": f"n{i}", "sequenceId": 2 * i, "released": i <= released,
              "nodePosition": {"x": NODES[i][0], "y": NODES[i][1], "mapId": "hall"},
              "actions": [{"actionId": f"w{i}", "actionType": "work", "blockingType": "HARD",
                           "actionParameters": [{"key": "seconds", "value": 2}]}] if i in works else []}
             for i in range(first, shown + 1)]
    edges = [{"edgeId": f"e{i}", "sequenceId": 2 * i + 1, "released": i < released, "startNodeId": f"n{i}",
              "endNodeId": f"n{i + 1}", "actions": []} for i in range(first, shown)]
    return Header(PROTOCOLS["2.1.0"], "m", "v").message({"orderId": order_id, "orderUpdateId": update, "nodes": nodes,
                                                        "edges": edges})


class Vehicle(unittest.TestCase):
    def setUp(self):
        self.make("2.1.0")

    def make(self, version):
        self.states = []
        self.vehicle = SimulatedVehicle(PROTOCOLS[version], "v", "m", "v", NODES[0], 0.0, World(1.0),
                                        lambda topic, message: self.states.append(message), 1.0, math.pi)

    def at(self):
        return round(self.vehicle.x, 6), round(self.vehicle.y, 6)

    def error(self):
        return self.states[-1]["errors"][0]["errorType"] if self.states[-1]["errors"] else None

    def test_vehicle_drives_to_the_end_of_its_base(self):
        self.vehicle.receive(order(0, 2, 4))
        for _ in range(100):
            self.vehicle.tick(0.1)
        self.assertEqual(self.at(), NODES[2])
        self.assertTrue(self.states[-1]["newBaseRequest"])
        self.assertEqual([n["nodeId"] for n in self.states[-1]["nodeStates"]], ["n3", "n4"])
        self.vehicle.receive(order(2, 4, 4, update=1))
        for _ in range(100):
            self.vehicle.tick(0.1)
        self.assertEqual((self.at(), self.states[-1]["lastNodeSequenceId"], self.states[-1]["nodeStates"]),
                         (NODES[4], 8, []))

    def test_vehicle_works_at_nodes_with_actions(self):
        self.vehicle.receive(order(0, 2, 2, works=(1,)))
        self.vehicle.tick(2.0)
        self.assertEqual((self.at(), self.states[-1]["actionStates"][0]["actionStatus"]), (NODES[1], "RUNNING"))
        self.vehicle.tick(1.5)
        self.assertEqual((self.at(), self.states[-1]["actionStates"][0]["actionStatus"]), ((1.5, 0.0), "FINISHED"))

    def test_new_horizon_replaces_the_old_one(self):
        self.vehicle.receive(order(0, 1, 4, works=(3,)))
        self.vehicle.receive(order(1, 2, 2, update=1))
        self.assertEqual([n["nodeId"] for n in self.states[-1]["nodeStates"]], ["n1", "n2"])
        self.assertEqual(self.states[-1]["actionStates"], [])

    def test_wrong_orders_are_refused(self):
        for version, busy, outdated, gap, far, malformed in (
                ("2.1.0", "orderError", "orderUpdateError", "orderUpdateError", "orderError", "validationError"),
                ("3.0.0", "OTHER_ORDER_ACTIVE", "OUTDATED_ORDER_UPDATE", "VALIDATION_FAILURE",
                 "START_NODE_OUT_OF_RANGE",
                 "VALIDATION_FAILURE")):
            self.make(version)
            self.vehicle.receive(order(2, 3, 3))
            self.assertEqual((self.error(), self.states[-1]["orderId"]), (far, ""))
            self.vehicle.receive(order(0, 2, 4, update=1))
            self.assertIsNone(self.error())
            for message, kind in ((order(0, 2, 3, "other"), busy), (order(1, 3, 4, update=2), gap),
                                  (order(3, 4, 4, update=2), gap), (order(2, 4, 4, update=0), outdated),
                                  ({"nodes": 3}, malformed), (None, malformed), ([], malformed)):
                self.vehicle.receive(message)
                self.assertEqual(self.error(), kind, message)
                self.assertEqual((self.states[-1]["orderUpdateId"], len(self.states[-1]["nodeStates"])), (1, 4))
            self.vehicle.receive(order(2, 4, 4, update=2))
            self.assertIsNone(self.error())
            self.assertEqual(self.vehicle.refused, 8)

    def test_repeated_order_is_ignored(self):
        message = order(0, 2, 4)
        self.vehicle.receive(message)
        self.vehicle.receive(copy.deepcopy(message))
        self.assertEqual((self.error(), len(self.states[-1]["nodeStates"])), (None, 4))

    def test_completed_order_can_be_extended(self):
        self.vehicle.receive(order(0, 1, 1))
        self.vehicle.tick(5)
        self.vehicle.receive(order(1, 3, 3, update=1))
        self.vehicle.tick(5)
        self.assertEqual(self.at(), NODES[3])

    def test_states_are_valid_by_the_schemas(self):
        for version in PROTOCOLS:
            one = air.Air("work", False, version)
            self.assertTrue(one.drive())
            self.assertEqual(one.reports, [])
            self.assertGreater(one.monitor.messages["state"], 100)
