# SPDX-License-Identifier: MIT
"""Reads lower bound, its sources and plan cost over time from logs of single runs (`grove solve --log-format jsonl`).

The first line of a file distinguishes a log from results, so a folder can contain both.
"""
import json
from collections import Counter
from pathlib import Path
from typing import NamedTuple, Optional

from .rows import BadInput, printable, results_in


# Sources of the lower bound, in the order in which figures stack them.
BOUND_SOURCES = {"individual": "single agents", "wdg": "pairs and groups", "branching": "splits",
                 "tree": "tree of the ranks", "lagrangian": "Lagrangian bound", "joint": "joint search",
                 "cores": "unsatisfiable cores"}
OLD_BOUND_SOURCES = {"sequences": "individual", "groups": "wdg", "splits": "branching"}  # before version 0.1


class Moment(NamedTuple):
    """State of a run from this time until the next Moment."""
    seconds: float
    cost: Optional[int]  # cost of the best plan so far
    bound: Optional[int]


class Rise(NamedTuple):
    """An increase of the lower bound."""
    seconds: float
    bound: int     # after the increase
    steps: dict    # {source: increase by this source since the previous Rise}


class Run(NamedTuple):
    name: str        # file name without its suffix
    instance: str    # as the log names it
    agents: Optional[int]
    options: str
    status: str      # "" if the log contains no summary with a status
    end_s: float
    moments: list    # Moments in order of time; each differs from the previous one
    rises: list      # Rises in order of time

    def shares(self):
        """Returns {source: steps by which it raised the lower bound in the whole run}."""
        total = Counter()
        for rise in self.rises:
            total.update(rise.steps)
        return dict(total)


def _first_line(path):
    try:
        with path.open("rb") as file:
            return json.loads(file.readline(1 << 20))
    except (OSError, ValueError, RecursionError):
        return None


def is_log(path):
    found = _first_line(path) if path.suffix == ".jsonl" and path.is_file() else None
    return isinstance(found, dict) and "event" in found


def parted(arguments):
    """Divides the arguments into (files and folders with results, paths of logs). A folder can contribute to both."""
    results, logs = [], []
    for argument in arguments:
        path = Path(argument)
        if is_log(path):
            logs.append(path)
            continue
        inside = sorted(filter(is_log, path.iterdir())) if path.is_dir() else []
        logs += inside
        if not inside or results_in(path):
            results.append(argument)
    return results, list(dict.fromkeys(logs))


def _value(event, key, kinds, expected, place):
    value = event.get(key)
    if value is None or (isinstance(value, kinds) and not isinstance(value, bool) and value >= 0):
        return value
    raise BadInput(f"{place}, {key}: found '{json.dumps(value)[:60]}'; expected {expected}")


def _moment(event, place):
    """Returns the Moment of an event. Returns None if the event has no time or neither cost nor bound."""
    seconds = _value(event, "time_s", (int, float), "a number of at least 0", place)
    if seconds is None or not {"incumbent", "lower_bound"} & event.keys():
        return None
    return Moment(float(seconds), *(_value(event, key, int, "an integer of at least 0", place)
                                    for key in ("incumbent", "lower_bound")))


def _rise(event, place):
    """Returns the Rise of an event. Returns None if the event does not name the sources of its lower bound."""
    steps = event.get("raised_by")
    if steps is None:
        return None
    if not isinstance(steps, dict):
        raise BadInput(f"{place}, raised_by: found '{json.dumps(steps)[:60]}'; expected an object")
    expected = "an integer of at least 0"
    found = {OLD_BOUND_SOURCES.get(name, name): _value(steps, name, int, expected, f"{place}, raised_by")
             for name in steps}
    return Rise(float(event["time_s"]), event["lower_bound"], {name: step for name, step in found.items() if step})


def bound_sources(runs):
    """Returns {source: label} of the sources that raised the bound in any run, in the order of BOUND_SOURCES."""
    found = {source for run in runs for source in run.shares()}
    return ({source: label for source, label in BOUND_SOURCES.items() if source in found}
            | {source: printable(source) for source in sorted(found - BOUND_SOURCES.keys())})


def _last(event, place):
    """Returns (Moment, status) of the summary at the end of a log."""
    stats = event.get("stats") if isinstance(event.get("stats"), dict) else {}
    found = {"time_s": stats.get("wall_s"), "incumbent": event.get("cost"), "lower_bound": event.get("lower_bound")}
    status = event.get("status")
    return _moment(found, place), status if isinstance(status, str) else ""


def _without_repeats(moments):
    kept = []
    for moment in sorted(moments, key=lambda moment: moment.seconds):
        if not kept or moment[1:] != kept[-1][1:]:
            kept.append(moment)
    return kept


def _events(path):
    """Yields (place, event) for each line of a log. Skips an incomplete last line."""
    try:
        lines = path.read_text(encoding="utf-8").split("\n")
    except UnicodeDecodeError as error:
        raise BadInput(f"{path}: byte {error.start}: not UTF-8 text") from None
    except OSError as error:
        raise BadInput(f"{path}: cannot be read: {error.strerror}") from None
    for number, line in enumerate(lines, 1):
        if not line.strip():
            continue
        place = f"{path}: line {number}"
        try:
            event = json.loads(line)
        except (ValueError, RecursionError):
            if number == len(lines):
                return
            raise BadInput(f"{place}: not JSON; expected one object a line") from None
        if not isinstance(event, dict):
            raise BadInput(f"{place}: expected a JSON object")
        yield place, event


def _text_of(header, key):
    value = header.get(key)
    return printable(value) if isinstance(value, str) else ""


def read_log(path):
    """Reads one log and returns its Run. Raises BadInput, which names file, line and what was expected."""
    header, moments, rises, status, end = {}, [], [], "", 0.0
    for place, event in _events(path):
        if event.get("event") == "header":
            header = event
            continue
        if event.get("event") == "summary":
            moment, status = _last(event, place)
        else:
            moment = _moment(event, place)
        if moment:
            moments.append(moment)
            end = max(end, moment.seconds)
            if moment.bound is not None and (rise := _rise(event, place)):
                rises.append(rise)
    agents = header.get("agents")
    return Run(printable(path.stem), _text_of(header, "instance"), agents if isinstance(agents, int) else None,
               _text_of(header, "options"), status, end, _without_repeats(moments),
               sorted(rises, key=lambda rise: rise.seconds))
