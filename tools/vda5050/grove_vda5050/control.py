# SPDX-License-Identifier: MIT
"""Fleet control: sends each vehicle along its route, as far as the passing order allows.

Messages can be lost, late or out of order. Therefore control infers from a message only facts that stay true: a node
that was reported as reached stays reached, a finished action stays finished, and an update whose number is in a
vehicle's state was received. Each vehicle has at most one unconfirmed update at a time. The next update continues the
base that the vehicle has confirmed. Control resends an update until the vehicle's state contains its number.
"""
from .route import actions_done

RESEND_SECONDS = 3.0        # vehicle seconds until an unconfirmed update is sent again
SILENT_SECONDS = 40.0       # real seconds; vehicles must send a state at least every 30 s


class Limits:
    """Maximum number of nodes of a vehicle's base after its current node, and of its horizon after the base."""

    def __init__(self, base, horizon):
        self.base, self.horizon = base, horizon


class Vehicle:
    def __init__(self, route):
        self.route = route
        self.online = False
        self.heard = None           # time of the last state, real seconds
        self.reached = -1           # last reached node; -1: the vehicle has not accepted an order yet
        self.finished = set()       # ids of finished VDA 5050 actions
        self.failed = {}            # {id of a failed VDA 5050 action: True}
        self.update = -1            # number of the last update sent
        self.released = -1          # last node of the vehicle's base
        self.confirmed = -1         # number of the last update that the vehicle has confirmed
        self.message = None
        self.sent = None            # time of the last update, vehicle seconds
        self.timestamp = ""         # timestamp of the latest state; older states do not change the fields below
        self.errors = ()
        self.driving = self.working = self.lost = False
        self.at = self.theta = None

    @property
    def completed(self):
        return self.reached == self.route.last and all(w.id in self.finished for n in self.route.nodes
                                                       for w in n.node_actions)


class Control:
    """Controls all vehicles of an order.

    send(vehicle, content) publishes an order. log(seconds, vehicle, ...) writes a line of the log;
    `seconds` are vehicle seconds.
    """

    def __init__(self, releases, style, order_id, limits, send, clock, log=None, say=lambda text: None):
        self.releases, self.style, self.order_id, self.limits = releases, style, order_id, limits
        self.send, self.clock, self.log, self.say = send, clock, log, say
        self.vehicles = {name: Vehicle(route) for name, route in releases.routes.items()}
        self.messages = self.resent = 0

    # ---- Messages from vehicles

    def on_connection(self, name, message):
        vehicle = self.vehicles[name]
        state = message.get("connectionState")
        if state == self.style.protocol.lost and not vehicle.lost:
            self.say(f"{self.clock.now():7.1f} s  {name} has lost its connection")
        vehicle.online, vehicle.lost = state == "ONLINE", state == self.style.protocol.lost
        self.log_line(name)
        self.extend(name)

    def on_state(self, name, message):
        vehicle = self.vehicles[name]
        vehicle.heard, vehicle.online, vehicle.lost = self.clock.real(), True, False
        if message.get("timestamp", "") >= vehicle.timestamp:
            vehicle.timestamp = message.get("timestamp", "")
            self._read_errors(name, message.get("errors", []))
            self._read_position(vehicle, message)
        if message.get("orderId") == self.order_id:
            self._read_progress(name, message)
        self.log_line(name)
        self.extend(name)

    def _read_progress(self, name, message):
        vehicle = self.vehicles[name]
        update = message.get("orderUpdateId", -1)
        if vehicle.confirmed < update <= vehicle.update:
            vehicle.confirmed = update
        sequence = message.get("lastNodeSequenceId", 0)
        if sequence % 2 == 0 and sequence // 2 <= vehicle.released:
            vehicle.reached = max(vehicle.reached, sequence // 2)
        for action in message.get("actionStates", []):
            if action.get("actionStatus") == "FINISHED":
                vehicle.finished.add(action.get("actionId"))
            elif action.get("actionStatus") == "FAILED" and action.get("actionId") not in vehicle.failed:
                vehicle.failed[action.get("actionId")] = True
                self.say(f"{self.clock.now():7.1f} s  {name}: action {action.get('actionId')} failed")
        if vehicle.reached >= 0:
            done = actions_done(vehicle.route, vehicle.reached, vehicle.finished)
            for other in self.releases.complete(name, done):
                self.extend(other)

    def _read_errors(self, name, errors):
        """Prints the errors of a state that the previous state did not contain."""
        vehicle = self.vehicles[name]
        found = tuple(f"{e.get('errorType')}" + (f": {e['errorDescription']}" if e.get("errorDescription") else "")
                      for e in errors)
        for each in found:
            if each not in vehicle.errors:
                self.say(f"{self.clock.now():7.1f} s  {name}: {each}")
        vehicle.errors = found

    def _read_position(self, vehicle, message):
        position = message.get(self.style.protocol.position)
        if position and position.get(self.style.protocol.localized):
            vehicle.at, vehicle.theta = (position["x"], position["y"]), position["theta"]
        vehicle.driving = bool(message.get("driving"))
        vehicle.working = any(a.get("actionStatus") in ("INITIALIZING", "RUNNING")
                              for a in message.get("actionStates", []))

    # ---- Orders to vehicles

    def extend(self, name):
        """Releases further nodes to a vehicle if the order and the limits allow it.

        Does nothing if the vehicle is offline or has an unconfirmed update.
        """
        vehicle = self.vehicles[name]
        if not vehicle.online or vehicle.confirmed < vehicle.update:
            return
        released = min(self.releases.allowed[name], max(vehicle.reached, 0) + self.limits.base)
        if released <= vehicle.released:
            return
        vehicle.update += 1
        vehicle.message = self.style.order(vehicle.route, self.order_id, vehicle.update, max(vehicle.released, 0),
                                           released, min(released + self.limits.horizon, vehicle.route.last))
        vehicle.released = released
        self._publish(name)

    def _publish(self, name):
        vehicle = self.vehicles[name]
        vehicle.sent = self.clock.now()
        self.messages += 1
        self.send(name, vehicle.message)

    def tick(self):
        """Resends updates that have been unconfirmed for RESEND_SECONDS. Call it several times per second."""
        for name, vehicle in self.vehicles.items():
            if vehicle.confirmed < vehicle.update and self.clock.now() - vehicle.sent > RESEND_SECONDS:
                self.resent += 1
                self._publish(name)

    # ---- Progress

    @property
    def completed(self):
        return all(vehicle.completed for vehicle in self.vehicles.values())

    def state_of(self, name):
        vehicle = self.vehicles[name]
        if vehicle.completed:
            return "done"
        if vehicle.lost or (vehicle.heard is not None and self.clock.real() - vehicle.heard > SILENT_SECONDS):
            return "lost"
        return "working" if vehicle.working else "moving" if vehicle.driving else "waiting"

    def log_line(self, name):
        vehicle = self.vehicles[name]
        if self.log and vehicle.reached >= 0:
            self.log(self.clock.now(), name, vehicle.at or vehicle.route.nodes[vehicle.reached].at, vehicle.theta,
                     self.releases.done[name], self.state_of(name))

    def reasons(self):
        """Yields for each vehicle that is not done a text that says why."""
        for name, vehicle in self.vehicles.items():
            if vehicle.completed:
                continue
            node = vehicle.route.nodes[max(vehicle.reached, 0)].id
            if vehicle.heard is None:
                yield f"{name} ({vehicle.route.serial}) has sent no state"
            elif vehicle.reached < 0:
                errors = "".join(f" ({e})" for e in vehicle.errors)
                yield f"{name} has not accepted its order, which begins on {node}{errors}"
            elif vehicle.failed:
                yield f"{name} on {node}: action {next(iter(vehicle.failed))} failed"
            elif vehicle.reached == vehicle.released and self.releases.waits_for(name):
                yield f"{name} on {node} waits for {self.releases.waits_for(name)[0]}"
            else:
                yield f"{name} is between {node} and {vehicle.route.nodes[vehicle.released].id}"
