# SPDX-License-Identifier: MIT
"""Implements the command line of grove report."""
import argparse
import contextlib
import io
import os
import sys
from pathlib import Path

from .lines import method_name
from .logs import parted, read_log
from .metrics import best_costs, has_plan
from .rows import NO_RESULTS, PROBLEMS, BadInput, printable, read_results
from .tracker import read_known, submission

DEFAULT_BASELINES = "optimal-cbs,hcbs,mgcbs,s-cbs"
BAD_INPUT = 2
INTERNAL_FAILURE = 1
PAGE = "report.html"

DESCRIPTION = """\
Turns results of 'grove bench' into a report: tables and figures of success rate, runtime and
solution quality by map, agents and tasks; success over the number of agents; quality over time;
costs and times on the instances that all methods solve; instances solved over time; speed-ups over
the baselines; the influence of omega. The report is one page, DIR/report.html, which needs only a
browser. The same directory gets every figure as SVG and PNG and every table as CSV. Logs of single
runs (grove solve --log-format jsonl) become a figure of lower bound and plan over time and one of the
sources of the lower bound; a directory of results may hold logs, too."""

EPILOG = """\
A line of a figure is a method with one omega and one time limit. Rows that differ only in the seed
are repetitions: means are taken over these first, then over instances. If two rows describe the
same run, only the later one counts. The same rows give the same files, byte for byte.

If claims contradict each other (two optimal costs, a plan below a proven bound), the page begins
with a red box, and stderr gets a warning. The same holds for false claims of other solvers: an
invalid plan, a cost below the recounted one, a lower bound above the cost of a checked plan.

--tracker writes a file for submission to MAPF Tracker (tracker.pathfinding.ai): the cheapest plan
of one method for each instance of classical MAPF on a scenario of the Moving AI benchmark, from the
plan files that 'grove bench --keep-plans' kept. --best-known reads a download of MAPF Tracker: a
CSV or JSON with columns map_name, scen_type, type_id, agents, lower_cost and solution_cost; the
file name may replace the first three columns.

Exit codes:
  0  the report was written
  1  internal failure
  2  bad usage or input: one line on stderr with file, row, column and what was expected

Examples:
  grove report results -o report
  grove report ours.csv theirs.csv --baseline cbs,hcbs -o report
  grove report first.jsonl second.jsonl -o runs
  grove report results --tracker submission.csv --tracker-method Grove
  grove report results --best-known random-32-32-20.csv -o report
  grove report results --study-map empty-32-32 --study-agents 10 -o report"""


class _Help(argparse.RawDescriptionHelpFormatter):
    def __init__(self, prog):
        super().__init__(prog, width=100)


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        raise BadInput(f"{message.removeprefix('argument ')} (see 'grove report --help')")


def _names(text):
    names = tuple(name.strip() for name in text.split(","))
    if not all(names):
        raise argparse.ArgumentTypeError(f"found '{text}'; expected a comma-separated list of names")
    return names


def _agents(text):
    if not text.isascii() or not text.isdigit():
        raise argparse.ArgumentTypeError(f"found '{text}'; expected an integer of at least 0")
    return int(text)


def _parse(arguments):
    parser = _Parser(prog="grove report", description=DESCRIPTION, epilog=EPILOG,
                     allow_abbrev=False, formatter_class=_Help)
    add = parser.add_argument
    add("results", nargs="+", metavar="RESULTS",
        help="results.csv, results.jsonl, a directory with one of them, or a run's log (*.jsonl)")
    add("-o", "--output", metavar="DIR", help="directory to write into; created if missing. Required without --tracker")
    add("--method", type=_names, default=(), metavar="NAMES", help="read only rows of these methods (default: all); "
        "the set of common instances depends on this")
    add("--baseline", type=_names, metavar="NAMES", help="methods to compare the others with (default: "
        f"{DEFAULT_BASELINES}, and all external solvers that are not anytime)")
    add("--problem", type=_names, default=(), metavar="NAMES",
        help=f"report only these of {', '.join(PROBLEMS)} (default: all in the results)")
    add("--study", type=_names, metavar="NAMES",
        help="methods of the study of omega (default: those whose options differ only in --omega)")
    add("--study-map", metavar="MAP", help="map of its figure (default: a room map, else the first)")
    add("--study-agents", type=_agents, metavar="N", help="number of agents of its figure (default: 5, else the "
        "smallest number)")
    add("--best-known", action="append", default=[], metavar="FILE",
        help="download of MAPF Tracker, or a directory of downloads, to compare with (repeatable)")
    add("--tracker", metavar="FILE", help="file for submission to MAPF Tracker")
    add("--tracker-method", metavar="NAME", help="method to submit (default: the only one with plans)")
    a = parser.parse_intermixed_args(arguments)
    if not a.output and not a.tracker:
        parser.error("the following arguments are required: -o/--output")
    if a.tracker_method and not a.tracker:
        parser.error("argument --tracker-method: requires --tracker")
    return a


def _known(option, names, found):
    for name in names:
        if name not in found:
            raise BadInput(f"{option}: found '{name}', which is not in the results; "
                           f"expected one of {', '.join(sorted(found))}")


def _names_of(rows):
    """Returns {name: method} with the names that the figures show and those in the rows."""
    return {method_name(row.method): row.method for row in rows} | {row.method: row.method for row in rows}


def _check_names(a, rows):
    methods = _names_of(rows)
    _known("--method", a.method, methods)
    _known("--baseline", a.baseline or (), methods)
    _known("--study", a.study or (), methods)
    _known("--problem", a.problem, {row.problem for row in rows})
    _known("--study-map", [a.study_map] if a.study_map else (), {row.map for row in rows})


def _chosen(a, results):
    """Returns the results with only the rows of --method."""
    if not a.method:
        return results
    wanted = {_names_of(results.rows)[name] for name in a.method}
    return results._replace(rows=[row for row in results.rows if row.method in wanted])


def _write_report(a, results, logs, known):
    try:
        from .report import Options, make_report  # imported here so that --help needs no matplotlib
    except ModuleNotFoundError as error:
        if error.name not in ("matplotlib", "numpy"):
            raise
        raise BadInput(f"{sys.executable} has no module {error.name}, which draws the figures; "
                       "expected the Debian package python3-matplotlib") from None
    from .page import page
    baselines = a.baseline or {*DEFAULT_BASELINES.split(","),
                               *(row.method for row in results.rows if row.solver and not row.anytime)}
    folder = Path(a.output)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        report = make_report(results, logs, Options(baselines, a.problem, a.study, a.study_map, a.study_agents,
                                                    tuple(a.best_known), known), folder)
        (folder / PAGE).write_text(page(report), encoding="utf-8")
    except OSError as error:
        raise BadInput(f"{error.filename or folder}: cannot be written: {error.strerror}") from None
    return report


def _submitting_method(a, rows):
    with_plans = sorted({row.method for row in rows if row.plan_file and has_plan(row)})
    if a.tracker_method:
        _known("--tracker-method", [a.tracker_method], _names_of(rows))
        return _names_of(rows)[a.tracker_method]
    if len(with_plans) > 1:
        raise BadInput("--tracker: found plans of several methods; expected --tracker-method "
                       + " or ".join(map(method_name, with_plans)))
    return with_plans[0] if with_plans else ""


def _write_whole(path, text):
    """Writes a file completely or not at all. Raises BadInput if it cannot be written."""
    part = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        part.write_text(text, encoding="utf-8", newline="")
        os.replace(part, path)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise BadInput(f"{path}: cannot be written: {error.strerror}") from None


def _write_submission(a, results):
    method = _submitting_method(a, results.rows)
    found = submission([row for row in results.rows if not method or row.method == method],
                       best_costs(results.rows))
    if not found.rows:
        reasons = "; ".join(f"{number} {why}" for why, number in found.omitted.items())
        raise BadInput(f"--tracker: no row to submit: {reasons or 'no rows'}")
    _write_whole(Path(a.tracker), found.text)
    print(printable(f"wrote {a.tracker}: {found.rows} rows of {method_name(method)} for MAPF Tracker"))
    for why, number in found.omitted.items():
        print(printable(f"left out: {number} {why}"))


def _print(text):
    """Prints the text and returns the exit code, which is a failure if the text cannot be written (full disk, pipe)."""
    try:
        print(text, end="", flush=True)
        return 0
    except OSError:
        _complain("standard output: cannot be written")
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # so that Python's flush at exit succeeds
        return INTERNAL_FAILURE


def _complain(message):
    print("grove: error: " + message.replace("\n", "\\n"), file=sys.stderr)


def _warn(number, what, file, a):
    if number:
        print(f"grove: warning: {what} ({number} times); see {Path(a.output) / file}", file=sys.stderr)


def _run(arguments):
    a = _parse(arguments)
    files, logs = parted(a.results)
    results = read_results(files) if files or not logs else NO_RESULTS
    _check_names(a, results.rows)
    results = _chosen(a, results)
    logs = [read_log(path) for path in logs]
    known = read_known(a.best_known)
    if a.output:
        report = _write_report(a, results, logs, known)
        _warn(len(report.contradictions), "proofs contradict each other", "contradictions.csv", a)
        _warn(len(report.false_claims), "solvers make false claims", "false_claims.csv", a)
        contents = [f"{len(report.results.rows)} rows"] if files else []
        contents += [f"{len(logs)} log{'s' * (len(logs) > 1)}"] if logs else []
        print(printable(f"wrote {Path(a.output) / PAGE}: {', '.join(contents)}"))
    if a.tracker:
        _write_submission(a, results)


def main(arguments):
    try:
        with contextlib.redirect_stdout(io.StringIO()) as output:
            _run(arguments)
    except BadInput as error:
        _complain(str(error))
        return BAD_INPUT
    except SystemExit:  # raised by --help
        pass
    return _print(output.getvalue())
