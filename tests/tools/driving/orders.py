# SPDX-License-Identifier: MIT
"""Generates passing orders with grove, for tests of the programs that drive robots."""
import atexit
import functools
import json
import shutil
import subprocess
import tempfile
from pathlib import Path

GROVE = Path("build/release/bin/grove")     # suite.run() replaces it

# A ring: four robots on a block of 2 x 2 cells; each moves to the cell of the next robot.
ROUND = {"map": "open.map", "tasks": [],
         "agents": [{"id": "a", "start": [2, 1], "goal": [3, 1]}, {"id": "b", "start": [3, 1], "goal": [3, 2]},
                    {"id": "c", "start": [3, 2], "goal": [2, 2]}, {"id": "d", "start": [2, 2], "goal": [2, 1]}]}
# Two robots that must pass each other in a corridor with a single niche.
NARROW = {"map": "narrow.map", "tasks": [{"id": "t", "cell": [3, 0], "agents": ["up"]}],
          "agents": [{"id": "up", "start": [0, 1], "goal": [6, 1]}, {"id": "down", "start": [6, 1], "goal": [0, 1]}]}
# Two robots on roads of two and three steps that pass each other at a crossing, where both have a task. One of them has
# another task on a side road.
ROADS = {"roadmap": "hall.roadmap.json",
         "tasks": [{"id": "press", "cell": "C", "agents": ["r1", "r2"], "duration": 2},
                   {"id": "look", "cell": "N", "agents": ["r2"]}],
         "agents": [{"id": "r1", "start": "W", "goal": "E"}, {"id": "r2", "start": "E", "goal": "W"}]}
HALL = {"vertices": [{"id": "W", "at": [0, 0]}, {"id": "C", "at": [2, 0]}, {"id": "E", "at": [5, 0]},
                     {"id": "N", "at": [2, 2]}],
        "edges": [{"from": "W", "to": "C", "steps": 2}, {"from": "C", "to": "E", "steps": 3},
                  {"from": "C", "to": "N", "steps": 2}]}
MAPS = {"open.map": ["." * 7] * 5, "wide.map": ["." * 9] * 6, "narrow.map": ["@@@.@@@", "......."]}
GENERATED = {"dense": ("open.map", "--agents", 6, "--tasks", 12, "--seed", 6),
             "work": ("open.map", "--agents", 5, "--tasks", 8, "--turning", "--durations", "0-3", "--seed", 5),
             "many": ("wide.map", "--agents", 9, "--tasks", 18, "--seed", 3)}


@functools.cache
def folder():
    path = Path(tempfile.mkdtemp())
    atexit.register(shutil.rmtree, path, True)
    for name, rows in MAPS.items():
        text = f"type octile\nheight {len(rows)}\nwidth {len(rows[0])}\nmap\n"
        (path / name).write_text(text + "".join(row + "\n" for row in rows))
    (path / "hall.roadmap.json").write_text(json.dumps(HALL))
    for name, instance in (("round", ROUND), ("narrow", NARROW), ("roads", ROADS)):
        (path / f"{name}.cts.json").write_text(json.dumps(instance))
    return path


def grove(*arguments):
    subprocess.run([GROVE, *map(str, arguments)], cwd=folder(), check=True, capture_output=True, timeout=60)


@functools.cache
def order_file(name, following=True):
    """Returns the passing order file of one of the instances above. If not `following`, no robot follows another."""
    stem = name if following else f"{name}.none_follows"
    if name in GENERATED:
        map_name, *options = GENERATED[name]
        grove("generate", "instance", "--map", map_name, *options, "-o", f"{name}.cts.json")
    grove("solve", f"{name}.cts.json", "--omega", "0.5", "--threads", "1", "--quiet", "--require-plan",
          "--output", f"{stem}.plan.json", *([] if following else ["--no-following"]))
    grove("execute", f"{name}.cts.json", f"{stem}.plan.json", "--order", f"{stem}.order.json")
    return folder() / f"{stem}.order.json"


def visits(name):
    """Returns {(robot, cell)} for the tasks of the instance."""
    order_file(name)
    instance = json.loads((folder() / f"{name}.cts.json").read_text())
    return {(robot, tuple(task["cell"])) for task in instance["tasks"] for robot in task["agents"]}
