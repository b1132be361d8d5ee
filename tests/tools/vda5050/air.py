# SPDX-License-Identifier: MIT
"""Simulates control, vehicles and a monitor in virtual time, without a broker.

Messages can be delayed, reordered or lost."""
import functools
import heapq
import json
import math
import random

import orders
from grove_driving.order import read_order
from grove_vda5050.clock import Clock
from grove_vda5050.control import Control, Limits
from grove_vda5050.fleet import World
from grove_vda5050.messages import Style
from grove_vda5050.protocol import PROTOCOLS, Header, Topics
from grove_vda5050.release import Releases
from grove_vda5050.route import THETA, check_order, make_route
from grove_vda5050.vehicle import SimulatedVehicle
from grove_vda5050.monitor import Monitor

TICK = 0.1
HEARTBEAT = 10.0


@functools.cache
def order(name, following=True):
    return read_order(orders.order_file(name, following))


@functools.cache
def routes(name, following=True):
    check_order(name, order(name, following))
    return {r.name: make_route(r, r.name) for r in order(name, following).robots}


def style(version="2.1.0"):
    return Style(PROTOCOLS[version], "map", 0.1, "work", "visit", 1.0)


class Air:
    def __init__(self, name, following=True, version="2.1.0", delayed=0.0, lost=0.0, seed=0, base=10, horizon=5,
                 releases=Releases, stops=None):
        self.now, self.number, self.due = 0.0, 0, []
        self.random = random.Random(f"{name} {seed}")
        self.delayed, self.lost = delayed, lost
        self.stops = stops or {}                # robot: (begin, end)
        self.topics = Topics(PROTOCOLS[version], "i", "m")
        self.reports = []
        self.monitor = Monitor(self.topics, self.reports.append)
        self.world = World(1.0)
        those = routes(name, following)
        self.control = Control(releases(order(name, following), those), style(version), "an order",
                               Limits(base, horizon), self.send, Clock(monotonic=lambda: self.now))
        self.headers = {robot: Header(PROTOCOLS[version], "m", robot) for robot in those}
        self.vehicles, self.sent_at = {}, {}
        for robot in order(name, following).robots:
            self.add(robot, those[robot.name], version)

    def add(self, robot, route, version):
        def publish(topic, message):
            self.sent_at[robot.name] = self.now
            self.schedule(self.on_vehicle_message, robot.name, topic, message)

        speed = self.random.uniform(0.5, 3)
        self.vehicles[robot.name] = SimulatedVehicle(PROTOCOLS[version], robot.name, "m", route.serial,
                                                     route.nodes[0].at,
                                                     THETA.get(robot.heading, 0.0), self.world, publish, speed, math.pi)
        self.world.holders[route.nodes[0].id] = [self.vehicles[robot.name]]
        self.vehicles[robot.name].publish_state()

    # ---- messages

    def schedule(self, function, *arguments):
        if self.random.random() < self.lost:
            return
        seconds = self.random.uniform(0, 20) if self.random.random() < self.delayed else 0.0
        self.number += 1
        heapq.heappush(self.due, (self.now + seconds, self.number, function, arguments))

    def notify_monitor(self, serial, name, message):
        """Passes a message to the monitor, in the order in which a broker would receive messages."""
        self.monitor.on_message(self.topics.topic(serial, name), json.dumps(message).encode())

    def send(self, robot, content):
        message = json.loads(json.dumps(self.headers[robot].message(content)))
        self.notify_monitor(robot, "order", message)
        self.schedule(self.vehicles[robot].receive, message)

    def on_vehicle_message(self, robot, name, message):
        self.notify_monitor(robot, name, message)
        self.control.on_state(robot, json.loads(json.dumps(message)))

    # ---- the execution

    def drive(self, seconds=3000):
        """Runs until all robots are done or `seconds` virtual seconds have passed. Returns whether all are done."""
        while self.now < seconds and not self.control.completed:
            self.now += TICK
            while self.due and self.due[0][0] <= self.now:
                _, _, function, arguments = heapq.heappop(self.due)
                function(*arguments)
            for robot, vehicle in self.vehicles.items():
                begin, end = self.stops.get(robot, (0, 0))
                vehicle.stopped = begin <= self.now < end
                vehicle.tick(TICK)
                if self.now - self.sent_at[robot] > HEARTBEAT:
                    vehicle.publish_state()
            self.control.tick()
        return self.control.completed
