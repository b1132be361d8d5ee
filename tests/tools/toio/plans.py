# SPDX-License-Identifier: MIT
"""Passing orders to drive, made by grove itself, and drives of them in virtual time."""
import asyncio
import atexit
import functools
import json
import shutil
import subprocess
import tempfile
from pathlib import Path

from grove_toio.clock import VirtualLoop
from grove_toio.driver import Driver
from grove_toio.mat import MATS, make_grid
from grove_toio.order import read_order
from grove_toio.simulate import simulate
from grove_toio.simulated import Troubles

GROVE = Path("build/release/bin/grove")
PATIENCE = 240                  # virtual seconds

# A ring: four robots of a block of 2 x 2 cells, each on to the next one's cell.
ROUND = {"map": "open.map", "tasks": [],
         "agents": [{"id": "a", "start": [2, 1], "goal": [3, 1]}, {"id": "b", "start": [3, 1], "goal": [3, 2]},
                    {"id": "c", "start": [3, 2], "goal": [2, 2]}, {"id": "d", "start": [2, 2], "goal": [2, 1]}]}
# Two who want to pass each other in a corridor with one niche.
NARROW = {"map": "narrow.map", "tasks": [{"id": "t", "cell": [3, 0], "agents": ["up"]}],
          "agents": [{"id": "up", "start": [0, 1], "goal": [6, 1]}, {"id": "down", "start": [6, 1], "goal": [0, 1]}]}
MAPS = {"open.map": ["." * 7] * 5, "wide.map": ["." * 9] * 6, "narrow.map": ["@@@.@@@", "......."]}
GENERATED = {"crowd": ("open.map", "--agents", 6, "--tasks", 12, "--seed", 6),
             "work": ("open.map", "--agents", 5, "--tasks", 8, "--turning", "--durations", "0-3", "--seed", 5),
             "many": ("wide.map", "--agents", 9, "--tasks", 18, "--seed", 3)}
# The simple mat has room for 7 x 5 cells, but not for robots that go round.
MAT = {"round": "collection", "many": "collection"}


@functools.cache
def folder():
    path = Path(tempfile.mkdtemp())
    atexit.register(shutil.rmtree, path, True)
    for name, rows in MAPS.items():
        text = f"type octile\nheight {len(rows)}\nwidth {len(rows[0])}\nmap\n"
        (path / name).write_text(text + "".join(row + "\n" for row in rows))
    for name, instance in (("round", ROUND), ("narrow", NARROW)):
        (path / f"{name}.cts.json").write_text(json.dumps(instance))
    return path


def grove(*arguments):
    subprocess.run([GROVE, *map(str, arguments)], cwd=folder(), check=True, capture_output=True, timeout=60)


@functools.cache
def order_file(name):
    if name in GENERATED:
        map_name, *options = GENERATED[name]
        grove("generate", "instance", "--map", map_name, *options, "-o", f"{name}.cts.json")
    grove("solve", f"{name}.cts.json", "--omega", "0.5", "--threads", "1", "--quiet", "--require-plan",
          "--output", f"{name}.plan.json")
    grove("execute", f"{name}.cts.json", f"{name}.plan.json", "--order", f"{name}.order.json")
    return folder() / f"{name}.order.json"


@functools.cache
def order(name):
    return read_order(order_file(name))


def grid(name):
    width, height = map(max, order(name).size(), (7, 5))
    return make_grid(MATS[MAT.get(name, "simple")], width, height)


def run(coroutine):
    with asyncio.Runner(loop_factory=VirtualLoop) as runner:
        return runner.run(coroutine)


def drive(name, loss=0.0, seed=0, lifts=(), seconds=PATIENCE, kind=Driver, slip=0.05, noise=1.0, **options):
    """(outcome, world)"""
    return run(simulate(order(name), grid(name), Troubles(loss, slip, noise), seed, lifts, seconds, kind, **options))


def visits(name):
    """{(robot, cell)} of the tasks of its instance."""
    order_file(name)
    instance = json.loads((folder() / f"{name}.cts.json").read_text())
    return {(robot, tuple(task["cell"])) for task in instance["tasks"] for robot in task["agents"]}
