# SPDX-License-Identifier: MIT
"""Tests a simulated cube against the specification of writes and responses."""
import asyncio
import unittest

from grove_toio import protocol
from grove_toio.protocol import Target
from grove_toio.simulated import Disturbances, SimulatedCube
from grove_toio.world import World

import plans

MAT = (0, 0, 500, 500)


class SingleCube:
    """Holds a cube, its responses and position reports, and a virtual clock."""

    def __init__(self, disturbances=Disturbances(noise=0.0)):
        self.world = World(MAT)
        self.cube = SimulatedCube("a", self.world, 100, 100, 0, disturbances)
        self.responses, self.positions = [], []
        self.cube.on_motor = lambda data: self.responses.append(tuple(data))
        self.cube.on_id = lambda data: self.positions.append(protocol.read_id_notification(data))

    async def after(self, seconds, *writes):
        running = asyncio.create_task(self.world.run())
        for data in writes:
            await self.cube.write(data)
        await asyncio.sleep(seconds)
        running.cancel()


def play(seconds, *writes, cube=None):
    cube = cube or SingleCube()
    plans.run(cube.after(seconds, *writes))
    return cube


class Journeys(unittest.TestCase):
    def near(self, cube, x, y, box=protocol.REACHED_BOX):
        self.assertLessEqual(abs(cube.cube.x - x), box)
        self.assertLessEqual(abs(cube.cube.y - y), box)

    def test_target_is_reached(self):
        done = play(5, protocol.one_target(3, Target(200, 150), 40, 5))
        self.assertEqual(done.responses, [(0x83, 3, protocol.DONE)])
        self.near(done, 200, 150)

    def test_cube_stops_before_its_target(self):
        apart = []
        for seed in range(20):
            single = SingleCube()
            single.cube.random.seed(seed)
            play(5, protocol.one_target(3, Target(200, 100), 40, 5), cube=single)
            apart.append(200 - single.cube.x)
        self.assertLess(min(apart), 6)
        self.assertGreater(max(apart), 10)

    def test_two_targets_are_reached_in_order(self):
        single = SingleCube()
        done = play(8, protocol.targets(4, [Target(200, 100), Target(200, 200)], 40, 5), cube=single)
        self.assertEqual(done.responses, [(0x84, 4, protocol.DONE)])
        self.near(done, 200, 200)
        self.assertTrue(any(abs(p.x - 200) <= 16 and abs(p.y - 100) <= 16 for p in done.positions))

    def test_cube_turns_on_the_spot(self):
        done = play(3, protocol.one_target(5, Target(protocol.SAME, protocol.SAME, 270, protocol.SHORTEST), 40, 5))
        self.assertEqual(done.responses, [(0x83, 5, protocol.DONE)])
        self.assertLessEqual(abs(done.cube.angle - 270), protocol.REACHED_ANGLE)
        self.near(done, 100, 100, 1)

    def test_target_too_far_for_its_time_limit_times_out(self):
        done = play(3, protocol.one_target(6, Target(490, 490), 10, 1))
        self.assertEqual(done.responses, [(0x83, 6, protocol.TIMEOUT)])
        self.assertLess(done.cube.x, 200)

    def test_speed_below_the_minimum_is_unsupported(self):
        done = play(1, protocol.one_target(6, Target(200, 200), 7, 5))
        self.assertEqual(done.responses, [(0x83, 6, protocol.UNSUPPORTED)])

    def test_target_without_a_change_is_a_bad_parameter(self):
        nowhere = Target(protocol.SAME, protocol.SAME, 0, protocol.SAME_ANGLE)
        done = play(1, protocol.one_target(6, nowhere, 40, 5))
        self.assertEqual(done.responses, [(0x83, 6, protocol.BAD_PARAMETERS)])

    def test_second_write_replaces_the_first(self):
        done = play(4, protocol.one_target(1, Target(400, 100), 40, 9), protocol.one_target(2, Target(100, 180), 40, 9))
        self.assertEqual(done.responses, [(0x83, 1, protocol.REPLACED), (0x83, 2, protocol.DONE)])

    def test_only_one_write_can_be_appended(self):
        one, two, three = (protocol.targets(n, [Target(100 + 60 * n, 100)], 40, 5, protocol.APPEND) for n in (1, 2, 3))
        done = play(8, one, two, three)
        self.assertEqual(done.responses, [(0x84, 3, protocol.CANNOT_APPEND), (0x84, 1, protocol.DONE),
                                          (0x84, 2, protocol.DONE)])
        self.near(done, 220, 100)

    def test_wheels_run_for_the_given_time(self):
        done = play(2, protocol.wheels(20, 20, 500))
        self.assertAlmostEqual(done.cube.x - 100, 20, delta=3)
        self.assertEqual(done.responses, [])

    def test_stop_ends_a_journey(self):
        single = SingleCube()

        async def begin_and_stop():
            await single.after(0.5, protocol.one_target(1, Target(400, 100), 40, 9))
            await single.after(0.5, protocol.stop())
            before = single.cube.x
            await single.after(1)
            return before

        self.assertEqual(plans.run(begin_and_stop()), single.cube.x)
        self.assertGreater(single.cube.x, 110)
        self.assertEqual(single.responses, [(0x83, 1, protocol.REPLACED)])


class Positions(unittest.TestCase):
    def test_lifted_cube_misses_its_id(self):
        single = SingleCube()
        single.cube.lift()
        play(1, protocol.one_target(1, Target(400, 100), 40, 9), cube=single)
        self.assertIn((0x83, 1, protocol.ID_MISSED), single.responses)
        self.assertEqual(single.positions, [protocol.Missed()])

    def test_cube_beyond_the_mat_misses_its_id(self):
        done = play(6, protocol.wheels(-40, -40))
        self.assertIsInstance(done.positions[-1], protocol.Missed)
        self.assertLess(done.cube.x, 0)

    def test_notifications_of_a_cube_at_rest(self):
        for condition, least, most in ((0, 95, 101), (0xff, 25, 35), (1, 1, 2)):
            single = SingleCube()
            plans.run(single.cube.configure(protocol.notify_positions(1, condition)))
            single.cube.notifying = protocol.Notifying(1, condition)
            play(1, cube=single)
            self.assertTrue(least <= len(single.positions) <= most, (condition, len(single.positions)))

    def test_some_messages_are_lost(self):
        nowhere = Target(protocol.SAME, protocol.SAME, 0, protocol.SAME_ANGLE)
        writes = [protocol.one_target(n, nowhere, 40, 5) for n in range(200)]
        done = play(10, *writes, cube=SingleCube(Disturbances(loss=0.2)))
        self.assertTrue(90 <= len(done.responses) <= 160, len(done.responses))
