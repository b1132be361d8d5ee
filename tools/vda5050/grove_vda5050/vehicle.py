# SPDX-License-Identifier: MIT
"""Simulates a vehicle, which accepts orders, drives only along its base and publishes its state.

It refuses orders that do not continue its current order (VDA 5050 2.1.0, 6.6.2 and figure 8; 3.0.0, 6.1.2).
"""
import math

from .protocol import Header

START_TOLERANCE = 0.3       # maximum distance from the first node of a new order, metres
ALIGNED = 1e-6


class Refused(Exception):
    """Raised to refuse an order. `kinds`: error types in versions 2.1.0 and 3.0.0."""

    def __init__(self, kinds, why):
        super().__init__(why)
        self.kinds = kinds


MALFORMED = ("validationError", "VALIDATION_FAILURE")
OUTDATED = ("orderUpdateError", "OUTDATED_ORDER_UPDATE")
NO_CONTINUATION = ("orderUpdateError", "VALIDATION_FAILURE")
BUSY = ("orderError", "OTHER_ORDER_ACTIVE")
TOO_FAR = ("orderError", "START_NODE_OUT_OF_RANGE")


def turn_between(angle, goal):
    return (goal - angle + math.pi) % (2 * math.pi) - math.pi


class SimulatedVehicle:
    """A simulated vehicle. publish(topic, message) sends a message; world.enter() and world.leave() receive its nodes.
    """

    def __init__(self, protocol, name, manufacturer, serial, at, theta, world, publish, speed=1.0,
                 turn_speed=math.pi / 2):
        self.protocol, self.name, self.serial, self.world = protocol, name, serial, world
        self.publish = publish
        self.x, self.y = at
        self.theta = theta
        self.speed, self.turn_speed = speed, turn_speed
        self.header = Header(protocol, manufacturer, serial)
        self.order_id, self.update = "", 0
        self.nodes, self.edges = [], []         # nodes and edges ahead: first base, then horizon
        self.base_end = None                    # (id, sequence number) of the last released node
        self.last = ("", 0)                     # (id, sequence number) of the last reached node
        self.to_do = []                         # actions left on that node
        self.action_states = {}                 # {id: [type, status]}
        self.left = None                        # remaining seconds of the running action, or None
        self.errors = []
        self.driving = False
        self.on_edge = False
        self.map_id = ""
        self.stopped = False
        self.acted = 0                          # number of finished actions
        self.refused = 0

    # ---- Orders

    def receive(self, order):
        try:
            self._take(order)
        except (KeyError, TypeError, IndexError, AttributeError) as error:
            self._refuse(order, Refused(MALFORMED, f"{type(error).__name__}: {error}"))
        except Refused as refused:
            self._refuse(order, refused)
        self.publish_state()

    def _refuse(self, order, refused):
        self.refused += 1
        references = [{"referenceKey": key, "referenceValue": str(order[key])} for key in ("orderId", "orderUpdateId")
                      if isinstance(order, dict) and key in order]
        self.errors = [{"errorType": refused.kinds[self.protocol.version[0] != "2"], "errorLevel": "WARNING",
                        "errorDescription": str(refused), "errorReferences": references}]

    @property
    def is_idle(self):
        return not self.nodes and not self.to_do

    def _take(self, order):
        nodes, edges = order["nodes"], order["edges"]
        if not nodes or len(edges) != len(nodes) - 1 or not nodes[0]["released"]:
            raise Refused(MALFORMED, "nodes and edges do not form a path")
        if any(a["released"] < b["released"] for a, b in zip(nodes, nodes[1:])):
            raise Refused(MALFORMED, "a released node follows the horizon")
        first = (nodes[0]["nodeId"], nodes[0]["sequenceId"])
        if order["orderId"] != self.order_id:
            self._begin(order, nodes[0], first)
        elif order["orderUpdateId"] <= self.update:
            if order["orderUpdateId"] < self.update:
                raise Refused(OUTDATED, f"update {order['orderUpdateId']} is older than {self.update}")
            return
        elif first != (self.last if self.is_idle else self.base_end):
            raise Refused(NO_CONTINUATION, f"the base ends with {self.base_end}, not {first}")
        self._append(order, nodes[1:], edges)

    def _begin(self, order, node, first):
        if not self.is_idle:
            raise Refused(BUSY, f"order {self.order_id} is not done")
        at = node["nodePosition"]
        if math.hypot(at["x"] - self.x, at["y"] - self.y) > START_TOLERANCE:
            raise Refused(TOO_FAR, f"it is at ({self.x:.2f}, {self.y:.2f})")
        self.nodes, self.edges, self.action_states, self.map_id = [], [], {}, at["mapId"]
        self.last = self.base_end = first
        self.to_do = list(node["actions"])
        self._know_actions([node])

    def _append(self, order, nodes, edges):
        self.order_id, self.update, self.errors = order["orderId"], order["orderUpdateId"], []
        dropped = {a["actionId"] for node in self.nodes if not node["released"] for a in node["actions"]}
        for action in dropped:
            self.action_states.pop(action, None)
        self.nodes = [node for node in self.nodes if node["released"]] + nodes
        self.edges = [edge for edge in self.edges if edge["released"]] + edges
        self._know_actions(nodes)
        for node in nodes:
            if node["released"]:
                self.base_end = (node["nodeId"], node["sequenceId"])

    def _know_actions(self, nodes):
        for node in nodes:
            for action in node["actions"]:
                self.action_states[action["actionId"]] = [action["actionType"], "WAITING"]

    # ---- Motion

    def tick(self, seconds):
        """Simulates `seconds` seconds, in which the vehicle does actions and drives, one after the other."""
        while seconds > 1e-9 and not self.stopped:
            if self.to_do:
                seconds = self._act(seconds)
            elif self.nodes and self.nodes[0]["released"] and self.edges[0]["released"]:
                seconds = self._drive(seconds)
            else:
                break
        if self.stopped or not (self.nodes and self.nodes[0]["released"]):
            self._set_driving(False)

    def _set_driving(self, driving):
        if self.driving != driving:
            self.driving = driving
            self.publish_state()

    def _act(self, seconds):
        action = self.to_do[0]
        state = self.action_states[action["actionId"]]
        if self.left is None:
            parameters = {p["key"]: p["value"] for p in action.get("actionParameters", [])}
            self.left = float(parameters.get("seconds", 0))
            state[1] = "RUNNING"
            self.driving = False
            if self.left > 0:
                self.publish_state()
        used = min(seconds, self.left)
        self.left -= used
        if self.left <= 1e-9:
            state[1] = "FINISHED"
            self.left = None
            self.to_do.pop(0)
            self.acted += 1
            self.publish_state()
        return seconds - used

    def _drive(self, seconds):
        node, edge = self.nodes[0], self.edges[0]
        goal = node["nodePosition"]
        dx, dy = goal["x"] - self.x, goal["y"] - self.y
        way = math.hypot(dx, dy)
        if not self.on_edge and "orientation" in edge and way:
            turned = self._turn(math.atan2(dy, dx) + edge["orientation"], seconds)
            if turned is not None:
                return turned
        if not self.on_edge:
            self.on_edge = True
            self.world.enter(self, node["nodeId"])
        self._set_driving(True)
        used = min(seconds, way / self.speed)
        share = 1.0 if way <= self.speed * seconds else self.speed * used / way
        self.x, self.y = self.x + share * dx, self.y + share * dy
        if share < 1.0:
            return 0.0
        if "theta" in goal:
            turned = self._turn(goal["theta"], seconds - used)
            if turned is not None:
                return turned
        self._reach(node)
        return seconds - used

    def _turn(self, goal, seconds):
        """Turns towards a heading and returns the seconds left. Returns None if the vehicle already has the heading."""
        off = turn_between(self.theta, goal)
        if abs(off) < ALIGNED:
            return None
        self._set_driving(True)
        used = min(seconds, abs(off) / self.turn_speed)
        self.theta += math.copysign(min(abs(off), used * self.turn_speed), off)
        if used < seconds:
            self.theta = goal
        return seconds - used

    def _reach(self, node):
        self.world.leave(self, self.last[0])
        self.on_edge = False
        self.last = (node["nodeId"], node["sequenceId"])
        self.nodes.pop(0)
        self.edges.pop(0)
        self.to_do = list(node["actions"])
        if not self.to_do:
            self.publish_state()

    # ---- State

    def position(self):
        theta = round(turn_between(0.0, self.theta), 5)     # 5 decimals, because -3.14159 is within the limits
        return {"x": round(self.x, 4), "y": round(self.y, 4), "theta": theta, "mapId": self.map_id,
                self.protocol.localized: True}

    def publish_state(self):
        battery, charge = self.protocol.power
        content = {
            "orderId": self.order_id, "orderUpdateId": self.update, "lastNodeId": self.last[0],
            "lastNodeSequenceId": self.last[1], "driving": self.driving, "paused": self.stopped,
            "newBaseRequest": bool(self.nodes) and not self.nodes[0]["released"], "operatingMode": "AUTOMATIC",
            "nodeStates": [{k: n[k] for k in ("nodeId", "sequenceId", "released")} for n in self.nodes],
            "edgeStates": [{k: e[k] for k in ("edgeId", "sequenceId", "released")} for e in self.edges],
            "actionStates": [{"actionId": k, "actionType": v[0], "actionStatus": v[1]}
                             for k, v in self.action_states.items()],
            "errors": self.errors, self.protocol.position: self.position(), battery: {charge: 80.0, "charging": False},
            "safetyState": {self.protocol.emergency_stop: "NONE", "fieldViolation": False}}
        if self.protocol.version[0] != "2":
            content["instantActionStates"] = []
        self.publish("state", self.header.message(content))
