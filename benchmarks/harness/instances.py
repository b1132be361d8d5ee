# SPDX-License-Identifier: MIT
"""What is solved: cases of the Moving AI folder, drawn ones, and the files that stand for them."""

import dataclasses
import json
import pathlib

from harness.programs import run

RESERVED_ROWS = 20  # of a scenario: its tasks begin after them, or after the agents


@dataclasses.dataclass(frozen=True)
class Case:
    """The first `agents` rows of scenario number `scenario` of a map, with `tasks` tasks.

    Without tasks (None) it is classical MAPF: the scenario as it stands.
    """

    map: str
    agents: int
    tasks: int | None
    scenario: int
    mg: bool = False

    @property
    def problem(self):
        return "mapf" if self.tasks is None else "mg" if self.mg else "cts"

    @property
    def id(self):
        """What tables call it; a scenario as it stands as `grove bench` would."""
        if self.tasks is None:
            return f"{self.map}-random-{self.scenario}-{self.agents}"
        return (f"experiments/{self.map}_s{self.scenario}_n{self.agents}_m{self.tasks}"
                + ("_mg" if self.mg else ""))

    def __str__(self):
        size = f"{self.agents}" if self.tasks is None else f"{self.agents}/{self.tasks}"
        return f"{self.map} {size} scenario {self.scenario}"


@dataclasses.dataclass(frozen=True)
class FileCase:
    """An instance as it stands in its file."""

    file: pathlib.Path
    agents: int
    tasks: int
    problem: str
    map: str
    scenario: int | None = None

    @property
    def id(self):
        return self.file.name.removesuffix(".cts.json")

    def __str__(self):
        return str(self.file)


@dataclasses.dataclass(frozen=True)
class DrawnCase:
    """An instance on a world, both as `grove generate` draws them: everywhere the same bytes.

    `world` has the words after `grove generate`. Without tasks (None) it is classical MAPF.
    """

    name: str
    world: str
    agents: int
    tasks: int | None
    seed: int
    mg: bool = False

    def __str__(self):
        return self.name

    def make(self, grove, folder):
        """How `grove solve` is told of it; its files are made in the folder."""
        folder = pathlib.Path(folder)
        kind = self.world.split()[0]
        world = folder / f"world.{'map' if kind == 'map' else 'roadmap.json'}"
        run([grove, "generate", *self.world.split(), "-o", world])
        of_world = [f"--{kind}", world, "--seed", self.seed]
        if self.tasks is None:
            scenario = folder / "world.scen"
            run([grove, "generate", "scenario", *of_world, "--rows", self.agents, "-o", scenario])
            return [scenario, "--map", world, "--agents", self.agents]
        instance = folder / "instance.cts.json"
        run([grove, "generate", "instance", *of_world, "--agents", self.agents, "--tasks", self.tasks,
             "-o", instance, *(["--mg"] if self.mg else [])])
        return [instance]


def cases_in(folder):
    """The instances of a folder, by name."""
    cases = []
    for file in sorted(pathlib.Path(folder).glob("*.cts.json")):
        text = json.loads(file.read_text(encoding="utf-8"))
        problem = "cts" if all("goal" in agent for agent in text["agents"]) else "mg"
        cases.append(FileCase(file, len(text["agents"]), len(text["tasks"]), problem,
                              str(text.get("map") or text.get("roadmap"))))
    return cases


class Maps:
    """A folder with <map>.map and <map>-random-<k>.scen files."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def map(self, case):
        return self.folder / f"{case.map}.map"

    def scenario(self, case, number=None):
        return self.folder / f"{case.map}-random-{number or case.scenario}.scen"

    def missing(self, case):
        """The file that the case needs and that is not there; none: it can be run."""
        if not isinstance(case, Case):
            return None
        return next((file for file in (self.map(case), self.scenario(case)) if not file.exists()),
                    None)


def scenario_with_enough_rows(maps, case, folder):
    """The scenario of a case; if it has too few rows, a copy with those of the next one after it.

    Crowds need it: random-32-32-20 has 409 rows, and 250 agents with 250 tasks take 500.
    """
    lines = maps.scenario(case).read_text().splitlines()
    if len(lines) - 1 >= max(RESERVED_ROWS, case.agents) + (case.tasks or 0):
        return maps.scenario(case)
    following = maps.scenario(case, case.scenario + 1)
    if not following.exists():
        return maps.scenario(case)
    longer = pathlib.Path(folder) / "longer.scen"
    longer.write_text("\n".join(lines + following.read_text().splitlines()[1:]) + "\n")
    return longer


def instance_arguments(grove, maps, case, folder):
    """How `grove solve` is told of the case, whose instance is made in the folder if need be."""
    if isinstance(case, FileCase):
        return [case.file]
    if isinstance(case, DrawnCase):
        return case.make(grove, folder)
    if case.tasks is None:
        return [maps.scenario(case), "--map", maps.map(case), "--agents", case.agents]
    instance = pathlib.Path(folder) / "instance.cts.json"
    run([grove, "generate", "instance", "--map", maps.map(case),
         "--scen", scenario_with_enough_rows(maps, case, folder),
         "--agents", case.agents, "--tasks", case.tasks, "--seed", case.scenario,
         "-o", instance, *(["--mg"] if case.mg else [])])
    return [instance]
