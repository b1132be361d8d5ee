# SPDX-License-Identifier: MIT
"""Tests order messages against the published schemas."""
import json
import unittest

import air
from grove_vda5050.protocol import PROTOCOLS, Header
from grove_vda5050.monitor import load_validators


def messages(name, version, released=4, shown=7):
    for route in air.routes(name, False).values():
        last = route.last
        yield route, Header(PROTOCOLS[version], "m", route.serial).message(
            air.style(version).order(route, "o", 0, 0, min(released, last), min(shown, last)))


class Messages(unittest.TestCase):
    def test_orders_are_valid_by_the_schemas(self):
        for version in PROTOCOLS:
            validator = load_validators(version)["order"]
            for name in ("dense", "work", "roads"):
                for _, message in messages(name, version):
                    self.assertEqual([e.message for e in validator.iter_errors(message)], [])
                    broken = json.loads(json.dumps(message))
                    del broken["nodes"][0]["released"]
                    self.assertTrue(list(validator.iter_errors(broken)))

    def test_base_is_released_and_horizon_is_not(self):
        for route, message in messages("dense", "2.1.0"):
            nodes, edges = message["nodes"], message["edges"]
            self.assertEqual([n["sequenceId"] for n in nodes], list(range(0, 2 * len(nodes), 2)))
            self.assertEqual([e["sequenceId"] for e in edges], list(range(1, 2 * len(edges), 2)))
            self.assertEqual([n["released"] for n in nodes], [i <= 4 for i in range(len(nodes))])
            self.assertEqual([e["released"] for e in edges], [i < 4 for i in range(len(edges))])
            for i, edge in enumerate(edges):
                self.assertEqual((edge["startNodeId"], edge["endNodeId"]), (nodes[i]["nodeId"], nodes[i + 1]["nodeId"]))
            self.assertLessEqual(len(nodes), 8)
            self.assertEqual(route.nodes[0].id, nodes[0]["nodeId"])

    def test_turns_are_orientations_of_edges(self):
        for version, key, value in (("2.1.0", "rotationAllowed", False),
                                    ("3.0.0", "reachOrientationBeforeEntering", True)):
            for route, message in messages("work", version, 100, 100):
                for edge in message["edges"]:
                    self.assertEqual((edge["orientation"], edge["orientationType"], edge[key]),
                                     (0.0, "TANGENTIAL", value))
                self.assertEqual(["theta" in n["nodePosition"] for n in message["nodes"]],
                                 [False] * route.last + [True])

    def test_works_and_visits_are_actions(self):
        those = [a for _, m in messages("work", "2.1.0", 100, 100) for n in m["nodes"] for a in n["actions"]]
        works = {a["actionId"]: dict((p["key"], p["value"]) for p in a["actionParameters"]) for a in those
                 if a["actionType"] == "work"}
        self.assertTrue(works)
        self.assertTrue(all(p["seconds"] >= 1 and p["task"] for p in works.values()))
        self.assertIn("visit", {a["actionType"] for a in those})

    def test_header_ids_increase(self):
        header = Header(PROTOCOLS["2.1.0"], "m", "s")
        one, other = header.message({}), header.message({})
        self.assertEqual((one["headerId"], other["headerId"], one["version"]), (0, 1, "2.1.0"))
        self.assertRegex(one["timestamp"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z$")
