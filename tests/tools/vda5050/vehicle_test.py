# SPDX-License-Identifier: MIT
"""The simulated vehicle: what it takes, what it refuses, and that it never leaves its base."""
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
        self.said = []
        self.vehicle = SimulatedVehicle(PROTOCOLS[version], "v", "m", "v", NODES[0], 0.0, World(1.0),
                                        lambda topic, message: self.said.append(message), 1.0, math.pi)

    def at(self):
        return round(self.vehicle.x, 6), round(self.vehicle.y, 6)

    def error(self):
        return self.said[-1]["errors"][0]["errorType"] if self.said[-1]["errors"] else None

    def test_it_drives_to_the_end_of_its_base(self):
        self.vehicle.receive(order(0, 2, 4))
        for _ in range(100):
            self.vehicle.tick(0.1)
        self.assertEqual(self.at(), NODES[2])
        self.assertTrue(self.said[-1]["newBaseRequest"])
        self.assertEqual([n["nodeId"] for n in self.said[-1]["nodeStates"]], ["n3", "n4"])
        self.vehicle.receive(order(2, 4, 4, update=1))
        for _ in range(100):
            self.vehicle.tick(0.1)
        self.assertEqual((self.at(), self.said[-1]["lastNodeSequenceId"], self.said[-1]["nodeStates"]), (NODES[4], 8, []))

    def test_on_its_way_it_works_where_it_is_told(self):
        self.vehicle.receive(order(0, 2, 2, works=(1,)))
        self.vehicle.tick(2.0)
        self.assertEqual((self.at(), self.said[-1]["actionStates"][0]["actionStatus"]), (NODES[1], "RUNNING"))
        self.vehicle.tick(1.5)
        self.assertEqual((self.at(), self.said[-1]["actionStates"][0]["actionStatus"]), ((1.5, 0.0), "FINISHED"))

    def test_a_new_horizon_replaces_the_old_one(self):
        self.vehicle.receive(order(0, 1, 4, works=(3,)))
        self.vehicle.receive(order(1, 2, 2, update=1))
        self.assertEqual([n["nodeId"] for n in self.said[-1]["nodeStates"]], ["n1", "n2"])
        self.assertEqual(self.said[-1]["actionStates"], [])

    def test_refusals(self):
        for version, busy, outdated, gap, far, malformed in (
                ("2.1.0", "orderError", "orderUpdateError", "orderUpdateError", "orderError", "validationError"),
                ("3.0.0", "OTHER_ORDER_ACTIVE", "OUTDATED_ORDER_UPDATE", "VALIDATION_FAILURE", "START_NODE_OUT_OF_RANGE",
                 "VALIDATION_FAILURE")):
            self.make(version)
            self.vehicle.receive(order(2, 3, 3))
            self.assertEqual((self.error(), self.said[-1]["orderId"]), (far, ""))
            self.vehicle.receive(order(0, 2, 4, update=1))
            self.assertIsNone(self.error())
            for message, kind in ((order(0, 2, 3, "other"), busy), (order(1, 3, 4, update=2), gap),
                                  (order(3, 4, 4, update=2), gap), (order(2, 4, 4, update=0), outdated),
                                  ({"nodes": 3}, malformed), (None, malformed), ([], malformed)):
                self.vehicle.receive(message)
                self.assertEqual(self.error(), kind, message)
                self.assertEqual((self.said[-1]["orderUpdateId"], len(self.said[-1]["nodeStates"])), (1, 4))
            self.vehicle.receive(order(2, 4, 4, update=2))
            self.assertIsNone(self.error())
            self.assertEqual(self.vehicle.refused, 8)

    def test_what_it_has_already_is_passed_over(self):
        message = order(0, 2, 4)
        self.vehicle.receive(message)
        self.vehicle.receive(copy.deepcopy(message))
        self.assertEqual((self.error(), len(self.said[-1]["nodeStates"])), (None, 4))

    def test_an_order_that_was_done_goes_on(self):
        self.vehicle.receive(order(0, 1, 1))
        self.vehicle.tick(5)
        self.vehicle.receive(order(1, 3, 3, update=1))
        self.vehicle.tick(5)
        self.assertEqual(self.at(), NODES[3])

    def test_states_are_as_the_schemas_want_them(self):
        for version in PROTOCOLS:
            one = air.Air("work", False, version)
            self.assertTrue(one.drive())
            self.assertEqual(one.complaints, [])
            self.assertGreater(one.monitor.messages["state"], 100)
