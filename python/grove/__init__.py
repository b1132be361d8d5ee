# SPDX-License-Identifier: MIT
"""Plans collision-free paths for many robots, with a proven bound on the distance from the optimum.

>>> import grove
>>> world = grove.World('''
... ......
... .@@.@.
... ......''')
>>> instance = grove.Instance(
...     world,
...     agents=[{"id": "red", "start": (0, 0), "goal": (5, 2)},
...             {"id": "blue", "start": (5, 0), "goal": (0, 2)}],
...     tasks=[{"id": "press", "cell": (3, 1), "agents": ["red", "blue"]}])
>>> solution = grove.solve(instance, threads=1)
>>> solution
<grove.Solution: optimal, cost 14, lower bound 14>
>>> solution.plan.positions()[0, :4].tolist()       # agent red: (x, y) at times 0, 1, 2, 3
[[0, 0], [1, 0], [2, 0], [3, 0]]

Times in plans are in steps, run times in seconds. Errors are subclasses of grove.Error: InputError for files,
agents and tasks, InvalidArgument for other values. See docs/python.md.
"""

from __future__ import annotations

import html as _html
import operator as _operator
import os as _os

from grove import _grove
from grove._grove import (
    AgentPlan,
    Error,
    InputError,
    Instance,
    InvalidArgument,
    Plan,
    Progress,
    Solution,
    World,
    __version__,
    default_memory_limit,
    default_threads,
    fix_choices,
    read_instance,
    read_plan,
    read_scenario,
)

__all__ = [
    "AgentPlan", "Error", "InputError", "Instance", "InvalidArgument", "Plan", "Progress", "Session",
    "Solution", "View", "World", "__version__", "check", "data_frame", "default_memory_limit",
    "default_threads", "fix_choices", "instance_from_arrays", "instance_from_dict", "picture", "read_instance",
    "read_plan", "read_scenario", "solve", "view", "visits",
]


def _plain(value):
    """Converts NumPy arrays and scalars to plain Python values for json."""
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{value!r} is a {type(value).__name__}; expected numbers, texts, lists or dicts")


def _invalid(field, value, expected):
    shape = getattr(value, "shape", None)
    found = f"an array of {value.dtype} of shape {shape}" if shape is not None else repr(value)
    error = InvalidArgument(f"/{field}: found {found}; expected {expected}")
    error.field = f"/{field}"
    return error


def _rows(field, value, expected):
    """Returns the elements of a list or an array. Raises InvalidArgument for any other value."""
    if isinstance(value, (str, bytes, dict)) or not hasattr(value, "__iter__"):
        raise _invalid(field, value, expected)
    try:
        return list(value)
    except TypeError:  # an array without dimensions
        raise _invalid(field, value, expected) from None


def _cells(field, value):
    """Returns the cells of a list or an array as tuples (x, y) of int. Raises InvalidArgument for invalid cells."""
    rows = _rows(field, value, "a list or an array of cells (x, y)")
    cells = []
    for i, row in enumerate(rows):
        expected = "a cell (x, y), two whole numbers"
        parts = _rows(f"{field}/{i}", row, expected)
        try:
            x, y = (_operator.index(part) for part in parts)
        except (TypeError, ValueError):
            raise _invalid(f"{field}/{i}", row, expected) from None
        cells.append((x, y))
    return cells


# --- Instances ---

def instance_from_dict(data, folder=".", *, following=True):
    """Makes an instance from a dict in the format of a *.cts.json file.

    data: its "map" is a World, a list of rows, or a file name; or its "roadmap" is a World or a file name.
    folder: the directory to which file names are relative.
    following: whether a robot may enter a place in the step in which another leaves it.
    """
    rest = {key: value for key, value in data.items() if key not in ("map", "roadmap")}
    worlds = [data[key] for key in ("map", "roadmap") if key in data]
    if len(worlds) != 1:
        raise InvalidArgument("expected 'map' or 'roadmap', and not both")
    world = worlds[0]
    if isinstance(world, (str, _os.PathLike)):
        world = World.read(_os.path.join(folder, world))
    elif not isinstance(world, World):
        world = World(world)
    return _grove._instance_of_dict(world, {"tasks": [], **rest}, following)


def instance_from_arrays(world, starts, goals=None, tasks=None, *, following=True):
    """Makes an instance on a grid from arrays of cells (x, y).

    starts, goals: one row (x, y) per agent. Without goals, each agent ends on any one of its tasks.
    tasks: for each agent, the cells that it must visit. A cell of several agents is one task for all of them.
    following: whether a robot may enter a place in the step in which another leaves it.

    The agents have the ids a0, a1, ..., and the tasks the ids t0, t1, ....

    >>> instance_from_arrays(World("....\\n...."), starts=[(0, 0), (3, 0)], tasks=[[(3, 1)], [(0, 1)]])
    <grove.Instance: 2 agents, 2 tasks>
    """
    starts = _cells("starts", starts)
    goals = None if goals is None else _cells("goals", goals)
    if tasks is not None:
        tasks = [_cells(f"tasks/{i}", cells)
                 for i, cells in enumerate(_rows("tasks", tasks, "a list of cells for each agent"))]
    count = len(starts)
    for name, rows in (("goals", goals), ("tasks", tasks)):
        if rows is not None and len(rows) != count:
            raise InvalidArgument(f"{len(rows)} {name} for {count} starts; expected as many")
    agents = [{"id": f"a{i}", "start": start} for i, start in enumerate(starts)]
    for agent, goal in zip(agents, goals if goals is not None else []):
        agent["goal"] = goal
    visitors = {}
    for agent, cells in zip(agents, tasks if tasks is not None else []):
        for cell in cells:
            ids = visitors.setdefault(cell, [])
            if agent["id"] not in ids:
                ids.append(agent["id"])
    all_tasks = [{"id": f"t{i}", "cell": cell, "agents": ids}
                 for i, (cell, ids) in enumerate(visitors.items())]
    return Instance(world, agents, all_tasks, following=following)


# --- Solving ---

def solve(instance, *, omega=_grove._omega, time_limit=_grove._time_limit, memory_limit="auto",
          threads="auto", deterministic=False, seed=0, method="auto", start=None, progress=None,
          incumbent=None, progress_interval=0.1, stop=None):
    """Finds a plan and proves a lower bound on the cost of every plan.

    omega: relative tolerance: the search ends when its plan costs at most 1 + omega times the lower bound; 0: optimal.
    time_limit: seconds; None: no limit. When it is reached, solve() returns the best plan so far.
    memory_limit: bytes of this process; "auto": default_memory_limit(); None: no limit. It also ends the search.
    threads: number of search threads; "auto": default_threads().
    deterministic: finds the same plan for any number of threads, unless a limit is reached.
    seed: seed of all random choices.
    method: "auto", or a published method for comparison (`grove solve --help` lists them).
    start: a valid plan of the instance, from which the search starts.
    progress: called with a Progress about every `progress_interval` seconds, and at the end.
    incumbent: called with each better Plan and a Progress.
    stop: a threading.Event; setting it ends the search in the same way as a limit.

    Returns a Solution; its texts["stopped_by"] names the limit that ended the search, if any. Raises InvalidArgument
    for options that are invalid or do not suit the instance. If a callback raises an exception, the search ends and
    solve() raises this exception. Ctrl-C raises KeyboardInterrupt. Other Python threads run during the search.
    """
    return _grove._solve(instance, {
        "omega": omega, "time_limit": time_limit, "memory_limit": memory_limit, "threads": threads,
        "deterministic": deterministic, "seed": seed, "method": method, "start": start,
        "progress": progress, "incumbent": incumbent, "progress_interval": progress_interval,
        "stop": stop, "visit_weight": 0})


def check(plan, limit=20):
    """Checks a Plan, or a Solution and its claims; returns the violations as (place in the plan file, message).

    If the list is empty, the plan is valid. It has at most `limit` violations. The checker has its own code for
    paths, visits, costs and conflicts.

    >>> world = World("...")
    >>> swapping = instance_from_arrays(world, [(0, 0), (1, 0)], goals=[(1, 0), (0, 0)])
    >>> check(Plan(swapping, [[(0, 0), (1, 0)], [(1, 0), (0, 0)]]))
    [('/agents/0/path/1', "agents 'a0' and 'a1' swap [0, 0] and [1, 0] between times 0 and 1")]
    """
    if isinstance(plan, Solution):
        return _grove._check_solution(plan, limit)
    return _grove._check_plan(plan, limit)


class Session:
    """An instance and its plan, updated when time passes, robots are late, or the instance changes.

    Session(plan) starts with a Plan, Session(instance) without a plan. One thread at a time.
    """

    def __init__(self, plan):
        self._session = _grove._Session(plan)

    @property
    def instance(self):
        """The remaining instance; its time 0 is now."""
        return self._session.instance()

    @property
    def plan(self):
        """A valid plan of the current instance; None if there is none yet, or if a change made it invalid."""
        return self._session.plan()

    def advance(self, steps, late=None):
        """Advances the session by `steps` steps along its plan; times then count from 0 again.

        late: robots that are now behind the plan, in steps: {"red": 2}. Robots that must wait for them are also late.

        Raises InvalidArgument without a plan, if steps < 0, or if a delay is impossible; the session is then unchanged.
        """
        self._session.advance(steps, dict(late or {}))

    def change(self, new_tasks=(), dropped_tasks=(), blocked=()):
        """Changes the instance; the next replan() repairs the plan.

        new_tasks: tasks as in an instance.
        dropped_tasks: ids of tasks that no robot has to visit any more.
        blocked: cells to block, or vertices to block with all their roads.

        Raises InvalidArgument if the change is impossible, and InputError for malformed tasks; the session is then
        unchanged.
        """
        self._session.change(list(new_tasks), list(dropped_tasks), list(blocked))

    def replan(self, *, commit=0, omega=_grove._omega, time_limit=_grove._replan_time_limit,
               memory_limit="auto", threads="auto", deterministic=False, seed=0, method="auto",
               progress=None, incumbent=None, progress_interval=0.1, stop=None, visit_weight=0):
        """Solves the current instance, starting from the repaired old plan; returns a Solution.

        commit: number of steps of the old plan with which the new plan begins; robots execute them during the search.

        visit_weight: for tasks that only some of their robots must visit: weight, from 0 to 100, of the times of these
        visits against the cost, when the session chooses the robots. 10: tasks are visited early.

        The other arguments are those of solve(). After Ctrl-C the session has the best plan so far.
        """
        return self._session.replan(commit, {
            "omega": omega, "time_limit": time_limit, "memory_limit": memory_limit,
            "threads": threads, "deterministic": deterministic, "seed": seed, "method": method,
            "start": None, "progress": progress, "incumbent": incumbent,
            "progress_interval": progress_interval, "stop": stop, "visit_weight": visit_weight})


# --- Displaying plans ---

def visits(plan):
    """Lists all visits as (agent, task, begin, end), in steps; end equals begin for a task without a duration."""
    cells = {task["id"]: task["cell"] for task in plan.instance.tasks}
    cells = {task: cell if isinstance(cell, str) else tuple(cell) for task, cell in cells.items()}
    rows = []
    for agent in plan.agents:
        working = {task: (begin, end) for task, begin, end in agent.work}
        path, time = agent.path, 0
        for task in agent.tasks:
            if task in working:
                begin, end = working[task]
            else:
                begin = end = next((t for t in range(time, len(path)) if path[t] == cells[task]), time)
            rows.append((agent.id, task, begin, end))
            time = end
    return rows


def data_frame(plan):
    """Returns a pandas.DataFrame with a row for each agent and time: agent, time, x, y, and heading if agents turn."""
    import pandas

    positions = plan.positions()
    agents, times = positions.shape[:2]
    columns = {
        "agent": [agent.id for agent in plan.agents for _ in range(times)],
        "time": list(range(times)) * agents,
        "x": positions[:, :, 0].reshape(-1),
        "y": positions[:, :, 1].reshape(-1),
    }
    headings = plan.headings()
    if (headings >= 0).any():
        names = {-1: None, 0: "north", 1: "east", 2: "south", 3: "west"}
        columns["heading"] = [names[int(h)] for h in headings.reshape(-1)]
    return pandas.DataFrame(columns)


class View:
    """An HTML page that plays plans. Notebooks show it; save() writes it to a file.

    html: the text of the page.
    height: height in a notebook, pixels.
    """

    def __init__(self, html, height):
        self.html = html
        self.height = height

    def save(self, path):
        """Writes the page atomically, as one file that needs no other files."""
        _grove._write_file(path, self.html.encode())

    def _repr_html_(self):
        return (f'<iframe srcdoc="{_html.escape(self.html)}" width="100%" height="{self.height}" '
                'style="border:0"></iframe>')

    def __repr__(self):
        return f"<grove.View: {len(self.html) // 1000} kB; save(path) writes it>"


def view(*plans, title="plan", height=600):
    """Returns a View that plays a Plan or Solution, or two of them for one instance side by side.

    The View of an Instance shows its start. A notebook shows the View if it is the last value of a cell.
    """
    if not 1 <= len(plans) <= 2:
        raise InvalidArgument(f"{len(plans)} plans; expected one or two")
    wrong = [plan for plan in plans[isinstance(plans[0], Instance):] if not isinstance(plan, (Plan, Solution))]
    if wrong or (isinstance(plans[0], Instance) and len(plans) > 1):
        raise InvalidArgument(f"found {', '.join(type(plan).__name__ for plan in plans)}; expected one or two "
                              "of Plan and Solution, or a single Instance")
    if isinstance(plans[0], Instance):
        return View(_grove._page(plans[0], title, []), height)
    solutions = [(f"plan {i + 1}" if len(plans) > 1 else title, plan) for i, plan in enumerate(plans)]
    return View(_grove._page(plans[0].instance, title, solutions), height)


def picture(plan, path, *, at=(0,), width=800, speed=4.0):
    """Writes a picture of a Plan, Solution or Instance.

    path: *.svg, *.png or *.gif.
    at: times that an .svg or .png shows, in steps. A .gif shows all times.
    width: width of the picture, pixels.
    speed: speed of a .gif, steps per second.
    """
    kind = _os.path.splitext(_os.fspath(path))[1][1:].lower()
    if kind not in ("svg", "png", "gif"):
        raise InvalidArgument(f"{path}: expected a name that ends in .svg, .png or .gif")
    if isinstance(plan, Instance):
        instance, shown = plan, None
    else:
        instance, shown = plan.instance, plan.plan if isinstance(plan, Solution) else plan
    _grove._write_file(path, _grove._picture(instance, shown, kind, list(at), width, speed))
