# SPDX-License-Identifier: MIT
"""Writes submissions to MAPF Tracker and reads its best known costs and bounds.

MAPF Tracker (tracker.pathfinding.ai) is an archive of the best plans and bounds for the Moving AI scenarios.
"""
import csv
import io
import json
import re
import sys
from collections import Counter
from pathlib import Path
from typing import NamedTuple, Optional

from .groups import grouped
from .lines import line_of
from .metrics import best_bounds, has_plan
from .plans import BadPlan, cost_of, motion_string, read_plan
from .rows import BadInput

MAPS = frozenset("""\
Berlin_1_256 Boston_0_256 Paris_1_256 brc202d den312d den520d empty-16-16 empty-32-32 empty-48-48 empty-8-8 ht_chantry
ht_mansion_n lak303d lt_gallowstemplar_n maze-128-128-1 maze-128-128-10 maze-128-128-2 maze-32-32-2 maze-32-32-4
orz900d ost003d random-32-32-10 random-32-32-20 random-64-64-10 random-64-64-20 room-32-32-4 room-64-64-16
room-64-64-8 w_woundedcoast warehouse-10-20-10-2-1 warehouse-10-20-10-2-2 warehouse-20-40-10-2-1
warehouse-20-40-10-2-2""".split())
SCENARIO = re.compile(r"(.+)-(even|random)-([0-9]{1,6})")
COLUMNS = ["map_name", "scen_type", "type_id", "agents", "lower_cost", "solution_cost", "flip_up_down", "solution_plan"]
ABSENT = ("", "null", "undefined", None)  # missing values in downloads from MAPF Tracker


class Place(NamedTuple):
    """An instance: the first `agents` rows of a scenario."""
    map: str
    type: str
    number: int
    agents: int


def place_of(row):
    """Returns the Place of a row. Returns None if the instance is not named as rows of a Moving AI scenario."""
    name = row.instance.rsplit("/", 1)[-1]
    found = SCENARIO.fullmatch(name.removesuffix(f"-{row.agents}"))
    if row.problem != "mapf" or not name.endswith(f"-{row.agents}") or not found or found[1] != row.map:
        return None
    return Place(row.map, found[2], int(found[3]), row.agents) if row.map in MAPS else None


# --- Submissions ---

class Submission(NamedTuple):
    text: str
    rows: int
    omitted: Counter  # {reason: number of runs}


def _lower_bound(rows, cost):
    """Returns the highest bound, proven or claimed, that does not exceed `cost`. Returns None if there is none."""
    bounds = [bound for row in rows if row.bound_holds_for_all_plans
              for bound in (row.lower_bound, row.claimed_lower_bound)
              if bound is not None and bound <= cost]
    return max(bounds, default=None)


def _best_plan(rows, omitted):
    """Returns (cost, motion strings) of the cheapest plan whose file still agrees with its row.

    Returns None if there is none.
    """
    for row in sorted(rows, key=lambda row: (row.cost, row.seed or 0)):
        try:
            paths = read_plan(Path(row.plan_file), row.agents)
            cost = cost_of(paths)
            if cost != row.cost:
                raise BadPlan(f"costs {cost}; expected {row.cost} as in the row")
            return row.cost, [motion_string(path) for path in paths]
        except BadPlan as error:
            omitted[f"{row.plan_file}: {error}"] += 1
    return None


def _why_not(row):
    if row.problem != "mapf":
        return "not classical MAPF"
    if place_of(row) is None:
        return ("not of a scenario of the Moving AI benchmark "
                "(expected the name MAP-even-N-AGENTS or MAP-random-N-AGENTS)")
    if not has_plan(row):
        return f"without a checked plan (status {row.status})"
    return "" if row.plan_file else "without a plan file (grove bench --keep-plans)"


def submission(rows, best):
    """Returns the Submission with the cheapest plan for each instance.

    rows: the rows of one method. best: best_costs() of all rows; bounds above these costs are omitted.
    """
    omitted = Counter()
    fit = []
    for row in rows:
        why = _why_not(row)
        omitted[why] += bool(why)
        fit += [] if why else [row]
    file = io.StringIO(newline="")
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(COLUMNS)
    count = 0
    for place, group in sorted(grouped(fit, place_of).items()):
        found = _best_plan(group, omitted)
        if not found:
            continue
        cost, motions = found
        bound = _lower_bound(group, min(best[row.problem, row.instance] for row in group))
        writer.writerow([*place, "" if bound is None else bound, cost, "FALSE", "\n".join(motions)])
        omitted["not the cheapest plan of the instance"] += len(group) - 1
        count += 1
    return Submission(file.getvalue(), count, +omitted)


# --- Downloads ---

class Known(NamedTuple):
    bound: Optional[int]
    cost: Optional[int]


def _named(path):
    """Returns the columns that the file name, such as MAP.csv or MAP-even-3.csv, determines for all its rows."""
    found = SCENARIO.fullmatch(path.stem)
    return {"map_name": found[1], "scen_type": found[2], "type_id": found[3]} if found else {"map_name": path.stem}


def _whole(value, place, column):
    if value in ABSENT:
        return None
    if isinstance(value, int) and not isinstance(value, bool) and value >= 0:
        return value
    if isinstance(value, str) and value.isascii() and value.isdigit() and len(value) <= 15:
        return int(value)
    raise BadInput(f"{place}, {column}: found '{str(value)[:40]}'; expected an integer of at least 0")


def _known_row(found, place):
    """Returns (Place, Known) for one row of a download. Raises BadInput."""
    for column in ("map_name", "scen_type", "type_id", "agents"):
        if found.get(column) in ABSENT:
            raise BadInput(f"{place}: missing {column}; expected the columns of a download of MAPF Tracker, "
                           "or a file named MAP.csv or MAP-TYPE-NUMBER.csv")
    numbers = {column: _whole(found.get(column), place, column)
               for column in ("type_id", "agents", "lower_cost", "solution_cost")}
    return (Place(str(found["map_name"]), str(found["scen_type"]), numbers["type_id"], numbers["agents"]),
            Known(numbers["lower_cost"], numbers["solution_cost"]))


def _csv_rows(path, text):
    csv.field_size_limit(min(sys.maxsize, 2**31 - 1))  # because plans for a thousand agents are long
    reader = csv.DictReader(io.StringIO(text, newline=""), strict=True)
    try:
        header = reader.fieldnames or []
        for column in ("agents", "lower_cost", "solution_cost"):
            if column not in header:
                raise BadInput(f"{path}: line 1: missing column {column}; "
                               "expected the columns of a download of MAPF Tracker")
        for row in reader:
            yield f"{path}: line {reader.line_num}", row
    except csv.Error as error:
        raise BadInput(f"{path}: line {reader.line_num}: not CSV: {error}") from None


def _json_rows(path, text):
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        raise BadInput(f"{path}: not JSON; expected a list of objects") from None
    for number, row in enumerate(found if isinstance(found, list) else [found], 1):
        if not isinstance(row, dict):
            raise BadInput(f"{path}: entry {number}: expected an object")
        yield f"{path}: entry {number}", row


def _files(argument):
    path = Path(argument)
    if not path.exists():
        raise BadInput(f"{path}: no such file or directory")
    files = sorted(each for each in path.iterdir() if each.suffix in (".csv", ".json")) if path.is_dir() else [path]
    if not files or files[0].suffix not in (".csv", ".json"):
        raise BadInput(f"{path}: expected a .csv or .json of MAPF Tracker, or a directory with such files")
    return files


def _better(one, other):
    return Known(max((bound for bound in (one.bound, other.bound) if bound is not None), default=None),
                 min((cost for cost in (one.cost, other.cost) if cost is not None), default=None))


def read_known(arguments):
    """Returns {Place: Known} for all files, with the best values if files overlap."""
    known = {}
    for path in (path for argument in arguments for path in _files(argument)):
        try:
            text = path.read_text(encoding="utf-8-sig")
        except UnicodeDecodeError as error:
            raise BadInput(f"{path}: byte {error.start}: not UTF-8 text") from None
        except OSError as error:
            raise BadInput(f"{path}: cannot be read: {error.strerror}") from None
        for place, row in (_json_rows if path.suffix == ".json" else _csv_rows)(path, text):
            key, found = _known_row(_named(path) | {name: value for name, value in row.items() if value not in ABSENT},
                                    place)
            known[key] = _better(found, known.get(key, Known(None, None)))
    return known


class Comparison(NamedTuple):
    """Best cost and bound of a line on one instance, with the best known cost and bound."""
    instance: str
    place: Place
    known: Known
    line: object
    cost: Optional[int]   # cost of the cheapest checked plan
    bound: Optional[int]  # highest proven lower bound

    @property
    def cost_ratio(self):
        return self.cost / self.known.cost if self.cost is not None and self.known.cost else None

    @property
    def better_plan(self):
        return None not in (self.cost, self.known.cost) and self.cost < self.known.cost

    @property
    def higher_bound(self):
        return None not in (self.bound, self.known.bound) and self.bound > self.known.bound

    @property
    def closes(self):
        """Whether the line proves an optimum that the archive does not have."""
        is_open = self.known.cost is None or self.known.bound is None or self.known.bound < self.known.cost
        best = min(cost for cost in (self.cost, self.known.cost) if cost is not None) \
            if (self.cost, self.known.cost) != (None, None) else None
        return is_open and None not in (best, self.bound) and self.bound == best


def known_of(rows, known):
    """Returns {(problem, instance): Known} for the instances that the archive has."""
    places = {(row.problem, row.instance): place_of(row) for row in rows}
    return {key: known[place] for key, place in places.items() if place in known}


def comparisons(rows, known):
    """Returns a Comparison for each line on each instance that is in the archive. `known`: read_known()."""
    found = []
    groups = grouped(rows, lambda row: (row.problem, row.instance, line_of(row)))
    for (_, instance, line), group in groups.items():
        place = place_of(group[0])
        if place not in known:
            continue
        found.append(Comparison(instance, place, known[place], line,
                                min((row.cost for row in group if has_plan(row)), default=None),
                                next(iter(best_bounds(group).values()), None)))
    return sorted(found, key=lambda each: (each.place, each.line))
