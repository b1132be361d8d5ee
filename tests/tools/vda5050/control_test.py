# SPDX-License-Identifier: MIT
"""Tests complete executions in virtual time: despite delayed and lost messages no vehicles meet and all tasks are
done."""
import os
import unittest

import air
from grove_vda5050.release import Releases

FACTOR = int(os.environ.get("GROVE_FUZZ_FACTOR", "1"))
NAMES = ("dense", "work", "many", "narrow", "roads", "round")


class _Eager(Releases):
    """Releases too early, by waiting for one action too few."""

    def waits_for(self, name):
        after = super().waits_for(name)
        return after if after and self.done[after[0]] < after[1] else None


class Drives(unittest.TestCase):
    def check(self, one):
        self.assertTrue(one.drive(), list(one.control.reasons()))
        self.assertEqual((one.reports, one.world.collisions), ([], []))
        done = {(v.route.robot, w.id)
                for v in one.control.vehicles.values() for n in v.route.nodes for w in n.node_actions}
        finished = {(robot, k) for robot, v in one.vehicles.items() for k, s in v.action_states.items()
                    if s[1] == "FINISHED"}
        self.assertEqual(done, finished)

    def test_drive_without_disturbances_is_completed(self):
        for name in NAMES:
            for version in ("2.1.0", "3.0.0"):
                one = air.Air(name, False, version)
                self.check(one)
                self.assertEqual(sum(v.refused for v in one.vehicles.values()), 0)
                self.assertEqual(one.control.resent, 0)

    def test_drive_with_late_and_lost_messages_is_completed(self):
        for name in NAMES:
            for seed in range(2 * FACTOR):
                self.check(air.Air(name, False, delayed=0.3, lost=0.2, seed=seed, base=1 + seed % 7,
                                   horizon=seed % 4))

    def test_drive_with_stopping_vehicles_is_completed(self):
        calm = air.Air("dense", False)
        self.check(calm)
        late = air.Air("dense", False, stops={"a0": (2, 90), "a3": (5, 60)})
        self.check(late)
        self.assertGreater(late.now, max(90, calm.now))

    def test_reasons_name_a_vehicle_that_stops_for_good(self):
        one = air.Air("dense", False, stops={"a1": (3, 1e9)})
        self.assertFalse(one.drive(300))
        self.assertEqual((one.reports, one.world.collisions), ([], []))
        reasons = list(one.control.reasons())
        self.assertTrue(any(r.startswith("a1 is between ") for r in reasons), reasons)
        for reason in reasons:
            self.assertRegex(reason, r"^a\d (is between \S+ and \S+|on \S+ waits for a\d)$")

    def test_reasons_name_a_vehicle_that_refuses_its_order(self):
        one = air.Air("dense", False)
        one.vehicles["a2"].x += 1
        self.assertFalse(one.drive(200))
        self.assertTrue(any("a2 has not accepted its order" in r and "orderError" in r for r in one.control.reasons()))

    def test_bases_are_at_most_as_long_as_allowed(self):
        one = air.Air("many", False, base=3, horizon=2)
        longest = []
        send = one.control.send

        def check_and_send(robot, content):
            vehicle = one.control.vehicles[robot]
            nodes = [n for n in content["nodes"] if n["released"]]
            longest.append(nodes[-1]["sequenceId"] // 2 - max(vehicle.reached, 0))
            self.assertLessEqual(len(content["nodes"]) - len(nodes), 2)
            send(robot, content)
        one.control.send = check_and_send
        self.check(one)
        self.assertEqual(max(longest), 3)

    def test_too_early_releases_are_detected(self):
        detected = 0
        for name in NAMES:
            one = air.Air(name, False, releases=_Eager, base=100)
            one.drive(300)
            detected += bool(one.reports)
        self.assertGreaterEqual(detected, 3)
