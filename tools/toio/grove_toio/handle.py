# SPDX-License-Identifier: MIT
"""Tracks one cube for the driver: last position, current command, and whether the command is still running."""
from collections import deque
from typing import NamedTuple

from . import protocol
from .geometry import distance, point_to_segment, turn_between

ANSWER_SECONDS = 0.5        # after this time without motion or response, a message was lost or the cube has stopped
SETTLE_SECONDS = 0.06       # time from the end of a motion until notified positions are those of a cube at rest
SILENT_SECONDS = 1.0
MOVED, TURNED = 3.5, 7      # larger changes are motion and not noise, units and degrees
SEEN_AT_REST = 3            # number of positions at rest that an arrival requires
TIMEOUT = 5                 # time limit of the cube for each target, seconds


class Command(NamedTuple):
    kind: str               # journey, turn, wheels or stop
    path: tuple             # points to which the command leads
    number: int
    written: float
    until: float            # time at which a command of kind wheels or stop ends


class Handle:
    """A cube together with the robot whose actions it does."""

    def __init__(self, robot, cube, place, now):
        self.robot, self.cube, self.name, self.now = robot, cube, robot.name, now
        self.place = self.goal = place      # centres of its current or last cell, and of its next cell
        self.onward = None                  # point to which it may drive on from the goal without a stop, or None
        self.done = 0                       # number of actions done
        self.state = "waiting"
        self.command = None
        self.number = 0
        self.position = self.angle = None
        self.seen = now()
        self.missing = False
        self.trouble = None                 # text that says why the cube cannot be driven, or None
        self.configured = False
        self.moved_at, self.moved_from = now(), None
        self.rest_since = now()
        self.history = deque(maxlen=5)
        self.writes = self.repeats = self.corrections = 0
        self.last_path = None
        cube.on_id, cube.on_motor, cube.on_configuration = self._on_id, self._on_motor, self._on_configuration

    # ---- notifications

    def _on_configuration(self, data):
        self.configured = self.configured or data[:1] == b"\x98"

    def _on_id(self, data):
        found = protocol.read_id_notification(data)
        if isinstance(found, protocol.Missed):
            self.missing = True
            self.history.clear()
        elif found:
            self.missing = False
            self.position, self.angle, self.seen = (found.x, found.y), found.angle, self.now()
            self.history.append((self.seen, self.position))
            self._note_motion()

    def _note_motion(self):
        if self.moved_from is None or distance(self.position, self.moved_from[0]) > MOVED \
                or abs(turn_between(self.angle, self.moved_from[1])) > TURNED:
            self.moved_from, self.moved_at = (self.position, self.angle), self.seen

    def _on_motor(self, data):
        found = protocol.read_motor_notification(data)
        if not found or not self.command or found.number != self.command.number:
            return
        if found.code == protocol.BAD_STATE:
            self.trouble = "is being switched off"
        elif found.code == protocol.UNSUPPORTED:
            self.trouble = "does not accept the commands (firmware older than 2.1.0, or --speed too low?)"
        # All other codes (done, timeout, off the mat, nothing to do, replaced) end the motion. The position of the
        # cube then determines the next command.
        if self.command.kind in ("journey", "turn"):
            self._end_command()

    def _end_command(self):
        self.command, self.rest_since = None, self.now() + SETTLE_SECONDS

    def settle(self):
        """Treats the command as ended if its duration, or ANSWER_SECONDS without motion or response, have passed."""
        if self.command is None:
            return
        if self.command.kind in ("wheels", "stop"):
            over = self.now() >= self.command.until
        else:
            over = self.now() - max(self.command.written, self.moved_at) > ANSWER_SECONDS
        if over:
            self._end_command()

    # ---- State

    @property
    def silent(self):
        return self.now() - self.seen > SILENT_SECONDS

    @property
    def seen_now(self):
        return self.position is not None and not self.missing and not self.silent

    def _positions_at_rest(self):
        return [p for t, p in self.history if t >= self.rest_since]

    @property
    def at_rest(self):
        """Whether no command is running, the cube is detected, and its latest positions are equal up to noise."""
        if self.command is not None or not self.seen_now:
            return False
        those = self._positions_at_rest()
        return len(those) >= SEEN_AT_REST and all(distance(p, those[0]) <= MOVED for p in those)

    @property
    def mean(self):
        those = self._positions_at_rest()
        return (sum(x for x, _ in those) / len(those), sum(y for _, y in those) / len(those))

    def in_lane(self, a, b, tolerance):
        return point_to_segment(self.position, a, b) <= tolerance

    def lane(self):
        """Returns the path on which the cube may be from now on, as far as it is known."""
        if not self.seen_now:
            return [self.place, self.goal]
        if self.command is None or self.command.kind == "stop":
            return [self.position]
        path = list(self.command.path)
        return [self.position] + (path[path.index(self.goal):] if self.goal in path else path)

    def strays(self):
        """Returns the distance of the cube from its lane, in units."""
        path = [self.place, self.goal, *([self.onward] if self.onward else [])]
        return min(point_to_segment(self.position, a, b) for a, b in zip(path, path[1:]))

    # ---- commands

    async def _write(self, data, kind, path, seconds=0.0):
        self.writes += 1
        self.command = Command(kind, tuple(path), self.number, self.now(), self.now() + seconds)
        await self.cube.write(data)

    def _next_number(self):
        self.number = (self.number + 1) % 256
        return self.number

    async def travel(self, path, speed):
        """Starts a journey to the points of `path` in order. `path`: one or two points."""
        self.repeats += tuple(path) == self.last_path
        self.last_path = tuple(path)
        those = [protocol.Target(round(x), round(y)) for x, y in path]
        number = self._next_number()
        data = protocol.one_target(number, those[0], speed, TIMEOUT) if len(those) == 1 \
            else protocol.targets(number, those, speed, TIMEOUT)
        await self._write(data, "journey", path)

    async def turn(self, angle, speed):
        target = protocol.Target(protocol.SAME, protocol.SAME, round(angle) % 360, protocol.SHORTEST)
        await self._write(protocol.one_target(self._next_number(), target, speed, TIMEOUT), "turn", [self.goal])

    async def roll(self, speed, milliseconds):
        """Drives straight forwards or backwards for `milliseconds`. The loss of this command does no harm."""
        self.corrections += 1
        data = protocol.wheels(speed, speed, milliseconds)
        await self._write(data, "wheels", [self.goal], milliseconds / 1000 + 0.1)

    async def stop(self):
        await self._write(protocol.stop(), "stop", [], 0.1)

    async def ask_for_positions(self):
        """Requests positions continuously, even at rest, so that lost messages are noticed."""
        await self.cube.configure(protocol.notify_positions(3, 0))
