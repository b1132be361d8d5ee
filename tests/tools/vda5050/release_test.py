# SPDX-License-Identifier: MIT
"""Tests releases: no place is released while another vehicle can be there, and finally all places are released."""
import random
import unittest

import air
from grove_vda5050.release import Releases

NAMES = ("dense", "work", "many", "narrow", "roads", "round")


class _Eager(Releases):
    """Releases too early, by waiting for one action too few."""

    def waits_for(self, name):
        after = super().waits_for(name)
        return after if after and self.done[after[0]] < after[1] else None


def walk(name, seed, kind=Releases):
    """Lets vehicles complete released nodes in random order. Returns (whether all are done, number of places released
    to a second vehicle, summed over all steps)."""
    order, routes = air.order(name, False), air.routes(name, False)
    releases, draw = kind(order, routes), random.Random(seed)
    reached = dict.fromkeys(routes, 0)
    shared = 0
    while True:
        claims = [{n.place for n in routes[r].nodes[reached[r]:releases.allowed[r] + 1]} for r in routes]
        shared += sum(map(len, claims)) - len(set().union(*claims))
        able = [r for r in routes if reached[r] < releases.allowed[r]]
        if not able:
            break
        robot = draw.choice(able)
        reached[robot] += 1
        node = routes[robot].nodes[reached[robot]]
        releases.complete(robot, node.end if reached[robot] == routes[robot].last else node.begin)
    return all(reached[r] == routes[r].last for r in routes), shared


class Release(unittest.TestCase):
    def test_all_is_released_for_any_order_of_arrivals(self):
        for name in NAMES:
            for seed in range(40):
                self.assertEqual(walk(name, seed), (True, 0), (name, seed))

    def test_too_early_releases_are_detected(self):
        self.assertGreater(sum(walk(name, seed, _Eager)[1] for name in NAMES for seed in range(3)), 0)

    def test_completion_releases_the_waiting_vehicle(self):
        releases = Releases(air.order("narrow", False), air.routes("narrow", False))
        waits = {name: releases.waits_for(name) for name in ("up", "down")}
        self.assertTrue(any(waits.values()))
        for name, after in waits.items():
            if after:
                self.assertNotEqual(after[0], name)
                self.assertEqual(releases.complete(after[0], after[1]), [])
                self.assertEqual(releases.complete(after[0], after[1] + 1), [name])
