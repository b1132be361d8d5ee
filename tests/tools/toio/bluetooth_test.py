# SPDX-License-Identifier: MIT
"""Tests the Bluetooth connection with a fake bleak module that has simulated cubes as devices."""
import asyncio
import sys
import types
import unittest
from unittest import mock

import plans
from grove_toio import bluetooth, protocol
from grove_driving.bad_input import BadInput
from grove_toio.driver import Driver
from grove_toio.mat import BODY
from grove_toio.simulate import make_world
from grove_toio.simulated import Disturbances


class Device:
    def __init__(self, name, address, cube):
        self.name, self.address, self.cube = name, address, cube


class BleakError(Exception):
    pass


HANDLERS = {protocol.MOTOR: "on_motor", protocol.ID_INFORMATION: "on_id", protocol.CONFIGURATION: "on_configuration"}


class Client:
    """Imitates BleakClient of bleak 0.20, with characteristics by UUID and handlers that get the characteristic
    first."""

    def __init__(self, device, disconnected_callback=None, timeout=10):
        self.device, self.cube, self.disconnected = device, device.cube, disconnected_callback
        self.is_connected = False
        device.client = self
        device.connections = 0

    async def connect(self):
        self.is_connected = True
        self.device.connections += 1

    async def disconnect(self):
        self.is_connected = False

    def break_off(self):
        self.is_connected = False
        self.cube.notifying = protocol.Notifying(1, 0xff)       # the settings of the connection are lost
        self.cube.on_id = self.cube.on_motor = self.cube.on_configuration = lambda data: None
        self.disconnected(self)

    async def start_notify(self, uuid, handler):
        setattr(self.cube, HANDLERS[uuid], lambda data: handler(uuid, bytearray(data)))

    async def write_gatt_char(self, uuid, data, response=False):
        if not self.is_connected:
            raise BleakError("not connected")
        if uuid == protocol.MOTOR and not response:
            await self.cube.write(data)
        elif uuid == protocol.CONFIGURATION and response:
            await self.cube.configure(data)
        else:
            raise BleakError("the characteristic Motor is written without a response, Configuration with one")

    async def read_gatt_char(self, uuid):
        x, y = round(self.cube.x), round(self.cube.y)
        return bytearray(protocol.position(x, y, 0, x, y, 0) if uuid == protocol.ID_INFORMATION else b"")


def fake_bleak(devices):
    async def discover(timeout, service_uuids):
        assert service_uuids == [protocol.SERVICE]
        await asyncio.sleep(timeout)
        return devices

    return types.SimpleNamespace(BleakClient=Client, BleakScanner=types.SimpleNamespace(discover=discover),
                                 exc=types.SimpleNamespace(BleakError=BleakError))


async def drive(named=(), hide=(), name="dense", after_3_s=None):
    order, grid = plans.order(name), plans.grid(name)
    world, simulated = make_world(order, grid, Disturbances(), 1)
    devices = [Device(f"toio-{robot}", f"00:0{i}", cube) for i, (robot, cube) in enumerate(simulated.items())
               if robot not in hide]
    with mock.patch.dict(sys.modules, {"bleak": fake_bleak(devices[::-1])}):
        running = asyncio.create_task(world.run())
        try:
            cubes = await bluetooth.connect_cubes(order, grid, dict(named))
            assert all(cubes[robot].device.cube is simulated[robot] for robot in cubes)
            if after_3_s:
                asyncio.get_running_loop().call_later(3, after_3_s, devices)
            outcome = await Driver(order, cubes, grid).drive(plans.PATIENCE)
            for cube in cubes.values():
                await cube.disconnect()
            return outcome, world, devices
        finally:
            running.cancel()


class Bluetooth(unittest.TestCase):
    def test_cubes_are_identified_by_their_positions(self):
        outcome, world, devices = plans.run(drive())
        self.assertTrue(outcome.completed, outcome.waits)
        self.assertGreater(world.least, BODY)
        self.assertFalse(any(d.client.is_connected for d in devices))

    def test_cubes_are_identified_by_name_and_address(self):
        outcome, *_ = plans.run(drive([("a0", "TOIO-A0"), ("a1", "00:01")]))
        self.assertTrue(outcome.completed)

    def test_lost_connection_is_restored(self):
        outcome, world, devices = plans.run(drive(after_3_s=lambda those: those[0].client.break_off()))
        self.assertTrue(outcome.completed, outcome.waits)
        self.assertEqual(devices[0].connections, 2)
        self.assertGreater(world.least, BODY)

    def refused(self, text, **options):
        with self.assertRaises(BadInput) as caught:
            plans.run(drive(**options))
        self.assertIn(text, str(caught.exception))

    def test_missing_cubes_are_refused(self):
        self.refused("found no cube 'toio-x'", named=[("a0", "toio-x")])
        self.refused("the start of a2; expected one", hide=("a2",))

    def test_missing_bleak_is_an_error(self):
        with mock.patch.dict(sys.modules, {"bleak": None}), self.assertRaises(BadInput) as caught:
            plans.run(bluetooth.connect_cubes(plans.order("dense"), plans.grid("dense"), {}))
        self.assertIn("python3-bleak", str(caught.exception))
