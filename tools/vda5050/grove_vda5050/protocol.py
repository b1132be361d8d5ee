# SPDX-License-Identifier: MIT
"""The two versions of VDA 5050 that are spoken, and what differs between them.

https://github.com/VDA5050/VDA5050. Of a message only what both have in common is written elsewhere."""
from datetime import datetime, timezone
from typing import NamedTuple


class Protocol(NamedTuple):
    version: str            # as messages have it
    interface: str          # first level of topics, as suggested for a local broker
    lost: str               # connectionState of a vehicle that is not heard any more
    position: str           # key of a vehicle's position, and of whether it knows it
    localized: str
    turns_on_node: dict     # an edge on which the vehicle does not turn, but on the node before
    deviation: object       # allowedDeviationXY of so many metres
    power: tuple            # key of the battery, and of its charge
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
    """Of the messages of one topic."""

    def __init__(self, protocol, manufacturer, serial):
        self.fixed = {"version": protocol.version, "manufacturer": manufacturer, "serialNumber": serial}
        self.number = 0

    def message(self, content):
        now = datetime.now(timezone.utc).isoformat(timespec="milliseconds").replace("+00:00", "Z")
        header = {"headerId": self.number, "timestamp": now, **self.fixed}
        self.number = (self.number + 1) % 2 ** 32
        return header | content
