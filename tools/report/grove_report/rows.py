# SPDX-License-Identifier: MIT
"""Reads results of `grove bench`, `grove-mpi batch` or experiments.py: CSV files, JSON lines, or their directories."""
import csv
import json
import math
from pathlib import Path
from typing import NamedTuple, Optional

from .tables import text_of_cell

PROBLEMS = ("mg", "cts", "mixed", "mapf", "choices")
INVALID, CLAIMED, UNSUPPORTED = "invalid", "claimed", "unsupported"  # invalid plan; claim without plan; not supported
STATUSES = ("optimal", "bounded", "feasible", "infeasible", "unknown", "error", INVALID, CLAIMED, UNSUPPORTED)
STATUSES_WITH_PLAN = ("optimal", "bounded", "feasible")


# Names of counters in tables from before version 0.1, and their current names.
RENAMED_COUNTERS = {
    "batches": "node_batches", "facts_sent": "learned_bounds_sent", "gain_configurations": "gain_lacam",
    "gain_neighborhood": "gain_lns", "gain_priorities": "gain_prioritized", "helps": "assists",
    "joint_pairs": "joint_mdd_nodes", "path_sets_asked": "mdd_queries", "path_sets_known": "mdd_hits",
    "plans_configurations": "plans_lacam", "plans_neighborhood": "plans_lns", "plans_priorities": "plans_prioritized",
    "prices_asked": "branching_cost_queries", "prices_known": "branching_cost_hits",
    "prices_of_ranks": "remote_pricings", "primal_joint_steps": "primal_lacam_steps",
    "primal_neighborhoods": "primal_lns_iterations", "silent_ranks": "unresponsive_ranks",
    "splits_bar": "splits_vertex_edge", "splits_no_rest_by": "splits_cost", "splits_no_traversal": "splits_corridor",
    "splits_rest_by": "splits_target", "splits_stop_is_not": "splits_sequence",
    "trees_prepared_in_vain": "trees_prepared_unused"}


class BadInput(Exception):
    """An error in the input. The text is one line: file, place, what is wrong, what was expected."""


class Point(NamedTuple):
    """A plan found during a run, as the run reports it."""
    seconds: float
    cost: int
    lower_bound: Optional[int]


class Row(NamedTuple):
    """One run of one method on one instance. Times are in seconds, costs in time steps, memory in MB. None: absent."""
    instance: str
    method: str
    options: str
    map: str
    scenario: Optional[int]
    agents: int
    tasks: int
    problem: str
    omega: str  # canonical: "0", "0.01", "inf"; "" if the method has none
    seed: Optional[int]
    time_limit_s: float
    solved: bool
    status: str
    cost: Optional[int]
    lower_bound: Optional[int]
    gap: Optional[float]
    root_cost: Optional[int]
    sqr: Optional[float]
    runtime_s: float  # the time limit if the run is not solved
    wall_s: Optional[float]
    roots: Optional[int]
    rtsp_calls: Optional[int]
    nodes: Optional[int]
    low_level_calls: Optional[int]
    peak_memory_mb: Optional[float]
    version: str
    machine: str
    ended_at: str
    error: str
    ranks: Optional[int]
    threads: Optional[int]
    instance_digest: str  # digest of the instance files, because different instances can have the same id
    counts: dict  # {name: number} for the other counters of the search; empty if the run reports none
    first_plan_s: Optional[float]
    plan_file: str  # path relative to the working directory; "" if no plan was kept
    solver: str     # adapter of an external solver; "" for Grove
    claimed_cost: Optional[int]  # claimed_...: unchecked claims of an external solver
    claimed_lower_bound: Optional[int]
    claimed_s: Optional[float]
    anytime: bool   # the solver improves its plan until the time limit
    trace: tuple    # Points; empty if the run reports none
    certified: Optional[bool]  # None: no certificate was requested
    verify_s: Optional[float]
    proof_bytes: Optional[int]

    @property
    def ended_s(self):
        return self.runtime_s if self.wall_s is None else self.wall_s

    @property
    def bound_holds_for_all_plans(self):
        """Whether the lower bound holds for all plans, not only for plans without following conflicts."""
        return "--no-following" not in self.options


def printable(text):
    """Returns the text with lone surrogates escaped; file names and JSON strings can contain them."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def _text(value):
    if not isinstance(value, str):
        raise ValueError("a text")
    if value.isascii() and value.isprintable():
        return value
    return "".join(letter if letter.isprintable() else letter.encode("unicode_escape").decode()
                   for letter in value)


def _integer(value):
    """Reads an integer >= 0."""
    if isinstance(value, str) and value.isascii() and value.isdigit() and len(value) <= 18:
        return int(value)
    if isinstance(value, int) and not isinstance(value, bool) and value >= 0:
        return value
    raise ValueError("an integer of at least 0")


def _number(value):
    """Reads a finite number >= 0."""
    try:
        if isinstance(value, (str, int, float)) and not isinstance(value, bool):
            number = float(value)
            if math.isfinite(number) and number >= 0:
                return number
    except (ValueError, OverflowError):
        pass
    raise ValueError("a number of at least 0")


def _positive(value):
    try:
        number = _number(value)
    except ValueError:
        number = 0
    if number <= 0:
        raise ValueError("a number above 0")
    return number


def _omega(value):
    if value == "":
        return ""
    try:
        if isinstance(value, (str, int, float)) and not isinstance(value, bool):
            number = float(value)
            if number >= 0:  # false for nan
                return f"{number:g}"
    except (ValueError, OverflowError):
        pass
    raise ValueError("a number of at least 0, or inf")


def _boolean(value):
    known = {True: True, False: False, "true": True, "false": False}
    if not isinstance(value, (bool, str)) or value not in known:
        raise ValueError("true or false")
    return known[value]


def _one_of(words):
    def read(value):
        if value not in words:
            raise ValueError("one of " + ", ".join(words))
        return value
    return read


def _status(value):
    """Reads a status. Tables from before version 0.1 have different words for two of them."""
    return _one_of(STATUSES)({"wrong": INVALID, "unsuitable": UNSUPPORTED}.get(value, value))


def _counts(value):
    """Reads counters such as "bypasses=2 mdd_queries=77" and returns them with their current names."""
    try:
        pairs = [word.split("=") for word in value.split()]
        return {_text(RENAMED_COUNTERS.get(name, name)): _integer(number) for name, number in pairs}
    except (AttributeError, ValueError):
        raise ValueError("numbers as name=7, separated by blanks") from None


def _trace(value):
    """Reads a trace such as "0.25:120:100 1.5:118:-", whose words are seconds:cost:lower_bound."""
    try:
        words = [word.split(":") for word in value.split()]
        return tuple(Point(_number(seconds), _integer(cost), None if bound == "-" else _integer(bound))
                     for seconds, cost, bound in words)
    except (AttributeError, ValueError):
        raise ValueError("plans as seconds:cost:bound, separated by blanks") from None


# {column: (reader, value if absent)}. NEEDED instead of a value means that the column is required.
NEEDED = object()
COLUMNS = {
    "instance": (_text, NEEDED), "method": (_text, NEEDED), "options": (_text, ""),
    "map": (_text, NEEDED), "scenario": (_integer, None), "agents": (_integer, NEEDED),
    "tasks": (_integer, NEEDED), "problem": (_one_of(PROBLEMS), NEEDED), "omega": (_omega, ""),
    "seed": (_integer, None), "time_limit_s": (_positive, NEEDED), "solved": (_boolean, NEEDED),
    "status": (_status, NEEDED), "cost": (_integer, None),
    "lower_bound": (_integer, None), "gap": (_number, None), "root_cost": (_integer, None),
    "sqr": (_number, None), "runtime_s": (_number, NEEDED), "wall_s": (_number, None),
    "roots": (_integer, None), "rtsp_calls": (_integer, None), "nodes": (_integer, None),
    "low_level_calls": (_integer, None), "peak_memory_mb": (_number, None), "version": (_text, ""),
    "machine": (_text, ""), "ended_at": (_text, ""), "error": (_text, ""), "ranks": (_integer, None),
    "threads": (_integer, None), "instance_digest": (_text, ""), "counts": (_counts, {}),
    "first_plan_s": (_number, None), "plan_file": (_text, ""), "solver": (_text, ""),
    "claimed_cost": (_integer, None), "claimed_lower_bound": (_integer, None), "claimed_s": (_number, None),
    "anytime": (_boolean, False), "trace": (_trace, ()), "certified": (_boolean, None),
    "verify_s": (_number, None), "proof_bytes": (_integer, None),
}
assert tuple(COLUMNS) == Row._fields
_NAMES = tuple(COLUMNS)
_READERS = tuple(reader for reader, _ in COLUMNS.values())
_ABSENT = tuple(absent for _, absent in COLUMNS.values())


def _shown(value):
    text = value if isinstance(value, str) else json.dumps(value)
    text = text if len(text) <= 60 else text[:57] + "..."
    return "'" + text.encode("unicode_escape").decode("ascii") + "'"


class Unreadable(NamedTuple):
    """Represents a row without data about its instance, because grove bench could not read the instance."""
    instance: str


class CutOff(NamedTuple):
    """Represents an incomplete last line, because the benchmark was killed or is still running."""


_OF_INSTANCE = tuple(_NAMES.index(name) for name in ("map", "agents", "tasks", "problem"))


def _row(values, place):
    """Returns a Row or Unreadable. `values`: one value per column, in the order of COLUMNS; None or "" if absent."""
    if values[_NAMES.index("status")] == "error" and not any(values[at] for at in _OF_INSTANCE):
        return Unreadable(_text(str(values[0])))
    read = []
    for name, reader, absent, value in zip(_NAMES, _READERS, _ABSENT, values):
        if value is None or value == "":
            if absent is NEEDED:
                raise BadInput(f"{place}, column {name}: empty; expected a value")
            read.append(absent)
            continue
        try:
            read.append(reader(value))
        except ValueError as expected:
            raise BadInput(f"{place}, column {name}: found {_shown(value)}; expected {expected}") \
                from None
    row = Row._make(read)
    if row.solved and row.status not in STATUSES_WITH_PLAN:
        raise BadInput(f"{place}, column status: found '{row.status}' in a solved row; "
                       f"expected one of {', '.join(STATUSES_WITH_PLAN)}")
    if row.solved and row.cost is None:
        raise BadInput(f"{place}, column cost: empty in a solved row; expected an integer")
    sqr = row.sqr
    if row.solved and sqr is None and row.root_cost is not None:
        sqr = row.root_cost / row.cost if row.cost else 1.0  # if the cost is 0, so is the root cost
    return row._replace(runtime_s=row.runtime_s if row.solved else row.time_limit_s,
                        sqr=sqr if row.solved else None)


def row_of(found, place):
    """Returns the Row for a dictionary {column: value}. Ignores other keys. `place`: for error messages."""
    return _row([found.get(name) for name in _NAMES], place)


def _check_columns(found, place):
    missing = [name for name, (_, absent) in COLUMNS.items()
               if absent is NEEDED and name not in found]
    if missing:
        raise BadInput(f"{place}: missing column {', '.join(missing)}; "
                       "expected the columns that grove bench writes")
    twice = sorted({name for name in found if found.count(name) > 1})
    if twice:
        raise BadInput(f"{place}: found column {twice[0]} twice; expected it once")


def _read_csv(path, file):
    reader = csv.reader(file, strict=True)
    try:
        header = next(reader, None)
        if header is None:
            raise BadInput(f"{path}: empty; expected a line with the names of the columns")
        _check_columns(header, f"{path}: line 1")
        at = [header.index(name) if name in header else None for name in COLUMNS]
        for number, fields in enumerate(reader, 1):
            place = f"{path}: row {number} (line {reader.line_num})"
            if not fields:
                continue
            if len(fields) != len(header):
                raise BadInput(f"{place}: {len(fields)} columns; "
                               f"expected {len(header)} as in the first line")
            yield _row([None if index is None else text_of_cell(fields[index]) for index in at], place)
    except csv.Error as error:
        raise BadInput(f"{path}: line {reader.line_num}: not CSV: {error}") from None


def _read_json_lines(path, file):
    for number, line in enumerate(file, 1):
        place = f"{path}: row {number}"
        if not line.strip():
            continue
        try:
            found = json.loads(line)
        except (ValueError, RecursionError):
            if not line.endswith("\n"):
                yield CutOff()
                return
            raise BadInput(f"{place}: not JSON; expected one object a line") from None
        if not isinstance(found, dict):
            raise BadInput(f"{place}: found {_shown(found)}; expected a JSON object")
        yield row_of(found, place)


READERS = {".csv": _read_csv, ".jsonl": _read_json_lines}


def results_in(folder):
    """Returns the results file in a directory. Returns None if there is none."""
    for name in ("results.jsonl", "results.csv"):  # the same rows, but only the first file is always complete
        if (folder / name).exists():
            return folder / name
    return None


def _files(argument):
    path = Path(argument)
    if not path.exists():
        raise BadInput(f"{path}: no such file or directory")
    if not path.is_dir():
        if path.suffix not in READERS:
            raise BadInput(f"{path}: unknown file type; expected .csv, .jsonl or a directory")
        return path
    found = results_in(path)
    if found:
        return found
    raise BadInput(f"{path}: no results.jsonl and no results.csv in this directory; "
                   "expected what grove bench or grove-mpi batch writes")


def _read_file(path):
    try:
        with path.open(encoding="utf-8-sig", newline="" if path.suffix == ".csv" else None) as file:
            return list(READERS[path.suffix](path, file))
    except UnicodeDecodeError as error:
        raise BadInput(f"{path}: byte {error.start}: not UTF-8 text") from None
    except OSError as error:
        raise BadInput(f"{path}: cannot be read: {error.strerror}") from None


def _without_repeats(rows):
    """Returns (rows without repetitions, number of omitted rows).

    Keeps the row that ended last among rows with the same problem, instance, method, omega, limit and seed.
    """
    kept = {}
    for row in rows:
        key = (row.problem, row.instance, row.method, row.omega, row.time_limit_s, row.seed)
        if key not in kept or row.ended_at >= kept[key].ended_at:
            kept[key] = row
    return list(kept.values()), len(rows) - len(kept)


class Results(NamedTuple):
    rows: list
    files: list     # (path as text, number of rows)
    cut_off: list   # paths of files with an incomplete last line, which was omitted
    repeated: int   # number of rows that were omitted because a later row repeats their run
    unreadable: list  # instances that grove bench could not read; their rows were omitted


NO_RESULTS = Results([], [], [], 0, [])


def read_results(arguments):
    """Reads the rows of all files and directories and returns the Results, sorted. Raises BadInput."""
    files = list(dict.fromkeys(_files(argument) for argument in arguments))
    rows, counts, cut_off, unreadable = [], [], [], []
    for path in files:
        read = _read_file(path)
        found = [row._replace(plan_file=str(path.parent / row.plan_file)) if row.plan_file else row
                 for row in read if isinstance(row, Row)]
        counts.append((printable(str(path)), len(found)))
        cut_off += [counts[-1][0] for row in read if isinstance(row, CutOff)]
        unreadable += [row.instance for row in read if isinstance(row, Unreadable)]
        rows += found
    if not rows:
        raise BadInput(f"{', '.join(path for path, _ in counts)}: no rows; expected at least one")
    kept, repeated = _without_repeats(rows)
    # Sorts the rows, because the result must not depend on the order in which runs ended.
    kept.sort(key=lambda row: (row.problem, row.map, row.agents, row.tasks, row.scenario or 0,
                               row.instance, row.method, row.omega, row.time_limit_s,
                               -1 if row.seed is None else row.seed))
    return Results(kept, counts, cut_off, repeated, sorted(set(unreadable)))
