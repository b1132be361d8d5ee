# SPDX-License-Identifier: MIT
"""Starts the parts of a trial on one machine: broker, simulated vehicles and the connection of the monitor."""
import contextlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from grove_driving.bad_input import BadInput

from .mqtt import Broker, Connection

START_SECONDS = 10.0
MOSQUITTO = "/usr/sbin/mosquitto"


def _free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@contextlib.contextmanager
def own_broker():
    """Runs mosquitto on the loopback address and yields its Broker."""
    program = shutil.which("mosquitto") or (MOSQUITTO if Path(MOSQUITTO).exists() else None)
    if not program:
        raise BadInput("trial: mosquitto was not found; expected the Debian package mosquitto")
    with tempfile.TemporaryDirectory() as folder:
        port = _free_port()
        settings = Path(folder) / "mosquitto.conf"
        settings.write_text(f"listener {port} 127.0.0.1\nallow_anonymous true\nmax_queued_messages 0\nlog_type none\n")
        process = subprocess.Popen([program, "-c", settings], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            _await_port(port, process)
            yield Broker("127.0.0.1", port)
        finally:
            process.terminate()
            process.wait()


def _await_port(port, process):
    until = time.monotonic() + START_SECONDS
    while time.monotonic() < until and process.poll() is None:
        with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), 1):
            return
        time.sleep(0.05)
    raise OSError(0, "mosquitto did not start", "trial")


@contextlib.contextmanager
def own_vehicles(program, arguments):
    """Runs `grove vda5050 vehicles` as a child process. Yields the process once all vehicles are connected."""
    process = subprocess.Popen([sys.executable, program, "vehicles", *arguments], stdout=subprocess.PIPE, text=True)
    try:
        if not process.stdout.readline():
            raise OSError(0, "the vehicles did not start", "trial")
        yield process
    finally:
        process.kill()
        process.wait()


def end_vehicles(process):
    """Terminates the vehicles and returns (exit code, output)."""
    process.send_signal(signal.SIGTERM)
    text, _ = process.communicate(timeout=60)
    return process.returncode, text


def monitor_connection(broker, topics):
    """Returns a connection that receives all messages from and to the vehicles of `topics`."""
    connection = Connection(broker, [(topics.topic("+", "+"), 0)])
    connection.await_subscription()
    return connection
