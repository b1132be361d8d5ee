# SPDX-License-Identifier: MIT
"""Tests control and simulated vehicles in the same combination as in the program, at several paces and in virtual
time.

Times in the log are in seconds of the vehicles, so that they can be compared with the times of the plan."""
import functools
import json
import queue
import tempfile
import unittest
from pathlib import Path

import orders
from grove_vda5050 import cli, fleet
from grove_vda5050.clock import Clock
from grove_vda5050.mqtt import Message, encode


class Broker:
    """Forwards messages to all connections and stores retained messages."""

    def __init__(self):
        self.kept = {}
        self.connections = []

    def publish(self, message, retain):
        if retain:
            self.kept[message.topic] = message
        for connection in self.connections:
            connection.receive(message)


class Connection:
    failure = None

    def __init__(self, broker, topics, will=None, hello=None, pause=None):
        """Connects to the broker. While get() waits, it calls `pause()`, which advances the time. None: get() must not
        wait."""
        self.broker, self.topics, self.inbox, self.pause = broker, [t.split("/") for t, _ in topics], self, pause
        self.messages = queue.SimpleQueue()
        broker.connections.append(self)
        for message in broker.kept.values():
            self.receive(message)
        if hello:
            self.publish(*hello, retain=True)

    def publish(self, topic, message, qos=0, retain=False):
        self.broker.publish(Message(topic, encode(message)), retain)

    def receive(self, message):
        levels = message.topic.split("/")
        if any(len(t) == len(levels) and all(a in ("+", b) for a, b in zip(t, levels)) for t in self.topics):
            self.messages.put(message)

    def empty(self):
        return self.messages.empty()

    def get(self, timeout=0.0):
        while self.empty():
            if timeout <= 0:
                raise queue.Empty
            self.pause()
            timeout -= fleet.TICK
        return self.messages.get()


class Drive:
    """Runs `grove vda5050 trial` with options in this process, with Broker instead of mosquitto."""

    def __init__(self, name, *options):
        self.seconds = 0.0
        with tempfile.TemporaryDirectory() as folder:
            log_file = Path(folder) / "drive.jsonl"
            a = cli._parser().parse_args(["trial", str(orders.order_file(name, False)), "--log", str(log_file),
                                          *options])
            setup, clock, broker = cli.Setup(a), Clock(a.pace, lambda: self.seconds), Broker()
            self.fleet = cli._fleet(a, setup, functools.partial(Connection, broker), clock)
            topics = [(setup.topics.topic("+", name), 0) for name in ("state", "connection")]
            with cli._log(a, setup) as log:
                drive = cli._Drive(a, setup, Connection(broker, topics, pause=self.pause), clock, log,
                                   lambda text: None)
                self.completed = drive.run()
            self.summary = list(drive.summary())
            self.lines = [json.loads(line) for line in log_file.read_text().splitlines()[1:]]

    def pause(self):
        self.seconds += fleet.TICK
        self.fleet.step()

    @property
    def end(self):
        return self.lines[-1]["t"]

    def first(self, robot, action):
        """Returns the first time at which the robot had completed `action` actions."""
        return next(line["t"] for line in self.lines if line["robot"] == robot and line["action"] >= action)


@functools.cache
def drive(*arguments):
    return Drive(*arguments)


def planned_ends(name):
    """Returns {robot: (number of actions, planned end of the last action in steps)} of the robots with actions."""
    robots = json.loads(orders.order_file(name, False).read_text())["robots"]
    return {r["id"]: (len(r["actions"]), r["actions"][-1]["planned"] + r["actions"][-1]["steps"])
            for r in robots if r["actions"]}


def lateness(one, name):
    """Returns the delay of each robot at its end in seconds, at one second per step, as the page of a drive log
    shows it."""
    return {robot: one.first(robot, count) - end for robot, (count, end) in planned_ends(name).items()}


class Paces(unittest.TestCase):
    def test_log_times_are_seconds_of_the_vehicles(self):
        calm = drive("dense")
        for pace in (4, 20):
            one = drive("dense", "--pace", str(pace))
            self.assertTrue(one.completed)
            self.assertAlmostEqual(one.end, one.seconds * pace, delta=3)
            # At a higher pace the same latency is longer in seconds of the vehicles.
            self.assertAlmostEqual(one.end / calm.end, 1, delta=0.5)
            self.assertLess(one.seconds, calm.seconds / 2)
            self.assertEqual(one.fleet.world.collisions, [])

    def test_slow_vehicles_are_late_at_any_pace(self):
        for pace in ("1", "10"):
            in_time, slow = (drive("dense", "--pace", pace, "--turn-speed", "100000", "--speed", speed)
                             for speed in ("2", "0.25"))
            longest = max(end for _, end in planned_ends("dense").values())
            self.assertLess(max(lateness(in_time, "dense").values()), longest)
            self.assertGreater(max(lateness(slow, "dense").values()), 2.5 * longest)

    def test_stop_lasts_as_long_as_requested(self):
        for pace in ("1", "10"):
            one = drive("narrow", "--pace", pace, "--stop", "down@3=60")
            self.assertTrue(one.completed)
            moves = [line for line in one.lines if line["robot"] == "down" and line["state"] == "moving"]
            gap = max(b["t"] - a["t"] for a, b in zip(moves, moves[1:]))
            self.assertAlmostEqual(gap, 60, delta=4)
            self.assertGreater(min(lateness(one, "narrow").values()), 50)

    def test_message_delay_is_in_seconds_of_the_vehicles(self):
        ends = [drive("many", "--pace", pace, "--delayed", "0.3", "--delay", "5", "--lost", "0.1").end
                for pace in ("1", "10")]
        self.assertAlmostEqual(ends[1] / ends[0], 1, delta=0.4)

    def test_time_limit_is_in_real_seconds(self):
        one = drive("narrow", "--pace", "10", "--stop", "down@1=1000000", "--time-limit", "20")
        self.assertFalse(one.completed)
        self.assertAlmostEqual(one.seconds, 20, delta=0.5)
        self.assertEqual(one.summary[0],
                         f"Time          {10 * one.seconds:.1f} s of the vehicles, {one.seconds:.1f} s real")
