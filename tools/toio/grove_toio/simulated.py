# SPDX-License-Identifier: MIT
"""Simulates a cube, which exchanges the same bytes as a real cube, drives on two wheels, slips, and loses messages.

The simulation follows the specification. Where the specification leaves the behaviour open, it assumes the worst case:
every journey ends up to 15 units before its target.
"""
import asyncio
import math
import random
from typing import NamedTuple

from . import protocol
from .geometry import turn_between
from .mat import MM

# From the simulator of the toio SDK for Unity, whose authors measured the value; the specification does not state it.
UNITS_PER_SPEED = 2.04      # units per second for one step of speed
TREAD = 26.6 / MM           # distance between the wheels, units
SENSOR_AHEAD = 3.0          # distance of the sensor in front of the centre, units, from examples in the specification
MISSED_AFTER = 0.07         # time off the mat until the notification, seconds
DELAYS = (0.010, 0.035)     # range of message delays, seconds
EASE_ANGLE, EASE_WAY = 40.0, 12.0   # remaining degrees and units at which the cube starts to brake


class Disturbances(NamedTuple):
    loss: float = 0.0       # share of lost messages, in each direction
    slip: float = 0.0       # slips per second of driving
    noise: float = 1.0      # maximum error of notified positions, units


class _Driving:
    """Progress of a journey."""

    def __init__(self, journey, now, box):
        self.journey, self.index, self.begun, self.box = journey, 0, now, box
        self.at_place = False
        self.aligned = False
        self.goal = None


class SimulatedCube:
    def __init__(self, name, world, x, y, angle, disturbances=Disturbances(), seed=0):
        self.name, self.world, self.disturbances = name, world, disturbances
        self.x, self.y, self.angle = x, y, angle
        self.random = random.Random(f"{name} {seed}")
        self.bias = self.random.uniform(0.95, 1.05)
        self.lifted = False
        self.lifted_at = None
        self.missed_sent = False
        self.on_motor = self.on_id = self.on_configuration = lambda data: None
        self.notifying = protocol.Notifying(1, 0xff)
        self.notified_at = self.changed_at = -math.inf
        self.notified = None
        self.driving = self.added = None
        self.wheels = self.wheels_until = None
        self.slips_until = -math.inf
        self.next_in = self.next_out = 0.0
        world.cubes.append(self)

    # ---- messages

    async def connect(self):
        pass

    async def disconnect(self):
        pass

    async def write(self, data):
        """Writes to the Motor characteristic without response. The message can be lost."""
        self.next_in = self._send(self.next_in, self._receive, bytes(data))

    async def configure(self, data):
        self.next_in = self._send(self.next_in, self._receive_configuration, bytes(data))

    def _send(self, not_before, handler, data):
        """Delivers or loses a message. Returns the time before which no later message in its direction may arrive."""
        if self.random.random() < self.disturbances.loss:
            return not_before
        loop = asyncio.get_running_loop()
        when = max(not_before + 1e-5, loop.time() + self.random.uniform(*DELAYS))
        loop.call_at(when, handler, data)
        return when

    def _notify(self, handler, data):
        self.next_out = self._send(self.next_out, handler, data)

    def _respond(self, driving, code):
        if driving:
            self._notify(self.on_motor, protocol.response(driving.journey.kind, driving.journey.number, code))

    def _receive_configuration(self, data):
        self.notifying = protocol.read_configuration_write(data) or self.notifying
        self._notify(self.on_configuration, protocol.notifying_set())

    def _receive(self, data):
        write, now = protocol.read_motor_write(data), asyncio.get_running_loop().time()
        if isinstance(write, protocol.Wheels):
            self._replace(None)
            self.wheels = (write.left, write.right)
            self.wheels_until = now + write.milliseconds / 1000 if write.milliseconds else math.inf
        elif write:
            self._receive_journey(write, now)

    def _receive_journey(self, journey, now):
        driving = _Driving(journey, now, self.random.uniform(2, protocol.REACHED_BOX))
        first = journey.targets[0]
        if journey.speed < protocol.MIN_SPEED:
            self._respond(driving, protocol.UNSUPPORTED)
        elif first.x == first.y == protocol.SAME and first.rotation in (protocol.NO_ROTATION, protocol.SAME_ANGLE):
            self._respond(driving, protocol.BAD_PARAMETERS)
        elif journey.append and self.driving and self.driving.journey.kind == 0x04:
            if self.added:
                self._respond(driving, protocol.CANNOT_APPEND)
            else:
                self.added = driving
        else:
            self._replace(driving)
            if not self._sees():
                self._end(protocol.ID_MISSED)

    def _replace(self, driving):
        self._respond(self.driving, protocol.REPLACED)
        self.driving, self.added, self.wheels = driving, None, None

    def _end(self, code):
        self._respond(self.driving, code)
        self.driving = None
        if code == protocol.DONE and self.added:
            self.driving, self.added = self.added, None
            self.driving.begun = asyncio.get_running_loop().time()
        self.added = None

    # ---- hands

    def lift(self):
        self.lifted, self.lifted_at = True, None

    def put_down(self, x, y, angle):
        self.lifted, self.lifted_at = False, None
        self.x, self.y, self.angle = x, y, angle

    def _sees(self):
        return not self.lifted and self.world.on_mat(self.x, self.y)

    # ---- motion

    def tick(self, seconds, now):
        if not self._sees():
            self._off_mat(now)
            return
        self.lifted_at, self.missed_sent = None, False
        left, right = self._speeds(now)
        if left or right:
            self._move(left, right, seconds, now)
        self._notify_position(now)

    def _off_mat(self, now):
        self.wheels = None
        if self.driving:
            self._end(protocol.ID_MISSED)
        self.lifted_at = now if self.lifted_at is None else self.lifted_at
        if now - self.lifted_at >= MISSED_AFTER and not self.missed_sent:
            self._notify(self.on_id, protocol.missed())
            self.missed_sent = True

    def _speeds(self, now):
        if self.wheels:
            if now < self.wheels_until:
                return self.wheels
            self.wheels = None
        return self._journey_speeds(now) if self.driving else (0, 0)

    def _journey_speeds(self, now):
        driving = self.driving
        if now - driving.begun > (driving.journey.seconds or 10):
            self._end(protocol.TIMEOUT)
            return 0, 0
        target = driving.journey.targets[driving.index]
        if driving.goal is None:
            driving.goal = (self.x if target.x == protocol.SAME else target.x,
                            self.y if target.y == protocol.SAME else target.y)
        dx, dy = driving.goal[0] - self.x, driving.goal[1] - self.y
        if abs(dx) <= driving.box and abs(dy) <= driving.box:
            driving.at_place = True
        if driving.at_place:
            return self._turn_at_place(driving, target, now)
        return self._way_speeds(driving, dx, dy)

    def _turn_at_place(self, driving, target, now):
        off = turn_between(self.angle, target.angle)
        if target.rotation != protocol.NO_ROTATION and abs(off) > protocol.REACHED_ANGLE - 1:
            return self._spin(driving.journey.speed, off)
        if driving.index + 1 < len(driving.journey.targets):
            driving.index += 1
            driving.begun, driving.goal = now, None
            driving.at_place = driving.aligned = False
            driving.box = self.random.uniform(2, protocol.REACHED_BOX)
        else:
            self._end(protocol.DONE)
        return 0, 0

    @staticmethod
    def _spin(speed, off):
        turning = max(protocol.MIN_SPEED, min(speed, speed * abs(off) / EASE_ANGLE))
        return (turning, -turning) if off > 0 else (-turning, turning)

    def _way_speeds(self, driving, dx, dy):
        """Returns the wheel speeds. Movement type 2 turns before it drives straight; others steer while driving."""
        off = turn_between(self.angle, math.degrees(math.atan2(dy, dx)))
        speed = driving.journey.speed
        if driving.journey.movement == protocol.ROTATE_THEN_STRAIGHT:
            driving.aligned = abs(off) < (25 if driving.aligned else 4)
            if not driving.aligned:
                return self._spin(speed, off)
        onwards = max(protocol.MIN_SPEED, min(speed, speed * math.hypot(dx, dy) / EASE_WAY))
        steer = max(-0.5, min(0.5, off / 40)) * onwards
        return onwards + steer, onwards - steer

    def _move(self, left, right, seconds, now):
        grip = self._grip(seconds, now)
        left, right = (speed * UNITS_PER_SPEED * self.bias * self.random.gauss(1, 0.05) for speed in (left, right))
        way = (left + right) / 2 * seconds * grip
        self.angle = (self.angle + math.degrees((left - right) / TREAD * seconds * grip)) % 360
        self.x += way * math.cos(math.radians(self.angle))
        self.y += way * math.sin(math.radians(self.angle))

    def _grip(self, seconds, now):
        """Returns the share of the wheels' distance that the cube covers. A slip can turn the cube and end a motion."""
        if now >= self.slips_until and self.random.random() < self.disturbances.slip * seconds:
            self.slips_until = now + self.random.uniform(0.1, 0.6)
            self.angle += self.random.uniform(-12, 12)
            if self.random.random() < 0.3:
                self.driving = self.added = self.wheels = None
        return 0.1 if now < self.slips_until else 1.0

    # ---- positions

    def _seen(self, value):
        return max(0, round(value + self.random.uniform(-self.disturbances.noise, self.disturbances.noise)))

    def _notify_position(self, now):
        if now - self.notified_at < 0.01 * self.notifying.interval - 1e-9:
            return
        here = (round(self.x), round(self.y), round(self.angle))
        if here != self.notified:
            self.notified, self.changed_at = here, now
        quiet = {0: math.inf, 1: 0.0}.get(self.notifying.condition, 0.3)
        if now - self.changed_at > quiet:
            return
        self.notified_at = now
        angle = round(self.angle + self.random.uniform(-1, 1)) % 360
        x, y = self._seen(self.x), self._seen(self.y)
        sensor_x = max(0, round(x + SENSOR_AHEAD * math.cos(math.radians(angle))))
        sensor_y = max(0, round(y + SENSOR_AHEAD * math.sin(math.radians(angle))))
        self._notify(self.on_id, protocol.position(x, y, angle, sensor_x, sensor_y, angle))
