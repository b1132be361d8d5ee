#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The page and `grove check` agree on every plan: random instances of all kinds, half of their plans broken.

agreement_test.py GROVE VERDICTS [--plans N] [--seed S]   VERDICTS: verdicts.ts, bundled for node
"""

import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile

HEADINGS = "NESW"


def random_grid(rng):
    width, height = rng.randint(3, 6), rng.randint(2, 5)
    rows = ["".join("@" if rng.random() < 0.15 else "." for _ in range(width)) for _ in range(height)]
    text = f"type octile\nheight {height}\nwidth {width}\nmap\n" + "\n".join(rows) + "\n"
    cells = [[x, y] for y in range(height) for x in range(width) if rows[y][x] == "."]
    return text, cells


def random_roadmap(rng):
    count = rng.randint(4, 8)
    vertices = [{"id": f"v{i}", "at": [rng.randint(0, 20), rng.randint(0, 20)]} for i in range(count)]
    edges = []
    for i in range(1, count):
        edges.append([rng.randrange(i), i])
    for _ in range(rng.randint(1, count)):
        edges.append(rng.sample(range(count), 2))
    roads = [{"from": f"v{a}", "to": f"v{b}", "steps": rng.randint(1, 4), "one_way": rng.random() < 0.25} for a, b in edges]
    return {"vertices": vertices, "edges": roads}, [v["id"] for v in vertices]


def random_instance(rng, folder, number):
    """Writes an instance and its map; its path."""
    on_roads = rng.random() < 0.35
    if on_roads:
        roadmap, cells = random_roadmap(rng)
        name = f"{number}.roadmap.json"
        (folder / name).write_text(json.dumps(roadmap))
        instance = {"roadmap": name}
    else:
        text, cells = random_grid(rng)
        name = f"{number}.map"
        (folder / name).write_text(text)
        instance = {"map": name}
    agents = rng.randint(1, min(3, max(1, len(cells) - 1)))
    starts, goals = rng.sample(cells, min(agents, len(cells))), rng.sample(cells, min(agents, len(cells)))
    instance["agents"] = []
    for i, start in enumerate(starts):
        agent = {"id": f"a{i}", "start": start}
        if rng.random() < 0.75:
            agent["goal"] = goals[i]
        if not on_roads and rng.random() < 0.5:
            agent.update(motion="turning", turn_steps=rng.randint(1, 3), heading=rng.choice(HEADINGS))
            if "goal" in agent and rng.random() < 0.3:
                agent["goal_heading"] = rng.choice(HEADINGS)
        instance["agents"].append(agent)
    instance["tasks"] = []
    for k in range(rng.randint(0, 4)):
        who = rng.sample([a["id"] for a in instance["agents"]], rng.randint(1, len(starts)))
        task = {"id": f"t{k}", "cell": rng.choice(cells), "agents": who}
        if rng.random() < 0.4:
            task["duration"] = rng.randint(1, 4)
        instance["tasks"].append(task)
    path = folder / f"{number}.cts.json"
    path.write_text(json.dumps(instance))
    return path


def shift_step(rng, plan):
    agent = rng.choice(plan["agents"])
    agent["path"].insert(rng.randrange(len(agent["path"])), rng.choice(agent["path"]))


def drop_step(rng, plan):
    agent = rng.choice(plan["agents"])
    if len(agent["path"]) > 1:
        agent["path"].pop(rng.randrange(len(agent["path"])))


def cut_end(rng, plan):
    agent = rng.choice(plan["agents"])
    del agent["path"][rng.randint(1, len(agent["path"])) :]


def teleport(rng, plan):
    agent = rng.choice(plan["agents"])
    agent["path"][rng.randrange(len(agent["path"]))] = rng.choice(rng.choice(plan["agents"])["path"])


def swap_tails(rng, plan):
    if len(plan["agents"]) > 1:
        a, b = rng.sample(plan["agents"], 2)
        at = rng.randint(0, min(len(a["path"]), len(b["path"])))
        a["path"][at:], b["path"][at:] = b["path"][at:], a["path"][at:]


def turn(rng, plan):
    entries = [e for a in plan["agents"] for e in a["path"] if len(e) in (3, 5) and e[2] in list(HEADINGS)]
    if entries:
        rng.choice(entries)[2] = rng.choice(HEADINGS)


def unwind(rng, plan):
    """A turn goes back on itself."""
    agent = rng.choice(plan["agents"])
    at = rng.randrange(len(agent["path"]))
    agent["path"][at:at] = list(reversed(agent["path"][max(0, at - 2) : at]))


def change_work(rng, plan):
    works = [w for a in plan["agents"] for w in a.get("work", [])]
    if works:
        rng.choice(works)[rng.choice(["begin", "end"])] += rng.choice([-2, -1, 1, 2])


def drop_work(rng, plan):
    agents = [a for a in plan["agents"] if a.get("work")]
    if agents:
        rng.choice(agents)["work"].pop()


def change_number(rng, plan):
    where = rng.choice([plan, rng.choice(plan["agents"])])
    key = rng.choice(["cost", "lower_bound"] if where is plan else ["cost"])
    where[key] += rng.choice([-1, 1])


def change_order(rng, plan):
    agent = rng.choice(plan["agents"])
    rng.shuffle(agent["sequence"])
    if rng.random() < 0.3 and agent["sequence"]:
        agent["sequence"].pop()


def change_status(rng, plan):
    plan["status"] = rng.choice(["optimal", "bounded", "feasible"])


def rest_longer(rng, plan):
    agent = rng.choice(plan["agents"])
    agent["path"] += [agent["path"][-1]] * rng.randint(1, 3)


BREAKS = [shift_step, drop_step, cut_end, teleport, swap_tails, turn, unwind, change_work, drop_work, change_number,
          change_order, change_status, rest_longer]  # fmt: skip


class Cases:
    def __init__(self, grove, verdicts, seed):
        self.grove, self.rng = grove, random.Random(seed)
        self.node = subprocess.Popen(["node", verdicts], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.valid = self.invalid = self.unreadable = 0
        self.differ = []

    def run_grove(self, *arguments):
        return subprocess.run([self.grove, *map(str, arguments)], capture_output=True, text=True)

    def solved(self, folder, number):
        instance = random_instance(self.rng, folder, number)
        plan = folder / f"{number}.plan.json"
        omega = self.rng.choice(["0", "0.1", "0.5", "inf"])
        limits = ("--time-limit", "0.3", "--threads", "1", "--quiet")
        self.run_grove("solve", instance, *limits, "--omega", omega, "--output", plan)
        if not plan.exists() or "agents" not in json.loads(plan.read_text()):
            return None
        return instance, plan

    def compare(self, instance, plan):
        check = self.run_grove("check", instance, plan)
        page = plan.with_suffix(".html")
        view = self.run_grove("view", instance, plan, "-o", page)
        if view.returncode != 0:
            self.unreadable += 1
            if check.returncode == 0:
                self.differ.append((instance, plan, "view refuses what check finds valid: " + view.stderr))
            return
        self.node.stdin.write(f"{page}\n")
        self.node.stdin.flush()
        verdict = json.loads(self.node.stdout.readline())
        is_valid = verdict.get("violations") == []
        if is_valid != (check.returncode == 0):
            self.differ.append((instance, plan, f"{check.stdout}{check.stderr}{json.dumps(verdict)[:600]}"))
        self.valid += is_valid
        self.invalid += not is_valid

    def run(self, plans, folder):
        number = 0
        while self.valid + self.invalid < plans and not self.differ:
            number += 1
            case = self.solved(folder, number)
            if case is None:
                continue
            instance, plan = case
            text = json.loads(plan.read_text())
            self.compare(instance, plan)
            for _ in range(self.rng.choice([1, 1, 2])):
                self.rng.choice(BREAKS)(self.rng, text)
            plan.write_text(json.dumps(text))
            self.compare(instance, plan)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("grove")
    parser.add_argument("verdicts")
    parser.add_argument("--plans", type=int, default=150)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        cases = Cases(arguments.grove, arguments.verdicts, arguments.seed)
        cases.run(arguments.plans, pathlib.Path(folder))
        for instance, plan, text in cases.differ:
            print(f"differ: {instance.read_text()}\n{plan.read_text()}\n{text}", file=sys.stderr)
    print(f"{cases.valid} valid, {cases.invalid} not, {cases.unreadable} unreadable, {len(cases.differ)} differ")
    sys.exit(1 if cases.differ else 0)


if __name__ == "__main__":
    main()
