# SPDX-License-Identifier: MIT
"""Simulates a fleet of vehicles, each with its own connection, and a world that records their true positions."""
import heapq
import itertools
import json
import math
import random
import time
from typing import NamedTuple

from .protocol import Header
from .vehicle import SimulatedVehicle

TICK = 0.02                 # real seconds between two steps of the simulation
HEARTBEAT = 10.0            # real seconds between states if nothing changes; VDA 5050 allows at most 30
NEAR = 1.5                  # pairs of vehicles up to this distance are always measured, cells


class Disturbances(NamedTuple):
    """Disturbances of messages and vehicles. All times are vehicle seconds."""
    delayed: float = 0.0    # share of delayed messages, in each direction
    delay: float = 2.0      # maximum delay, seconds
    lost: float = 0.0       # share of lost messages, in each direction
    stops: tuple = ()       # (robot, begin, duration) of each stop


class World:
    """Records the nodes that each vehicle holds. A vehicle on an edge holds both ends."""

    def __init__(self, cell):
        self.cell = cell
        self.holders = {}               # {node: vehicles}
        self.collisions = []
        self.least = math.inf           # least distance between two centres, metres
        self.least_pair = None

    def enter(self, vehicle, node):
        for other in self.holders.get(node, ()):
            if other is not vehicle:
                self.collisions.append(f"{vehicle.name} drove to {node}, where {other.name} was")
        self.holders.setdefault(node, []).append(vehicle)

    def leave(self, vehicle, node):
        if vehicle in self.holders.get(node, ()):
            self.holders[node].remove(vehicle)

    def measure(self, vehicles):
        bins = {}
        size = NEAR * self.cell
        for vehicle in vehicles:
            bins.setdefault((vehicle.x // size, vehicle.y // size), []).append(vehicle)
        for (i, j), those in bins.items():
            near = [v for di, dj in ((0, 0), (0, 1), (1, -1), (1, 0), (1, 1)) for v in bins.get((i + di, j + dj), ())]
            for one in those:
                for other in near:
                    if one is not other:
                        self._measure_pair(one, other)

    def _measure_pair(self, one, other):
        apart = math.hypot(one.x - other.x, one.y - other.y)
        if apart < self.least:
            self.least, self.least_pair = apart, (one.name, other.name)


class Fleet:
    """All vehicles of an order, initially on their starts. connect(topics, will, hello) returns a connection."""

    def __init__(self, connect, topics, routes, headings, cell, speed, turn_speed, disturbances, seed, clock):
        self.connect, self.topics, self.disturbances, self.clock = connect, topics, disturbances, clock
        self.random = random.Random(f"vehicles {seed}")
        self.world = World(cell)
        self.due = []                   # heap of pending calls: (time, number, function, arguments)
        self.numbers = itertools.count()
        self.vehicles, self.connections = [], []
        self.then = clock.now()         # time up to which the vehicles are simulated, vehicle seconds
        self.sent_at = {}               # {vehicle: time of its last message, real seconds}
        self.delayed = self.lost = self.received = 0
        for route in routes.values():
            self._add(route, headings[route.robot], speed, turn_speed)

    def _add(self, route, theta, speed, turn_speed):
        protocol = self.topics.protocol

        def topic(name):
            return self.topics.topic(route.serial, name)

        def state(text):
            return topic("connection"), header.message({"connectionState": text})

        def publish(name, message):
            self.sent_at[vehicle] = self.clock.real()
            self._by_radio(lambda: connection.publish(topic(name), message))

        header = Header(protocol, self.topics.manufacturer, route.serial)
        connection = self.connect([(topic("order"), 0)], will=state(protocol.lost), hello=state("ONLINE"))
        vehicle = SimulatedVehicle(protocol, route.robot, self.topics.manufacturer, route.serial, route.nodes[0].at,
                                   theta, self.world, publish, speed, turn_speed)
        connection.offline = state("OFFLINE")
        self.world.holders[route.nodes[0].id] = [vehicle]
        self.vehicles.append(vehicle)
        self.connections.append(connection)
        self._later(self.random.random(), vehicle.publish_state)

    # ---- Messages, with delays and losses

    def _later(self, seconds, function, *arguments):
        heapq.heappush(self.due, (self.clock.now() + seconds, next(self.numbers), function, arguments))

    def _by_radio(self, function, *arguments):
        drawn = self.random.random()
        if drawn < self.disturbances.lost:
            self.lost += 1
        elif drawn < self.disturbances.lost + self.disturbances.delayed:
            self.delayed += 1
            self._later(self.random.uniform(0, self.disturbances.delay), function, *arguments)
        else:
            function(*arguments)

    def _receive(self, vehicle, payload):
        self.received += 1
        try:
            order = json.loads(payload)
        except ValueError:
            order = None
        vehicle.receive(order)

    # ---- Run

    def run(self):
        """Runs until an exception ends it."""
        while True:
            time.sleep(TICK)
            self.step()

    def step(self):
        """Simulates the time since the previous call."""
        now = self.clock.now()
        self._deliver(now)
        self._stop_and_go(now)
        for vehicle in self.vehicles:
            vehicle.tick(now - self.then)
            if self.clock.real() - self.sent_at.get(vehicle, self.clock.real()) > HEARTBEAT:
                vehicle.publish_state()
        self.world.measure(self.vehicles)
        self.then = now

    def _deliver(self, now):
        for vehicle, connection in zip(self.vehicles, self.connections):
            while not connection.inbox.empty():
                self._by_radio(self._receive, vehicle, connection.inbox.get().payload)
        while self.due and self.due[0][0] <= now:
            _, _, function, arguments = heapq.heappop(self.due)
            function(*arguments)

    def _stop_and_go(self, now):
        for robot, begin, seconds in self.disturbances.stops:
            vehicle = next(v for v in self.vehicles if v.name == robot)
            vehicle.stopped = begin <= now < begin + seconds

    def close(self):
        for connection in self.connections:
            connection.publish(*connection.offline, qos=1, retain=True)
            connection.close()
