# SPDX-License-Identifier: MIT
"""Connects to an MQTT broker with paho (Debian: python3-paho-mqtt 1.6)."""
import json
import queue
import threading
from typing import NamedTuple

from grove_driving.bad_input import BadInput

CONNECT_SECONDS = 10.0
MOST_SEND = 1000000


class Broker(NamedTuple):
    host: str
    port: int
    username: str = None
    password: str = None
    ca_file: str = None         # file of the certificates to trust with TLS
    tls: bool = False

    def __str__(self):
        return f"{self.host}:{self.port}"


class Message(NamedTuple):
    topic: str
    payload: bytes


def _paho():
    try:
        import paho.mqtt.client  # imported here so that orders can be written without it
    except ModuleNotFoundError:
        raise BadInput("--broker: found no module paho; expected the Debian package python3-paho-mqtt") from None
    return paho.mqtt.client


def encode(message):
    return json.dumps(message, ensure_ascii=False, separators=(",", ":")).encode()


class Connection:
    """A connection to a broker. Puts received messages into `inbox`, and reconnects automatically."""

    def __init__(self, broker, topics, will=None, hello=None):
        """Connects to the broker. Raises BadInput if it cannot be reached.

        will: (topic, message) that the broker publishes when the connection is lost. hello: (topic, message) that the
        client publishes after each connect. Both messages are retained, so that later subscribers receive them.
        """
        paho = _paho()
        self.inbox = queue.SimpleQueue()
        self.topics, self.hello = topics, hello
        self.failure = None
        self.subscribed = threading.Event()     # set when the broker has confirmed a subscription
        self.client = paho.Client()
        self.client.max_queued_messages_set(MOST_SEND)
        if broker.username:
            self.client.username_pw_set(broker.username, broker.password)
        if broker.tls:
            self.client.tls_set(broker.ca_file)
        if will:
            self.client.will_set(will[0], encode(will[1]), qos=1, retain=True)
        self.client.on_connect = self._on_connect
        self.client.on_subscribe = lambda *_: self.subscribed.set()
        self.client.on_message = lambda client, data, message: self.inbox.put(Message(message.topic, message.payload))
        self.client.reconnect_delay_set(1, 10)
        try:
            self.client.connect(broker.host, broker.port, keepalive=15)
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or error
            raise BadInput(f"--broker: {broker} cannot be reached: {reason}; expected an MQTT broker") from None
        self.client.loop_start()

    def _on_connect(self, client, data, flags, code):
        if code:
            self.failure = _paho().connack_string(code)
            return
        for topic, qos in self.topics:
            client.subscribe(topic, qos)
        if self.hello:
            self.publish(*self.hello, qos=1, retain=True)

    def await_subscription(self):
        if not self.subscribed.wait(CONNECT_SECONDS):
            raise BadInput(f"--broker: subscription failed: {self.failure or 'no answer'}; expected an MQTT broker")

    def publish(self, topic, message, qos=0, retain=False):
        self.client.publish(topic, encode(message), qos, retain)

    def close(self):
        self.client.disconnect()
        self.client.loop_stop()
