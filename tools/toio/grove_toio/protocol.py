# SPDX-License-Identifier: MIT
"""Encodes and decodes the messages of cubes.

Source: toio Core Cube specification 2.4.0, pages "Motor", "Identification sensor" and "Configuration"
(https://toio.github.io/toio-spec/en/). Numbers are little-endian. Angles are in degrees clockwise from the x axis.
"""
import struct
from typing import NamedTuple

SERVICE = "10b20100-5b3b-4571-9508-cf3efcd7bbae"
ID_INFORMATION = "10b20101-5b3b-4571-9508-cf3efcd7bbae"
MOTOR = "10b20102-5b3b-4571-9508-cf3efcd7bbae"
CONFIGURATION = "10b201ff-5b3b-4571-9508-cf3efcd7bbae"

ROTATE_THEN_STRAIGHT = 2
CONSTANT_SPEED = 0
OVERWRITE, APPEND = 0, 1
SAME = 0xffff               # as x or y of a target: the current position of the cube
SHORTEST, NO_ROTATION, SAME_ANGLE = 0, 5, 6
MIN_SPEED, MAX_SPEED = 10, 255
MOST_TARGETS = 29
REACHED_BOX = 15            # a cube treats a target as reached within this distance in x and in y, units
REACHED_ANGLE = 4

DONE, TIMEOUT, ID_MISSED, BAD_PARAMETERS, BAD_STATE, REPLACED, UNSUPPORTED, CANNOT_APPEND = range(8)


class Target(NamedTuple):
    x: int
    y: int
    angle: int = 0
    rotation: int = NO_ROTATION


class Wheels(NamedTuple):
    """Wheel speeds, negative for backwards, and their duration (0: unlimited)."""
    left: int
    right: int
    milliseconds: int


class Journey(NamedTuple):
    """A journey to one target (kind 0x03) or through several (kind 0x04)."""
    kind: int
    number: int             # repeated in the response
    seconds: int            # time limit for each target; 0: 10 s
    movement: int
    speed: int
    profile: int
    append: int
    targets: tuple


class Response(NamedTuple):
    kind: int               # 0x83 or 0x84
    number: int
    code: int


class Position(NamedTuple):
    x: int
    y: int
    angle: int
    sensor_x: int
    sensor_y: int
    sensor_angle: int


class Missed(NamedTuple):
    """The cube detects no position, because it was lifted or is outside the mat."""


class Notifying(NamedTuple):
    """Configuration of the position notifications."""
    interval: int           # minimum interval, in units of 10 ms
    condition: int          # 0: always; 1: on a change; 0xff: until 300 ms after a change


# ---- Messages to the cube

def stop():
    return wheels(0, 0)


def _wheel(number, speed):
    return bytes((number, 2 if speed < 0 else 1, abs(speed)))


def wheels(left, right, milliseconds=None):
    """Returns a command that runs the wheels for `milliseconds` (a multiple of 10; None: until the next write)."""
    both = _wheel(1, left) + _wheel(2, right)
    if milliseconds is None:
        return b"\x01" + both
    return b"\x02" + both + bytes((milliseconds // 10,))


def _target(target):
    return struct.pack("<HHH", target.x, target.y, target.rotation << 13 | target.angle)


def one_target(number, target, speed, seconds):
    return bytes((0x03, number, seconds, ROTATE_THEN_STRAIGHT, speed, CONSTANT_SPEED, 0)) + _target(target)


def targets(number, those, speed, seconds, append=OVERWRITE):
    head = bytes((0x04, number, seconds, ROTATE_THEN_STRAIGHT, speed, CONSTANT_SPEED, 0, append))
    return head + b"".join(map(_target, those))


def notify_positions(interval, condition):
    return bytes((0x18, 0, interval, condition))


def _read_target(data):
    x, y, turn = struct.unpack("<HHH", data)
    return Target(x, y, turn & 0x1fff, turn >> 13)


def _read_wheels(data, milliseconds):
    speeds = {}
    for number, direction, speed in (data[1:4], data[4:7]):
        speeds[number] = -speed if direction == 2 else speed
    return Wheels(speeds[1], speeds[2], milliseconds) if set(speeds) == {1, 2} else None


def read_motor_write(data):
    """Decodes a motor command and returns Wheels or a Journey. Returns None if a cube would discard the data."""
    kind, size = data[0], len(data)
    if kind == 0x01 and size == 7:
        return _read_wheels(data, 0)
    if kind == 0x02 and size == 8:
        return _read_wheels(data, 10 * data[7])
    if kind == 0x03 and size == 13:
        return Journey(kind, *data[1:6], OVERWRITE, (_read_target(data[7:]),))
    if kind == 0x04 and size > 8 and (size - 8) % 6 == 0 and (size - 8) // 6 <= MOST_TARGETS:
        those = tuple(_read_target(data[i:i + 6]) for i in range(8, size, 6))
        return Journey(kind, *data[1:6], data[7], those)
    return None


def read_configuration_write(data):
    return Notifying(data[2], data[3]) if data[0] == 0x18 and len(data) == 4 else None


# ---- Messages from the cube

def response(kind, number, code):
    return bytes((kind | 0x80, number, code))


def position(x, y, angle, sensor_x, sensor_y, sensor_angle):
    return struct.pack("<B6H", 0x01, x, y, angle, sensor_x, sensor_y, sensor_angle)


def missed():
    return b"\x03"


def notifying_set():
    return b"\x98\x00\x00"


def read_motor_notification(data):
    """Decodes a motor notification and returns a Response. Returns None for other notifications."""
    return Response(*data[:3]) if len(data) >= 3 and data[0] in (0x83, 0x84) else None


def read_id_notification(data):
    """Decodes an id notification and returns a Position or Missed. Returns None for other notifications."""
    if data[:1] == b"\x01" and len(data) == 13:
        return Position(*struct.unpack_from("<6H", data, 1))
    return Missed() if data[:1] in (b"\x02", b"\x03", b"\x04") else None
