# SPDX-License-Identifier: MIT
"""Describes the two supported versions of VDA 5050 (https://github.com/VDA5050/VDA5050) and their differences.

All differences are in this module; other modules write only the parts of messages that both versions have in common.
"""
from datetime import datetime, timezone
from typing import NamedTuple


class Protocol(NamedTuple):
    version: str            # value of the key "version"
    interface: str          # first level of topics, as the standard suggests for a local broker
    lost: str               # connectionState of a vehicle that has lost its connection
    position: str           # key of the vehicle's position
    localized: str          # key of the flag that says whether the vehicle knows its position
    turns_on_node: dict     # keys of an edge which say that the vehicle turns on the node before the edge
    deviation: object       # function: metres -> value of allowedDeviationXY
    power: tuple            # keys of the battery and of its charge
    emergency_stop: str     # key of the safety state


PROTOCOLS = {
    "2.1.0": Protocol("2.1.0", "uagv", "CONNECTIONBROKEN", "agvPosition", "positionInitialized",
                      {"rotationAllowed": False}, lambda metres: metres, ("batteryState", "batteryCharge"), "eStop"),
    "3.0.0": Protocol("3.0.0", "vda5050", "CONNECTION_BROKEN", "mobileRobotPosition", "localized",
                      {"reachOrientationBeforeEntering": True},
                      lambda metres: {"a": metres, "b": metres, "theta": 0.0}, ("powerSupply", "stateOfCharge"),
                      "activeEmergencyStop"),
}


class Topics(NamedTuple):
    protocol: Protocol
    interface: str
    manufacturer: str

    def topic(self, serial, name):
        return f"{self.interface}/v{self.protocol.version[0]}/{self.manufacturer}/{serial}/{name}"

    def serial_and_name(self, topic):
        return topic.split("/")[-2:]


class Header:
    """Adds headers with consecutive numbers to the messages of one topic."""

    def __init__(self, protocol, manufacturer, serial):
        self.fixed = {"version": protocol.version, "manufacturer": manufacturer, "serialNumber": serial}
        self.number = 0

    def message(self, content):
        now = datetime.now(timezone.utc).isoformat(timespec="milliseconds").replace("+00:00", "Z")
        header = {"headerId": self.number, "timestamp": now, **self.fixed}
        self.number = (self.number + 1) % 2 ** 32
        return header | content
