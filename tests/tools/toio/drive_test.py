# SPDX-License-Identifier: MIT
"""Tests complete executions with simulated cubes: all tasks are visited in the order of the plan, without
collisions."""
import functools
import io
import json
import unittest

import orders
import plans
from grove_driving.drive_log import ExecutionLog
from grove_toio.driver import Driver
from grove_toio.mat import BODY
from grove_toio.rings import PARTS

NAMES = ("dense", "work", "many", "narrow", "round")
SEEDS = range(3)


class Watched(Driver):
    """Records the times at which actions end."""

    ended = {}

    def end_action(self, handle):
        self.ended[handle.name, handle.done] = self.now()
        super().end_action(handle)


class Ordinary(unittest.TestCase):
    def test_all_tasks_are_visited_without_collisions(self):
        for name in NAMES:
            for loss in (0.0, 0.05, 0.2):
                for seed in SEEDS if name != "many" else SEEDS[:1]:
                    with self.subTest(name=name, loss=loss, seed=seed):
                        outcome, world = plans.calm_drive(name, loss, seed)
                        self.assertTrue(outcome.completed, outcome.waits)
                        self.assertGreater(world.least, BODY)
                        self.assert_visited(name, outcome)

    def assert_visited(self, name, outcome):
        seen = {(r.name, cell) for r in plans.order(name).robots
                for cell in (r.start, *(a.place for a in r.actions[:outcome.done[r.name]]))}
        self.assertLessEqual(orders.visits(name), seen)

    def test_drive_with_slips_and_noise_is_completed(self):
        for name in ("dense", "round"):
            outcome, world = plans.drive(name, 0.05, 7, slip=1.0, noise=2.0)
            self.assertTrue(outcome.completed, outcome.waits)
            self.assertGreater(world.least, BODY)

    def test_drive_at_lowest_and_highest_speed_is_completed(self):
        for speed in (10, 255):
            outcome, world = plans.drive("dense", 0.05, 1, speed=speed)
            self.assertTrue(outcome.completed, outcome.waits)
            self.assertGreater(world.least, BODY)

    def test_cubes_end_on_their_goals(self):
        _, world = plans.calm_drive("dense", 0.2, 1)
        grid = plans.grid("dense")
        for robot, cube in zip(plans.order("dense").robots, world.cubes):
            x, y = grid.cell((cube.x, cube.y))
            self.assertLess(max(abs(x - robot.actions[-1].place[0]), abs(y - robot.actions[-1].place[1])), 0.15)

    def test_turning_robots_end_with_the_planned_heading(self):
        _, world = plans.calm_drive("work", 0.05, 2)
        headings = {"E": 0, "S": 90, "W": 180, "N": 270}
        for robot, cube in zip(plans.order("work").robots, world.cubes):
            if robot.actions and robot.actions[-1].kind == "turn":
                off = (cube.angle - headings[robot.actions[-1].heading] + 180) % 360 - 180
                self.assertLess(abs(off), 15)

    def test_equal_seeds_give_equal_drives(self):
        one, other = (plans.drive("dense", 0.2, 5) for _ in range(2))
        self.assertEqual(one[0], other[0])
        self.assertEqual(one[1].least, other[1].least)


class Order(unittest.TestCase):
    def drive(self, name, **options):
        Watched.ended = {}
        outcome, _ = plans.drive(name, 0.05, 1, kind=Watched, **options)
        self.assertTrue(outcome.completed, outcome.waits)
        self.assertEqual(len(Watched.ended), outcome.all_actions)
        return Watched.ended

    def test_actions_end_after_those_they_wait_for(self):
        ended = self.drive("dense")
        for robot in plans.order("dense").robots:
            for k, action in enumerate(robot.actions):
                if action.after:
                    self.assertLessEqual(ended[action.after], ended[robot.name, k] + 1e-9)

    def test_work_takes_its_steps(self):
        ended = self.drive("work", step_seconds=0.7)
        tried = 0
        for robot in plans.order("work").robots:
            for k, action in enumerate(robot.actions):
                if action.kind == "work" and k and action.steps:
                    self.assertGreaterEqual(ended[robot.name, k] - ended[robot.name, k - 1], 0.7 * action.steps - 0.1)
                    tried += 1
        self.assertTrue(tried)

    def test_actions_of_a_ring_end_together(self):
        ended = self.drive("round")
        self.assertEqual(len(ended), 4)
        self.assertLess(max(ended.values()) - min(ended.values()), 0.1)

    def test_two_cells_share_one_write_if_the_order_allows_it(self):
        outcome, _ = plans.drive("narrow", slip=0.0)
        self.assertLess(outcome.writes - outcome.corrections, outcome.all_actions + 8)
        self.assertGreater(PARTS, 1)


class Log(unittest.TestCase):
    @staticmethod
    @functools.cache
    def lines():
        stream = io.StringIO()
        log = ExecutionLog(stream, "o.json", [r.name for r in plans.order("work").robots], 1.0)
        plans.drive("work", 0.05, 1, log=log)
        return [json.loads(line) for line in stream.getvalue().splitlines()]

    def test_log_has_the_documented_format(self):
        head, *lines = self.lines()
        names = [r.name for r in plans.order("work").robots]
        self.assertEqual(head, {"format": "grove drive 1", "order": "o.json", "robots": names, "seconds_per_step": 1.0})
        states = {"waiting", "moving", "working", "lifted", "lost", "done"}
        for line in lines:
            self.assertEqual(set(line), {"t", "robot", "at", "angle", "action", "state"})
            self.assertIn(line["robot"], names)
            self.assertIn(line["state"], states)
            self.assertTrue(0 <= line["angle"] < 360)
        self.assertEqual([line["t"] for line in lines], sorted(line["t"] for line in lines))
        self.assertLessEqual({"moving", "working", "done"}, {line["state"] for line in lines})

    def test_log_begins_at_starts_and_ends_at_goals(self):
        _, *lines = self.lines()
        for robot in plans.order("work").robots:
            own = [line for line in lines if line["robot"] == robot.name]
            for line, cell, action, near in ((own[0], robot.start, 0, 0.1),
                                             (own[-1], robot.actions[-1].place, len(robot.actions), 0.15)):
                self.assertLess(max(abs(line["at"][0] - cell[0]), abs(line["at"][1] - cell[1])), near)
                self.assertEqual(line["action"], action)
            self.assertEqual(own[-1]["state"], "done")
            self.assertEqual(sorted(line["action"] for line in own), [line["action"] for line in own])

    def test_log_has_ten_lines_a_second_and_one_for_each_change(self):
        _, *lines = self.lines()
        for name in {line["robot"] for line in lines}:
            own = [line for line in lines if line["robot"] == name]
            for before, line in zip(own, own[1:]):
                if (before["action"], before["state"]) == (line["action"], line["state"]):
                    self.assertGreater(line["t"] - before["t"], 0.09)
