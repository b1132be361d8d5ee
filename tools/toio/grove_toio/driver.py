# SPDX-License-Identifier: MIT
"""Drives cubes along a passing order.

Each robot does its actions one after the other and starts each as soon as the order allows it. An action is done when
the cube is detected at rest within the tolerance of the grid (mat.py). The response of the cube does not count, because
responses can be lost and come up to 15 units before the target. If the cube drives on without a stop, straight or round
a corner, the action is done when the cube is detected within the tolerance of its next lane.

A second check covers events outside the order, for instance a cube that a user lifts and puts back elsewhere. No cube
drives along a line that comes closer than the safe distance to another cube or to the line along which that cube
drives. As long as all cubes follow the order, this check never stops a cube.
"""
import asyncio
import math
from typing import NamedTuple

from . import rings
from .geometry import distance, nearer, turn_between
from .handle import Handle
from .mat import BODY
from .cells import HEADINGS
from .protocol import REACHED_BOX
from .simulated import UNITS_PER_SPEED

POLL = 0.03
CLEAR_TO_BEGIN, CLEAR_TO_CONTINUE = BODY + 1.0, BODY
LAST_UNITS = REACHED_BOX + 2    # distance below which a cube may ignore a target (REACHED_BOX plus noise), units
ROLL_SPEED = 20
REST_NOISE = 1.5                # a cube at rest can appear to be up to this far outside the tolerance, units
ASTRAY = 0.75                   # a cube farther from its lane is not driven back, cells
TURN_TOLERANCE = 8
ASK_SECONDS = 0.5
PATIENCE = 3.0                  # time that a cube has for its first position, seconds


class Outcome(NamedTuple):
    seconds: float
    completed: bool
    done: dict                  # {robot: number of actions done}
    all_actions: int
    writes: int
    repeats: int
    corrections: int            # number of short rolls over the last units
    waits: list                 # texts that say why robots are not done

    @property
    def actions(self):
        return sum(self.done.values())


class Driver:
    def __init__(self, order, cubes, grid, speed=40, step_seconds=1.0, log=None, say=lambda text: None):
        self.order, self.grid, self.speed, self.step_seconds = order, grid, speed, step_seconds
        self.loop = asyncio.get_running_loop()
        self.begun = self.loop.time()
        self.log, self.say = log, say
        self.handles = [Handle(robot, cubes[robot.name], grid.centre(robot.start), self.now) for robot in order.robots]
        self.by_name = {h.name: h for h in self.handles}
        self.at_ring = {ring: {} for ring in order.rings}     # {ring: {robot: index of last path point reached, or -1}}
        self.under_way = set()                                # rings in progress
        self.reported = {}                                    # {(robot, subject): (kind, text)}

    def now(self):
        return self.loop.time() - self.begun

    # ---- Conditions of the order

    def after_done(self, handle, k):
        after = handle.robot.actions[k].after
        return after is None or self.by_name[after[0]].done > after[1]

    def next_point(self, handle, k):
        """Returns the goal of action k + 1 if the cube may drive on to it without a stop; otherwise None."""
        actions = handle.robot.actions
        if k + 1 >= len(actions):
            return None
        following = actions[k + 1]
        if following.kind != "move" or following.ring is not None or following.place == handle.robot.place_before(k):
            return None
        return self.grid.centre(following.place) if self.after_done(handle, k + 1) else None

    def ring_cells(self, ring):
        return [self.order.robots[i].place_before(k) for i, k in self.order.rings[ring]]

    def ring_may_begin(self, ring):
        if ring in self.under_way:
            return True
        for i, k in self.order.rings[ring]:
            handle = self.handles[i]
            if handle.done != k or handle.name not in self.at_ring[ring] or not self.after_done(handle, k):
                return False
        cells = self.ring_cells(ring)
        if any(rings.near(cells, self.ring_cells(other)) for other in self.under_way):
            return False
        self.under_way.add(ring)
        return True

    # ---- One robot

    async def run_robot(self, handle):
        await self.reach(handle, handle.place, self.grid.tolerance)
        for k, action in enumerate(handle.robot.actions):
            if action.ring is not None:
                await self.go_round(handle, action.ring)
            else:
                await self.stand_until(handle, lambda k=k: self.after_done(handle, k))
                await getattr(self, action.kind)(handle, k, action)
            self.end_action(handle)
        await self.stand_until(handle, lambda: False, "done")

    def end_action(self, handle):
        handle.place = handle.goal
        handle.done += 1

    async def move(self, handle, k, action):
        await self.reach(handle, self.grid.centre(action.place), self.grid.tolerance,
                         lambda: self.next_point(handle, k))

    async def turn(self, handle, _, action):
        wanted = HEADINGS[action.heading]
        while True:
            if self.is_drivable(handle):
                if handle.at_rest and abs(turn_between(handle.angle, wanted)) <= TURN_TOLERANCE:
                    return
                if handle.at_rest:
                    self.set_state(handle, "moving")
                    await handle.turn(wanted, self.speed)
            await self.poll(handle)

    async def work(self, handle, _, action):
        """Executes a task. Only the time during which the cube stands on its cell counts."""
        left, then = action.steps * self.step_seconds, self.now()
        while left > 1e-6:
            if self.stands(handle):
                self.set_state(handle, "working")
                await self.poll(handle)
                left -= self.now() - then
            elif self.is_drivable(handle) and handle.at_rest:
                await self.reach(handle, handle.place, self.grid.tolerance)
            else:
                await self.poll(handle)
            then = self.now()

    async def go_round(self, handle, ring):
        """Drives the cube through a ring. No robot starts a part before all robots have completed the previous part."""
        those = [self.handles[i] for i, _ in self.order.rings[ring]]
        path = rings.wide_paths(self.ring_cells(ring))[those.index(handle)]
        tolerance = min(self.grid.tolerance, rings.TOLERANCE)
        parts = self.at_ring[ring]
        parts[handle.name] = -1
        await self.stand_until(handle, lambda: self.ring_may_begin(ring))
        for part, cell in enumerate(path):
            await self.reach(handle, self.grid.centre(cell), tolerance)
            handle.place = handle.goal
            parts[handle.name] = part
            await self.stand_until(handle, lambda part=part: all(parts[h.name] >= part for h in those))
        self.under_way.discard(ring)

    def stands(self, handle):
        return self.is_drivable(handle) and handle.at_rest \
            and distance(handle.mean, handle.place) <= self.grid.tolerance + REST_NOISE

    async def stand_until(self, handle, may, state="waiting"):
        """Waits until may() returns true. If the cube is pushed away in the meantime, drives it back to its place."""
        while not may():
            if not self.is_drivable(handle):
                pass
            elif handle.at_rest and not self.stands(handle):
                await self.reach(handle, handle.place, self.grid.tolerance)
            else:
                self.set_state(handle, state)
            await self.poll(handle)

    async def poll(self, handle):
        await asyncio.sleep(POLL)
        handle.settle()

    # ---- Motion

    async def reach(self, handle, goal, tolerance, next_point=lambda: None):
        """Drives the cube until it is at rest at the goal, or is detected on the lane from the goal to next_point()."""
        handle.goal = goal
        while True:
            handle.onward = onward = next_point()
            if self.is_drivable(handle):
                if onward and handle.in_lane(goal, onward, tolerance):
                    return
                if handle.at_rest and distance(handle.mean, goal) <= tolerance:
                    return
                await self.continue_to(handle, goal, onward)
            else:
                await self.hold(handle)
            await self.poll(handle)

    async def continue_to(self, handle, goal, onward):
        path = [goal, onward] if onward else [goal]
        if onward and self.in_the_way(handle, path):
            path = [goal]
        blocker = self.in_the_way(handle, path)
        if blocker:
            self.set_state(handle, "waiting")
            self.report(handle, "blocked", f"waits for {blocker.name}, which blocks its lane")
            await self.hold(handle)
            return
        self.withdraw(handle, "blocked")
        self.set_state(handle, "moving")
        if handle.command:
            await self.redirect(handle, path)
        elif handle.at_rest:
            await self.set_off(handle, path)

    @staticmethod
    async def hold(handle):
        """Sends a stop if the cube is detected and neither at rest nor stopping.

        Call it repeatedly, because messages can be lost.
        """
        stopping = handle.command is not None and handle.command.kind == "stop"
        if handle.seen_now and not stopping and not handle.at_rest:
            await handle.stop()

    async def redirect(self, handle, path):
        """Extends, shortens or stops a journey in progress. Other motions are short, so they are left to end."""
        if handle.command.kind != "journey" or handle.command.path[-1] == path[-1]:
            return
        if len(path) == 2 or not self.within_last_units(handle.position, path[0]):
            await handle.travel(path, self.speed)
        else:
            await handle.stop()

    async def set_off(self, handle, path):
        if len(path) == 1 and self.within_last_units(handle.mean, path[0]):
            await self.cover_last_units(handle, path[0])
        else:
            await handle.travel(path, self.speed)

    @staticmethod
    def within_last_units(point, goal):
        return abs(goal[0] - point[0]) <= LAST_UNITS and abs(goal[1] - point[1]) <= LAST_UNITS

    async def cover_last_units(self, handle, goal):
        """Turns or rolls the cube once, towards a goal so near that the cube could ignore it as a target.

        Turns it unless the goal is about straight ahead or behind; otherwise rolls it to the goal.
        """
        dx, dy = goal[0] - handle.mean[0], goal[1] - handle.mean[1]
        way, bearing = math.hypot(dx, dy), math.degrees(math.atan2(dy, dx))
        off = turn_between(handle.angle, bearing)
        forward = abs(off) <= 90
        if not forward:
            bearing += 180
            off = turn_between(handle.angle, bearing)
        if abs(off) > 7 and way * math.sin(math.radians(abs(off))) > 0.8:
            await handle.turn(bearing, self.speed)
        else:
            seconds = way / (ROLL_SPEED * UNITS_PER_SPEED)
            await handle.roll(ROLL_SPEED if forward else -ROLL_SPEED, max(10, 10 * round(100 * seconds)))

    def in_the_way(self, handle, path):
        least = CLEAR_TO_CONTINUE if handle.command else CLEAR_TO_BEGIN
        lane = [handle.position, *path]
        return next((other for other in self.handles
                     if other is not handle and nearer(lane, other.lane(), least)), None)

    # ---- Failures

    def is_drivable(self, handle):
        """Returns whether the cube can be driven. Reports each new cause if it cannot, and when it can again."""
        if handle.trouble:
            return self.report_undrivable(handle, "lost", handle.trouble)
        if handle.missing:
            return self.report_undrivable(handle, "lifted", "is off the mat")
        if handle.silent or handle.position is None:
            return self.report_undrivable(handle, "lost", "has stopped sending positions")
        if handle.strays() > ASTRAY * self.grid.pitch:
            stands, wanted = self.grid.cell(handle.position), self.grid.cell(handle.goal)
            return self.report_undrivable(
                handle, "lost", f"stands at [{stands[0]:.1f}, {stands[1]:.1f}], far from its lane to "
                                f"[{wanted[0]:.1f}, {wanted[1]:.1f}]; put the cube on its lane")
        self.withdraw(handle, "undrivable", "continues")
        return True

    def report_undrivable(self, handle, state, why):
        if handle.position is None and self.now() < PATIENCE:
            return False    # no report yet, because the first position has just been requested
        self.set_state(handle, state)
        self.report(handle, "undrivable", why)
        return False

    def report(self, handle, about, text):
        """Prints the text unless the last report on this subject was of the same kind."""
        kind = text.split(",")[0].split("[")[0]
        if self.reported.get((handle.name, about), ("",))[0] != kind:
            self.reported[handle.name, about] = kind, text
            self.say(f"{self.now():7.1f} s  {handle.name} {text}")

    def withdraw(self, handle, about, text=None):
        """Clears the report on a subject. If there was one, prints `text` unless it is None."""
        if self.reported.pop((handle.name, about), None) and text:
            self.say(f"{self.now():7.1f} s  {handle.name} {text}")

    def waits_of(self, handle):
        """Describes the fault of the cube, what the robot waits for, or what it does.

        Returns None if it has completed all its actions and no fault or blocked lane is reported.
        """
        k = handle.done
        if (handle.name, "undrivable") in self.reported:
            return f"{handle.name} {self.reported[handle.name, 'undrivable'][1]}"
        if (handle.name, "blocked") in self.reported:
            return f"{handle.name} {self.reported[handle.name, 'blocked'][1]}"
        if k == len(handle.robot.actions):
            return None
        action = handle.robot.actions[k]
        if not self.after_done(handle, k):
            return f"{handle.name} waits for {action.after[0]} to end action {action.after[1]}"
        if action.ring is not None:
            others = [self.handles[i].name for i, _ in self.order.rings[action.ring]]
            return f"{handle.name} waits for its ring with {', '.join(n for n in others if n != handle.name)}"
        return f"{handle.name} is doing action {k}"

    # ---- All robots

    def set_state(self, handle, state):
        if handle.state != state:
            handle.state = state
            self.log_line(handle)

    def log_line(self, handle):
        if self.log and handle.position is not None:
            self.log.write(self.now(), handle.name, self.grid.cell(handle.position), handle.angle + 90,
                           handle.done, handle.state)

    async def log_all(self):
        while True:
            await asyncio.sleep(0.1)
            for handle in self.handles:
                self.log_line(handle)

    async def ask_for_positions(self, handle):
        while not handle.configured:
            await handle.ask_for_positions()
            await asyncio.sleep(ASK_SECONDS)

    def all_done(self):
        return all(h.done == len(h.robot.actions) for h in self.handles)

    async def watch(self, seconds):
        while not self.all_done() and self.now() < seconds:
            await asyncio.sleep(POLL)

    async def drive(self, seconds=math.inf):
        """Drives all robots until they are done or `seconds` have passed. Then stops all cubes, even after errors."""
        tasks = [asyncio.create_task(work) for handle in self.handles
                 for work in (self.ask_for_positions(handle), self.run_robot(handle))]
        tasks.append(asyncio.create_task(self.log_all()))
        watch = asyncio.create_task(self.watch(seconds))
        try:
            await self.first_failure_or(watch, tasks)
            return self.outcome()
        finally:
            for task in (watch, *tasks):
                task.cancel()
            await asyncio.gather(watch, *tasks, return_exceptions=True)
            await self.stop_all()

    @staticmethod
    async def first_failure_or(watch, tasks):
        while not watch.done():
            running = [watch, *(t for t in tasks if not t.done())]
            done, _ = await asyncio.wait(running, return_when=asyncio.FIRST_COMPLETED)
            for task in done:
                task.result()

    async def stop_all(self):
        """Stops all cubes. Sends each stop three times, because messages can be lost."""
        for _ in range(3):
            await asyncio.gather(*(h.stop() for h in self.handles))
            await asyncio.sleep(0.05)
        for handle in self.handles:
            if handle.done == len(handle.robot.actions):
                self.set_state(handle, "done")

    def outcome(self):
        waits = [text for text in map(self.waits_of, self.handles) if text]
        return Outcome(self.now(), self.all_done(), {h.name: h.done for h in self.handles},
                       sum(len(h.robot.actions) for h in self.handles), sum(h.writes for h in self.handles),
                       sum(h.repeats for h in self.handles), sum(h.corrections for h in self.handles), waits)
