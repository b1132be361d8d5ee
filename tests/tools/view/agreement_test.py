#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks that the page and `grove check` agree on the validity of plans.

The instances are those in benchmarks/data and random ones of all kinds. Each plan is compared as solved and after
random changes. In some instances the agents get choices afterwards, of which the plan is one.

agreement_test.py GROVE NODE VERDICTS [--plans N] [--seed S]   VERDICTS: verdicts.ts, bundled for node
"""

import argparse
import collections
import json
import pathlib
import random
import subprocess
import sys
import tempfile

HEADINGS = "NESW"
DATA = pathlib.Path(__file__).resolve().parents[3] / "benchmarks" / "data"


def random_grid(rng):
    width, height = rng.randint(3, 6), rng.randint(2, 5)
    rows = ["".join("@" if rng.random() < 0.15 else "." for _ in range(width)) for _ in range(height)]
    text = f"type octile\nheight {height}\nwidth {width}\nmap\n" + "\n".join(rows) + "\n"
    cells = [[x, y] for y in range(height) for x in range(width) if rows[y][x] == "."]
    return text, cells


def random_roadmap(rng):
    count = rng.randint(4, 8)
    vertices = [{"id": f"v{i}", "at": [rng.randint(0, 20), rng.randint(0, 20)]} for i in range(count)]
    edges = [[rng.randrange(i), i] for i in range(1, count)]
    edges += [rng.sample(range(count), 2) for _ in range(rng.randint(1, count))]
    # Adds parallel roads in random directions.
    edges += [rng.sample(edge, 2) for edge in rng.sample(edges, rng.randint(0, 2))]
    roads = [{"from": f"v{a}", "to": f"v{b}", "steps": rng.randint(1, 4), "one_way": rng.random() < 0.25}
             for a, b in edges]
    return {"vertices": vertices, "edges": roads}, [v["id"] for v in vertices]


def start_on_a_road(rng, roadmap):
    """Returns a place within a road, or None if there is none."""
    long = [i for i, road in enumerate(roadmap["edges"]) if road["steps"] > 1]
    if not long:
        return None
    index = rng.choice(long)
    road = roadmap["edges"][index]
    return [road["from"], road["to"], rng.randint(1, road["steps"] - 1), index]


def add_turning(rng, agent):
    steps, heading = rng.randint(1, 3), rng.choice(HEADINGS)
    agent.update(motion="turning", turn_steps=steps)
    if steps > 1 and rng.random() < 0.3:
        to = HEADINGS[(HEADINGS.index(heading) + rng.choice([1, 3])) % 4]
        agent["start"] = [*agent["start"], heading, to, rng.randint(1, steps - 1)]
    else:
        agent["heading"] = heading
    if "goal" in agent and rng.random() < 0.3:
        agent["goal_heading"] = rng.choice(HEADINGS)


def random_tasks(rng, cells, agents):
    places = rng.sample(cells, min(len(cells), 2)) if rng.random() < 0.3 else cells  # often several tasks on one cell
    tasks = []
    for k in range(rng.randint(0, 4)):
        who = rng.sample([a["id"] for a in agents], rng.randint(1, len(agents)))
        task = {"id": f"t{k}", "cell": rng.choice(places), "agents": who}
        if rng.random() < 0.4:
            task["duration"] = rng.randint(1, 4)
        tasks.append(task)
    return tasks


def add_working(rng, agent, cell, tasks):
    """Lets the agent start in the middle of executing a task of its own."""
    task = {"id": f"t{len(tasks)}", "cell": cell, "agents": [agent["id"]], "duration": rng.randint(1, 4)}
    agent["working"] = {"task": task["id"], "done": rng.randint(0, task["duration"] - 1)}
    tasks.append(task)


def random_instance(rng, folder, number):
    """Writes an instance and its map. Returns the path of the instance."""
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
    count = min(rng.randint(1, 3), max(1, len(cells) - 1))
    starts, goals = rng.sample(cells, min(count, len(cells))), rng.sample(cells, min(count, len(cells)))
    agents = [{"id": f"a{i}", "start": start} for i, start in enumerate(starts)]
    tasks = random_tasks(rng, cells, agents)
    for i, agent in enumerate(agents):
        if rng.random() < 0.75:
            agent["goal"] = goals[i]
        if not on_roads and rng.random() < 0.5:
            add_turning(rng, agent)
        if rng.random() < 0.15:
            add_working(rng, agent, starts[i], tasks)
    if on_roads and rng.random() < 0.3 and "working" not in agents[0]:
        agents[0]["start"] = start_on_a_road(rng, roadmap) or agents[0]["start"]
    path = folder / f"{number}.cts.json"
    path.write_text(json.dumps({**instance, "agents": agents, "tasks": tasks}))
    return path


def first_visit(path, cell, begin):
    """Returns the first time from `begin` on at which the path is on the cell, or None."""
    cell = cell if isinstance(cell, list) else [cell]
    size = 1 if isinstance(cell[0], str) else 2
    times = (t for t in range(begin, len(path)) if path[t][:size] == cell and (size == 2 or len(path[t]) == 1))
    return next(times, None)


def stated_visits(agent, tasks):
    """Returns the visits of the agent to its tasks, in their order: {task: (begin, end)}, or None if there are none."""
    work = {piece["task"]: (piece["begin"], piece["end"]) for piece in agent.get("work", [])}
    visits, now = {}, 0
    for task in agent["sequence"]:
        visit = work.get(task)
        if visit is None:
            time = first_visit(agent["path"], tasks[task]["cell"], min(now, len(agent["path"]) - 1))
            if time is None:
                return None
            visit = time, time
        visits[task] = visit
        now = visit[1]
    return visits


def loosen_tasks(rng, data, plan):
    """Gives tasks a choice of agents, and states their visits in the plan."""
    tasks = {task["id"]: task for task in data["tasks"]}
    everyone = [agent["id"] for agent in data["agents"]]
    visits = {agent["id"]: stated_visits(agent, tasks) for agent in plan["agents"]}
    if None in visits.values():
        return
    for task in data["tasks"]:
        visitors = task["agents"]
        more = [agent for agent in everyone if agent not in visitors and rng.random() < 0.6]
        need = rng.randint(1, len(visitors))
        if rng.random() < 0.3 or need == len(visitors) + len(more):
            continue
        task["agents"] = rng.sample(visitors + more, len(visitors) + len(more))
        if len(task["agents"]) == len(everyone) and rng.random() < 0.5:
            task["agents"] = "*"
        task["need"] = need
        for agent in plan["agents"]:
            if agent["id"] in visitors and not any(w["task"] == task["id"] for w in agent.get("work", [])):
                begin, end = visits[agent["id"]][task["id"]]
                agent.setdefault("work", []).append({"task": task["id"], "begin": begin, "end": end})


def loosen_goals(rng, data):
    places = [agent["goal"] for agent in data["agents"] if "goal" in agent] + [task["cell"] for task in data["tasks"]]
    for agent in data["agents"]:
        if "goal" in agent and rng.random() < 0.6:
            goal = agent.pop("goal")
            others = [place for i, place in enumerate(places) if place != goal and place not in places[:i]]
            agent["goals"] = [goal, *rng.sample(others, min(len(others), rng.randint(0, 3)))]
            rng.shuffle(agent["goals"])


def loosen(rng, instance, plan):
    """Gives the agents of the instance choices, of which the plan is one."""
    data = json.loads(instance.read_text())
    loosen_goals(rng, data)
    if rng.random() < 0.8:
        loosen_tasks(rng, data, plan)
    instance.write_text(json.dumps(data))


def generated_instance(rng, folder, number, run_grove):
    """Generates an instance with `grove generate` and returns its path."""
    path, seed = folder / f"{number}.cts.json", str(rng.randrange(1000))
    if rng.random() < 0.5:
        world = ["--map", folder / f"{number}.map"]
        kind = rng.choice([["random", "--obstacles", "0.1"], ["empty"]])
        run_grove("generate", "map", *kind, "--width", "8", "--height", "8", "--seed", seed, "-o", world[1])
    else:
        world = ["--roadmap", folder / f"{number}.roadmap.json"]
        run_grove("generate", "roadmap", "--kind", "planar", "--vertices", "12", "--seed", seed, "-o", world[1])
    more = ["--mg"] if rng.random() < 0.3 else []
    run_grove("generate", "instance", *world, "--agents", "3", "--tasks", "4", "--seed", seed, *more, "-o", path)
    return path


def features(instance):
    """Returns the names of the instance's features."""
    data = json.loads(instance.read_text())
    agents, tasks = data["agents"], data.get("tasks", [])
    cells = [str(task["cell"]) for task in tasks]
    with_tasks = {agent for task in tasks for agent in task["agents"]}
    needs = [task["need"] for task in tasks if "need" in task]
    found = {
        "choice of goals": any(len(a.get("goals", [])) > 1 for a in agents),
        "choice of agents": len(needs) > 0,
        "choice of all agents": any(task["agents"] == "*" for task in tasks),
        "need above 1": any(need > 1 for need in needs),
        "roadmap": "roadmap" in data,
        "start on a road": "roadmap" in data
        and any(isinstance(a["start"], list) and len(a["start"]) > 2 for a in agents),
        "turning": any("motion" in a for a in agents),
        "start within a turn": any("motion" in a and len(a["start"]) == 5 for a in agents),
        "duration": any(task.get("duration") for task in tasks),
        "start at work": any("working" in a for a in agents),
        "tasks on one cell": len(set(cells)) < len(cells),
        "idle agent": any("goal" not in a and a["id"] not in with_tasks for a in agents),
    }
    return [name for name, is_so in found.items() if is_so]


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
    """Inserts up to two entries of a path a second time, in reverse order."""
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


def no_way(rng, plan):
    """Changes a number in a path entry, so that a step may lead onto a blocked cell, along a different road or off the
    map."""
    agent = rng.choice(plan["agents"])
    entry = agent["path"][rng.randrange(len(agent["path"]))]
    numbers = [i for i, part in enumerate(entry) if isinstance(part, int)]
    if numbers:
        entry[rng.choice(numbers)] += rng.choice([-1, 1])


def rest_on_another(rng, plan):
    """Gives one agent the path of another agent."""
    if len(plan["agents"]) > 1:
        a, b = rng.sample(plan["agents"], 2)
        a["path"] = list(b["path"])


def work_again(rng, plan):
    agents = [a for a in plan["agents"] if a.get("work")]
    if agents:
        agent = rng.choice(agents)
        piece = dict(rng.choice(agent["work"]))
        later = rng.randint(0, 3)
        agent["work"].append({**piece, "begin": piece["begin"] + later, "end": piece["end"] + later})


def work_for_another(rng, plan):
    works = [w for a in plan["agents"] for w in a.get("work", [])]
    tasks = [t for a in plan["agents"] for t in a["sequence"]]
    if works:
        rng.choice(works)["task"] = rng.choice(tasks)


def visit_by_another(rng, plan):
    """Moves a stated visit to another agent."""
    agents = [a for a in plan["agents"] if a.get("work")]
    if agents:
        agent = rng.choice(agents)
        piece = agent["work"].pop(rng.randrange(len(agent["work"])))
        if piece["task"] in agent["sequence"]:
            agent["sequence"].remove(piece["task"])
        other = rng.choice(plan["agents"])
        other.setdefault("work", []).append(piece)
        other["sequence"].insert(rng.randint(0, len(other["sequence"])), piece["task"])


def drop_visit(rng, plan):
    """Removes a stated visit, from the order of tasks as well."""
    agents = [a for a in plan["agents"] if a.get("work")]
    if agents:
        agent = rng.choice(agents)
        task = agent["work"].pop(rng.randrange(len(agent["work"])))["task"]
        agent["sequence"] = [other for other in agent["sequence"] if other != task]


def state_a_visit(rng, plan):
    """States a visit of a task, on any place of the path."""
    tasks = [task for agent in plan["agents"] for task in agent["sequence"]]
    if tasks:
        agent, time = rng.choice(plan["agents"]), rng.randint(0, 6)
        agent.setdefault("work", []).append({"task": rng.choice(tasks), "begin": time, "end": time})


def without_a_path(rng, plan):
    if rng.random() < 0.5:
        plan["agents"].pop(rng.randrange(len(plan["agents"])))
    else:
        rng.choice(plan["agents"])["path"] = []


def huge_number(rng, plan):
    agent = rng.choice(plan["agents"])
    for work in agent.get("work", [])[:1]:
        work[rng.choice(["begin", "end"])] = rng.choice([-(2**30), 2**30])
    agent["cost"] = rng.choice([agent["cost"], 2**30])
    plan[rng.choice(["cost", "lower_bound"])] = 2**60


def change_omega(rng, plan):
    plan["omega"] = rng.choice([0, 1e-9, 1e-5, 0.05, 0.25, 1, 1e6, "inf"])


def change_bound(rng, plan):
    plan["lower_bound"] = rng.choice([-1, 0, plan["cost"] // 2, plan["cost"] - 1, plan["cost"], plan["cost"] + 1])
    if rng.random() < 0.5:
        change_status(rng, plan)


BREAKS = [shift_step, drop_step, cut_end, teleport, swap_tails, turn, unwind, change_work, drop_work, change_number,
          change_order, change_status, rest_longer, no_way, rest_on_another, work_again, work_for_another,
          without_a_path, huge_number, change_omega, change_bound]  # fmt: skip
BREAKS_OF_VISITS = [visit_by_another, drop_visit, state_a_visit, change_work, cut_end]


def path_lists(plan):
    """Returns the plan in the path format of EECBS, in which the row comes before the column."""
    lines = (
        f"Agent {i}: " + "".join(f"({y},{x})->" for x, y in agent["path"]) for i, agent in enumerate(plan["agents"])
    )
    return "\n".join(lines) + "\n"


def visualizer_text(rng, plan):
    """Returns the plan in the format of lacam3, with claims of cost and bound that can be wrong."""
    paths = [agent["path"] for agent in plan["agents"]]
    cells = [[path[min(t, len(path) - 1)] for path in paths] for t in range(max(map(len, paths)))]
    lines = [f"{t}:" + "".join(f"({x},{y})," for x, y in row) for t, row in enumerate(cells)]
    claims = [f"soc={plan['cost']}", f"soc_lb={plan['lower_bound']}"]
    return "\n".join([f"agents={len(paths)}", *rng.sample(claims, rng.randint(0, 2)), "solution=", *lines]) + "\n"


def is_for_others(plan):
    """Returns whether other tools can represent the plan: no roads, turns, task executions or negative numbers, and a
    path for every agent."""
    agents = plan["agents"]
    return len(agents) > 0 and plan["lower_bound"] >= 0 and all(
        a["path"] and not a.get("work") and all(len(e) == 2 and min(e) >= 0 for e in a["path"]) for a in agents
    )


class Cases:
    def __init__(self, grove, node, verdicts, seed):
        self.grove, self.rng = grove, random.Random(seed)
        self.node = subprocess.Popen([node, verdicts], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.valid = self.invalid = self.unreadable = 0
        self.seen = collections.Counter()
        self.differ = []

    def run_grove(self, *arguments):
        return subprocess.run([self.grove, *map(str, arguments)], capture_output=True, text=True)

    def solved(self, instance, plan):
        """Solves the instance and returns the plan, or None if there is none."""
        omega = self.rng.choice(["0", "0.1", "0.5", "inf"])
        limits = ("--time-limit", "0.3", "--threads", "1", "--quiet")
        self.run_grove("solve", instance, *limits, "--omega", omega, "--output", plan)
        found = json.loads(plan.read_text()) if plan.exists() else {}
        return found if "agents" in found else None

    def compare(self, instance, plan):
        check = self.run_grove("check", instance, plan)
        page = plan.with_suffix(".html")
        view = self.run_grove("view", instance, plan, "-o", page)
        if view.returncode != 0:
            self.unreadable += 1
            if (view.returncode, check.returncode) != (2, 2):
                self.differ.append((instance, plan, "view refuses a plan that check reads: " + view.stderr))
            return
        self.node.stdin.write(f"{page}\n")
        self.node.stdin.flush()
        verdict = json.loads(self.node.stdout.readline())
        is_valid = verdict.get("violations") == []
        if "error" in verdict or is_valid != (check.returncode == 0):
            self.differ.append((instance, plan, f"{check.stdout}{check.stderr}{json.dumps(verdict)[:600]}"))
        self.valid += is_valid
        self.invalid += not is_valid
        self.seen.update(features(instance) + sorted({found["kind"] for found in verdict.get("violations", [])}))

    def compare_both(self, instance, plan):
        """Compares the verdicts on a plan and on a changed version of it, each in the format of Grove or of a different
        tool."""
        data = self.solved(instance, plan)
        if data is None:
            return
        if instance.parent == plan.parent and self.rng.random() < 0.5:
            loosen(self.rng, instance, data)
        if self.rng.random() < 0.05:
            data = {key: data[key] for key in ("status", "lower_bound", "omega")}
        self.write(plan, data)
        self.compare(instance, plan)
        if "agents" not in data:
            return
        for _ in range(self.rng.choice([1, 1, 2])):
            if len(data["agents"]) > 0 and all(agent["path"] for agent in data["agents"]):
                breaks = BREAKS_OF_VISITS if self.rng.random() < 0.3 else BREAKS
                self.rng.choice(breaks)(self.rng, data)
        self.write(plan, data)
        self.compare(instance, plan)

    def write(self, plan, data):
        kind = self.rng.random()
        if kind > 0.2 or "agents" not in data or not is_for_others(data):
            plan.write_text(json.dumps(data))
            return
        self.seen["other tools"] += 1
        plan.write_text(path_lists(data) if kind < 0.1 else visualizer_text(self.rng, data))

    def instance(self, folder, number):
        if self.rng.random() < 0.1:
            return generated_instance(self.rng, folder, number, self.run_grove)
        return random_instance(self.rng, folder, number)

    def run(self, plans, folder):
        for instance in sorted(DATA.glob("*.cts.json")):
            self.compare_both(instance, folder / f"{instance.name}.plan.json")
        number = 0
        while self.valid + self.invalid < plans and not self.differ:
            number += 1
            self.compare_both(self.instance(folder, number), folder / f"{number}.plan.json")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("grove")
    parser.add_argument("node")
    parser.add_argument("verdicts")
    parser.add_argument("--plans", type=int, default=150)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        cases = Cases(arguments.grove, arguments.node, arguments.verdicts, arguments.seed)
        cases.run(arguments.plans, pathlib.Path(folder))
        for instance, plan, text in cases.differ:
            print(f"differ: {instance.read_text()}\n{plan.read_text()}\n{text}", file=sys.stderr)
    print(", ".join(f"{name} {count}" for name, count in sorted(cases.seen.items())))
    print(f"{cases.valid} valid, {cases.invalid} invalid, {cases.unreadable} unreadable, {len(cases.differ)} differ")
    sys.exit(1 if cases.differ else 0)


if __name__ == "__main__":
    main()
