# SPDX-License-Identifier: MIT
"""Compares messages byte by byte with the examples in the toio Core Cube specification 2.4.0."""
import unittest

from grove_toio import protocol
from grove_toio.protocol import Journey, Missed, Notifying, Position, Response, Target, Wheels


class Writes(unittest.TestCase):
    def test_wheels_write(self):
        self.assertEqual(protocol.wheels(100, -20), bytes([0x01, 0x01, 0x01, 0x64, 0x02, 0x02, 0x14]))

    def test_timed_wheels_write(self):
        self.assertEqual(protocol.wheels(100, -20, 100), bytes([0x02, 0x01, 0x01, 0x64, 0x02, 0x02, 0x14, 0x0a]))

    def test_stop_write(self):
        self.assertEqual(protocol.stop(), bytes([0x01, 0x01, 0x01, 0x00, 0x02, 0x01, 0x00]))

    def test_single_target_write(self):
        data = protocol.one_target(0x00, Target(700, 386, 90, 0), 0x50, 5)
        self.assertEqual(data, bytes([0x03, 0x00, 0x05, 0x02, 0x50, 0x00, 0x00, 0xbc, 0x02, 0x82, 0x01, 0x5a, 0x00]))

    def test_multiple_targets_write(self):
        data = protocol.targets(7, [Target(100, 100, 0, 0), Target(200, 100, 90, 0)], 0x50, 5, protocol.APPEND)
        self.assertEqual(data, bytes([0x04, 0x07, 0x05, 0x02, 0x50, 0x00, 0x00, 0x01,
                                      0x64, 0x00, 0x64, 0x00, 0x00, 0x00, 0xc8, 0x00, 0x64, 0x00, 0x5a, 0x00]))

    def test_upper_three_bits_hold_the_kind_of_turn(self):
        self.assertEqual(protocol.one_target(0, Target(0xffff, 0xffff, 0x0123, 5), 10, 0)[7:],
                         bytes([0xff, 0xff, 0xff, 0xff, 0x23, 0xa1]))

    def test_two_targets_fit_into_20_bytes(self):
        self.assertLessEqual(len(protocol.targets(0, [Target(1, 2)] * 2, 40, 5)), 20)

    def test_notification_settings_write(self):
        self.assertEqual(protocol.notify_positions(1, 1), bytes([0x18, 0x00, 0x01, 0x01]))


class RoundTrips(unittest.TestCase):
    def test_wheels_are_read_back(self):
        self.assertEqual(protocol.read_motor_write(protocol.wheels(100, -20)), Wheels(100, -20, 0))
        self.assertEqual(protocol.read_motor_write(protocol.wheels(-3, 20, 250)), Wheels(-3, 20, 250))

    def test_journeys_are_read_back(self):
        those = tuple(Target(i, 2 * i, 3 * i, i % 7) for i in range(1, 30))
        self.assertEqual(protocol.read_motor_write(protocol.one_target(9, those[4], 80, 3)),
                         Journey(3, 9, 3, 2, 80, 0, 0, those[4:5]))
        for count in (1, 2, 29):
            self.assertEqual(protocol.read_motor_write(protocol.targets(255, those[:count], 10, 0, protocol.APPEND)),
                             Journey(4, 255, 0, 2, 10, 0, 1, those[:count]))

    def test_configuration_is_read_back(self):
        self.assertEqual(protocol.read_configuration_write(protocol.notify_positions(3, 0xff)), Notifying(3, 0xff))

    def test_malformed_writes_are_discarded(self):
        whole = protocol.targets(1, [Target(1, 2)], 40, 5)
        for data in (whole[:-1], whole[:8], protocol.targets(1, [Target(1, 2)] * 30, 40, 5), b"\x03\x00", b"\x09",
                     bytes([0x01, 0x01, 0x01, 0x64, 0x01, 0x02, 0x14])):
            self.assertIsNone(protocol.read_motor_write(data), data)


class Notifications(unittest.TestCase):
    def test_position_is_read(self):
        data = bytes([0x01, 0xc5, 0x02, 0x7f, 0x01, 0x32, 0x01, 0xbc, 0x02, 0x82, 0x01, 0x32, 0x01])
        self.assertEqual(protocol.read_id_notification(data), Position(709, 383, 306, 700, 386, 306))
        self.assertEqual(protocol.position(709, 383, 306, 700, 386, 306), data)

    def test_missed_position_is_read(self):
        self.assertEqual(protocol.read_id_notification(protocol.missed()), Missed())
        self.assertEqual(protocol.missed(), bytes([0x03]))

    def test_responses_are_read(self):
        for kind in (0x03, 0x04):
            for code in range(8):
                data = protocol.response(kind, 17, code)
                self.assertEqual(data, bytes([0x80 | kind, 17, code]))
                self.assertEqual(protocol.read_motor_notification(data), Response(0x80 | kind, 17, code))

    def test_other_notifications_are_ignored(self):
        for data in (b"", b"\xe0\x32\x00", b"\x83\x01"):
            self.assertIsNone(protocol.read_motor_notification(data))
        for data in (b"", b"\x01\x02", b"\x07"):
            self.assertIsNone(protocol.read_id_notification(data))
