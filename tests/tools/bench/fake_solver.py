#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Imitates external solvers, both correct and faulty ones, for tests of grove bench.

    fake_solver.py MAP SCENARIO AGENTS OUTPUT [IGNORED...] KIND

Every agent of the scenario starts in the first column and goes to the last column of the same row, so that the
straight paths are optimal."""
import os
import signal
import subprocess
import sys
import time
from pathlib import Path


def rows_of(scenario, agents):
    """Returns (start, goal) of each agent as (x, y) pairs."""
    lines = Path(scenario).read_text().splitlines()[1:]
    numbers = [[int(word) for word in line.split("\t")[4:8]] for line in lines[:agents]]
    assert len(numbers) == agents == len(lines), "the scenario has a wrong number of rows"
    return [((a, b), (c, d)) for a, b, c, d in numbers]


def straight(start, goal, waits=0):
    return [start] * waits + [(x, start[1]) for x in range(start[0], goal[0] + 1)]


def write(output, paths):
    """Writes paths in the format of EECBS, in which cells are (row,column)."""
    text = "".join(f"Agent {k}: " + "".join(f"({y},{x})->" for x, y in path) + "\n"
                   for k, path in enumerate(paths))
    Path(output).write_text(text)


def main():
    map_file, scenario, agents, output, *_, kind = sys.argv[1:]
    assert set("".join(Path(map_file).read_text().splitlines()[4:])) <= {".", "@"}
    rows = rows_of(scenario, int(agents))
    paths = [straight(*row) for row in rows]
    cost = sum(len(path) - 1 for path in paths)
    if kind == "honest":
        write(output, paths)
        print(f"cost {cost} bound {cost}")
    elif kind == "collides":
        first = paths[0][:2] + [(1, 1)] + paths[0][1:]  # (1, 1): where the second agent is at that time
        write(output, [first, straight(*rows[1], waits=1), *paths[2:]])
        print(f"cost {cost}")
    elif kind == "claims":
        print(f"cost {cost - 1}")
    elif kind == "asserts":
        print("no number, but a plan, I have")
    elif kind == "understates":
        write(output, [straight(*row, waits=2) for row in rows])
        print(f"cost {cost}")
    elif kind == "overbounds":
        write(output, paths)
        print(f"cost {cost} bound {cost + 5}")
    elif kind == "garbage":
        Path(output).write_text("I am no plan\n")
    elif kind == "partial":
        write(output, [path[:3] for path in paths])
        signal.pause()
    elif kind == "planless":
        print("nothing found")
    elif kind == "hangs":
        child = subprocess.Popen(["sleep", "600"])
        Path(os.environ["FAKE_PIDS"]).write_text(str(child.pid))
        signal.pause()
    elif kind == "crashes":
        print("out of luck")
        sys.stdout.flush()
        os.kill(os.getpid(), signal.SIGABRT)
    elif kind == "fails":
        print("out of luck")
        sys.exit(255)
    elif kind == "allocates":
        bytearray(3_000_000_000)
    elif kind == "anytime":
        # The first claimed cost is 1 too low. The last plan is reported 3 times, the third time with a cost 1 too low.
        for waits, offset in ((3, 3 * len(rows) - 1), (1, len(rows)), (0, 0), (0, 0), (0, -1)):
            write(output, [straight(*row, waits=waits) for row in rows])
            print(f"at {time.process_time():.3f} cost {cost + offset}", flush=True)
        signal.pause()
    elif kind == "late":
        # Writes its only plan long after the time limit and claims to have found it at 0.001 s.
        time.sleep(2.5)
        write(output, [straight(*row) for row in rows])
        print(f"at 0.001 cost {cost}", flush=True)
    else:
        raise SystemExit(f"no such kind: {kind}")


if __name__ == "__main__":
    main()
