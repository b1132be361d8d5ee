#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests docs/schemas: they accept files that Grove ships and writes, and refuse files that Grove and grove-verify
refuse.

    schemas_test.py GROVE [GROVE_VERIFY]

Exits with code 77 (skipped) if jsonschema is not installed.
"""
import copy
import importlib.util
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
SCHEMAS = ROOT / "docs/schemas"
DATA = ROOT / "benchmarks/data"
GROVE = Path(sys.argv[1]).resolve()
VERIFY = Path(sys.argv[2]).resolve() if len(sys.argv) > 2 else None


def load(path):
    return json.loads(Path(path).read_text(encoding="utf-8"))


def lines(path):
    return [json.loads(line) for line in Path(path).read_text(encoding="utf-8").splitlines()]


def validators():
    import jsonschema
    stored = {(SCHEMAS / path.name).as_uri(): load(path) for path in SCHEMAS.glob("*.schema.json")}
    return {uri.rsplit("/", 1)[1].split(".")[0]: jsonschema.Draft202012Validator(
                schema, resolver=jsonschema.RefResolver(uri, schema, store=stored),
                format_checker=jsonschema.FormatChecker(["regex"]))
            for uri, schema in stored.items()}


def properties(schema):
    """Yields (key, schema) of each property that the schema describes. Skips conditions, which only restrict
    properties."""
    for key, value in schema.items() if isinstance(schema, dict) else []:
        if key == "properties":
            yield from value.items()
        if key in ("properties", "$defs"):
            for inner in value.values():
                yield from properties(inner)
        elif key in ("items", "additionalProperties"):
            yield from properties(value)
        elif key == "anyOf":
            for inner in value:
                yield from properties(inner)


def grove(*arguments, cwd=None, code=0):
    done = subprocess.run([GROVE, *map(str, arguments)], capture_output=True, text=True, timeout=60, cwd=cwd)
    if code is not None and done.returncode != code:
        raise AssertionError(f"{arguments} ended with {done.returncode}, not {code}: {done.stderr}")
    return done


class Case(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.validators = validators()

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)
        for path in [*DATA.glob("*.map"), *DATA.glob("*.json"), *DATA.glob("*.scen")]:
            shutil.copy(path, self.folder)

    def write(self, name, value):
        (self.folder / name).write_text(json.dumps(value))
        return self.folder / name

    def schema_errors(self, schema, value):
        schema = "instance" if schema == "choices" else schema
        return [f"/{'/'.join(map(str, error.absolute_path))}: {error.message}"
                for error in self.validators[schema].iter_errors(value)]

    def assert_valid(self, schema, value, what=""):
        found = self.schema_errors(schema, value)
        self.assertEqual(found, [], what)

    def solve(self, instance, *options, name="x"):
        """Solves the instance, validates the plan and each line of the log against the schemas, and returns both."""
        plan, log = self.folder / f"{name}.plan.json", self.folder / f"{name}.jsonl"
        grove("solve", instance, "--quiet", "--threads", 1, "--output", plan, "--log", log, "--log-format", "jsonl",
              "--log-tree", 50, *options, cwd=self.folder)
        self.assert_valid("plan", load(plan), instance)
        for line in lines(log):
            self.assert_valid("run-log-line", line, line)
        return load(plan), lines(log)


class Schemas(Case):
    def test_schemas_are_valid(self):
        import jsonschema
        self.assertEqual(len(self.validators), 9)
        for name, validator in self.validators.items():
            jsonschema.Draft202012Validator.check_schema(validator.schema)
            self.assertIn("title", validator.schema, name)
            self.assertIn("description", validator.schema, name)

    def resolved(self, validator, schema):
        while "$ref" in schema:
            _, target = validator.resolver.resolve(schema["$ref"])
            schema = {**target, **{key: value for key, value in schema.items() if key != "$ref"}}
        return schema

    def test_properties_have_titles_and_descriptions(self):
        for name, validator in self.validators.items():
            found = list(properties(validator.schema))
            self.assertGreaterEqual(len(found), 1, name)
            for key, schema in found:
                described = self.resolved(validator, schema)
                for word in ("title", "description"):
                    self.assertTrue(described.get(word), f"{name}: {key} has no {word}")

    def test_references_have_no_sibling_properties(self):
        """Checks that no schema has "$ref" next to "properties", because VS Code would ignore the referenced
        properties."""
        def check(schema, where):
            if isinstance(schema, dict):
                self.assertFalse("$ref" in schema and "properties" in schema and isinstance(schema["$ref"], str), where)
            for key, inner in schema.items() if isinstance(schema, dict) else enumerate(schema):
                if isinstance(inner, (dict, list)):
                    check(inner, f"{where}/{key}")
        for name, validator in self.validators.items():
            check(validator.schema, name)


class ShippedFiles(Case):
    def test_instances_roadmaps_and_adapters_are_valid(self):
        for schema, pattern, folder in (("instance", "*.cts.json", DATA), ("roadmap", "*.roadmap.json", DATA),
                                        ("solver", "*.json", ROOT / "tools/bench/solvers")):
            found = list(folder.rglob(pattern))
            self.assertTrue(found, pattern)
            for path in found:
                self.assert_valid(schema, load(path), path)

    def test_examples_of_the_documents_are_valid(self):
        """Validates every JSON example of an instance, a roadmap, an adapter or new tasks in docs/formats.md."""
        text = (ROOT / "docs/formats.md").read_text(encoding="utf-8")
        seen = set()
        for block in text.split("```json\n")[1:]:
            value = json.loads(block.split("```")[0])
            schema = ("roadmap" if "vertices" in value else "instance" if "agents" in value and "tasks" in value
                      else "solver" if "command" in value else "change" if "cell" in value
                      or "tasks" in value else None)
            if schema:
                seen.add(schema)
                self.assert_valid(schema, value, block)
        self.assertEqual(seen, {"roadmap", "instance", "solver", "change"})

    def test_formats_document_lists_every_key(self):
        text = (ROOT / "docs/formats.md").read_text(encoding="utf-8")
        for name in ("instance", "roadmap", "plan", "change", "solver"):
            for key, _ in properties(self.validators[name].schema):
                self.assertTrue(f"`{key}`" in text or f'`"{key}"`' in text or f'"{key}":' in text, f"{name}: {key}")


class WrittenFiles(Case):
    def test_counters_are_those_of_the_registry(self):
        """Compares names, titles and meanings with src/model/counters.def, and names with docs/formats.md."""
        text = (ROOT / "src/model/counters.def").read_text(encoding="utf-8")
        rows = re.findall(r'GROVE_COUNTER\(\s*\w+,\s*"(\w+)",\s*\w+,\s*"([^"]*)",((?:\s*"[^"]*")+)\)', text)
        self.assertEqual(len(rows), text.count("\nGROVE_COUNTER("))
        described = load(SCHEMAS / "plan.schema.json")["properties"]["stats"]["properties"]
        formats = (ROOT / "docs/formats.md").read_text(encoding="utf-8")
        for name, title, meaning in rows:
            self.assertEqual((described[name]["title"], described[name]["description"]),
                             (title, "".join(re.findall(r'"([^"]*)"', meaning))), name)
            self.assertIn(f"`{name}`", formats)

    def test_plans_and_logs_are_valid(self):
        cases = {
            "grid": (DATA / "first.cts.json", "--omega", 0),
            "roadmap": (DATA / "yard.cts.json", "--omega", 0),
            "turning and work": (DATA / "shop.cts.json", "--omega", 0),
            "MG": (DATA / "random-32x32-20_n5_m10_mg.cts.json",),
            "scenario": (DATA / "random-32x32-20.scen", "--agents", 30, "--omega", 0.1, "--without", "primal"),
            "fixed policy": (DATA / "first.cts.json", "--omega", 0, "--policy", "fixed"),
            "published": (DATA / "first.cts.json", "--method", "optimal-cbs"),
            "no following": (DATA / "first.cts.json", "--no-following"),
            "MG made CTS": (DATA / "random-32x32-20_n5_m10_mg.cts.json", "--method", "cts-cbs-b"),
        }
        known = set(load(SCHEMAS / "plan.schema.json")["properties"]["stats"]["properties"])
        statuses, events = set(), set()
        for name, (instance, *options) in cases.items():
            plan, log = self.solve(instance, *options, name=name)
            statuses.add(plan["status"])
            events |= {line["event"] for line in log}
            self.assertLessEqual(set(plan["stats"]), known, name)
            for line in log:
                self.assertLessEqual(set(line.get("counts", {})), known, name)
        self.assertLessEqual({"optimal", "bounded"}, statuses)
        self.assertLessEqual({"header", "incumbent", "bound", "counts", "root", "node", "summary"}, events)

    def hard_instance(self):
        robots = 14
        (self.folder / "corridor.map").write_text(f"type octile\nheight 2\nwidth {robots}\nmap\n"
                                                  + ("." * robots + "\n") * 2)
        return self.write("hard.cts.json", {"map": "corridor.map", "tasks": [], "agents": [
            {"id": f"a{i}", "start": [i, 0], "goal": [robots - 1 - i, 1]} for i in range(robots)]})

    def test_runs_at_a_limit_write_valid_files(self):
        hard = self.hard_instance()
        plan, _ = self.solve(hard, "--time-limit", 0.2, "--without", "primal,lacam", name="unknown")
        self.assertEqual(plan["status"], "unknown")
        self.solve(hard, "--time-limit", 0.3, "--checkpoint", "kept", "--resume", "never", name="kept")
        plan, log = self.solve(hard, "--time-limit", 0.6, "--checkpoint", "kept", "--resume", "auto", name="resumed")
        self.assertIn("seconds_before", plan["stats"])
        self.assertLessEqual({"resumed", "checkpoint"}, {line["event"] for line in log})

    def test_infeasible_run_writes_valid_files(self):
        (self.folder / "walled.map").write_text("type octile\nheight 1\nwidth 3\nmap\n.@.\n")
        walled = self.write("walled.cts.json", {"map": "walled.map", "tasks": [], "agents": [
            {"id": "a", "start": [0, 0], "goal": [2, 0]}]})
        plan, log = self.solve(walled)
        self.assertEqual(plan["status"], "infeasible")
        self.assertIn("infeasible", {line["event"] for line in log})

    def test_passing_orders_are_valid(self):
        actions = set()
        for name in ("first", "yard", "shop"):
            instance = DATA / f"{name}.cts.json"
            self.solve(instance, "--omega", 0, name=name)
            grove("execute", instance, f"{name}.plan.json", "--order", f"{name}.order.json", cwd=self.folder)
            order = load(self.folder / f"{name}.order.json")
            self.assert_valid("passing-order", order, name)
            actions |= {action["do"] for robot in order["robots"] for action in robot["actions"]}
        self.assertEqual(actions, {"move", "turn", "work"})

    def test_drive_logs_are_valid(self):
        grove("toio", "--demo", "--fast", "--quiet", "--log", "drive.jsonl", cwd=self.folder)
        drive = lines(self.folder / "drive.jsonl")
        self.assertGreater(len(drive), 10)
        for line in drive:
            self.assert_valid("drive-log-line", line, line)

    def test_replan_reads_and_writes_valid_files(self):
        self.solve(DATA / "shop.cts.json", name="shop")
        cases = [{"tasks": [{"id": "more", "cell": [0, 1], "agents": ["red", "blue"], "duration": 2}]},
                 {"$schema": "change.schema.json", "id": "more", "cell": [0, 1], "agents": ["spare"]}]
        for change in cases:
            self.assert_valid("change", change)
            done = grove("replan", DATA / "shop.cts.json", "shop.plan.json", "--at", 9, "--commit", 1, "--new-task",
                         self.write("change.json", change), "-o", "then.plan.json", "--output-instance",
                         "then.cts.json",
                         cwd=self.folder)
            self.assertNotIn("unknown key", done.stderr)
            self.assert_valid("plan", load(self.folder / "then.plan.json"))
            then = load(self.folder / "then.cts.json")
            self.assert_valid("instance", then)
            self.assertIn("working", {key for agent in then["agents"] for key in agent})

    def test_generate_writes_valid_files(self):
        grove("generate", "roadmap", "--kind", "planar", "--vertices", 30, "--one-way", 30, "-o", "town.roadmap.json",
              cwd=self.folder)
        self.assert_valid("roadmap", load(self.folder / "town.roadmap.json"))
        for kind, options in (("map", ["first.map", "--turning", "--durations", "0-4"]),
                              ("roadmap", ["town.roadmap.json"])):
            grove("generate", "instance", f"--{kind}", *options, "--agents", 2, "--tasks", 2, "--seed", 1, "-o",
                  "made.cts.json", cwd=self.folder)
            self.assert_valid("instance", load(self.folder / "made.cts.json"), kind)

    def test_tables_of_results_are_valid(self):
        self.write("mine.json", {"name": "mine", "command": "{program} {map} {scenario}", "plan": None,
                                 "claims": {"cost": "cost (\\d+)"}})
        (self.folder / "list.txt").write_text("first.cts.json\nrandom-32x32-20_n5_m10_mg.cts.json\n"
                                              "empty-32x32.scen --map empty-32x32.map --agents 3\n")
        grove("bench", "list.txt", "--run", "auto:", "--run", "ends: --method cts-cbs-b", "--solver",
              "mine=mine.json:/bin/false", "--time-limit", 1, "--output-dir", "table", "--quiet", cwd=self.folder,
              code=None)
        rows = lines(self.folder / "table/results.jsonl")
        self.assertGreaterEqual(len(rows), 6)
        for row in rows:
            self.assert_valid("results-row", row, row)
        self.assertIn("unsupported", {row["status"] for row in rows})
        self.assertTrue(any(row["solved"] for row in rows))
        self.assertTrue(any(row["solver"] == "mine" for row in rows))


class RefusedFiles(Case):
    """Tests files that both the programs and the schemas must refuse."""

    def refused_by_verify(self, kind, value):
        """Returns whether grove-verify refuses the instance. The certificate is empty."""
        instance = self.write("broken.cts.json", value if kind != "roadmap" else
                              {**load(DATA / "yard.cts.json"), "roadmap": "broken.roadmap.json"})
        if kind == "roadmap":
            self.write("broken.roadmap.json", value)
        done = subprocess.run([VERIFY, instance, "/dev/null"], capture_output=True, text=True, timeout=60,
                              cwd=self.folder)
        self.assertEqual(done.returncode, 2, done.stdout)
        return not done.stdout.startswith("unreadable: line ")  # a line of the certificate

    def assert_refused(self, kind, value):
        self.assertTrue(self.schema_errors(kind, value), "the schema accepts it")
        self.assertTrue(self.refused_by_grove(kind, value), "grove accepts it")
        if VERIFY and kind in ("instance", "choices", "roadmap"):
            self.assertTrue(self.refused_by_verify(kind, value), "grove-verify accepts it")

    def assert_accepted(self, kind, value):
        self.assert_valid(kind, value)
        self.assertFalse(self.refused_by_grove(kind, value), kind)
        if VERIFY and kind in ("instance", "choices", "roadmap"):
            self.assertFalse(self.refused_by_verify(kind, value), kind)

    def refused_by_grove(self, kind, value):
        path = self.write(f"broken.{kind}.json", value)
        if kind in ("instance", "choices"):
            done = grove("solve", path, "--quiet", "--output", "-", "--omega", "inf", cwd=self.folder, code=None)
        elif kind == "roadmap":
            yard = self.write("on.cts.json", {**load(DATA / "yard.cts.json"), "roadmap": path.name})
            done = grove("solve", yard, "--quiet", "--output", "-", "--omega", "inf", cwd=self.folder, code=None)
        elif kind == "plan":
            done = grove("check", DATA / "shop.cts.json", path, code=None)
        elif kind == "change":
            done = grove("replan", DATA / "shop.cts.json", self.plan_of_shop(), "--at", 0, "--new-task", path, "-o",
                         "-",
                         "--quiet", "--output-instance", "then.cts.json", cwd=self.folder, code=None)
        else:
            done = grove("bench", DATA / "first.cts.json", "--solver", f"mine={path}:/bin/true", "--output-dir",
                         "table",
                         "--quiet", "--time-limit", 1, cwd=self.folder, code=None)
            shutil.rmtree(self.folder / "table", ignore_errors=True)
        self.assertIn(done.returncode, (0, 2), done.stderr)
        return done.returncode == 2

    def plan_of_shop(self):
        path = self.folder / "shop.plan.json"
        if not path.exists():
            grove("solve", DATA / "shop.cts.json", "--quiet", "--output", path)
        return path

    def valid(self, kind):
        """Returns a valid file of this kind with all keys."""
        if kind == "instance":
            shop = load(DATA / "shop.cts.json")
            shop["tasks"].append({"id": "begun", "cell": [4, 2], "agents": ["spare"], "duration": 9})
            shop["agents"][2]["working"] = {"task": "begun", "done": 2}
            return shop
        if kind == "choices":
            shop = load(DATA / "shop.cts.json")
            shop["agents"][0]["goals"] = [shop["agents"][0].pop("goal"), [1, 0]]
            shop["tasks"][0].update(agents="*", need=1)
            return shop
        if kind == "roadmap":
            return load(DATA / "yard.roadmap.json")
        if kind == "plan":
            return load(self.plan_of_shop())
        if kind == "change":
            return {"tasks": [{"id": "more", "cell": [0, 1], "agents": ["red"], "duration": 1}]}
        return {"name": "mine", "about": "x", "command": "{program} {map} {scenario} {agents}", "instance": "movingai",
                "plan": "{output}", "anytime": True, "threads": 2,
                "claims": {"cost": "cost (\\d+)", "seconds": {"file": "{output}", "regex": "t=(\\d+)", "unit": "ms"}},
                "trace": [{"file": "{output}", "regex": "(.) (.)", "groups": ["cost", "seconds"]}]}

    def each_place(self, value, path=()):
        """Yields (path, value) of each nested value. Skips stats, about, and all but the first entry of each list."""
        yield path, value
        if isinstance(value, dict):
            for key, inner in value.items():
                if key not in ("stats", "about"):
                    yield from self.each_place(inner, (*path, key))
        elif isinstance(value, list) and value:
            yield from self.each_place(value[0], (*path, 0))

    @staticmethod
    def changed(value, path, change):
        value = copy.deepcopy(value)
        inner = value
        for key in path[:-1]:
            inner = inner[key]
        change(inner, path[-1])
        return value

    def mutations(self, value):
        """Yields (description, file) with a misspelt key, a value of a wrong type or a number below the allowed
        range."""
        for path, inner in self.each_place(value):
            if not path:
                continue
            key = path[-1]
            wrong = [{"x": 1}, True if not isinstance(inner, bool) else 1]
            if isinstance(inner, int) and not isinstance(inner, bool):
                wrong += ["1"]
                if "at" not in path:
                    wrong += [inner + 0.5]
                    if key != "lower_bound":
                        wrong += [-(1 << 40)]
            if isinstance(inner, str):
                wrong += [7, None]
            if isinstance(inner, list):
                wrong += [7]
            if key == "plan":
                wrong.remove(None)
            for other in wrong:
                yield f"{path} is {other!r}", self.changed(value, path, lambda at, k, v=other: at.__setitem__(k, v))
            if isinstance(key, str) and len(key) > 3:
                word = (key + "s", key[1] + key[0] + key[2:], key.upper())[len(key) % 3]
                yield f"{path} is called {word}", self.changed(
                    value, path, lambda at, k, w=word: at.__setitem__(w, at.pop(k)))

    def test_files_with_all_keys_are_accepted(self):
        for kind in ("instance", "choices", "roadmap", "plan", "change", "solver"):
            self.assert_accepted(kind, self.valid(kind))
        self.assert_accepted("instance", {**load(DATA / "first.cts.json"), "tasks": []})
        self.assert_accepted("change", {"id": "t", "cell": [0, 1], "agents": "*"})

    def test_choices_on_roadmaps_are_accepted(self):
        yard = load(DATA / "yard.cts.json")
        yard["agents"][0]["goals"] = [yard["agents"][0].pop("goal"), ["bay"]]
        self.assert_accepted("choices", yard)

    def test_stated_visits_are_accepted(self):
        """Checks a plan that states a visit without duration."""
        instance = self.write("any.cts.json", {
            "map": "first.map", "agents": [{"id": "red", "start": [0, 0], "goals": [[0, 0], [8, 0]]},
                                           {"id": "blue", "start": [8, 4]}],
            "tasks": [{"id": "t", "cell": [0, 0], "agents": "*", "need": 1}]})
        plan = {"status": "optimal", "cost": 0, "lower_bound": 0, "omega": 0,
                "agents": [{"id": "red", "sequence": ["t"], "cost": 0, "work": [{"task": "t", "begin": 0, "end": 0}],
                            "path": [[0, 0]]},
                           {"id": "blue", "sequence": [], "cost": 0, "path": [[8, 4]]}]}
        self.assert_valid("choices", load(instance))
        self.assert_valid("plan", plan)
        grove("check", instance, self.write("any.plan.json", plan), cwd=self.folder)

    def test_unknown_keys_are_refused_and_remarks_accepted(self):
        """Checks that every object refuses unknown keys and accepts keys for remarks."""
        for kind in ("instance", "choices", "roadmap", "plan", "change", "solver"):
            whole = self.valid(kind)
            objects = [path for path, value in self.each_place(whole) if isinstance(value, dict)]
            self.assertGreater(len(objects), 1)
            for path in objects:
                for key, good in (("_note", True), ("_", True), ("$schema", True), ("note", False), ("deadline", False),
                                  ("$note", False)):
                    changed = copy.deepcopy(whole)
                    inner = changed
                    for step in path:
                        inner = inner[step]
                    inner[key] = "x"
                    with self.subTest(kind=kind, path=path, key=key):
                        self.assert_accepted(kind, changed) if good else self.assert_refused(kind, changed)

    def test_mutated_files_are_refused(self):
        for kind in ("instance", "choices", "roadmap", "change", "solver", "plan"):
            value, count = self.valid(kind), 0
            for what, broken in self.mutations(value):
                count += 1
                with self.subTest(kind=kind, what=what):
                    self.assert_refused(kind, broken)
            self.assertGreater(count, 10)

    def test_missing_keys_are_refused(self):
        needed = {"instance": [(), ("agents", 0), ("tasks", 0), ("agents", 2, "working")],
                  "choices": [("tasks", 0)],
                  "roadmap": [(), ("vertices", 0), ("edges", 0)], "change": [("tasks", 0)],
                  "solver": [("trace", 0)], "plan": [(), ("agents", 0)]}
        optional = {"goal", "turn_steps", "goal_heading", "working", "duration", "one_way", "stats", "work", "file",
                    "following", "motion", "need"}
        for kind, places in needed.items():
            for place in places:
                inner = self.valid(kind)
                for key in place:
                    inner = inner[key]
                for key in set(inner) - optional:
                    broken = self.changed(self.valid(kind), (*place, key), lambda at, k: at.pop(k))
                    with self.subTest(kind=kind, missing=(*place, key)):
                        self.assert_refused(kind, broken)

    def test_inconsistent_keys_are_refused(self):
        shop, yard, town, solver = (self.valid("instance"), load(DATA / "yard.cts.json"), self.valid("roadmap"),
                                    self.valid("solver"))
        agent, driver = {"id": "r", "start": [0, 0]}, {"id": "r", "start": "gate"}

        def alone(robot, **keys):
            return {"map": "first.map", "agents": [{**robot, **keys}], "tasks": []}

        def on_roads(robot, **keys):
            return {"roadmap": "yard.roadmap.json", "agents": [{**robot, **keys}], "tasks": []}

        cases = [
            ("instance", {**shop, "roadmap": "yard.roadmap.json"}),
            ("instance", {**shop, "map": ""}),
            ("instance", {**shop, "agents": []}),
            ("instance", {**shop, "duration": 3}),
            ("instance", {**yard, "motion": "turning"}),
            ("instance", alone(agent, duration=3)),
            ("instance", alone(agent, heading="N")),
            ("instance", alone(agent, turn_steps=2)),
            ("instance", alone(agent, motion="turning")),
            ("instance", alone(agent, motion="rolling", heading="N")),
            ("instance", alone(agent, motion="turning", heading="north")),
            ("instance", alone(agent, motion="turning", heading="N", turn_steps=0)),
            ("instance", alone(agent, motion="turning", heading="N", goal_heading="N")),
            ("instance", alone(agent, goal=[1, 0, "N"])),
            ("instance", alone(agent, goal="gate")),
            ("instance", alone({"id": "", "start": [0, 0]})),
            ("instance", alone({"id": "r", "start": [0, 0, "N"]})),
            ("instance", alone({"id": "r", "start": [0, 0, "N", "S", 1]}, motion="turning", turn_steps=2)),
            ("instance", alone({"id": "r", "start": [0, 0, "N", "E", 0]}, motion="turning", turn_steps=2)),
            ("instance", alone({"id": "r", "start": [0]})),
            ("instance", alone(agent, working={"task": "t", "done": 1, "extra": 2})),
            ("instance", on_roads(driver, motion="turning", heading="N")),
            ("instance", on_roads({"id": "r", "start": [0, 0]})),
            ("instance", on_roads({"id": "r", "start": ["gate", "north"]})),
            ("instance", on_roads({"id": "r", "start": ["gate", "north", 0]})),
            ("instance", on_roads(driver, goal=["gate", "north", 2])),
            ("instance", {**shop, "tasks": [{"id": "t", "cell": [0, 0], "agents": []}]}),
            ("instance", {**shop, "tasks": [{"id": "t", "cell": [0, 0], "agents": ["red", "red"]}]}),
            ("instance", {**shop, "tasks": [{"id": "t", "cell": [0, 0], "agents": ["red"], "duration": 65537}]}),
            ("instance", {**shop, "tasks": [{"id": "t", "cell": [0, 0], "agents": ["red"], "heading": "N"}]}),
            *(("choices", alone(agent, **keys)) for keys in (
                {"goals": []}, {"goals": [1, 0]}, {"goals": "*"}, {"goals": [[1, 0], [1, 0]]},
                {"goals": [[1, 0, "N"]]}, {"goals": ["gate"]}, {"goals": [[1, 0]], "goal": [2, 0]},
                {"goals": [[1, 0]], "goal_heading": "N"})),
            ("choices", on_roads(driver, goals=[["gate", "north", 2]])),
            ("choices", on_roads(driver, goals=[[0, 0]])),
            *(("choices", {**shop, "tasks": [{"id": "t", "cell": [0, 0], **keys}]}) for keys in (
                {"agents": "all"}, {"agents": ""}, {"agents": ["*", 1]}, {"agents": "*", "need": 0},
                {"agents": "*", "need": -1}, {"agents": "*", "need": 1.5}, {"agents": "*", "need": "all"},
                {"agents": "*", "need": None}, {"agents": "*", "need": 1 << 31}, {"need": 1})),
            ("change", {"id": "t", "cell": [0, 0], "agents": ["red"], "need": 0}),
            ("change", {"id": "t", "cell": [0, 0], "agents": "all"}),
            ("roadmap", {**town, "vertices": []}),
            ("roadmap", {**town, "vertices": [{"id": "A", "at": [0, 0, 0]}]}),
            ("roadmap", {**town, "edges": [{**town["edges"][0], "steps": 0}]}),
            ("change", {"id": "t", "cell": [0, 0], "agents": []}),
            ("change", {"id": "t", "cell": [0, 0], "agents": ["red"], "durations": 1}),
            ("change", {"tasks": [], "id": "t"}),
            ("change", {"tasks": [{"id": "t", "cell": [0, 0], "agents": ["red"], "durations": 1}]}),
            ("change", {}),
            ("solver", {**solver, "name": "a b"}),
            ("solver", {**solver, "command": "{program} {maps} {map} {scenario}"}),
            ("solver", {**solver, "command": "{program} {map} {scenario} {map"}),
            ("solver", {**solver, "colour": "red"}),
            ("solver", {**solver, "instance": "xml"}),
            ("solver", {**solver, "threads": 0}),
            ("solver", {**solver, "plan": None, "claims": {}}),
            ("solver", {**solver, "claims": {"costs": "(.)"}}),
            ("solver", {**solver, "claims": {"cost": {"regex": "(.)", "unit": "h"}}}),
            ("solver", {**solver, "claims": {"cost": "((("}}),
            ("solver", {**solver, "trace": [{"regex": "(.)", "groups": ["cost"]}]}),
            ("solver", {**solver, "trace": [{"regex": "(.)(.)(.)", "groups": ["cost", "seconds", "milliseconds"]}]}),
            ("plan", {**self.valid("plan"), "status": "best"}),
            ("plan", {**self.valid("plan"), "omega": -1}),
            ("plan", {**self.valid("plan"), "omega": "infinite"}),
            ("plan", {**self.valid("plan"), "status": "infeasible"}),
        ]
        for kind, broken in cases:
            with self.subTest(kind=kind, broken=json.dumps(broken)[:300]):
                self.assert_refused(kind, broken)


class SchemaKey(Case):
    def test_schema_key_is_accepted_in_input_files(self):
        instance = self.write("x.cts.json", {"$schema": "instance.schema.json", **load(DATA / "yard.cts.json")})
        self.write("yard.roadmap.json", {"$schema": "roadmap.schema.json", **load(DATA / "yard.roadmap.json")})
        for path, schema in ((instance, "instance"), (self.folder / "yard.roadmap.json", "roadmap")):
            self.assert_valid(schema, load(path))
        done = grove("solve", instance, "--output", self.folder / "x.plan.json")
        self.assertNotIn("schema", done.stdout + done.stderr)
        plan = {"$schema": "plan.schema.json", **load(self.folder / "x.plan.json")}
        self.assert_valid("plan", plan)
        self.assertEqual(grove("check", instance, self.write("y.plan.json", plan)).stderr, "")
        adapter = {"$schema": "solver.schema.json", "name": "mine", "command": "{program} {map} {scenario}"}
        self.assert_valid("solver", adapter)
        done = grove("bench", DATA / "empty-32x32.scen", "--agents", 1, "--time-limit", 1, "--quiet", "--output-dir",
                     "table", "--solver",
                     f"mine={self.write('mine.json', adapter)}:/bin/false", cwd=self.folder, code=None)
        self.assertNotIn("schema", done.stderr)
        self.assertTrue((self.folder / "table/results.jsonl").exists())


if __name__ == "__main__":
    if not importlib.util.find_spec("jsonschema"):
        print("skipped: python3-jsonschema is not installed")
        sys.exit(77)
    del sys.argv[1:3]
    unittest.main()
