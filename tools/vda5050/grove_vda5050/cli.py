# SPDX-License-Identifier: MIT
"""Implements the command line of grove vda5050."""
import contextlib
import functools
import json
import math
import os
import queue
import signal
import sys
import time
import uuid
from pathlib import Path

from grove_driving.arguments import (Parser, amount, integer, positive, robot_at_for, seed, share, wrong)
from grove_driving.bad_input import BadInput
from grove_driving.drive_log import ExecutionLog, open_log
from grove_driving.frame import Frame
from grove_driving.order import read_order
from grove_driving.program import FAILURE, exit_code, print_error

from . import trial
from .clock import Clock
from .control import Control, Limits
from .fleet import Disturbances, Fleet
from .messages import Style
from .monitor import Monitor
from .mqtt import Broker, Connection
from .protocol import PROTOCOLS, Header, Topics
from .release import Releases
from .route import ALLOWED, THETA, check_order, make_route, readable

TICK = 0.2
PROGRAM = Path(sys.argv[0]).resolve()

DESCRIPTION = """\
Drives vehicles by VDA 5050 2.1.0 or 3.0.0 along a passing order that 'grove execute INSTANCE PLAN --order
ORDER.json' has written. A node is released to a vehicle when the passing order allows the vehicle to drive
there, however late vehicles are. Requires plans without rings: grove solve --no-following."""

EPILOG = """\
  grove vda5050 orders ORDER.json -o DIR       writes the first order of each vehicle to a file, for inspection
  grove vda5050 drive ORDER.json --broker ...  fleet control: drives the vehicles that are on a broker
  grove vda5050 vehicles ORDER.json --broker ...  simulated vehicles, on their starts
  grove vda5050 watch --broker ...             monitor: checks messages by the schemas, and releases for conflicts
  grove vda5050 trial ORDER.json               drive, vehicles, watch and a broker, on this machine

Exit codes:
  0    all vehicles have done all actions (watch: no violation)
  1    not done within --time-limit, a violation or collision, or internal failure
  2    bad usage or input: one line on stderr with place, what was found and what was expected
  130  stopped by Ctrl-C (143 by SIGTERM); vehicles stop where their bases end"""


def _broker(text):
    expected = "HOST or HOST:PORT"
    host, colon, port = text.rpartition(":") if ":" in text else (text, "", "1883")
    if not host or not port.isdigit() or not 0 < int(port) < 65536:
        raise wrong(text, expected)
    return host, int(port)


def _protocol(text):
    for version in PROTOCOLS:
        if text == version or text == version.rpartition(".")[0]:
            return PROTOCOLS[version]
    raise wrong(text, "2.1 or 3.0")


def _level(text):
    if not text or not set(text) <= ALLOWED:
        raise wrong(text, "letters, digits and _ - . :")
    return text


def _serial(text):
    robot, equals, serial = text.rpartition("=")
    if not robot or not equals:
        raise wrong(text, "ROBOT=SERIAL")
    return robot, _level(serial)


def _count(text):
    return integer(text, 1, 10 ** 6, "an integer of at least 1")


def _count0(text):
    return integer(text, 0, 10 ** 6, "an integer of at least 0")


def _stop(text):
    return robot_at_for(text, endless=False)


def _add_protocol(add):
    add("--protocol", type=_protocol, default=PROTOCOLS["2.1.0"], metavar="VERSION",
        help="version of VDA 5050: 2.1 or 3.0 (default: 2.1)")
    add("--interface", type=_level, metavar="NAME", help="first level of topics (default: uagv; with 3.0: vda5050)")
    add("--manufacturer", type=_level, default="grove", metavar="NAME", help="third level of topics (default: grove)")
    add("--serial", type=_serial, action="append", default=[], metavar="ROBOT=SERIAL",
        help="serial number of a robot's vehicle (default: its id)")


def _add_broker(add):
    add("--broker", type=_broker, required=True, metavar="HOST[:PORT]", help="MQTT broker (default port: 1883)")
    add("--username", metavar="NAME",
        help="user name at the broker; the password is in the variable GROVE_MQTT_PASSWORD")
    add("--tls", action="store_true", help="connect with TLS")
    add("--ca-file", metavar="FILE", help="with --tls: certificates to trust (default: those of the system)")


def _add_style(add):
    add("--base", type=_count, default=10, metavar="N",
        help="maximum number of nodes released ahead of a vehicle (default: 10)")
    add("--horizon", type=_count0, default=5, metavar="N", help="number of nodes shown beyond the base (default: 5)")
    add("--map-id", type=_level, default="map", metavar="ID", help="mapId of all nodes (default: map)")
    add("--deviation", type=amount, default=0.1, metavar="METRES",
        help="allowed deviation from a reached node (default: 0.1)")
    add("--work-action", type=_level, default="work", metavar="TYPE", help="actionType of work (default: work)")
    add("--visit-action", type=_level, default="visit", metavar="TYPE",
        help="actionType of visits without duration (default: visit)")
    add("--step-seconds", type=positive, default=1.0, metavar="S", help="duration of one step of work (default: 1)")


def _add_drive(add):
    add("--time-limit", type=positive, default=3600.0, metavar="S",
        help="stop after S real seconds (default: 3600)")
    add("--log", metavar="DRIVE.jsonl", help="write the execution log to this file (docs/drive-log.md)")
    add("--quiet", action="store_true", help="print only errors")


def _add_pace(add):
    add("--pace", type=positive, default=1.0, metavar="X",
        help="speed of simulated vehicles: vehicle seconds per real second; all times except --time-limit, also in the "
             "log, are vehicle seconds (default: 1)")


def _add_vehicles(add):
    add("--speed", type=positive, default=1.0, metavar="M/S", help="speed of the vehicles (default: 1)")
    add("--turn-speed", type=positive, default=90.0, metavar="DEG/S",
        help="turning speed of the vehicles (default: 90)")
    add("--delayed", type=share, default=0.0, metavar="SHARE",
        help="share of delayed messages, in each direction (default: 0)")
    add("--delay", type=amount, default=2.0, metavar="S", help="maximum delay of a message (default: 2)")
    add("--lost", type=share, default=0.0, metavar="SHARE",
        help="share of lost messages, in each direction (default: 0)")
    add("--stop", type=_stop, action="append", default=[], metavar="ROBOT@S=S",
        help="stop a vehicle at a time in seconds, for a duration in seconds (repeatable)")
    add("--seed", type=seed, default=0, metavar="N", help="seed of all random events (default: 0)")


def _parser():
    parser = Parser(prog="grove vda5050", description=DESCRIPTION, epilog=EPILOG)
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)

    def command(name, text, *groups, order=True):
        one = commands.add_parser(name, help=text, description=text[:1].upper() + text[1:] + ".")
        if order:
            one.add_argument("order", metavar="ORDER.json", help="passing order")
        for title, adds in groups:
            group = one.add_argument_group(title) if title else one
            for add in adds:
                add(group.add_argument)
        return one

    protocol, style = ("the protocol", [_add_protocol]), ("the orders", [_add_style])
    broker, vehicles = ("the broker", [_add_broker]), ("the vehicles", [_add_vehicles, _add_pace])
    orders = command("orders", "writes the first order of each vehicle as a file", protocol, style)
    orders.add_argument("-o", "--output", required=True, metavar="DIR",
                        help="directory for SERIAL.order.json of each vehicle; created if missing")
    command("drive", "fleet control: drives the vehicles that are on a broker", (None, [_add_drive, _add_pace]), broker,
            protocol, style)
    command("vehicles", "simulated vehicles, each on its start, until Ctrl-C", broker, protocol, vehicles)
    watch = command("watch", "monitor of all messages of a broker, until Ctrl-C", broker, protocol, order=False)
    watch.add_argument("--seconds", type=positive, default=math.inf, metavar="S",
                       help="stop after S seconds (default: no limit)")
    command("trial", "broker, simulated vehicles, fleet control and monitor, all on this machine",
            (None, [_add_drive]), protocol, style, vehicles)
    return parser


class Setup:
    """Topics, routes and message style, derived from the options and the passing order; for `watch`, only topics."""

    def __init__(self, a):
        self.topics = Topics(a.protocol, a.interface or a.protocol.interface, a.manufacturer)
        if "order" not in a:
            return
        self.order = read_order(a.order)
        check_order(a.order, self.order)
        names = [r.name for r in self.order.robots]
        self.routes = {r.name: make_route(r, self._serial(a, r.name, names)) for r in self.order.robots}
        serials = [route.serial for route in self.routes.values()]
        for i, serial in enumerate(serials):
            if serial in serials[:i]:
                raise BadInput(f"--serial: found {serial} for {names[serials.index(serial)]} and {names[i]}; expected "
                               "different serial numbers")
        self.robots = {route.serial: name for name, route in self.routes.items()}
        self.frame = Frame(self.order)
        if "base" in a:
            self.style = Style(a.protocol, a.map_id, a.deviation, a.work_action, a.visit_action, a.step_seconds)

    @staticmethod
    def _serial(a, name, names):
        given = dict(a.serial)
        for robot in given:
            if robot not in names:
                raise BadInput(f"--serial: found robot '{robot}'; expected one of {', '.join(names)}")
        return given.get(name, readable(name))

    def headings(self):
        """Returns {robot: heading at its start in radians}; 0 if the order has no headings."""
        return {r.name: THETA.get(r.heading, 0.0) for r in self.order.robots}


def _make_broker(a):
    if a.ca_file and not a.tls:
        raise BadInput("--ca-file: requires --tls (see 'grove vda5050 drive --help')")
    if a.ca_file and not os.path.exists(a.ca_file):
        raise BadInput(f"{a.ca_file}: cannot be read; expected a file of certificates")
    return Broker(*a.broker, a.username, os.environ.get("GROVE_MQTT_PASSWORD"), a.ca_file, a.tls)


def _printer(a):
    return (lambda text: None) if getattr(a, "quiet", False) else (lambda text: print(text, flush=True))


# ---- orders

def _orders(a):
    setup = Setup(a)
    releases = Releases(setup.order, setup.routes)
    folder = Path(a.output)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadInput(f"{folder}: cannot be created: {error.strerror}") from None
    for name, route in setup.routes.items():
        released = min(releases.allowed[name], a.base)
        content = setup.style.order(route, f"grove-{readable(name)}", 0, 0, released,
                                    min(released + a.horizon, route.last))
        message = Header(a.protocol, a.manufacturer, route.serial).message(content)
        file = folder / f"{route.serial}.order.json"
        file.write_text(json.dumps(message, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    print(f"{folder}: the first orders of {len(setup.routes)} vehicles, VDA 5050 {a.protocol.version}")
    return 0


# ---- drive

class _Drive:
    """Fleet control that is connected to a broker."""

    def __init__(self, a, setup, connection, clock, log, say):
        self.a, self.setup, self.connection, self.clock, self.say = a, setup, connection, clock, say
        self.seconds = ()               # duration of the drive: (real seconds, vehicle seconds)
        topics = setup.topics
        headers = {name: Header(a.protocol, a.manufacturer, route.serial) for name, route in setup.routes.items()}

        def send(name, content):
            self.connection.publish(topics.topic(setup.routes[name].serial, "order"), headers[name].message(content))

        self.control = Control(Releases(setup.order, setup.routes), setup.style, str(uuid.uuid4()),
                               Limits(a.base, a.horizon), send, clock, log, say)

    def step(self):
        """Processes messages for TICK real seconds, then resends orders. Returns whether all vehicles are done."""
        until = self.clock.real() + TICK
        while (left := until - self.clock.real()) > 0:
            try:
                message = self.connection.inbox.get(timeout=left)
            except queue.Empty:
                break
            self._receive(message)
        if self.connection.failure:
            raise BadInput(f"--broker: connection refused: {self.connection.failure}")
        self.control.tick()
        return self.control.completed

    def _receive(self, message):
        serial, name = self.setup.topics.serial_and_name(message.topic)
        robot = self.setup.robots.get(serial)
        try:
            content = json.loads(message.payload)
            if robot and isinstance(content, dict):
                (self.control.on_state if name == "state" else self.control.on_connection)(robot, content)
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            self.say(f"{self.clock.now():7.1f} s  {serial}: invalid {name} message: {error}")

    def run(self):
        """Drives until all vehicles are done or the time limit is reached. Returns whether all vehicles are done."""
        completed = self.step()
        while not completed and self.clock.real() <= self.a.time_limit:
            completed = self.step()
        self.seconds = self.clock.real(), self.clock.now()
        return completed

    def summary(self):
        control = self.control
        done = sum(control.releases.done.values())
        real, seconds = self.seconds
        yield f"Time          {seconds:.1f} s" + (f" of the vehicles, {real:.1f} s real"
                                                  if self.clock.pace != 1 else "")
        yield f"Vehicles      {sum(v.completed for v in control.vehicles.values())} of {len(control.vehicles)} done"
        yield f"Actions       {done} of {sum(len(r.actions) for r in self.setup.order.robots)} of the passing order"
        yield f"Orders        {control.messages} messages, {control.resent} of them repeats"

    def failure(self):
        reasons = list(self.control.reasons())
        more = f"; and {len(reasons) - 8} more" if len(reasons) > 8 else ""
        return f"not done within {self.a.time_limit:g} s: {'; '.join(reasons[:8])}{more}" if reasons else None


def _control_connection(broker, topics):
    # Subscribes to states first, because the broker delivers retained connection messages immediately.
    return Connection(broker, [(topics.topic("+", "state"), 0), (topics.topic("+", "connection"), 1)])


def _describe(a, setup):
    order = setup.order
    yield f"Order         {os.path.basename(a.order)}: {len(order.robots)} robots, " \
          f"{sum(len(r.actions) for r in order.robots)} actions"
    yield f"Protocol      VDA 5050 {a.protocol.version}, topics {setup.topics.topic('...', '...')}"


@contextlib.contextmanager
def _log(a, setup):
    """Yields a function that writes a line of the log; without --log, yields None."""
    if not a.log:
        yield None
        return
    with open_log(a.log) as stream:
        log = ExecutionLog(stream, os.path.basename(a.order), list(setup.routes), a.step_seconds)

        def write(seconds, name, at, theta, done, state):
            log.write(seconds, name, setup.frame.cells(at), None if theta is None else 90 - math.degrees(theta), done,
                      state)
        yield write


def _drive(a):
    setup = Setup(a)
    broker, say = _make_broker(a), _printer(a)
    with _log(a, setup) as log:
        drive = _Drive(a, setup, _control_connection(broker, setup.topics), Clock(a.pace), log, say)
        for line in _describe(a, setup):
            say(line)
        completed = drive.run()
        drive.connection.close()
    for line in drive.summary():
        say(line)
    if not completed:
        print_error(drive.failure())
    return 0 if completed else FAILURE


# ---- vehicles

def _check_stops(a, setup):
    for robot, *_ in a.stop:
        if robot not in setup.routes:
            raise BadInput(f"--stop: found robot '{robot}'; expected one of {', '.join(setup.routes)}")


def _fleet(a, setup, connect, clock):
    return Fleet(connect, setup.topics, setup.routes, setup.headings(), setup.frame.cell, a.speed,
                 math.radians(a.turn_speed), Disturbances(a.delayed, a.delay, a.lost, tuple(a.stop)), a.seed, clock)


def _vehicles(a):
    setup = Setup(a)
    _check_stops(a, setup)
    connect = functools.partial(Connection, _make_broker(a))
    fleet = _fleet(a, setup, connect, Clock(a.pace))
    print(f"{len(fleet.vehicles)} vehicles", flush=True)
    with contextlib.suppress(KeyboardInterrupt, _Terminated):
        fleet.run()
    fleet.close()
    world = fleet.world
    print(f"Messages      {fleet.received} orders received, {sum(v.refused for v in fleet.vehicles)} refused; "
          f"{fleet.delayed} messages late, {fleet.lost} lost")
    print(f"Done          {sum(v.acted for v in fleet.vehicles)} task executions and visits")
    if world.least_pair:
        print(f"Distance      at least {world.least:.2f} m between centres, of {' and '.join(world.least_pair)}")
    print("Places        " + (world.collisions[0] if world.collisions else "no vehicle drove to an occupied place"))
    return FAILURE if world.collisions else 0


# ---- watch

def _receive_all(monitor, connection, until):
    while True:
        left = until - time.monotonic()
        if left <= 0 and connection.inbox.empty():
            return
        try:
            message = connection.inbox.get(timeout=min(max(left, 0), 3600))
        except queue.Empty:
            continue
        monitor.on_message(message.topic, message.payload)


def _monitored(monitor):
    counts = ", ".join(f"{count} {name}" for name, count in sorted(monitor.messages.items())) or "none"
    checked = ("not checked by schemas: python3-jsonschema is missing" if monitor.validators is None
               else f"all checked by the schemas of {monitor.topics.protocol.version}")
    yield f"Watched       {counts}; {checked}"
    yield f"Released      {monitor.violations or 'nothing'} wrong, {monitor.actions} actions reported finished"


def _watch(a):
    topics = Setup(a).topics
    monitor = Monitor(topics, lambda text: print(text, flush=True))
    broker = _make_broker(a)
    connection = trial.monitor_connection(broker, topics)
    print(f"Watching      {topics.topic('...', '...')} at {broker}", flush=True)
    with contextlib.suppress(KeyboardInterrupt, _Terminated):
        _receive_all(monitor, connection, time.monotonic() + a.seconds)
    connection.close()
    for line in _monitored(monitor):
        print(line)
    return FAILURE if monitor.violations else 0


# ---- trial

def _vehicle_arguments(a, broker):
    yield from (a.order, "--broker", str(broker), "--protocol", a.protocol.version, "--manufacturer", a.manufacturer)
    if a.interface:
        yield from ("--interface", a.interface)
    for robot, serial in a.serial:
        yield from ("--serial", f"{robot}={serial}")
    for option in ("speed", "turn_speed", "pace", "delayed", "delay", "lost", "seed"):
        yield from ("--" + option.replace("_", "-"), str(getattr(a, option)))
    for robot, begin, seconds in a.stop:
        yield from ("--stop", f"{robot}@{begin}={seconds}")


def _trial(a):
    setup, say = Setup(a), _printer(a)
    _check_stops(a, setup)
    for line in _describe(a, setup):
        say(line)
    monitor = Monitor(setup.topics, say)
    with trial.own_broker() as broker, _log(a, setup) as log:
        listener = trial.monitor_connection(broker, setup.topics)
        with trial.own_vehicles(PROGRAM, list(_vehicle_arguments(a, broker))) as process:
            drive = _Drive(a, setup, _control_connection(broker, setup.topics), Clock(a.pace), log, say)
            completed = drive.run()
            vehicles_code, vehicles_text = trial.end_vehicles(process)
        drive.connection.close()
        _receive_all(monitor, listener, time.monotonic() + 1)
        listener.close()
    for line in (*drive.summary(), *vehicles_text.splitlines(), *_monitored(monitor)):
        say(line)
    failures = [text for failed, text in ((not completed, drive.failure()), (vehicles_code, "vehicles collided"),
                                          (monitor.violations, "messages were wrong")) if failed]
    if failures:
        print_error("; ".join(failures))
    return FAILURE if failures else 0


class _Terminated(BaseException):
    pass


def _terminate(number, frame):
    raise _Terminated


COMMANDS = {"orders": _orders, "drive": _drive, "vehicles": _vehicles, "watch": _watch, "trial": _trial}


def _run(arguments):
    a = _parser().parse_args(arguments)
    signal.signal(signal.SIGTERM, _terminate)
    try:
        return COMMANDS[a.command](a)
    except _Terminated:
        return 128 + signal.SIGTERM


def main(arguments):
    return exit_code(_run, arguments)
