# SPDX-License-Identifier: MIT
"""Whole drives, in virtual time: whatever happens to messages, nobody meets and everything is done."""
import os
import unittest

import air
from grove_vda5050.release import Releases

FACTOR = int(os.environ.get("GROVE_FUZZ_FACTOR", "1"))
NAMES = ("crowd", "work", "many", "narrow", "roads", "round")


class _Eager(Releases):
    """Wrong: does not wait for the last of what it has to."""

    def waits_for(self, name):
        after = super().waits_for(name)
        return after if after and self.done[after[0]] < after[1] else None


class Drives(unittest.TestCase):
    def check(self, one):
        self.assertTrue(one.drive(), list(one.control.reasons()))
        self.assertEqual((one.complaints, one.world.collisions), ([], []))
        done = {(v.route.robot, w.id) for v in one.control.vehicles.values() for n in v.route.nodes for w in n.works}
        told = {(robot, k) for robot, v in one.vehicles.items() for k, s in v.action_states.items() if s[1] == "FINISHED"}
        self.assertEqual(done, told)

    def test_calm(self):
        for name in NAMES:
            for version in ("2.1.0", "3.0.0"):
                one = air.Air(name, False, version)
                self.check(one)
                self.assertEqual(sum(v.refused for v in one.vehicles.values()), 0)
                self.assertEqual(one.control.resent, 0)

    def test_late_and_lost_messages(self):
        for name in NAMES:
            for seed in range(2 * FACTOR):
                self.check(air.Air(name, False, delayed=0.3, lost=0.2, seed=seed, base=1 + seed % 7,
                                   horizon=seed % 4))

    def test_vehicles_that_stop(self):
        calm = air.Air("crowd", False)
        self.check(calm)
        late = air.Air("crowd", False, stops={"a0": (2, 90), "a3": (5, 60)})
        self.check(late)
        self.assertGreater(late.now, max(90, calm.now))

    def test_one_that_stops_for_good(self):
        one = air.Air("crowd", False, stops={"a1": (3, 1e9)})
        self.assertFalse(one.drive(300))
        self.assertEqual((one.complaints, one.world.collisions), ([], []))
        reasons = list(one.control.reasons())
        self.assertTrue(any(r.startswith("a1 is between ") for r in reasons), reasons)
        for reason in reasons:
            self.assertRegex(reason, r"^a\d (is between \S+ and \S+|on \S+ waits for a\d)$")

    def test_one_that_does_not_take_its_order(self):
        one = air.Air("crowd", False)
        one.vehicles["a2"].x += 1
        self.assertFalse(one.drive(200))
        self.assertTrue(any("a2 has not accepted its order" in r and "orderError" in r for r in one.control.reasons()))

    def test_bases_are_no_longer_than_they_may_be(self):
        one = air.Air("many", False, base=3, horizon=2)
        longest = []
        send = one.control.send

        def look(robot, content):
            vehicle = one.control.vehicles[robot]
            nodes = [n for n in content["nodes"] if n["released"]]
            longest.append(nodes[-1]["sequenceId"] // 2 - max(vehicle.reached, 0))
            self.assertLessEqual(len(content["nodes"]) - len(nodes), 2)
            send(robot, content)
        one.control.send = look
        self.check(one)
        self.assertEqual(max(longest), 3)

    def test_what_is_released_too_early_is_seen(self):
        seen = 0
        for name in NAMES:
            one = air.Air(name, False, releases=_Eager, base=100)
            one.drive(300)
            seen += bool(one.complaints)
        self.assertGreaterEqual(seen, 3)
