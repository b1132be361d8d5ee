# SPDX-License-Identifier: MIT
"""Models tiny instances, the motions of their agents and the least cost of a plan, as sections 1 and 2 of
docs/proof.md define them.

This plain Python code is a second implementation for comparison: slow, but short enough to review."""
import functools
import heapq
import itertools
import json
import random

INF = float("inf")
HEADINGS = "NESW"
AHEAD = {"N": (0, -1), "E": (1, 0), "S": (0, 1), "W": (-1, 0)}


class World:
    """Represents the places, links and neighbours of a grid, given by its rows, or of roads (from, to, steps, one
    way) between vertices."""

    def __init__(self, rows=None, vertices=0, roads=()):
        self.rows, self.vertices, self.roads = rows, vertices, list(roads)
        self.links = set()
        if rows is not None:
            self.width, self.height = len(rows[0]), len(rows)
            self.count = self.width * self.height
            for place in range(self.count):
                for heading in HEADINGS if self.passable(place) else "":
                    ahead = self.ahead(place, heading)
                    if ahead is not None:
                        self.links.add((place, ahead))
        else:
            self.count = vertices
            for start, end, steps, one_way in self.roads:
                row = [start, *range(self.count, self.count + steps - 1), end]
                self.count += steps - 1
                for pair in zip(row, row[1:]):
                    self.links |= {pair} if one_way else {pair, pair[::-1]}
        self.near = {place: {q for link in self.links for q in link if place in link} - {place}
                     for place in range(self.count)}
        self.after = {place: sorted(q for p, q in self.links if p == place) for place in range(self.count)}

    def passable(self, place):
        return self.rows is None or self.rows[place // self.width][place % self.width] == "."

    def ahead(self, place, heading):
        x, y = place % self.width + AHEAD[heading][0], place // self.width + AHEAD[heading][1]
        inside = 0 <= x < self.width and 0 <= y < self.height
        return y * self.width + x if inside and self.passable(y * self.width + x) else None

    def chain(self, place):
        """Returns the chain with `place` in its interior, from end to end, or None if there is none."""
        if len(self.near[place]) != 2:
            return None
        row = [place]
        for turn in (0, 1):
            before, now = place, sorted(self.near[place])[turn]
            while len(self.near[now]) == 2 and now != place:
                row.insert(len(row) if turn else 0, now)
                before, now = now, next(q for q in self.near[now] if q != before)
            if now == place:
                return None
            row.insert(len(row) if turn else 0, now)
        return tuple(min(row, row[::-1]))


class Agent:
    """Represents an agent. Its start is a pose: (place,), (place, heading) or (place, heading, to, steps done).

    goals: the places of which it chooses its goal; only for hand-made certificates."""

    def __init__(self, start, goal=None, turn=0, goal_heading=None, working=None, goals=()):
        self.start, self.goal, self.turn, self.goal_heading, self.working = start, goal, turn, goal_heading, working
        self.goals = list(goals)


class Instance:
    """Represents an instance. Each task is (place, duration, agents). needs: the needs of tasks with a choice of
    agents, by number; only for hand-made certificates."""

    def __init__(self, world, agents, tasks=(), needs=None):
        self.world, self.agents, self.tasks, self.needs = world, agents, list(tasks), needs or {}

    @functools.cache
    def own(self, agent):
        return [number for number, task in enumerate(self.tasks) if agent in task[2]]

    @functools.cache
    def stops(self, agent):
        own = self.own(agent)
        timed = {self.tasks[j][0] for j in own if self.tasks[j][1] > 0}
        first = {}
        for j in own:
            first.setdefault(self.tasks[j][0], j)
        return [j for j in own if self.tasks[j][1] > 0
                or (self.tasks[j][0] not in timed and first[self.tasks[j][0]] == j)]

    def plain_goal(self, agent):
        goal = self.agents[agent].goal
        timed = any(self.tasks[j][0] == goal and self.tasks[j][1] > 0 for j in self.own(agent))
        return goal if goal is not None and self.agents[agent].goal_heading is None and not timed else None

    def steps(self, agent, pose):
        """Returns the poses that one step can lead to, except by waiting."""
        place, turn = pose[0], self.agents[agent].turn
        if not turn:
            return [(q,) for q in self.world.after[place]]
        if len(pose) == 4:
            _, start, end, k = pose
            return [(place, end) if k + 1 == turn else (place, start, end, k + 1)]
        ahead = self.world.ahead(place, pose[1])
        sides = [HEADINGS[(HEADINGS.index(pose[1]) + by) % 4] for by in (1, 3)]
        turns = [(place, side) if turn == 1 else (place, pose[1], side, 1) for side in sides]
        return turns + ([(ahead, pose[1])] if ahead is not None else [])

    def ends(self, agent, pose, last):
        """Returns whether the agent may end in this pose after all its stops. last: the stop visited last, or None
        if the order is not tracked."""
        one, own = self.agents[agent], self.own(agent)
        if one.goal is not None:
            return pose[0] == one.goal and (one.goal_heading is None or pose[1:] == (one.goal_heading,))
        if not own:
            return True
        if last is not None and all(self.tasks[j][1] == 0 for j in own):
            return pose[0] == self.tasks[last][0]
        return pose[0] in {self.tasks[j][0] for j in own}

    def checksum(self):
        world, lines = self.world, []
        if world.rows is not None:
            lines += [f"grid {world.width} {world.height}",
                      *("".join("." if c == "." else "@" for c in row) for row in world.rows)]
        else:
            lines += [f"roadmap {world.vertices} {len(world.roads)}",
                      *(f"{a} {b} {d} {int(one)}" for a, b, d, one in world.roads)]
        for agent in self.agents:
            lines.append(f"agent {agent.start[0]} {-1 if agent.goal is None else agent.goal} {agent.turn}")
            if agent.turn:
                _, heading, to, k = agent.start if len(agent.start) == 4 else (*agent.start, agent.start[1], 0)
                lines.append(f"looks {heading} {to} {k} {agent.goal_heading or '-'}")
            if agent.goals:
                lines.append(" ".join(map(str, ["goals", *agent.goals])))
            if agent.working:
                lines.append("working {} {}".format(*agent.working))
        for number, (place, duration, agents) in enumerate(self.tasks):
            lines.append(" ".join(map(str, ["task", place, duration, *agents])))
            lines += [f"need {self.needs[number]}"] if number in self.needs else []
        value = 0xcbf29ce484222325
        for byte in "".join(line + "\n" for line in lines).encode():
            value = (value ^ byte) * 0x100000001b3 % 2**64
        return f"{value:016x}"

    def write(self, folder, name="tiny"):
        """Writes the files of the instance and returns the path of the instance file."""
        world = self.world
        if world.rows is not None:
            (folder / f"{name}.map").write_text(f"type octile\nheight {world.height}\nwidth {world.width}\nmap\n"
                                                + "\n".join(world.rows) + "\n")
            text, cell = {"map": f"{name}.map"}, lambda place: [place % world.width, place // world.width]
        else:
            roads = [{"from": f"v{a}", "to": f"v{b}", "steps": d, "one_way": one} for a, b, d, one in world.roads]
            vertices = [{"id": f"v{number}", "at": [number, 0]} for number in range(world.vertices)]
            (folder / f"{name}.roadmap.json").write_text(json.dumps({"vertices": vertices, "edges": roads}))
            text, cell = {"roadmap": f"{name}.roadmap.json"}, self.named
        agents = []
        for number, agent in enumerate(self.agents):
            one = {"id": f"a{number}", "start": cell(agent.start[0])}
            if agent.goal is not None:
                one["goal"] = cell(agent.goal)
            if agent.goals:
                one["goals"] = [cell(goal) for goal in agent.goals]
            if agent.turn:
                one |= {"motion": "turning", "turn_steps": agent.turn, "heading": agent.start[1],
                        "start": [*one["start"], *agent.start[1:]]}
                one |= {"goal_heading": agent.goal_heading} if agent.goal_heading else {}
            if agent.working:
                one["working"] = {"task": f"t{agent.working[0]}", "done": agent.working[1]}
            agents.append(one)
        tasks = [{"id": f"t{number}", "cell": cell(place), "agents": [f"a{a}" for a in own], "duration": duration}
                 for number, (place, duration, own) in enumerate(self.tasks)]
        for number, need in self.needs.items():
            tasks[number]["need"] = need
        path = folder / f"{name}.cts.json"
        path.write_text(json.dumps(text | {"agents": agents, "tasks": tasks}))
        return path

    def named(self, place):
        first = self.world.vertices
        for number, (start, end, steps, _) in enumerate(self.world.roads):
            if place >= self.world.vertices and first <= place < first + steps - 1:
                return [f"v{start}", f"v{end}", place - first + 1, number]
            first += steps - 1
        return f"v{place}"


def initial(instance, agent, ordered):
    """Returns the states (pose, done, (task, steps left) or None) at time 0."""
    one = instance.agents[agent]
    work = (one.working[0], instance.tasks[one.working[0]][1] - one.working[1]) if one.working else None
    return [*arrivals(instance, agent, (one.start, (), None), ordered)] if work is None else [(one.start, (), work)]


def arrivals(instance, agent, state, ordered):
    """Yields the states that the agent can choose when it reaches `state`: the execution of a task can start, and stops
    without duration count as visited. If `ordered`, each state visits at most one of them."""
    pose, done, _ = state
    here = [j for j in instance.stops(agent) if instance.tasks[j][0] == pose[0] and j not in done]
    quick = [j for j in here if instance.tasks[j][1] == 0]
    if quick and not ordered:
        done = tuple(sorted(done + tuple(quick)))
    yield pose, done, None
    for j in here:
        if instance.tasks[j][1] > 0:
            yield pose, done, (j, instance.tasks[j][1])
        elif ordered:
            yield pose, done + (j,), None


@functools.lru_cache(1 << 16)
def onwards(instance, agent, state, ordered):
    """Returns the states that are possible one step later."""
    pose, done, work = state
    if work:
        task, left = work
        if left > 1:
            return {(pose, done, (task, left - 1))}
        done = done + (task,) if ordered else tuple(sorted(done + (task,)))
        return set(arrivals(instance, agent, (pose, done, None), ordered))
    poses = [pose, *instance.steps(agent, pose)]
    return {state for next_ in poses for state in arrivals(instance, agent, (next_, done, None), ordered)}


def finished(instance, agent, state, ordered):
    pose, done, work = state
    return work is None and len(done) == len(instance.stops(agent)) and instance.ends(
        agent, pose, done[-1] if ordered and done else None)


def least_cost(instance, agent, constraints, latest=400):
    """Returns (c(A, D), a path as one place per time), or (inf, None) if there is no path. A constraint is a tuple
    as in a certificate, but without the agent. Raises AssertionError after `latest` steps."""
    ordered = any(d[0] in ("stop", "nostop") for d in constraints)
    world = instance.world
    constant_from = 1 + max([t for d in constraints for t in d[1:] if d[0] not in ("stop", "nostop") and t != INF],
                            default=0)
    passes = [(world.chain(d[1]), d) for d in constraints if d[0] == "pass"]

    def allowed(done):
        number = len(done) - 1
        return all((done[number] == j) == (kind == "stop")
                   for kind, k, j in (d for d in constraints if d[0] in ("stop", "nostop"))
                   if k == number)

    def free(place, time):
        return not any(d[0] == "bar" and d[1] == place and d[2] <= time <= d[3] for d in constraints)

    def after(node, state, time):
        """Returns the node at `time` after `node`, with the time of arrival and the entries into chains, or None if
        a constraint forbids the step."""
        (before, _, _), arrived, entries = node
        place = state[0][0]
        if place == before[0]:
            return state, arrived, entries
        if any(d[0] == "move" and d[1:3] == (before[0], place) and d[3] <= time <= d[4] for d in constraints):
            return None
        for chain, (_, f, p, start, end) in passes:
            if (before[0], place) == (f, p) and start <= time <= end and (chain, f, p) in {
                    (c, *through(c, entry)) for c, entry in entries}:
                return None
        now = set()
        for chain in {chain for chain, _ in passes}:
            if place in chain[1:-1]:
                is_inside = before[0] in chain[1:-1]
                now |= {e for e in entries if e[0] == chain} if is_inside else {(chain, (before[0], place))}
        return state, min(time, constant_from), frozenset(now)

    def rests(node, time):
        (pose, _, _), arrived, _ = node
        for d in constraints:
            if d[0] == "bar" and d[1] == pose[0] and d[3] > time or (
                    d[0] == "norest" and d[1] == pose[0] and arrived <= d[2]) or (
                    d[0] == "rest" and not (d[1] == pose[0] and arrived <= d[2])):
                return False
        return True

    nodes = {(state, 0, frozenset()): None for state in initial(instance, agent, ordered)
             if free(state[0][0], 0) and (not state[1] or not ordered or allowed(state[1]))}
    layers, seen = [nodes], set()
    for time in range(latest):
        for node in layers[-1]:
            if finished(instance, agent, node[0], ordered) and rests(node, time):
                path = []
                for layer in reversed(layers):
                    path.append(node[0][0][0])
                    node = layer[node]
                return time, path[::-1]
        following = {}
        for node in layers[-1]:
            for state in onwards(instance, agent, node[0], ordered):
                legal = free(state[0][0], time + 1) and (not ordered or state[1] == node[0][1] or allowed(state[1]))
                found = after(node, state, time + 1) if legal else None
                if found:
                    following.setdefault(found, node)
        if time > constant_from:
            new = following.keys() - seen
            if not new:
                return INF, None
            seen |= new
        layers.append(following)
    raise AssertionError("longer than expected")


def through(chain, entry):
    """Returns the step by which an agent that entered a chain by `entry` leaves it after traversing it."""
    start, first = entry
    row = list(chain)
    if len(row) == 3:
        return row[1], next(end for end in (row[0], row[2]) if end != start)
    return (row[-2], row[-1]) if first == row[1] else (row[1], row[0])


def collide(befores, afters, following):
    """Returns whether agents collide in the step from the places `befores` to the places `afters`."""
    for one, two in itertools.combinations(range(len(afters)), 2):
        p, q, u, v = befores[one], befores[two], afters[one], afters[two]
        if u == v or (u == q and v == p) or (not following and ((u == q and v != q) or (v == p and u != p))):
            return True
    return False


def optimum(instance, following=True, most=4000):
    """Returns the least cost of a valid plan, or inf if there is none, by Dijkstra's algorithm over joint states.
    Returns None after `most` states."""
    agents = range(len(instance.agents))
    starts = list(itertools.product(*(initial(instance, agent, False) for agent in agents)))
    waiting = [(0, number, start) for number, start in enumerate(starts)]
    known, tie = {start: 0 for start in starts}, itertools.count(len(starts))
    heapq.heapify(waiting)
    while waiting:
        cost, _, states = heapq.heappop(waiting)
        if cost > known[states]:
            continue
        most -= 1
        if most < 0:
            return None
        if all(state[0] == "rests" for state in states):
            return cost
        choices = []
        for agent, state in zip(agents, states):
            if state[0] == "rests":
                choices.append([(state, state[1], 0)])
                continue
            choice = [(next_, next_[0][0], 1) for next_ in onwards(instance, agent, state, False)]
            if finished(instance, agent, state, False):
                choice.append((("rests", state[0][0]), state[0][0], 0))
            choices.append(choice)
        befores = [state[1] if state[0] == "rests" else state[0][0] for state in states]
        for choice in itertools.product(*choices):
            if not collide(befores, [c[1] for c in choice], following):
                after, more = tuple(c[0] for c in choice), cost + sum(c[2] for c in choice)
                if more < known.get(after, INF):
                    known[after] = more
                    heapq.heappush(waiting, (more, next(tie), after))
    return INF


def random_instance(rng, kind):
    """Returns a random instance of kind plain, cts, mg, turning, work or roads. Each agent has a path, and their
    least costs sum to at most 16."""
    while True:
        if kind == "roads":
            vertices = rng.randint(3, 4)
            roads = [(a, b, rng.randint(1, 3), rng.random() < 0.3)
                     for a, b in itertools.combinations(range(vertices), 2) if rng.random() < 0.7]
            world = World(vertices=vertices,
                          roads=[(b, a, d, one) if rng.random() < 0.5 else (a, b, d, one) for a, b, d, one in roads])
        else:
            size = rng.choice([(3, 3), (4, 3), (5, 2), (4, 2), (6, 1)])
            world = World(["".join("@" if rng.random() < 0.25 else "." for _ in range(size[0]))
                           for _ in range(size[1])])
        cells = [place for place in range(world.count) if world.near[place]]
        count = rng.choice([2, 2, 3])
        if len(cells) < count + 1:
            continue
        starts, agents = rng.sample(cells, count), []
        ends = [c for c in cells if kind != "roads" or c < world.vertices]
        goals = rng.sample(ends, min(count, len(ends))) + [None] * count
        for number in range(count):
            goal = goals[number]
            if kind == "mg" or (kind != "plain" and rng.random() < 0.2):
                goal = None
            turn = rng.choice([1, 1, 2]) if kind == "turning" or (kind == "work" and rng.random() < 0.3) else 0
            start = (starts[number],) + ((rng.choice(HEADINGS),) if turn else ())
            if turn == 2 and rng.random() < 0.3:
                start += (HEADINGS[(HEADINGS.index(start[1]) + rng.choice([1, 3])) % 4], 1)
            agents.append(Agent(start, goal, turn,
                                rng.choice(HEADINGS) if turn and goal is not None and rng.random() < 0.5 else None))
        tasks, task_cells = [], [c for c in cells if kind != "roads" or c < world.vertices]
        for _ in range(0 if kind == "plain" else rng.randint(1, 4)):
            duration = rng.randint(1, 3) if kind == "work" and rng.random() < 0.6 else 0
            tasks.append((rng.choice(task_cells), duration, sorted(rng.sample(range(count), rng.choice([1, 1, 2])))))
        instance = Instance(world, agents, tasks)
        if kind == "work":
            for number, agent in enumerate(agents):
                timed = [j for j in instance.own(number) if tasks[j][1] > 0]
                if timed and rng.random() < 0.3 and tasks[timed[0]][0] not in starts:
                    agent.start = (tasks[timed[0]][0], *agent.start[1:])
                    starts[number] = agent.start[0]
                    agent.working = (timed[0], rng.randrange(tasks[timed[0]][1]))
        if sum(least_cost(instance, number, [])[0] for number in range(count)) <= 16:
            return instance
