# SPDX-License-Identifier: MIT
"""Demonstrates the way from instance to execution: three cubes, six tasks, 7 x 5 cells with obstacles."""
import json
import subprocess
import tempfile
from pathlib import Path

from grove_driving.bad_input import BadInput

from .cells import read_cell_order

INSTANCE = Path(__file__).resolve().parent / "demo" / "demo.cts.json"
SIZE = (7, 5)


def _grove(*arguments):
    grove = Path(__file__).resolve().parents[1] / "grove"
    if not grove.exists():
        raise BadInput(f"{grove}: no such file; expected grove in the directory of grove-toio")
    done = subprocess.run([grove, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode:
        raise BadInput(f"grove {arguments[0]}: {done.stderr.strip().removeprefix('grove: error: ')}")


def demo_order():
    with tempfile.TemporaryDirectory() as folder:
        plan, order = Path(folder) / "demo.plan.json", Path(folder) / "demo.order.json"
        _grove("solve", INSTANCE, "--omega", "0", "--threads", "1", "--quiet", "--require-plan", "--output", plan)
        _grove("execute", INSTANCE, plan, "--order", order)
        return read_cell_order(order)


def demo_visits():
    """Returns all visits that the demonstration requires, as [(task, robot, cell)]."""
    instance = json.loads(INSTANCE.read_text(encoding="utf-8"))
    return [(task["id"], robot, tuple(task["cell"])) for task in instance["tasks"] for robot in task["agents"]]


def tasks_left(order, done):
    """Returns the tasks of the demonstration that some assigned robot has not visited, in order of their ids."""
    seen = {(r.name, cell) for r in order.robots
            for cell in (r.start, *(a.place for a in r.actions[:done[r.name]]))}
    return sorted({task for task, robot, cell in demo_visits() if (robot, cell) not in seen})
