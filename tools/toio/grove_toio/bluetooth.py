# SPDX-License-Identifier: MIT
"""Connects to real cubes with bleak (Debian: python3-bleak 0.20). Not tested with real cubes.

Real and simulated cubes have the same interface: write(), configure() and three notification handlers.
"""
import asyncio

from grove_driving.bad_input import BadInput

from . import protocol
from .geometry import distance

SCAN_SECONDS = 8.0
CONNECT_SECONDS = 15.0
READ_TRIES, READ_PAUSE = 20, 0.1
RECONNECT_PAUSE = 1.0


def _bleak():
    try:
        import bleak  # imported here so that simulated cubes do not need it
    except ModuleNotFoundError:
        raise BadInput("--bluetooth: found no module bleak; expected the Debian package python3-bleak") from None
    return bleak


class BluetoothCube:
    def __init__(self, device):
        self.bleak = _bleak()
        self.device = device
        self.on_motor = self.on_id = self.on_configuration = lambda data: None
        self.configuration = None       # kept here, because a cube loses it with the connection
        self.wanted = False
        self.reconnecting = None
        self.client = self.bleak.BleakClient(device, disconnected_callback=self._lost, timeout=CONNECT_SECONDS)

    @property
    def label(self):
        """Name and address of the cube, because names are not unique."""
        return f"{self.device.name or 'a cube'} ({self.device.address})"

    async def connect(self):
        self.wanted = True
        await self.client.connect()
        for characteristic, handler in ((protocol.MOTOR, "on_motor"), (protocol.ID_INFORMATION, "on_id"),
                                        (protocol.CONFIGURATION, "on_configuration")):
            await self.client.start_notify(characteristic, self._handler(handler))
        if self.configuration:
            await self.configure(self.configuration)

    def _handler(self, name):
        return lambda _, data: getattr(self, name)(bytes(data))

    def _lost(self, _):
        if self.wanted and (self.reconnecting is None or self.reconnecting.done()):
            self.reconnecting = asyncio.get_running_loop().create_task(self._reconnect())

    async def _reconnect(self):
        while self.wanted and not self.client.is_connected:
            await asyncio.sleep(RECONNECT_PAUSE)
            try:
                await self.connect()
            except (self.bleak.exc.BleakError, asyncio.TimeoutError, OSError, EOFError):
                pass    # the loop tries again; until then the driver reports that the cube is silent

    async def disconnect(self):
        self.wanted = False
        if self.reconnecting:
            self.reconnecting.cancel()
        try:
            await self.client.disconnect()
        except (self.bleak.exc.BleakError, asyncio.TimeoutError, OSError, EOFError):
            pass

    async def write(self, data):
        """Writes a motor command. A failed write is treated as a lost message."""
        await self._write(protocol.MOTOR, data, False)

    async def configure(self, data):
        self.configuration = data
        await self._write(protocol.CONFIGURATION, data, True)

    async def _write(self, characteristic, data, with_response):
        try:
            await self.client.write_gatt_char(characteristic, data, response=with_response)
        except (self.bleak.exc.BleakError, asyncio.TimeoutError, OSError, EOFError):
            pass

    async def read_position(self):
        """Returns the position (x, y) in mat units. Returns None if READ_TRIES reads give no position."""
        for _ in range(READ_TRIES):
            found = protocol.read_id_notification(bytes(await self.client.read_gatt_char(protocol.ID_INFORMATION)))
            if isinstance(found, protocol.Position):
                return found.x, found.y
            await asyncio.sleep(READ_PAUSE)
        return None


def choose_named(devices, named):
    """Returns ({robot: device}, all other devices). `named`: {robot: name or address}.

    Raises BadInput if a named device is missing.
    """
    chosen = {}
    for robot, name in named.items():
        found = [d for d in devices if name.lower() in (d.address.lower(), (d.name or "").lower())]
        if not found:
            known = ", ".join(sorted(d.name or d.address for d in devices)) or "none"
            raise BadInput(f"--cube: found no cube '{name}'; expected one of the cubes that are on: {known}")
        chosen[robot] = found[0]
    return chosen, [d for d in devices if d not in chosen.values()]


def choose_by_place(order, grid, robots, positions):
    """Returns {robot: label of the cube on its start}. `positions`: {label: (x, y) or None}.

    Raises BadInput unless exactly one cube is near each start.
    """
    chosen = {}
    for robot in robots:
        start = grid.centre(order.robot(robot).start)
        near = [label for label, at in positions.items() if at and distance(at, start) < grid.pitch / 2]
        if len(near) != 1:
            where = f"{list(order.robot(robot).start)}, the start of {robot}"
            raise BadInput(f"--bluetooth: found {len(near)} cubes on {where}; expected one ({len(positions)} cubes are "
                           f"on; --cube {robot}=NAME selects one)")
        chosen[robot] = near[0]
    return chosen


async def _connect(device):
    cube = BluetoothCube(device)
    try:
        await cube.connect()
    except (cube.bleak.exc.BleakError, asyncio.TimeoutError, OSError, EOFError) as error:
        raise BadInput(f"--bluetooth: cannot connect to {cube.label}: {error or 'no answer'}") from None
    return cube


async def _scan():
    bleak = _bleak()
    try:
        return await bleak.BleakScanner.discover(timeout=SCAN_SECONDS, service_uuids=[protocol.SERVICE])
    except (bleak.exc.BleakError, OSError) as error:
        raise BadInput(f"--bluetooth: cannot scan for cubes: {error}; "
                       "expected a Bluetooth adapter that is on") from None


async def connect_cubes(order, grid, named):
    """Connects to one cube per robot and returns {robot: cube}."""
    devices, others = choose_named(await _scan(), named)
    cubes = {}
    spare = []
    try:
        for robot, device in devices.items():
            cubes[robot] = await _connect(device)
        robots = [r.name for r in order.robots if r.name not in cubes]
        for device in others if robots else []:
            spare.append(await _connect(device))
        labels = {cube.label: cube for cube in spare}
        positions = {label: await cube.read_position() for label, cube in labels.items()}
        for robot, label in choose_by_place(order, grid, robots, positions).items():
            cubes[robot] = labels[label]
            spare.remove(labels[label])
    except BaseException:
        for cube in (*spare, *cubes.values()):
            await cube.disconnect()
        raise
    for cube in spare:
        await cube.disconnect()
    return cubes
