# SPDX-License-Identifier: MIT
"""Determines the last node of its route that each vehicle may be sent to.

A released base cannot be taken back. So a node is released only when its vehicle may drive there and do all actions
there without further conditions: for every action up to the next move, the action that it waits for is reported as
completed. By the passing order, no other vehicle is then on that place, drives there, or may be sent there before
this vehicle has left it, because the others wait for that. (Waits that the order omits follow from waits of earlier
actions of the same robot. These are completed, too, and so are the actions that they waited for.) Hence nodes
released to different vehicles never have a place in common, counted from the last node that each vehicle reported
to have reached. `watch` checks this without using the order.
"""


class Releases:
    def __init__(self, order, routes):
        self.robots = {robot.name: robot for robot in order.robots}
        self.routes = routes
        self.done = dict.fromkeys(routes, 0)
        self.allowed = dict.fromkeys(routes, -1)    # the last node that may be released
        self.waiting = {}                           # robot: names of the robots that wait for one of its actions
        for name in routes:
            self._advance(name)

    def waits_for(self, name):
        """Returns the (robot, action) that blocks the node after the last allowed one. Returns None if none does."""
        route, following = self.routes[name], self.allowed[name] + 1
        if following > route.last:
            return None
        node = route.nodes[following]
        for action in self.robots[name].actions[max(node.begin - 1, 0):node.end]:
            if action.after and self.done[action.after[0]] <= action.after[1]:
                return action.after
        return None

    def _advance(self, name):
        while self.allowed[name] < self.routes[name].last:
            after = self.waits_for(name)
            if after:
                self.waiting.setdefault(after[0], set()).add(name)
                return
            self.allowed[name] += 1

    def complete(self, name, done):
        """Records that `done` actions of a robot are completed. Returns the robots that may now drive further."""
        if done <= self.done[name]:
            return []
        self.done[name] = done
        woken = self.waiting.pop(name, set())
        before = {other: self.allowed[other] for other in woken}
        for other in woken:
            self._advance(other)
        return [other for other in woken if self.allowed[other] > before[other]]
