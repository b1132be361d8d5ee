# SPDX-License-Identifier: MIT
"""Builds a report: tables and figures for each problem, the study of omega, and notes."""
import itertools
import re
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from . import anytime, curves, figures, metrics, proofs, tracker
from .counters import counters_by_line
from .groups import grouped, values_by
from .lines import GROVE, Lines, families, line_of, method_name, omega_text, omega_value, seconds_text
from .rows import PROBLEMS, UNSUPPORTED, BadInput
from .speedup import ALL_MAPS, hard_instances, speedups
from .style import style_of
from .tables import csv_text

PROBLEM_NAMES = {"mg": "MG-MAPF (agents without destinations)",
                 "cts": "CTS-MAPF (agents with tasks and destinations)",
                 "mixed": "mixed (some agents with a destination, some without)",
                 "mapf": "classical MAPF (destinations, no tasks)",
                 "choices": "choices (agents choose tasks or destinations)"}
# Maximum number of columns of a comparison that are readable side by side on a narrow screen.
WIDEST = 3
# Names of the files of a report. make_report() removes such files of an earlier report from the directory.
OWN_FILE = re.compile(rf"((summary|comparison|success|anytime|common|cactus|splits|search|speedup|only_solver)_"
                      rf"({'|'.join(PROBLEMS)})|omega_study|runs|bound_sources)(_[0-9]+)?\.(svg|png|csv)"
                      r"|(contradictions|false_claims|best_known)\.csv")


class Figure(NamedTuple):
    stem: str     # file name without suffix
    title: str
    svg: str


class Problem(NamedTuple):
    """Measures, figures and tables of the rows of one problem."""
    name: str
    lines: list
    rows: list
    by_line: dict       # {line: Measures}
    configurations: dict  # {configuration: {line: Measures}}
    instances: int
    only: dict          # {line: [row]}: only_solver()
    beyond: dict        # {line: number}: beyond_baselines()
    speedups: list
    hard: int           # number of hard_instances()
    comparison: list    # Figures
    cactus: Figure
    success: object     # Figure; None: no map has several numbers of agents
    anytime: object     # Figure; None: no line is anytime
    panels: list        # Panels of the figure `anytime`
    counters: dict      # {line: Counters}
    splits: object      # Figure; None: no run reports splits


class Study(NamedTuple):
    """Study of one family of lines that differ only in omega."""
    problem: str
    family: object      # Family
    lines: list         # lines of the family, then of Grove's own search for comparison
    map: str            # map of the figure
    agents: int         # number of agents in the figure
    configurations: dict  # {configuration: {line: Measures}} for all maps and numbers of agents
    figure: Figure


class BestKnown(NamedTuple):
    """Comparison of the rows with MAPF Tracker."""
    files: tuple
    entries: int        # number of entries read
    found: list         # tracker.Comparison


class Report(NamedTuple):
    results: object
    lines: Lines
    problems: list
    studies: list
    contradictions: list
    false_claims: list
    best_known: object  # BestKnown; None: not requested
    runs: object        # Figure of the logs; None: no logs
    bound_sources: object  # Figure; None: no log names the sources of its lower bound
    logs: list
    agreements: int     # number of instances with a proven optimum from several methods
    errors: list        # (line, number of errors, most frequent message)
    notes: list         # texts
    files: dict         # {name: bytes}, as written to the directory


class Looks:
    """Labels and styles of lines, for figures."""

    def __init__(self, lines):
        self.label = lines.label
        self.name = lines.name
        self._lines = lines

    def style(self, line):
        return style_of(self._lines.index(line), self._lines.is_baseline(line))


class Output:
    """Output directory of a report. Writes files and keeps their contents for the page."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.files = {}  # {name: bytes}

    def figure(self, stem, title, figure):
        svg, png = figures.drawn(figure)
        self._write(f"{stem}.svg", svg.encode("utf-8"))
        self._write(f"{stem}.png", png)
        return Figure(stem, title, svg)

    def table(self, stem, header, rows):
        self._write(f"{stem}.csv", csv_text(header, rows).encode("utf-8"))

    def _write(self, name, content):
        (self.folder / name).write_bytes(content)
        self.files[name] = content

    def remove_others(self):
        """Removes files of an earlier report that this report did not write, such as those for other problems."""
        for path in self.folder.iterdir():
            if path.name not in self.files and OWN_FILE.fullmatch(path.name):
                path.unlink()


def _parts(configurations):
    """Divides the configurations into groups whose columns fit side by side. Does not divide a map that fits into one
    group."""
    columns = figures.columns_of(configurations)
    parts = [[]]
    for _, group in itertools.groupby(columns.keys, key=lambda key: key[0]):
        keys = list(group)
        for chunk in (keys[at:at + WIDEST] for at in range(0, len(keys), WIDEST)):
            if len(parts[-1]) + len(chunk) > WIDEST:
                parts.append([])
            parts[-1] += chunk
    return [{configuration: found for configuration, found in configurations.items()
             if columns.key_of(configuration) in keys}
            for keys in parts if keys]


def _comparison_figures(output, problem, configurations, lines, looks):
    parts = _parts(configurations)
    for number, part in enumerate(parts, 1):
        stem = f"comparison_{problem}" + (f"_{number}" if len(parts) > 1 else "")
        maps = ", ".join(sorted({configuration.map for configuration in part}))
        yield output.figure(stem, f"Success rate, mean runtime and quality on {maps}",
                            figures.comparison(part, configurations, lines, looks))


def _cactus_figure(output, problem, runs, lines, looks):
    rows = [row for by_line in runs.values() for row in by_line.values()]
    maps = sorted({row.map for row in rows})
    groups = {"all maps" if len(maps) > 1 else maps[0]: metrics.by_line(rows)}
    if 1 < len(maps) <= 11:
        groups |= {name: metrics.by_line([row for row in rows if row.map == name])
                   for name in maps}
    return output.figure(f"cactus_{problem}", "Instances solved by a given time",
                         figures.cactus(groups, lines, looks))


def _splits_figure(output, problem, counters, lines, looks):
    shown = [line for line in lines if line in counters and counters[line].splits()]
    if not shown:
        return None
    return output.figure(f"splits_{problem}", "What nodes were split on", figures.splits(counters, shown, looks))


def _success_figure(output, problem, rows, best, lines, looks):
    """Makes the figure and table of success rates by map and number of agents, over all numbers of tasks.

    Returns None if no map has several numbers of agents.
    """
    groups = {name: {agents: metrics.measures_by_line(found, best) for agents, found in sorted(
                     grouped(group, lambda row: row.agents).items())}
              for name, group in sorted(grouped(rows, lambda row: row.map).items())}
    if all(len(by_agents) == 1 for by_agents in groups.values()):
        return None
    figure = output.figure(f"success_{problem}", "Success rate over the number of agents",
                           curves.success(groups, lines, looks))
    output.table(f"success_{problem}", ["map", "agents", *LINE_COLUMNS, "instances", "seeds", "runs", "solved",
                                        "success_rate"],
                 [[name, agents, *line, each.instances, each.seeds, each.runs, each.solved, each.success]
                  for name, by_agents in groups.items() for agents, found in by_agents.items()
                  for line, each in found.items()])
    return figure


def _anytime_figure(output, problem, panels, lines, looks):
    if not panels:
        return None
    shown = [line for line in lines if any(line in panel.curves for panel in panels)]
    figure = output.figure(f"anytime_{problem}", "Quality over time", curves.anytime(panels, shown, looks))
    rows = []
    for panel in panels:
        for line in shown:
            if line in panel.curves:
                moments = [(time, panel.curves[line].at(time)) for time in anytime.table_times(line.time_limit_s)]
                rows += [[panel.title, *line, time, panel.instances, panel.common, *step[1:]]
                         for time, step in moments if step]
    output.table(f"anytime_{problem}",
                 ["panel", *LINE_COLUMNS, "time_s", "instances", "common", *ANYTIME_COLUMNS], rows)
    return figure


ANYTIME_COLUMNS = ["with_plan", "common_with_plan", "mean_cost_ratio", "mean_cost_over_bound", "mean_bound_ratio"]
COMMON_COLUMNS = ["common", "common_mean_cost", "common_median_cost", "common_cost_ratio", "common_mean_s",
                  "common_median_s", "common_sqr"]
LINE_COLUMNS = ["method", "omega", "time_limit_s"]
MEASURE_COLUMNS = ["success_rate" if name == "success" else name for name in metrics.Measures._fields]


def _problem(output, name, rows, best, bounds, lines, looks):
    here = metrics.by_line(rows)
    ordered = [line for line in lines.all if line in here]
    configurations = metrics.by_configuration(rows, best)
    runs = metrics.median_runs(rows)
    counters = counters_by_line(rows)
    panels = anytime.panels(rows, best, bounds)
    problem = Problem(
        name, ordered, rows, metrics.measures_by_line(rows, best), configurations,
        len(runs), metrics.only_solver(runs), metrics.beyond_baselines(runs, lines.is_baseline),
        speedups(runs, lines.is_baseline), len(hard_instances(runs, lines.is_baseline)),
        list(_comparison_figures(output, name, configurations, ordered, looks)),
        _cactus_figure(output, name, runs, ordered, looks),
        _success_figure(output, name, rows, best, ordered, looks),
        _anytime_figure(output, name, panels, ordered, looks), panels,
        counters, _splits_figure(output, name, counters, ordered, looks))
    _write_tables(output, problem, lines)
    return problem


def _write_tables(output, problem, lines):
    name, ordered = problem.name, problem.lines
    output.table(f"summary_{name}",
                 [*LINE_COLUMNS, "baseline", *MEASURE_COLUMNS, "solved_by_it_alone",
                  "solved_by_no_baseline"],
                 [[*line, str(lines.is_baseline(line)).lower(), *problem.by_line[line],
                   len(problem.only.get(line, ())), problem.beyond.get(line, 0)]
                  for line in ordered])
    output.table(f"comparison_{name}",
                 ["map", "agents", "tasks", *LINE_COLUMNS, *MEASURE_COLUMNS],
                 [[*configuration, *line, *found[line]] for configuration, found in problem.configurations.items()
                  for line in ordered if line in found])
    output.table(f"common_{name}", ["map", "agents", "tasks", *LINE_COLUMNS, *COMMON_COLUMNS],
                 [[*configuration, *line, *(getattr(found[line], column) for column in COMMON_COLUMNS)]
                  for configuration, found in problem.configurations.items() for line in ordered
                  if line in found and found[line].common_mean_cost is not None])
    output.table(f"speedup_{name}",
                 ["map", "baseline", "baseline_omega", "method", "omega", "time_limit_s",
                  "instances", "median_ratio", "ratio_is", "baseline_median_s", "method_median_s",
                  "baseline_failed", "method_failed"],
                 [["all" if found.map == ALL_MAPS else found.map, found.baseline.method,
                   found.baseline.omega, *found.line, *found[3:]] for found in problem.speedups])
    output.table(f"only_solver_{name}",
                 [*LINE_COLUMNS, "map", "agents", "tasks", "instance", "runtime_s"],
                 [[*line, row.map, row.agents, row.tasks, row.instance, row.runtime_s]
                  for line in ordered for row in problem.only.get(line, ())])
    if problem.counters:
        names = sorted({counter for each in problem.counters.values() for counter in each.totals})
        output.table(f"search_{name}", [*LINE_COLUMNS, "runs", *names],
                     [[*line, found.runs, *(found.totals.get(counter, 0) for counter in names)]
                      for line, found in problem.counters.items()])


def _shown_configuration(configurations, wanted_map, wanted_agents):
    """Returns map and N for the figure of a study.

    They are the wanted ones or, by default, the first room map (or else the first map) and N = 5 (or else the least N).
    """
    maps = sorted({configuration.map for configuration in configurations})
    name = wanted_map or next((name for name in maps if name.startswith("room")), maps[0])
    sizes = sorted({configuration.agents for configuration in configurations if configuration.map == name})
    if wanted_agents is not None:
        return name, wanted_agents
    return name, 5 if 5 in sizes else sizes[0] if sizes else None


def _setting(problem, family, map_name, agents, rows):
    scenarios = len({row.instance for row in rows})
    limits = sorted({line.time_limit_s for line in family.lines})
    return [family.name, PROBLEM_NAMES[problem].split(" (")[0], f"map {map_name}, N = {agents}",
            f"{scenarios} instances",
            "time limit " + ", ".join(map(seconds_text, limits))]


def _studies(output, rows_of, best, looks, options):
    """Returns the Studies of the first problem that has lines which differ only in omega.

    CTS-MAPF comes first, as in the paper. Classical MAPF is excluded, because the x axis is the number of tasks.
    """
    for name in ("cts", "mg", "mixed"):
        rows = rows_of.get(name, [])
        found = families(rows, options.study_methods)
        stems = [f"omega_study_{number}" if len(found) > 1 else "omega_study"
                 for number in range(1, len(found) + 1)]
        studies = [_study(output, name, family, rows, best, looks, options, stem)
                   for family, stem in zip(found, stems)]
        if any(studies):
            return [study for study in studies if study]
    if (options.study_methods, options.study_map, options.study_agents) != (None, None, None):
        raise BadInput("--study, --study-map, --study-agents: no rows with several omegas are left; "
                       "expected methods, a map and a number of agents with such rows")
    return []


def _beside(family, rows):
    """Returns the lines of Grove's own search with the family's time limits that are not in the family."""
    limits = {line.time_limit_s for line in family.lines}
    found = {line_of(row) for row in rows if method_name(row.method) == GROVE and row.time_limit_s in limits}
    return sorted(found - set(family.lines))


def _study(output, problem, family, rows, best, looks, options, stem):
    lines = [*family.lines, *_beside(family, rows)]
    places = {(row.map, row.agents, row.tasks) for row in rows if line_of(row) in family.lines}
    rows = [row for row in rows if line_of(row) in lines and (row.map, row.agents, row.tasks) in places]
    configurations = metrics.by_configuration(rows, best)
    map_name, agents = _shown_configuration(configurations, options.study_map, options.study_agents)
    shown = {configuration: found for configuration, found in configurations.items()
             if (configuration.map, configuration.agents) == (map_name, agents)}
    if not shown:
        return None
    setting = _setting(problem, family, map_name, agents,
                       [row for row in rows if (row.map, row.agents) == (map_name, agents)])
    figure = output.figure(stem, f"The influence of ω: {family.name}",
                           figures.omega_study(shown, family.lines, lines, looks, setting))
    output.table(stem, ["map", "agents", "tasks", *LINE_COLUMNS, *MEASURE_COLUMNS],
                 [[*configuration, *line, *found[line]] for configuration, found in configurations.items()
                  for line in lines if line in found])
    return Study(problem, family, lines, map_name, agents, configurations, figure)


def _errors(rows, lines):
    found = metrics.by_line(row for row in rows if row.status == "error")
    return [(line, len(found[line]), Counter(row.error for row in found[line]).most_common(1)[0][0])
            for line in lines.all if line in found]


def _listed(values, most=6, between=", "):
    values = list(values)
    return between.join(values[:most]) + (f" and {len(values) - most} more" if values[most:] else "")


def _omegas(problem, lines):
    """Yields a note such as 'ω = 0: a, b; ω = 0.01: c' if the lines of a problem differ in omega."""
    methods = grouped(problem.lines, lambda line: line.omega)
    if len(methods) > 1:
        yield "; ".join(f"{omega_text(omega)}: {_listed(map(lines.name, methods[omega]))}"
                        for omega in sorted(methods, key=omega_value))


def _guarantee(line, solved, lines):
    """Yields notes on solved rows of a line that do not prove the tolerance omega, or have no guarantee."""
    outside = [row for row in solved if metrics.within_omega(row) is False]
    unproven = [row
                for row in solved if not row.solver and line.omega in metrics.NO_PROMISE and row.status != "optimal"]
    statuses = "status " + ", ".join(sorted({row.status for row in outside or unproven}))
    if outside:
        yield (f"{lines.label(line)}: {len(outside)} of {len(solved)} solved runs are outside ω "
               f"({statuses}): no proof that the plan costs at most (1 + ω) times the least possible.")
    if unproven:
        yield (f"{lines.label(line)}: no guarantee; {len(unproven)} of {len(solved)} solved runs are not "
               f"proven optimal ({statuses}).")


def _notes(results, rows, lines, problems):
    """Yields the notes that a reader needs before comparing methods."""
    for problem in problems:
        for omegas in _omegas(problem, lines):
            yield (f"{PROBLEM_NAMES[problem.name].split(' (')[0]}: methods with different ω are compared "
                   f"({omegas}). The larger ω, the less there is to prove: success rates, times and "
                   "speed-ups are comparable only to a limited extent.")
    solved = metrics.by_line([row for row in rows if row.solved])
    for line in lines.all:
        yield from _guarantee(line, solved.get(line, []), lines)
    others = sorted({lines.label(line_of(row)) for row in rows if row.solver})
    if others:
        yield (f"Guarantees of other solvers are not checked here ({_listed(others, 12)}). Only the validity of their "
               "plans and the costs are checked.")
    limits = sorted({row.time_limit_s for row in rows})
    if len(limits) > 1:
        yield (f"The rows have several time limits ({_listed(map(seconds_text, limits))}). No figure "
               "mixes them: a method with several limits has a line for each. Mean runtimes and PAR-2 are "
               "not comparable between different limits.")
    seeds = sorted({row.seed for row in rows if row.seed is not None})
    if len(seeds) > 1:
        yield (f"The rows have several seeds ({_listed(map(str, seeds))}). Runs that differ only in the "
               "seed are repetitions: rates and means are taken over these first, then over instances. Where "
               "instances are counted or compared one by one, the median run represents its instance.")
    for what, values in (("versions", {row.version for row in rows} - {""}),
                         ("machines", {row.machine for row in rows} - {""}),
                         ("numbers of ranks", {str(row.ranks) for row in rows if row.ranks is not None}),
                         ("numbers of threads", {str(row.threads) for row in rows
                                                 if row.threads is not None})):
        if len(values) > 1:
            yield (f"The rows come from runs with several {what} ({_listed(sorted(values))}): "
                   "times are comparable only to a limited extent.")
    digests = values_by((row for row in rows if row.instance_digest), lambda row: (row.problem, row.instance),
                        lambda row: row.instance_digest)
    ambiguous = sorted(instance for (_, instance), found in digests.items() if len(found) > 1)
    if ambiguous:
        yield (f"One name stands for several instances, or an instance has changed between runs: "
               f"{_listed(ambiguous)}. Rows of these instances are not comparable.")
    for path in results.cut_off:
        yield (f"{path}: the last line is cut off and was omitted; the bench was killed, or still "
               "runs.")
    if results.unreadable:
        yield (f"Instances that could not be read: {_listed(results.unreadable)}. Their rows were "
               "omitted.")
    if results.repeated:
        yield (f"{results.repeated} rows were omitted: a later row repeats the run (the same instance, "
               "method, ω, time limit and seed).")
    options = values_by(rows, line_of, lambda row: row.options)
    for line in lines.all:
        if len(options[line]) > 1:
            yield (f"{lines.label(line)} was run with different options: "
                   f"{_listed(sorted(options[line]), 3)}.")
    for problem in problems:
        tried = values_by(problem.rows, line_of, lambda row: row.instance)
        partial = [f"{lines.label(line)}: {len(tried[line])}" for line in problem.lines
                   if len(tried[line]) < problem.instances]
        if partial:
            yield (f"{PROBLEM_NAMES[problem.name].split(' (')[0]}: not every method was run on all "
                   f"{problem.instances} instances ({_listed(partial, 12, '; ')}). Cells without runs are "
                   "gaps. Totals are comparable only between methods with equally many runs.")


def _unsupported(rows):
    """Yields notes on instances that a method does not support."""
    found = grouped([row for row in rows if row.status == UNSUPPORTED], lambda row: row.method)
    for method, group in sorted(found.items()):
        why = Counter(row.error for row in group).most_common(1)[0][0]
        yield (f"{method_name(method)} does not support {len(group)} of the instances, which are omitted for it: "
               f"{why}.")


MOST_PANELS = 30  # of a figure of logs; its table has all logs


def _runs_figure(output, logs):
    if not logs:
        return None
    named = {run.instance for run in logs}
    short = {name: Path(name).name for name in named} if len({Path(name).name for name in named}) == len(named) \
        else {name: name for name in named}
    # An instance from a scenario is its first N rows, so the title needs N.
    groups = grouped(logs, lambda run: short[run.instance]
                     + (f", N = {run.agents}" if run.instance.endswith(".scen") else ""))
    output.table("runs", ["log", "instance", "agents", "options", "status", "time_s", "cost", "lower_bound"],
                 [[run.name, run.instance, run.agents, run.options, run.status, *moment]
                  for run in logs for moment in run.moments])
    shown = dict(list(groups.items())[:MOST_PANELS])
    return output.figure("runs", "Bound and plan of single runs", curves.runs(shown))


def _bound_sources_figure(output, logs):
    logs = [run for run in logs if run.shares()]
    if not logs:
        return None
    output.table("bound_sources", ["log", "time_s", "lower_bound", "source", "steps"],
                 [[run.name, rise.seconds, rise.bound, source, steps]
                  for run in logs for rise in run.rises for source, steps in rise.steps.items()])
    return output.figure("bound_sources", "Sources of the lower bound", curves.sources(logs[:MOST_PANELS]))


BEST_KNOWN_COLUMNS = ["map_name", "scen_type", "type_id", "agents", *LINE_COLUMNS, "best_known_bound",
                      "best_known_cost",
                      "cost", "lower_bound", "cost_ratio", "better_plan", "higher_bound", "closes"]


def _best_known(output, rows, options):
    if not options.known_files:
        return None
    found = tracker.comparisons(rows, options.known)
    output.table("best_known", BEST_KNOWN_COLUMNS, [
        [*each.place, *each.line, *each.known, each.cost, each.bound, each.cost_ratio,
         *(str(flag).lower() for flag in (each.better_plan, each.higher_bound, each.closes))] for each in found])
    return BestKnown(options.known_files, len(options.known), found)


class Options(NamedTuple):
    baselines: tuple
    problems: tuple           # problems to report; empty: all in the results
    study_methods: object     # methods of the study; None: lines whose options differ only in omega
    study_map: object         # None: a room map if there is one, otherwise the first map
    study_agents: object      # None: 5 if available, otherwise the smallest number
    known_files: tuple = ()   # downloads of MAPF Tracker
    known: object = None      # {Place: Known} of these files


def make_report(results, logs, options, folder):
    """Writes all figures and tables to `folder`, removes files of an earlier report, and returns the Report."""
    everything = [row for row in results.rows if not options.problems or row.problem in options.problems]
    rows = [row for row in everything if row.status != UNSUPPORTED]
    lines = Lines(rows, options.baselines)
    looks, output = Looks(lines), Output(folder)
    rows_of = grouped(rows, lambda row: row.problem)
    known = tracker.known_of(rows, options.known or {})
    known_costs = {key: each.cost for key, each in known.items() if each.cost is not None}
    known_bounds = {key: each.bound for key, each in known.items() if each.bound is not None}
    best, bounds = metrics.best_costs(rows, known_costs), metrics.best_bounds(rows, known_bounds)
    studies = _studies(output, rows_of, best, looks, options)  # first: raises BadInput if options match no rows
    problems = [_problem(output, name, rows_of[name], best, bounds, lines, looks)
                for name in PROBLEMS if name in rows_of]
    contradictions = proofs.contradictions(rows, known)
    output.table("contradictions", proofs.Contradiction._fields, contradictions)
    false_claims = proofs.false_claims(rows, known_costs)
    output.table("false_claims", proofs.FalseClaim._fields, false_claims)
    best_known, runs = _best_known(output, rows, options), _runs_figure(output, logs)
    bound_sources = _bound_sources_figure(output, logs)
    output.remove_others()
    notes = [*_notes(results, rows, lines, problems), *_unsupported(everything)]
    return Report(results._replace(rows=rows), lines, problems, studies, contradictions, false_claims, best_known,
                  runs, bound_sources, logs, proofs.optimal_agreements(rows), _errors(rows, lines), notes, output.files)
