#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests the public Python module.

    python_test.py SOURCE_DIR PACKAGE_DIR [GROVE]

Exits with code 77 (skipped) if numpy or pandas is not installed; only the tests need them.
"""
import contextlib
import doctest
import importlib.util
import inspect
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

SOURCE, PACKAGE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
GROVE = Path(sys.argv[3]).resolve() if len(sys.argv) > 3 else None
sys.path.insert(0, str(PACKAGE))
import grove  # noqa: E402

ROWS = [".....", ".@.@.", "....."]


def small():
    return grove.Instance(
        grove.World(ROWS),
        [{"id": "red", "start": (0, 0), "goal": (4, 2)}, {"id": "blue", "start": (4, 0), "goal": (0, 2)}],
        [{"id": "press", "cell": (2, 1), "agents": ["red", "blue"], "duration": 3},
         {"id": "look", "cell": (2, 0), "agents": ["red"]}])


def hard_instance(robots=14):
    """Returns an instance in which robots have to pass each other in a corridor, which takes hours of search."""
    return grove.instance_from_arrays(grove.World(["." * robots] * 2), [(i, 0) for i in range(robots)],
                                      [(robots - 1 - i, 1) for i in range(robots)])


class Documents(unittest.TestCase):
    def test_examples_in_docstrings_are_correct(self):
        self.assertEqual(doctest.testmod(grove).failed, 0)

    def test_examples_in_the_guide_are_correct(self):
        done = doctest.testfile(str(SOURCE / "docs/python.md"), module_relative=False,
                                optionflags=doctest.NORMALIZE_WHITESPACE)
        self.assertGreater(done.attempted, 15)
        self.assertEqual(done.failed, 0)

    def test_api_page_is_up_to_date(self):
        done = subprocess.run([sys.executable, SOURCE / "python/api_page.py", PACKAGE], capture_output=True, text=True,
                              timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        if done.stdout != (SOURCE / "docs/python-api.md").read_text():
            self.fail(f"docs/python-api.md is out of date; run python/api_page.py {PACKAGE} > docs/python-api.md")

    def test_example_is_short_and_runs(self):
        example = SOURCE / "examples/python/warehouse.py"
        self.assertLessEqual(len(example.read_text().splitlines()), 25)
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, example], cwd=folder, capture_output=True, text=True,
                                  env={**os.environ, "PYTHONPATH": str(PACKAGE)}, timeout=120)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("lower bound", done.stdout)
            self.assertTrue((Path(folder) / "warehouse.gif").read_bytes().startswith(b"GIF89a"))
            self.assertIn("<html", (Path(folder) / "warehouse.html").read_text())

    @unittest.skipUnless(importlib.util.find_spec("mypy"), "no mypy")
    def test_stubs_agree_with_the_module(self):
        with tempfile.TemporaryDirectory() as folder:
            # Compiled classes have a metaclass that stubs cannot express.
            allowed = Path(folder) / "allowed"
            allowed.write_text("grove\\.(AgentPlan|Instance|Plan|Progress|Solution|World)(\\.__init__)?\n")
            done = subprocess.run(
                [sys.executable, "-m", "mypy.stubtest", "grove", "--allowlist", allowed,
                 "--ignore-missing-stub"], cwd=folder, capture_output=True, text=True,
                env={**os.environ, "MYPYPATH": str(PACKAGE), "PYTHONPATH": str(PACKAGE)}, timeout=300)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


class Packaging(unittest.TestCase):
    @unittest.skipUnless(importlib.util.find_spec("tomllib"), "no tomllib")
    def test_pyproject_agrees_with_cmake(self):
        import tomllib
        project = tomllib.loads((SOURCE / "pyproject.toml").read_text())
        ours = project["tool"]["scikit-build"]
        version = ours["metadata"]["version"]
        found = re.search(version["regex"], (SOURCE / version["input"]).read_text())
        self.assertEqual(found.group("value"), grove.__version__)
        cmake = "".join(path.read_text() for path in [SOURCE / "CMakeLists.txt", SOURCE / "python/CMakeLists.txt",
                                                      *(SOURCE / "cmake").glob("*.cmake")])
        for option in ours["cmake"]["define"]:
            self.assertTrue(re.search(rf"(option|set)\({option}\b", cmake), option)
        for target in ours["build"]["targets"]:
            self.assertIn(f"module({target} ", cmake)
        for component in ours["install"]["components"]:
            self.assertIn(f"COMPONENT {component}\n", cmake)
        self.assertTrue((SOURCE / project["project"]["readme"]).exists())


class Instances(unittest.TestCase):
    def test_instance_keeps_its_agents_and_tasks(self):
        instance = small()
        again = grove.Instance(instance.world, instance.agents, instance.tasks)
        self.assertEqual(again.agents, instance.agents)
        self.assertEqual(again.tasks[0], {"id": "press", "cell": [2, 1], "agents": ["red", "blue"],
                                          "duration": 3})

    def test_files_are_read_back_unchanged(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "x.cts.json"
            small().write(path)
            self.assertEqual(grove.read_instance(path).agents, small().agents)
            data = json.loads(path.read_text())
            self.assertEqual(grove.instance_from_dict({**data, "$schema": "x"}, folder).tasks, small().tasks)
            solution = grove.solve(small())
            solution.write(str(path) + ".plan")
            back = grove.read_plan(str(path) + ".plan", small())
            self.assertEqual((back.status, back.plan.cost), ("optimal", solution.plan.cost))

    def test_instances_and_plans_convert_to_arrays(self):
        import numpy
        passable = numpy.array([[c == "." for c in row] for row in ROWS])
        world = grove.World.grid(passable)
        self.assertTrue((world.passable == passable).all())
        self.assertTrue((grove.World.grid(passable.T).passable == passable.T).all())  # a non-contiguous array
        starts = numpy.array([[0, 0], [4, 0]])
        instance = grove.instance_from_arrays(world, starts, starts[::-1],
                                              [numpy.array([[2, 1]]), numpy.zeros((0, 2), int)])
        solution = grove.solve(instance)
        positions = solution.plan.positions()
        self.assertEqual(positions.shape, (2, solution.plan.makespan + 1, 2))
        self.assertTrue((positions[:, 0] == starts).all())
        self.assertTrue((positions[:, -1] == starts[::-1]).all())
        self.assertLessEqual(abs(numpy.diff(positions, axis=1)).sum(axis=2).max(), 1)
        again = grove.Plan(instance, positions)
        self.assertEqual(again.cost, solution.plan.cost)
        self.assertEqual(grove.check(again), [])
        self.assertNotEqual(grove.check(grove.Plan(instance, positions[:, ::-1])), [])

    def test_roadmap_instance_is_solved(self):
        world = grove.World.roadmap({"A": (0, 0), "B": (6, 0), "C": (6, 3)},
                                    [("A", "B", 3), ("B", "C", 1, True)])
        instance = grove.Instance(world, [{"id": "r", "start": "A", "goal": "C"}])
        plan = grove.solve(instance).plan
        self.assertEqual(plan.agents[0].path, ["A", ("A", "B", 1), ("A", "B", 2), "B", "C"])
        self.assertEqual(plan.positions()[0].tolist(), [[0, 0], [2, 0], [4, 0], [6, 0], [6, 3]])
        self.assertEqual(world.roads[1], ("B", "C", 1, True))
        self.assertEqual(grove.check(grove.Plan(instance, [plan.agents[0].path])), [])

    def test_turning_robot_has_headings(self):
        instance = grove.Instance(grove.World(["...", "..."]), [
            {"id": "r", "start": (0, 0), "goal": (0, 1), "motion": "turning", "heading": "E"}])
        plan = grove.solve(instance).plan
        self.assertEqual(plan.headings().tolist(), [[1, 2, 2]])
        self.assertEqual(list(grove.data_frame(plan)["heading"]), ["east", "south", "south"])

    def test_following_decides_whether_a_ring_can_rotate(self):
        ring = [(0, 0), (1, 0), (1, 1), (0, 1)]
        for following, expected in ((True, ["optimal"]), (False, ["unknown", "infeasible"])):
            instance = grove.instance_from_arrays(grove.World(["..", ".."]), ring, ring[1:] + ring[:1],
                                                  following=following)
            self.assertEqual(instance.following, following)
            self.assertIn(grove.solve(instance, time_limit=60 if following else 0.2).status, expected)


class Solving(unittest.TestCase):
    def test_progress_and_incumbents_are_reported(self):
        seen, plans = [], []
        solution = grove.solve(small(), progress=seen.append, progress_interval=0,
                               incumbent=lambda plan, at: plans.append((plan.cost, at.cost)))
        self.assertEqual(seen[-1].lower_bound, solution.lower_bound)
        self.assertEqual(plans[-1], (solution.plan.cost, solution.plan.cost))

    def test_time_limit_is_reported(self):
        solution = grove.solve(hard_instance(), time_limit=0.1)
        self.assertIn(solution.status, ("feasible", "unknown"))
        self.assertEqual(solution.texts["stopped_by"], "time limit")

    def test_exception_of_a_callback_propagates(self):
        with self.assertRaises(ZeroDivisionError):
            grove.solve(hard_instance(), time_limit=60, progress=lambda progress: 1 / 0)

    def test_ctrl_c_raises_keyboard_interrupt(self):
        begun = threading.Event()

        def interrupt():
            begun.wait()
            os.kill(os.getpid(), signal.SIGINT)

        interrupter = threading.Thread(target=interrupt)
        interrupter.start()
        with self.assertRaises(KeyboardInterrupt):
            grove.solve(hard_instance(), time_limit=300, progress=lambda _: begun.set(), progress_interval=1e6)
        interrupter.join()

    def test_stop_event_ends_a_solve_and_other_threads_run(self):
        begun, stop = threading.Event(), threading.Event()

        def request_stop():
            begun.wait()
            sum(range(1_000_000))  # this thread runs while the solve does
            stop.set()

        requester = threading.Thread(target=request_stop)
        requester.start()
        solution = grove.solve(hard_instance(), time_limit=300, stop=stop, progress=lambda _: begun.set(),
                               progress_interval=1e6)
        requester.join()
        self.assertEqual(solution.texts["stopped_by"], "interrupt")

    def test_concurrent_solves_give_the_same_cost(self):
        expected = grove.solve(small()).plan.cost
        costs = []
        threads = [threading.Thread(target=lambda: costs.append(grove.solve(small()).plan.cost))
                   for _ in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(costs, [expected] * 6)

    def test_infeasible_status_and_start_plan(self):
        walled = grove.instance_from_arrays(grove.World([".@."]), [(0, 0)], [(2, 0)])
        self.assertEqual(grove.solve(walled).status, "infeasible")
        plan = grove.solve(small()).plan
        first = []
        grove.solve(small(), start=plan, incumbent=lambda p, at: first.append(p.cost))
        self.assertEqual(first[:1], [plan.cost])

    def with_choices(self):
        """Returns an instance in which one of two robots must look, and red may end on either of two cells."""
        return grove.Instance(
            grove.World(ROWS),
            [{"id": "red", "start": (0, 0), "goals": [(2, 0), (4, 2)]}, {"id": "blue", "start": (4, 0)}],
            [{"id": "look", "cell": (1, 0), "agents": "*", "need": 1},
             {"id": "push", "cell": (2, 0), "agents": ["blue", "red"], "duration": 2, "need": 1}])

    def test_choices_are_read_and_written(self):
        instance = self.with_choices()
        self.assertTrue(instance.has_choices)
        self.assertFalse(small().has_choices)
        self.assertEqual(instance.agents[0]["goals"], [[2, 0], [4, 2]])
        self.assertEqual((instance.tasks[0]["agents"], instance.tasks[0]["need"]), ("*", 1))
        self.assertEqual(instance.tasks[1]["need"], 1)
        again = grove.Instance(instance.world, instance.agents, instance.tasks)
        self.assertEqual((again.agents, again.tasks), (instance.agents, instance.tasks))
        with tempfile.TemporaryDirectory() as folder:
            instance.write(Path(folder) / "x.cts.json")
            read = grove.read_instance(Path(folder) / "x.cts.json")
            self.assertEqual((read.agents, read.tasks), (instance.agents, instance.tasks))
        with self.assertRaisesRegex(grove.InputError, "/agents/0/goals/1: cell .1, 1. is blocked"):
            grove.Instance(grove.World(ROWS), [{"id": "a", "start": (0, 0), "goals": [(0, 0), (1, 1)]}])
        with self.assertRaisesRegex(grove.InputError, "/tasks/0/need: found 2; expected an integer from 1 to 1"):
            grove.Instance(grove.World(ROWS), [{"id": "a", "start": (0, 0)}],
                           [{"id": "t", "cell": (0, 0), "agents": "*", "need": 2}])

    def test_plans_tell_visits(self):
        instance = self.with_choices()
        paths = [[(0, 0), (1, 0), (2, 0)], [(4, 0)]]
        plan = grove.Plan(instance, paths, work=[[("push", 2, 4), ("look", 1, 1)], []])
        self.assertEqual(grove.check(plan), [])
        self.assertEqual(plan.cost, 4)
        self.assertEqual(plan.agents[0].tasks, ["look", "push"])
        self.assertEqual(plan.agents[0].work, [("look", 1, 1), ("push", 2, 4)])
        self.assertEqual(grove.visits(plan), [("red", "look", 1, 1), ("red", "push", 2, 4)])
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "x.plan.json"
            grove.Solution(plan).write(path)
            self.assertEqual(grove.read_plan(path, instance).plan.agents[0].work, plan.agents[0].work)
        untold = grove.Plan(instance, paths, work=[[("push", 2, 4)], []])
        self.assertEqual(grove.check(untold), [
            ("/agents", "task 'look' is visited by 0 of its agents; expected at least 1")])
        for work, field in ((None, "/work"), ([[]], "/work"), ([[], 3], "/work/1"), (["look", []], "/work/0"),
                            ([[("look", 1)], []], "/work/0/0"), ([[(7, 1, 1)], []], "/work/0/0/0"),
                            ([[("look", 1.5, 1)], []], "/work/0/0/1"), ([[("look", 1, "1")], []], "/work/0/0/2"),
                            ([[], [("none", 0, 0)]], "/work/1/0/task")):
            with self.subTest(work=work), self.assertRaises(grove.InvalidArgument) as caught:
                grove.Plan(instance, paths, work=work)
            self.assertEqual(caught.exception.field, field)

    def test_choices_are_solved_and_replanned(self):
        instance = self.with_choices()
        plan = grove.solve(instance)
        self.assertEqual(grove.check(plan), [])
        with self.assertRaisesRegex(grove.InvalidArgument, "which method mgcbs does not support"):
            grove.solve(instance, method="mgcbs")
        session = grove.Session(grove.Plan(instance, [[(0, 0), (1, 0), (2, 0)], [(4, 0)]],
                                           work=[[("push", 2, 4), ("look", 1, 1)], []]))
        session.advance(3)
        self.assertEqual([t["id"] for t in session.instance.tasks], ["push"])
        self.assertEqual(session.instance.agents[0]["working"], {"task": "push", "done": 1})
        session.change(new_tasks=[{"id": "n", "cell": (0, 2), "agents": "*", "need": 1}])
        self.assertEqual(session.instance.tasks[-1]["need"], 1)
        self.assertEqual(grove.check(session.replan(visit_weight=10)), [])
        with self.assertRaisesRegex(grove.InvalidArgument, "found 101; expected from 0 to 100"):
            session.replan(visit_weight=101)

    def test_choices_are_fixed(self):
        plan = grove.Plan(self.with_choices(), [[(0, 0), (1, 0), (2, 0)], [(4, 0)]],
                          work=[[("push", 2, 4), ("look", 1, 1)], []])
        fixed = grove.fix_choices(plan)
        self.assertEqual(grove.check(fixed), [])
        self.assertEqual(fixed.cost, plan.cost)
        self.assertFalse(fixed.instance.has_choices)
        self.assertEqual([t["agents"] for t in fixed.instance.tasks], [["red"], ["red"]])
        self.assertEqual(fixed.instance.agents[0]["goal"], [2, 0])
        with self.assertRaises(grove.InvalidArgument):
            grove.fix_choices(grove.Plan(self.with_choices(), [[(0, 0)], [(4, 0)]], work=[[], []]))

    def test_session_replans_after_delays_and_changes(self):
        session = grove.Session(small())
        self.assertIsNone(session.plan)
        first = session.replan()
        session.advance(2, late={"blue": 1})
        self.assertEqual(session.instance.agents[1]["start"], list(first.plan.agents[1].path[1]))
        session.change(new_tasks=[{"id": "more", "cell": (0, 1), "agents": ["red"]}],
                       dropped_tasks=["look"] if "look" in [t["id"] for t in session.instance.tasks] else [],
                       blocked=[(4, 1)])
        again = session.replan(commit=1, time_limit=5)
        self.assertEqual(grove.check(again), [])
        self.assertIn(("red", "more"), [row[:2] for row in grove.visits(again.plan)])
        with self.assertRaises(grove.InvalidArgument):
            session.change(dropped_tasks=["nothing"])


class Errors(unittest.TestCase):
    def test_errors_name_the_invalid_argument(self):
        world = grove.World(ROWS)
        robot = {"id": "r", "start": (0, 0), "goal": (4, 2)}
        cases = [
            (lambda: grove.solve(small(), omega=-1), grove.InvalidArgument, "/omega"),
            (lambda: grove.solve(small(), method="best"), grove.InvalidArgument, "best"),
            (lambda: grove.solve(small(), threads="x"), TypeError, "threads"),
            (lambda: grove.Instance(world, [{**robot, "start": (1, 1)}]), grove.InputError, "/agents/0/start"),
            (lambda: grove.Instance(world, [{**robot, "heading": "E"}]), grove.InputError, "heading"),
            (lambda: grove.Instance(world, [robot, robot]), grove.InputError, "/agents/1"),
            (lambda: grove.World(["..", "."]), grove.InvalidArgument, "row"),
            (lambda: grove.read_instance("nowhere.cts.json"), grove.InputError, "nowhere.cts.json"),
            (lambda: grove.instance_from_dict({"agents": []}), grove.InvalidArgument, "map"),
            (lambda: grove.instance_from_dict({"map": ROWS, "agent": [robot]}), grove.InputError,
             "unknown key 'agent'; expected 'agents'"),
            (lambda: grove.instance_from_dict({"map": ROWS, "agents": [robot], "objective": "makespan"}),
             grove.InputError,
             "Grove does not model objectives"),
            (lambda: grove.Instance(world, [{**robot, "gaol": (4, 2)}]), grove.InputError,
             "/agents/0: unknown key 'gaol'"),
            (lambda: grove.Instance(world, [robot], [{"id": "t", "cell": (0, 0), "agents": ["r"], "dur": 1}]),
             grove.InputError,
             "/tasks/0: unknown key 'dur'; expected 'duration'"),
            (lambda: grove.Session(small()).change(new_tasks=[{"id": "t", "cell": (0, 0), "agents": ["red"],
                                                               "deadline": 1}]),
             grove.InputError, "Grove does not model deadlines"),
            (lambda: grove.Instance(world, [{**robot, "start": (0, float("nan"))}]), grove.InputError,
             "found no valid JSON number"),
            (lambda: grove.instance_from_arrays(world, [(0, 0)], []), grove.InvalidArgument, "goals"),
            (lambda: grove.Plan(small(), [[(0, 0)], [(4, 0)]]), grove.InvalidArgument, "takes time; expected the visits that the plan states"),
            (lambda: grove.picture(small(), "x.bmp"), grove.InvalidArgument, ".svg"),
            (lambda: grove.view(), grove.InvalidArgument, "one or two"),
            (lambda: grove.view(small()).save("/nowhere/x.html"), grove.InputError, "/nowhere"),
        ]
        for act, kind, part in cases:
            with self.assertRaises(kind) as caught:
                act()
            self.assertIn(part, str(caught.exception))

    def test_keys_for_remarks_are_accepted(self):
        data = {"map": ROWS, "_by": "me", "$schema": "instance.schema.json",
                "agents": [{"id": "r", "start": (0, 0), "goal": (4, 2), "_battery": {"full": True}}]}
        self.assertEqual(len(grove.instance_from_dict(data).agents), 1)

    def test_wrong_arrays_are_refused(self):
        import numpy as np

        world = grove.World(ROWS)
        free = small()
        arrays = grove.instance_from_arrays
        plain = arrays(world, [(0, 0)], [(4, 2)])
        for act, field, parts in (
                (lambda: arrays(world, 5), "/starts", ["found 5", "a list or an array of cells (x, y)"]),
                (lambda: arrays(world, [0, 0]), "/starts/0", ["found 0", "a cell (x, y), two whole numbers"]),
                (lambda: arrays(world, np.zeros((2, 3), int)), "/starts/0",
                 ["an array of int64 of shape (3,)", "two whole numbers"]),
                (lambda: arrays(world, np.zeros((2, 2))), "/starts/0", ["float64", "two whole numbers"]),
                (lambda: arrays(world, np.array(1)), "/starts", ["of shape ()"]),
                (lambda: arrays(world, [(0, 0)], [(0.5, 1)]), "/goals/0", ["found (0.5, 1)", "two whole numbers"]),
                (lambda: arrays(world, [(0, 0)], tasks=[(3, 1)]), "/tasks/0/0", ["found 3", "a cell (x, y)"]),
                (lambda: arrays(world, [(0, 0)], tasks=3), "/tasks", ["found 3", "a list of cells for each agent"]),
                (lambda: grove.World.grid(np.zeros((2, 2))), "/passable",
                 ["float64", "array of bool of two dimensions"]),
                (lambda: grove.World.grid(np.zeros(4, bool)), "/passable", ["bool of shape (4,)", "two dimensions"]),
                (lambda: grove.World.grid([[True], [True, False]]), "/passable", ["array of bool of two dimensions"]),
                (lambda: grove.World(np.zeros((2, 2), bool)), "/rows", ["array of bool", "World.grid() takes arrays"]),
                (lambda: grove.World(3), "/rows", ["found 3", "one for each row"]),
                (lambda: grove.World.roadmap({"A": 3}, []), "/vertices/A", ["found 3", "(x, y) in metres"]),
                (lambda: grove.World.roadmap([], []), "/vertices", ["found []", "a dict {'A': (x, y), ...}"]),
                (lambda: grove.World.roadmap({"A": (0, 0), "B": (1, 0)}, [("A", "B")]), "/roads/0",
                 ["(from, to, steps)"]),
                (lambda: grove.World.roadmap({"A": (0, 0), "B": (1, 0)}, [("A", "B", 1.5)]), "/roads/0/2",
                 ["found 1.5", "steps"]),
                (lambda: grove.World.roadmap({"A": (0, 0)}, [("A", "A", 1)]), "/edges/0", ["the same vertex"]),
                (lambda: grove.Plan(plain, 3), "/paths", ["found 3", "a list of paths, one for each agent"]),
                (lambda: grove.Plan(plain, [3]), "/paths/0", ["found 3", "a list of places"]),
                (lambda: grove.Plan(plain, [[(0, 0), (1, 2, 3, 4, 5)]]), "/paths/0/1",
                 ["found (1, 2, 3, 4, 5)", "a cell (x, y)"]),
                (lambda: grove.Plan(plain, np.zeros((1, 4, 3))), "/paths/0/0", ["a cell (x, y)"]),
                (lambda: grove.Session(free).change(blocked=[3]), "/blocked/0", ["found 3", "a cell (x, y)"]),
                (lambda: grove.Session(free).change(dropped_tasks=[3]), "/dropped_tasks/0",
                 ["found 3", "the id of a task"]),
                (lambda: grove.Session(free).advance("x"), "/steps", ["found 'x'", "a whole number"])):
            with self.subTest(field=field, parts=parts):
                with self.assertRaises(grove.InvalidArgument) as caught:
                    act()
                self.assertEqual(caught.exception.field, field)
                for part in parts:
                    self.assertIn(part, str(caught.exception))
                self.assertNotIn("incompatible", str(caught.exception))

    def test_error_has_the_field(self):
        with self.assertRaises(grove.InvalidArgument) as caught:
            grove.solve(small(), time_limit=-1)
        self.assertEqual(caught.exception.field, "/time_limit")


class Defaults(unittest.TestCase):
    """Compares the default options of the library, the Python module and the programs."""

    @staticmethod
    def of_python(function):
        found = {name: parameter.default for name, parameter in inspect.signature(function).parameters.items()}
        auto = {"threads": grove.default_threads, "memory_limit": grove.default_memory_limit}
        return {name: auto[name]() if name in auto and value == "auto" else value for name, value in found.items()}

    @staticmethod
    def of_program(command, option):
        text = subprocess.run([GROVE, command, "--help"], capture_output=True, text=True, check=True, timeout=60).stdout
        return re.search(rf"{option} [A-Z]\S*=(\S+)", text)[1]

    def test_defaults_of_solve(self):
        found = self.of_python(grove.solve)
        self.assertEqual((found["omega"], found["time_limit"]), (0.01, 180))
        self.assertEqual(found["threads"], len(os.sched_getaffinity(0)))
        physical = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
        self.assertTrue(0 < found["memory_limit"] <= 0.8 * physical)
        solution = grove.solve(small())
        self.assertEqual(solution.omega, found["omega"])

    @unittest.skipUnless(GROVE, "grove is not built")
    def test_defaults_agree_with_the_programs(self):
        for command, function in (("solve", grove.solve), ("replan", grove.Session.replan)):
            found = self.of_python(function)
            for name in ("omega", "time_limit", "threads", "seed", "method"):
                default = self.of_program(command, "--" + name.replace("_", "-"))
                self.assertEqual(default if name == "method" else float(default), found[name], (command, name))
            gigabytes = float(self.of_program(command, "--memory-limit"))
            self.assertAlmostEqual(gigabytes, found["memory_limit"] / 1e9, places=6)


class Views(unittest.TestCase):
    def test_views_and_pictures_are_written(self):
        solution = grove.solve(small())
        for plans in ([small()], [solution], [solution.plan], [solution, solution.plan]):
            view = grove.view(*plans)
            self.assertIn("<html", view.html)
            self.assertTrue(view._repr_html_().startswith("<iframe srcdoc=\"&lt;!"))
        with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder):
            for name, begin in (("x.svg", b"<?xml"), ("x.png", b"\x89PNG"), ("x.gif", b"GIF89a")):
                grove.picture(solution, name, at=[0, 3], width=100)
                self.assertTrue(Path(name).read_bytes().startswith(begin))


class Memory(unittest.TestCase):
    @staticmethod
    def resident():
        return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    def test_thousand_solves_do_not_leak_memory(self):
        instance = small()
        for _ in range(200):
            grove.solve(instance, incumbent=lambda plan, at: plan.positions())
        before = self.resident()
        for _ in range(1000):
            grove.solve(instance, incumbent=lambda plan, at: plan.positions())
        self.assertLess(self.resident() - before, 4 << 20)


if __name__ == "__main__":
    if not importlib.util.find_spec("numpy") or not importlib.util.find_spec("pandas"):
        print("skipped: numpy or pandas is not installed")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
