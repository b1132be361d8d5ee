# SPDX-License-Identifier: MIT
"""How far along their routes vehicles may go.

A released base cannot be taken back, so a node is released only when nothing has to happen any more
before its vehicle may go there and do what is to be done there: of every action up to the next move, the one that
it waits for is completed, and known to be. By the passing order then nobody else is on that place, goes
there, or may be sent there, before this vehicle has left it: the others wait for that. (Waits that the order
leaves out follow from waits of earlier actions of the same robot. Those are completed, too, and with them what
they waited for.) So what is released to different vehicles never has a place in common, from the node on
that each was last known to have reached; `watch` looks after that, without knowing the order."""


class Releases:
    def __init__(self, order, routes):
        self.robots = {robot.name: robot for robot in order.robots}
        self.routes = routes
        self.done = dict.fromkeys(routes, 0)
        self.allowed = dict.fromkeys(routes, -1)    # the last node that may be released
        self.waiting = {}                           # robot: those who wait for an action of it
        for name in routes:
            self._advance(name)

    def waits_for(self, name):
        """(robot, action) that keeps it from the node after the last allowed one; None: nothing does."""
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
        """So many actions of it are completed. Returns who may go further now."""
        if done <= self.done[name]:
            return []
        self.done[name] = done
        woken = self.waiting.pop(name, set())
        before = {other: self.allowed[other] for other in woken}
        for other in woken:
            self._advance(other)
        return [other for other in woken if self.allowed[other] > before[other]]
