# SPDX-License-Identifier: MIT
"""Tests lifted and unresponsive cubes and cubes with false reports, and that drivers with planted faults are
detected."""
import asyncio
import unittest

import plans
from grove_toio import protocol
from grove_toio.driver import Driver
from grove_toio.geometry import distance
from grove_toio.mat import BODY
from grove_toio.simulate import make_world
from grove_toio.simulated import Disturbances, SimulatedCube

RED = "a0"                      # a robot of the order "dense"


def cell_point(name, x, y):
    return plans.grid(name).centre((x, y))


class Lifted(unittest.TestCase):
    def drive(self, lifts, name="dense", seed=1, **options):
        outcome, world = plans.drive(name, 0.05, seed, lifts=lifts, **options)
        self.assertGreater(world.least, BODY)
        return outcome, world

    def test_cube_put_back_nearby_completes(self):
        for seed in range(6):
            for name in ("dense", "work", "round"):
                robots = [r.name for r in plans.order(name).robots]
                one, other = robots[seed % len(robots)], robots[(seed + 2) % len(robots)]
                lifts = [(one, 1.0 + seed / 2, 2.5), (other, 3.0, 1.0)]
                outcome, _ = self.drive(lifts, name, seed)
                self.assertTrue(outcome.completed, (name, seed, outcome.waits))

    def test_cube_lifted_at_the_start_completes(self):
        outcome, _ = self.drive([(RED, 0.0, 3.0)])
        self.assertTrue(outcome.completed)

    def test_lift_and_return_are_reported(self):
        messages = []
        self.drive([(RED, 2.0, 2.0)], say=messages.append)
        self.assertIn(f"{RED} is off the mat", "\n".join(messages))
        self.assertIn(f"{RED} continues", "\n".join(messages))

    def test_cube_never_put_back_stops_only_dependent_robots(self):
        done = []
        for seconds in (30, 60):
            outcome, _ = self.drive([(RED, 1.5, float("inf"))], seconds=seconds)
            self.assertFalse(outcome.completed)
            self.assertIn(f"{RED} is off the mat", outcome.waits)
            done.append(outcome.done)
        self.assertEqual(*done)             # the other robots get no further
        self.check_no_robot_can_continue(done[0], outcome.waits)

    def check_no_robot_can_continue(self, done, waits):
        for robot in plans.order("dense").robots:
            if robot.name == RED or done[robot.name] == len(robot.actions):
                continue
            (wait,) = [text for text in waits if text.startswith(f"{robot.name} waits for ")]
            after = robot.actions[done[robot.name]].after
            if "end its action" in wait:
                self.assertIn(f"waits for {after[0]} to end action {after[1]}", wait)
                self.assertLessEqual(done[after[0]], after[1])

    def test_cube_put_back_far_away_is_reported_and_not_hit(self):
        messages = []
        where = cell_point("dense", 6, 4) if plans.order("dense").robot(RED).start[0] < 3 else cell_point("dense", 0, 0)
        outcome, world = self.drive([(RED, 1.5, 1.0, where)], seconds=60, say=messages.append)
        cube = next(c for c in world.cubes if c.name == RED)
        if not outcome.completed:
            self.assertIn("far from its lane", "\n".join(messages))
            self.assertLess(distance((cube.x, cube.y), where), 1)

    def test_cube_put_back_in_the_way_of_another_completes(self):
        """Puts robot `up` down on the path of `down`, which has to stop and continues when `up` is back."""
        for seed in range(4):
            outcome, _ = self.drive([("up", 1.0, 1.5, cell_point("narrow", 0.5, 1.2))], "narrow", seed)
            self.assertTrue(outcome.completed, outcome.waits)


class WithoutResponses(SimulatedCube):
    """Loses all its responses."""

    @property
    def on_motor(self):
        return lambda data: None

    @on_motor.setter
    def on_motor(self, handler):
        pass


class FalseResponses(SimulatedCube):
    """Reports every journey as done, but does not move."""

    async def write(self, data):
        journey = protocol.read_motor_write(data)
        if isinstance(journey, protocol.Journey):
            self._notify(self.on_motor, protocol.response(journey.kind, journey.number, protocol.DONE))


class Refusing(SimulatedCube):
    async def write(self, data):
        journey = protocol.read_motor_write(data)
        if isinstance(journey, protocol.Journey):
            self._notify(self.on_motor, protocol.response(journey.kind, journey.number, self.code))


class Unresponsive(SimulatedCube):
    """Sends no notifications from the third second on."""

    def _notify(self, handler, data):
        if asyncio.get_running_loop().time() < 2:
            super()._notify(handler, data)


async def drive_with(kind, name, seconds, robots=None, messages=None, **attributes):
    """Executes an order with cubes of class `kind` for all robots, or only for those in `robots`. Returns (outcome,
    world)."""
    order, grid = plans.order(name), plans.grid(name)
    world, cubes = make_world(order, grid, Disturbances(), 1)
    for cube in cubes.values():
        if robots is None or cube.name in robots:
            cube.__class__ = kind
            cube.__dict__.update(attributes)
            cube.__dict__.pop("on_motor" if kind is WithoutResponses else "", None)
    running = asyncio.create_task(world.run())
    try:
        say = (messages if messages is not None else []).append
        return await Driver(order, cubes, grid, say=say).drive(seconds), world
    finally:
        running.cancel()


class Cubes(unittest.TestCase):
    def test_drive_without_responses_is_completed(self):
        outcome, world = plans.run(drive_with(WithoutResponses, "dense", plans.PATIENCE))
        self.assertTrue(outcome.completed, outcome.waits)
        self.assertGreater(world.least, BODY)

    def test_response_without_movement_does_not_end_an_action(self):
        outcome, _ = plans.run(drive_with(FalseResponses, "dense", 20))
        self.assertFalse(outcome.completed)
        self.assertEqual(outcome.actions, 0)

    def test_refused_writes_are_repeated(self):
        for code in (protocol.TIMEOUT, protocol.ID_MISSED, protocol.BAD_PARAMETERS, protocol.REPLACED,
                     protocol.CANNOT_APPEND):
            outcome, world = plans.run(drive_with(Refusing, "dense", 10, {RED}, code=code))
            self.assertEqual(outcome.done[RED], 0)
            self.assertGreater(outcome.repeats, 3)
            self.assertGreater(world.least, BODY)

    def test_fatal_response_codes_are_reported(self):
        for code, text in ((protocol.BAD_STATE, "switched off"),
                           (protocol.UNSUPPORTED, "does not accept the commands")):
            messages = []
            outcome, _ = plans.run(drive_with(Refusing, "dense", 10, {RED}, messages, code=code))
            self.assertIn(f"{RED} ", "".join(messages))
            self.assertIn(text, "".join(messages))
            self.assertTrue(any(text in each for each in outcome.waits))

    def test_unresponsive_cube_is_reported(self):
        messages = []
        outcome, world = plans.run(drive_with(Unresponsive, "dense", 30, {RED}, messages))
        self.assertIn(f"{RED} has stopped sending positions", "".join(messages))
        self.assertFalse(outcome.completed)
        self.assertGreater(world.least, BODY)

    def test_cubes_stop_after_a_cancelled_drive(self):
        async def break_off():
            order, grid = plans.order("dense"), plans.grid("dense")
            world, cubes = make_world(order, grid, Disturbances(), 1)
            running = asyncio.create_task(world.run())
            driving = asyncio.create_task(Driver(order, cubes, grid).drive())
            await asyncio.sleep(2)
            self.assertTrue(any(c.driving or c.wheels for c in world.cubes))
            driving.cancel()
            with self.assertRaises(asyncio.CancelledError):
                await driving
            places = [(c.x, c.y) for c in world.cubes]
            await asyncio.sleep(2)
            running.cancel()
            return places, [(c.x, c.y) for c in world.cubes]

        self.assertEqual(*plans.run(break_off()))


class WithoutGuard(Driver):
    def in_the_way(self, handle, path):
        return None


class WithoutOrder(WithoutGuard):
    """Ignores the `after` dependencies."""

    def after_done(self, handle, k):
        return True


class EarlyArrival(WithoutGuard):
    """Accepts a cube within REACHED_BOX of its goal as arrived, as the cubes themselves do."""

    async def reach(self, handle, goal, tolerance, onward=lambda: None):
        await super().reach(handle, goal, protocol.REACHED_BOX, onward)


class StraightRing(WithoutGuard):
    """Drives the robots of a ring on straight paths, ignoring the other robots."""

    async def go_round(self, handle, ring):
        k = handle.done
        await self.move(handle, k, handle.robot.actions[k])


class PlantedFaults(unittest.TestCase):
    def touched(self, kind, name):
        return [plans.drive(name, 0.05, seed, seconds=60, kind=kind)[1].touched for seed in range(6)]

    def test_ignoring_the_order_causes_collisions(self):
        self.assertTrue(all(self.touched(WithoutOrder, "dense")))

    def test_early_arrival_causes_collisions(self):
        self.assertTrue(any(self.touched(EarlyArrival, "dense")))

    def test_straight_paths_in_a_ring_cause_collisions(self):
        self.assertTrue(any(self.touched(StraightRing, "round")))

    def test_order_without_the_second_guard_prevents_collisions(self):
        """Executes an order without the second guard, whose purpose is to detect cubes moved by hand."""
        self.assertFalse(any(self.touched(WithoutGuard, "dense")))
