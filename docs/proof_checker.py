#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks certificates of classical MAPF with only vertex and edge splits: a minimal implementation of docs/proof.md.

    proof_checker.py INSTANCE.cts.json PROOF

An instance must be on a map, and its agents must have a start and a goal but no tasks and no turning. A certificate may
use only the rules `leaf` and `split` and the constraints `bar` and `move`, and no lemmas. A compressed certificate
requires the program zstd. This program is meant to be read; grove-verify checks all certificates and is faster. This
program uses at most 1 GB of memory and refuses a certificate that needs more.
"""
import heapq
import json
import resource
import subprocess
import sys
from pathlib import Path


MEMORY = 1_000_000_000  # bytes
MAX_LINE_LENGTH = 1 << 22


class Refused(Exception):
    pass


def expect(condition, reason):
    if not condition:
        raise Refused(reason)


def members(pairs):
    """Returns a JSON object as a dictionary, without keys that are remarks. Refuses duplicate keys."""
    expect(len(dict(pairs)) == len(pairs), "a key is there twice")
    return {key: value for key, value in pairs if not key.startswith("_") and key != "$schema"}


def read_instance(path):
    """Returns (neighbours of each place, starts, goals, checksum)."""
    instance = json.loads(path.read_text(encoding="utf-8-sig"), object_pairs_hook=members)
    agents = instance.get("agents", [])
    # Refuses other keys, because they could change the problem, and the bound would be that of a different problem.
    expect(instance.keys() == {"map", "agents", "tasks"} and agents and not instance["tasks"] and
           all(agent.keys() == {"id", "start", "goal"} for agent in agents), "expected classical MAPF")
    rows = (path.parent / instance["map"]).read_text(encoding="utf-8-sig").split("\n")[4:]
    rows = [["." if letter in ".GSE" else "@" for letter in row.strip()] for row in rows if row.strip()]
    height, width = len(rows), len(rows[0])
    places = {y * width + x for y in range(height) for x in range(width) if rows[y][x] == "."}
    links = {place: [q for q, near in ((place - width, True), (place + 1, place % width < width - 1),
                                       (place + width, True),
                                       (place - 1, place % width > 0)) if near and q in places] for place in places}
    cells = [[agent[key] for agent in agents] for key in ("start", "goal")]
    expect(all(isinstance(cell, list) and [type(x) for x in cell] == [int, int] and 0 <= cell[0] < width
               and cell[1] * width + cell[0] in places
               for some in cells for cell in some), "expected passable cells")
    starts, goals = ([y * width + x for x, y in some] for some in cells)
    expect(len(set(starts)) == len(starts) and len(set(goals)) == len(goals), "expected distinct starts and goals")
    text = [f"grid {width} {height}", *map("".join, rows), *(f"agent {s} {g} 0" for s, g in zip(starts, goals))]
    checksum = 0xcbf29ce484222325
    for byte in "".join(line + "\n" for line in text).encode():
        checksum = (checksum ^ byte) * 0x100000001b3 % 2**64
    return links, starts, goals, f"{checksum:016x}"


def distances(links, goal):
    """Returns {place: steps to the goal} for the places from which the goal is reachable."""
    found, queue = {goal: 0}, [goal]
    for place in queue:
        for near in links[place]:
            if near not in found:
                found[near] = found[place] + 1
                queue.append(near)
    return found


def least_cost(links, to_go, start, goal, constraints):
    """Computes c(A, D) of docs/proof.md by A* over places and times. Returns None if there is no path."""
    last = max((d[-1] for d in constraints), default=0)  # all times after `last` are equivalent
    bars, moves = ({d[1:] for d in constraints if d[0] == kind} for kind in ("bar", "move"))
    rest_from = 1 + max((time for place, time in bars if place == goal), default=-1)
    waiting = [(to_go[start], 0, start)] if start in to_go and (start, 0) not in bars else []
    seen = set()
    while waiting:
        _, time, place = heapq.heappop(waiting)
        if place == goal and time >= rest_from:
            return time
        if (place, min(time, last + 1)) not in seen:
            seen.add((place, min(time, last + 1)))
            for near in [place, *links[place]]:
                if near in to_go and (near, time + 1) not in bars and (place, near, time + 1) not in moves:
                    heapq.heappush(waiting, (time + 1 + to_go[near], time + 1, near))
    return None


def number(word):
    expect(word.isdigit(), f"expected a number, not {word}")
    return int(word)


def read_constraint(words, agents):
    """Reads a constraint for a single time as (agent, ("bar", P, T)) or (agent, ("move", P, Q, T))."""
    agent, kind, *numbers = words
    *places, begin, end = map(number, numbers)
    expect((kind, len(places), len(set(places))) in (("bar", 1, 1), ("move", 2, 2)),
           "this constraint is not supported here")
    expect(number(agent) < agents and begin == end, "expected an agent, and one time")
    return int(agent), (kind, *places, begin)


def read_split(line, agents):
    """Reads a split. Ensures that every plan satisfies at least one of its two constraints, and returns them."""
    words = [side.split(" ") for side in line.removeprefix("split ").split(" | ")]
    expect(line.startswith("split ") and len(words) == 2, "this rule is not supported here")
    (a, (kind, *one)), (b, (other, *two)) = (read_constraint(side, agents) for side in words)
    met = one == two if kind == "bar" else one == [two[1], two[0], two[2]]
    expect(a != b and kind == other and met, "a plan may satisfy neither of these constraints")
    return (a, (kind, *one)), (b, (other, *two))


def check(instance, lines):
    """Checks a certificate and returns (proven lower bound, whether following is allowed)."""
    links, starts, goals, instance_sum = read_instance(instance)
    to_go = [distances(links, goal) for goal in goals]
    head = [next(lines) for _ in range(4)]
    expect(head[0] == "grove-proof 1" and head[2] in ("following yes", "following no")
           and head[3].startswith("theorem "),
           "this header is not supported here")
    expect(head[1] == f"instance {instance_sum}", "the certificate is for another instance")
    bound = float("inf") if head[3] == "theorem inf" else number(head[3].removeprefix("theorem "))
    constraints = [[] for _ in starts]
    splits = []  # (agent of the constraint in force, second constraint unless its branch has started)
    known = {}

    def cost(agent):
        key = agent, tuple(constraints[agent])
        if key not in known:
            known[key] = least_cost(links, to_go[agent], starts[agent], goals[agent], constraints[agent])
        return known[key]

    while True:
        line = next(lines)
        if line != "leaf":
            (agent, first), second = read_split(line, len(starts))
            constraints[agent].append(first)
            splits.append((agent, second))
            continue
        costs = [cost(agent) for agent in range(len(starts))]
        expect(None in costs or sum(costs) >= bound, f"costs are {costs}; expected a sum of at least {bound}")
        while splits and splits[-1][1] is None:
            constraints[splits.pop()[0]].pop()
        if not splits:
            expect(next(lines) == "end" and next(lines, None) is None, "expected 'end'")
            return bound, head[2] == "following yes"
        agent, (other, second) = splits.pop()
        constraints[agent].pop()
        constraints[other].append(second)
        splits.append((other, None))


def lines_of(path):
    """Yields the lines of a certificate one at a time, because a few compressed bytes can contain any number of lines.
    """
    with path.open("rb") as file:
        compressed = file.read(4) == b"\x28\xb5\x2f\xfd"
    source = subprocess.Popen(["zstd", "-dcq", "--", path],
                              stdout=subprocess.PIPE).stdout if compressed else path.open("rb")
    with source:
        while line := source.readline(MAX_LINE_LENGTH):
            expect(line.endswith(b"\n"), "expected the end of a line")
            yield line[:-1].decode("ascii")


def main(instance, proof):
    try:
        bound, may_follow = check(Path(instance), lines_of(Path(proof)))
        print(f"verified: no plan costs less than {bound}" + ", where following is forbidden" * (not may_follow))
    except (Refused, ValueError, IndexError, StopIteration) as error:
        sys.exit(f"refused: {error or 'the certificate is incomplete'}")


def run(instance, proof):
    """Calls main() with a limit of MEMORY bytes, and refuses the certificate if it needs more."""
    _, most = resource.getrlimit(resource.RLIMIT_DATA)
    resource.setrlimit(resource.RLIMIT_DATA, (MEMORY, most))
    try:
        main(instance, proof)
    except MemoryError:
        resource.setrlimit(resource.RLIMIT_DATA, (most, most))  # so that the message can be printed
        sys.exit(f"refused: needs more than {MEMORY / 1e9:.1f} GB of memory")


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: proof_checker.py INSTANCE CERTIFICATE")
    run(*sys.argv[1:])
