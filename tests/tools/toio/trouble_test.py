# SPDX-License-Identifier: MIT
"""Lifted, lying and dead cubes; and drivers with planted faults, which the mat must find out."""
import asyncio
import unittest

import plans
from grove_toio import protocol
from grove_toio.driver import Driver
from grove_toio.geometry import distance
from grove_toio.mat import BODY
from grove_toio.simulate import make_world
from grove_toio.simulated import Disturbances, SimulatedCube

RED = "a0"                      # of the order "crowd"


def cell_point(name, x, y):
    return plans.grid(name).centre((x, y))


class Lifted(unittest.TestCase):
    def drive(self, lifts, name="crowd", seed=1, **options):
        outcome, world = plans.drive(name, 0.05, seed, lifts=lifts, **options)
        self.assertGreater(world.least, BODY)
        return outcome, world

    def test_put_back_near_where_it_was(self):
        for seed in range(6):
            for name in ("crowd", "work", "round"):
                robots = [r.name for r in plans.order(name).robots]
                one, other = robots[seed % len(robots)], robots[(seed + 2) % len(robots)]
                lifts = [(one, 1.0 + seed / 2, 2.5), (other, 3.0, 1.0)]
                outcome, _ = self.drive(lifts, name, seed)
                self.assertTrue(outcome.completed, (name, seed, outcome.waits))

    def test_before_it_begins_and_after_it_is_done(self):
        outcome, _ = self.drive([(RED, 0.0, 3.0)])
        self.assertTrue(outcome.completed)

    def test_it_is_said(self):
        said = []
        self.drive([(RED, 2.0, 2.0)], say=said.append)
        self.assertIn(f"{RED} is off the mat", "\n".join(said))
        self.assertIn(f"{RED} continues", "\n".join(said))

    def test_one_that_never_comes_back(self):
        done = []
        for seconds in (30, 60):
            outcome, _ = self.drive([(RED, 1.5, float("inf"))], seconds=seconds)
            self.assertFalse(outcome.completed)
            self.assertIn(f"{RED} is off the mat", outcome.waits)
            done.append(outcome.done)
        self.assertEqual(*done)             # the others had gone as far as they could
        self.check_as_far_as_they_can(done[0], outcome.waits)

    def check_as_far_as_they_can(self, done, waits):
        for robot in plans.order("crowd").robots:
            if robot.name == RED or done[robot.name] == len(robot.actions):
                continue
            (said,) = [text for text in waits if text.startswith(f"{robot.name} waits for ")]
            after = robot.actions[done[robot.name]].after
            if "end its action" in said:
                self.assertIn(f"waits for {after[0]} to end action {after[1]}", said)
                self.assertLessEqual(done[after[0]], after[1])

    def test_put_back_far_away_it_is_reported_and_nobody_drives_into_it(self):
        said = []
        where = cell_point("crowd", 6, 4) if plans.order("crowd").robot(RED).start[0] < 3 else cell_point("crowd", 0, 0)
        outcome, world = self.drive([(RED, 1.5, 1.0, where)], seconds=60, say=said.append)
        cube = next(c for c in world.cubes if c.name == RED)
        if not outcome.completed:
            self.assertIn("far from its lane", "\n".join(said))
            self.assertLess(distance((cube.x, cube.y), where), 1)

    def test_put_back_in_the_way_of_another(self):
        """Down has to stop before up, which was put down on its way, and goes on when up is back."""
        for seed in range(4):
            outcome, _ = self.drive([("up", 1.0, 1.5, cell_point("narrow", 0.5, 1.2))], "narrow", seed)
            self.assertTrue(outcome.completed, outcome.waits)


class Deaf(SimulatedCube):
    """Its responses never arrive."""

    @property
    def on_motor(self):
        return lambda data: None

    @on_motor.setter
    def on_motor(self, handler):
        pass


class Liar(SimulatedCube):
    """Says that it has done what it was told, and stands still."""

    async def write(self, data):
        journey = protocol.read_motor_write(data)
        if isinstance(journey, protocol.Journey):
            self._notify(self.on_motor, protocol.response(journey.kind, journey.number, protocol.DONE))


class Refusing(SimulatedCube):
    async def write(self, data):
        journey = protocol.read_motor_write(data)
        if isinstance(journey, protocol.Journey):
            self._notify(self.on_motor, protocol.response(journey.kind, journey.number, self.code))


class Gone(SimulatedCube):
    """Is not heard of after two seconds."""

    def _notify(self, handler, data):
        if asyncio.get_running_loop().time() < 2:
            super()._notify(handler, data)


async def drive_with(kind, name, seconds, robots=None, said=None, **attributes):
    """All cubes, or those of some robots, are of this kind."""
    order, grid = plans.order(name), plans.grid(name)
    world, cubes = make_world(order, grid, Disturbances(), 1)
    for cube in cubes.values():
        if robots is None or cube.name in robots:
            cube.__class__ = kind
            cube.__dict__.update(attributes)
            cube.__dict__.pop("on_motor" if kind is Deaf else "", None)
    running = asyncio.create_task(world.run())
    try:
        return await Driver(order, cubes, grid, say=(said if said is not None else []).append).drive(seconds), world
    finally:
        running.cancel()


class Cubes(unittest.TestCase):
    def test_without_any_response(self):
        outcome, world = plans.run(drive_with(Deaf, "crowd", plans.PATIENCE))
        self.assertTrue(outcome.completed, outcome.waits)
        self.assertGreater(world.least, BODY)

    def test_responses_alone_are_not_believed(self):
        outcome, _ = plans.run(drive_with(Liar, "crowd", 20))
        self.assertFalse(outcome.completed)
        self.assertEqual(outcome.actions, 0)

    def test_each_code_is_survived(self):
        for code in (protocol.TIMEOUT, protocol.ID_MISSED, protocol.BAD_PARAMETERS, protocol.REPLACED,
                     protocol.CANNOT_APPEND):
            outcome, world = plans.run(drive_with(Refusing, "crowd", 10, {RED}, code=code))
            self.assertEqual(outcome.done[RED], 0)
            self.assertGreater(outcome.repeats, 3)
            self.assertGreater(world.least, BODY)

    def test_codes_that_end_it_are_said(self):
        for code, text in ((protocol.BAD_STATE, "switched off"), (protocol.UNSUPPORTED, "does not accept the commands")):
            said = []
            outcome, _ = plans.run(drive_with(Refusing, "crowd", 10, {RED}, said, code=code))
            self.assertIn(f"{RED} ", "".join(said))
            self.assertIn(text, "".join(said))
            self.assertTrue(any(text in each for each in outcome.waits))

    def test_one_that_falls_silent(self):
        said = []
        outcome, world = plans.run(drive_with(Gone, "crowd", 30, {RED}, said))
        self.assertIn(f"{RED} has stopped sending positions", "".join(said))
        self.assertFalse(outcome.completed)
        self.assertGreater(world.least, BODY)

    def test_cubes_stand_after_a_drive_that_was_broken_off(self):
        async def break_off():
            order, grid = plans.order("crowd"), plans.grid("crowd")
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
    """Ignores `after`."""

    def after_done(self, handle, k):
        return True


class Early(WithoutGuard):
    """Believes that who is within 15 units has arrived, as cubes do."""

    async def reach(self, handle, goal, tolerance, onward=lambda: None):
        await super().reach(handle, goal, protocol.REACHED_BOX, onward)


class Straight(WithoutGuard):
    """Drives round without a look at the others."""

    async def go_round(self, handle, ring):
        k = handle.done
        await self.move(handle, k, handle.robot.actions[k])


class PlantedFaults(unittest.TestCase):
    def touched(self, kind, name):
        return [plans.drive(name, 0.05, seed, seconds=60, kind=kind)[1].touched for seed in range(6)]

    def test_without_the_order_they_collide(self):
        self.assertTrue(all(self.touched(WithoutOrder, "crowd")))

    def test_who_believes_the_cubes_collides(self):
        self.assertTrue(any(self.touched(Early, "crowd")))

    def test_who_drives_round_straight_collides(self):
        self.assertTrue(any(self.touched(Straight, "round")))

    def test_the_order_alone_keeps_them_apart(self):
        """The second guard is for cubes that hands have moved."""
        self.assertFalse(any(self.touched(WithoutGuard, "crowd")))
