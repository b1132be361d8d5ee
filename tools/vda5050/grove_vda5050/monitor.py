# SPDX-License-Identifier: MIT
"""Monitors a drive at run time: checks these properties, from the messages alone, and reports violations.

1. Every message satisfies its published schema.
2. No vehicle reports a node that was not released to it.
3. A vehicle holds its released nodes, from the last node that it reported as reached on. No two vehicles hold nodes
   with the same place. Therefore vehicles that stay within their bases cannot meet, however late they are and
   whichever messages they have not received yet.
"""
import json
from collections import Counter
from pathlib import Path

from .protocol import Topics

MAX_REPORTED = 50
SCHEMAS = Path(__file__).resolve().parent / "schemas"


def load_validators(version):
    """Returns {topic: validator}. Returns None if the module jsonschema is not installed."""
    try:
        import jsonschema
    except ModuleNotFoundError:
        return None
    validators = {}
    for file in sorted((SCHEMAS / version).glob("*.schema")):
        schema = json.loads(file.read_text())
        validators[file.stem] = jsonschema.validators.validator_for(schema)(schema)
    return validators


class _Vehicle:
    def __init__(self):
        self.order = None
        self.nodes = {}         # {sequence number: id} of the released nodes
        self.reached = 0        # sequence number of the last reached node
        self.known_from = 0     # sequence number of the first node whose release was observed


class Monitor:
    def __init__(self, topics: Topics, say=lambda text: None):
        self.topics, self.say = topics, say
        self.validators = load_validators(topics.protocol.version)
        self.vehicles = {}
        self.claims = {}        # {node id: {serial: sequence numbers}} of released nodes
        self.messages = Counter()
        self.finished = {}      # {serial: ids of finished actions}
        self.violations = 0

    def on_message(self, topic, payload):
        serial, name = self.topics.serial_and_name(topic)
        self.messages[name] += 1
        try:
            message = json.loads(payload)
        except ValueError as error:
            self.report(serial, name, f"invalid JSON: {error}")
            return
        if not self._validate(serial, name, message):
            return
        try:
            if name == "order":
                self._on_order(serial, message)
            elif name == "state":
                self._on_state(serial, message)
        except (KeyError, TypeError) as error:  # a malformed message, if schemas are not checked
            self.report(serial, name, f"{type(error).__name__}: {error}")

    def report(self, serial, name, text):
        self.violations += 1
        if self.violations <= MAX_REPORTED:
            self.say(f"{serial}: {name}: {text}")

    def _validate(self, serial, name, message):
        if self.validators is None:
            return isinstance(message, dict)
        if name not in self.validators:
            return True     # no schema, because grove neither sends nor reads this topic
        error = next(self.validators[name].iter_errors(message), None)
        if error:
            place = "/" + "/".join(map(str, error.absolute_path))
            self.report(serial, name, f"{place}: {error.message[:200]}")
        elif [message["version"], message["serialNumber"]] != [self.topics.protocol.version, serial]:
            self.report(serial, name, f"header has {message['version']}, {message['serialNumber']}")
        else:
            return True
        return False

    def _on_order(self, serial, message):
        vehicle = self.vehicles.setdefault(serial, _Vehicle())
        if message["orderId"] != vehicle.order:
            for node in vehicle.nodes.values():
                self._give_back(serial, node)
            vehicle.order, vehicle.nodes, vehicle.reached = message["orderId"], {}, 0
            vehicle.known_from = message["nodes"][0]["sequenceId"]
        for node in message["nodes"]:
            sequence = node["sequenceId"]
            if not node["released"] or sequence < vehicle.reached:
                continue
            known = vehicle.nodes.setdefault(sequence, node["nodeId"])
            if known != node["nodeId"]:
                self.report(serial, "order", f"node {sequence} was {known} and is {node['nodeId']} now")
        self._claim(serial, vehicle, message)

    def _claim(self, serial, vehicle, message):
        for node in message["nodes"]:
            if not node["released"] or node["sequenceId"] < vehicle.reached:
                continue
            holders = self.claims.setdefault(node["nodeId"], {})
            for other in holders:
                if other != serial:
                    self.report(serial, "order", f"{node['nodeId']} is released, but {other} may still be there")
            holders.setdefault(serial, set()).add(node["sequenceId"])

    def _give_back(self, serial, node, sequence=None):
        holders = self.claims.get(node, {})
        those = holders.get(serial, set())
        those.discard(sequence)
        if sequence is None or not those:
            holders.pop(serial, None)

    def _on_state(self, serial, message):
        vehicle = self.vehicles.get(serial)
        self.finished.setdefault(serial, set()).update(
            a["actionId"] for a in message["actionStates"] if a["actionStatus"] == "FINISHED")
        if vehicle is None or message["orderId"] != vehicle.order:
            return
        sequence = message["lastNodeSequenceId"]
        if sequence < max(vehicle.reached, vehicle.known_from):
            return      # an old message, or a node before the first observed order
        if vehicle.nodes.get(sequence) != message["lastNodeId"]:
            self.report(serial, "state", f"is on {message['lastNodeId']}, node {sequence}, which was not released")
            return
        for passed in [s for s in vehicle.nodes if s < sequence]:
            self._give_back(serial, vehicle.nodes.pop(passed), passed)
        vehicle.reached = sequence

    @property
    def actions(self):
        return sum(map(len, self.finished.values()))
