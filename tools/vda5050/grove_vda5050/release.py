# SPDX-License-Identifier: MIT
"""Determines, for each vehicle, the last node of its route that may be released to it.

A released base cannot be taken back. Therefore a node is released only when its vehicle may drive there and do all
actions there without further conditions. That is the case when every action for which the move to the node, or an
action on the node, waits has been reported as completed. Then, by the passing order, no other vehicle is on that place
or drives there, and none may be sent there before this vehicle has left it, because the other vehicles wait for that.
(Waits that the order omits follow from waits of earlier actions of the same robot, whose predecessors are completed,
too.) Consequently, if each vehicle holds its released nodes from the last node that it reported as reached on, no two
vehicles hold nodes with the same place. `grove vda5050 watch` checks this without using the order.
"""


class Releases:
    def __init__(self, order, routes):
        self.robots = {robot.name: robot for robot in order.robots}
        self.routes = routes
        self.done = dict.fromkeys(routes, 0)
        self.allowed = dict.fromkeys(routes, -1)    # {robot: last node that may be released}
        self.waiting = {}                           # {robot: names of the robots that wait for one of its actions}
        for name in routes:
            self._advance(name)

    def waits_for(self, name):
        """Returns an action, as (robot, action), that must be completed before the next node may be released.

        Returns None if there is no such action or no further node.
        """
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
        """Records that a robot has completed `done` actions. Returns the robots that may now drive further."""
        if done <= self.done[name]:
            return []
        self.done[name] = done
        woken = self.waiting.pop(name, set())
        before = {other: self.allowed[other] for other in woken}
        for other in woken:
            self._advance(other)
        return [other for other in woken if self.allowed[other] > before[other]]
