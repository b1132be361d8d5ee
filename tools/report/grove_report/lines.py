# SPDX-License-Identifier: MIT
"""Defines the lines of figures and tables. A line is one method with one omega and one time limit."""
import re
import shlex
from collections import defaultdict
from typing import NamedTuple

from .groups import values_by


class Line(NamedTuple):
    method: str
    omega: str
    time_limit_s: float


GROVE = "Grove"


def method_name(method):
    """Returns the name of a method for display. `auto` is the option value for Grove's own search."""
    return GROVE if method == "auto" else method


def line_of(row):
    return Line(row.method, row.omega, row.time_limit_s)


def omega_value(omega):
    return float(omega) if omega else -1.0


def omega_text(omega):
    return "ω = ∞" if omega == "inf" else f"ω = {omega}" if omega else "no ω"


def seconds_text(seconds):
    return f"{seconds:g} s"


class Lines:
    """All lines of the rows, with their labels, in the same order for all figures and tables."""

    def __init__(self, rows, baselines):
        self.baselines = frozenset(baselines)
        # The lines of the first comparison (MG-MAPF) come first, so that they get the most distinct colours. The other
        # lines follow, ordered by method.
        shown_first = {line_of(row) for row in rows if row.problem == "mg"}
        found = {line_of(row) for row in rows}
        self.all = sorted(found, key=lambda line: (
            line not in shown_first, self.is_baseline(line), line.method, omega_value(line.omega),
            line.time_limit_s))
        omegas = values_by(rows, lambda row: row.problem, lambda row: row.omega)
        self._omegas_differ = any(len(values) > 1 for values in omegas.values())
        self._limits = values_by(found, lambda line: (line.method, line.omega), lambda line: line.time_limit_s)
        self._index = {line: index for index, line in enumerate(self.all)}
        self._methods = {line.method for line in found}

    def is_baseline(self, line):
        return line.method in self.baselines

    def index(self, line):
        return self._index[line]

    def name(self, line):
        """Returns the label without omega, for figures and tables that show omega separately."""
        return self._called(line, False)

    def label(self, line):
        """Returns the label: the method, its omega if rows of one problem differ in omega, and its time limit if the
        method has several. Omegas must be visible then, because a larger omega leaves less to prove."""
        return self._called(line, self._omegas_differ)

    def _called(self, line, with_omega):
        name = method_name(line.method)
        parts = [line.method if name in self._methods else name]
        if with_omega and line.omega:  # methods of other solvers have no omega
            parts.append(omega_text(line.omega))
        if len(self._limits[line.method, line.omega]) > 1:
            parts.append(f"limit {seconds_text(line.time_limit_s)}")
        return ", ".join(parts)


class Family(NamedTuple):
    """Lines that differ only in omega."""
    name: str
    lines: list  # in ascending order of omega


def _without_omega(options):
    """Returns the options without --omega, as a tuple of words."""
    try:
        words = shlex.split(options)
    except ValueError:
        words = options.split()
    kept, skip = [], False
    for word in words:
        if skip:
            skip = False
        elif word == "--omega":
            skip = True
        elif not word.startswith("--omega="):
            kept.append(word)
    return tuple(kept)


def _bare(method, omega):
    """Returns a method's name without omega at its end: "cts-cbs" for "cts-cbs-w0.01"."""
    end = re.search(r"[\s,_-]+(?:w|ω|omega)?\s*=?\s*" + re.escape(omega) + "$", method)
    return method[:end.start()] if omega and end and end.start() else method


def _name(lines):
    bare = sorted({_bare(line.method, line.omega) for line in lines})
    return bare[0] if len(bare) == 1 else " / ".join(bare[:3]) + (" / ..." if bare[3:] else "")


def families(rows, methods=None):
    """Returns the families that have at least two omegas.

    The options of the lines in a family (without options, their names) differ only in omega. If `methods` is given,
    the lines of these methods form one family per time limit instead.
    """
    groups = defaultdict(set)
    for row in rows:
        if methods is None:
            key = _without_omega(row.options) if row.options else (None, _bare(row.method, row.omega))
            groups[key, row.time_limit_s].add(line_of(row))
        elif row.method in methods:
            groups["named", row.time_limit_s].add(line_of(row))
    found = []
    for lines in groups.values():
        if len({line.omega for line in lines} - {""}) > 1:
            ordered = sorted(lines, key=lambda line: (omega_value(line.omega), line.method))
            found.append(Family(_name(ordered), ordered))
    return sorted(found, key=lambda family: (-len(family.lines), family.name, family.lines))
