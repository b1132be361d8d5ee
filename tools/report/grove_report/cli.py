# SPDX-License-Identifier: MIT
"""The command line of grove report."""
import argparse
import contextlib
import io
import os
import sys
from pathlib import Path

from .rows import PROBLEMS, BadInput, printable, read_results

DEFAULT_BASELINES = "optimal-cbs,hcbs,mgcbs,s-cbs"
BAD_INPUT = 2
INTERNAL_FAILURE = 1
PAGE = "report.html"

DESCRIPTION = """\
Turns results of 'grove bench' into a report: tables and figures of success rate, runtime and
solution quality by map, agents and tasks; instances solved over time; speed-ups over the
baselines; the influence of omega. One page to read, DIR/report.html, needs nothing but a browser;
beside it every figure as SVG and PNG and every table as CSV."""

EPILOG = """\
A line of a figure is a method with one omega and one time limit. Rows of one run that is there
twice count once, the later. The same rows give the same files, byte for byte.

If claims contradict each other - two optimal costs, a plan below a proven bound - the page begins
with a red box, and stderr says so too.

Exit codes:
  0  the report was written
  1  internal failure
  2  bad usage or input: one line on stderr with file, row, column and what was expected

Examples:
  grove report results -o report
  grove report ours.csv theirs.csv --baseline cbs,hcbs -o report
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
        raise argparse.ArgumentTypeError(f"found '{text}'; expected names with commas between")
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
        help="results.csv, results.jsonl, or a folder with one of them")
    add("-o", "--output", required=True, metavar="DIR", help="folder to write into; made if need be")
    add("--baseline", type=_names, metavar="NAMES",
        help=f"methods that the others are measured by (default: {DEFAULT_BASELINES})")
    add("--problem", type=_names, default=(), metavar="NAMES",
        help=f"only these of {', '.join(PROBLEMS)} (default: all there are)")
    add("--study", type=_names, metavar="NAMES",
        help="methods of the study of omega (default: those whose options differ in --omega alone)")
    add("--study-map", metavar="MAP", help="its figure's map (default: a room map, else the first)")
    add("--study-agents", type=_agents, metavar="N", help="its figure's agents (default: 5, else the "
        "fewest)")
    return parser.parse_intermixed_args(arguments)


def _known(option, names, found):
    for name in names:
        if name not in found:
            raise BadInput(f"{option}: nothing in the results is called '{name}'; "
                           f"expected one of {', '.join(sorted(found))}")


def _check_names(a, rows):
    methods = {row.method for row in rows}
    _known("--baseline", a.baseline or (), methods)
    _known("--study", a.study or (), methods)
    _known("--problem", a.problem, {row.problem for row in rows})
    _known("--study-map", [a.study_map] if a.study_map else (), {row.map for row in rows})


def _write_report(a, results):
    try:
        from .report import Options, make_report  # here, so that --help needs no matplotlib
    except ModuleNotFoundError as error:
        if error.name not in ("matplotlib", "numpy"):
            raise
        raise BadInput(f"{sys.executable} has no {error.name}, which draws the figures; "
                       "expected the Debian package python3-matplotlib") from None
    from .page import page
    baselines = a.baseline or tuple(DEFAULT_BASELINES.split(","))
    folder = Path(a.output)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        report = make_report(results, Options(baselines, a.problem, a.study, a.study_map,
                                              a.study_agents), folder)
        (folder / PAGE).write_text(page(report), encoding="utf-8")
    except OSError as error:
        raise BadInput(f"{error.filename or folder}: cannot be written: {error.strerror}") from None
    return report


def _print(text):
    """A full disk or a closed pipe must not pass for success."""
    try:
        print(text, end="", flush=True)
        return 0
    except OSError:
        _complain("standard output: cannot be written")
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # for the flush at the end
        return INTERNAL_FAILURE


def _complain(message):
    print("grove: error: " + message.replace("\n", "\\n"), file=sys.stderr)


def _run(arguments):
    a = _parse(arguments)
    results = read_results(a.results)
    _check_names(a, results.rows)
    report = _write_report(a, results)
    if report.contradictions:
        print(f"grove: warning: proofs contradict each other ({len(report.contradictions)} times); "
              f"see {Path(a.output) / 'contradictions.csv'}", file=sys.stderr)
    print(printable(f"wrote {Path(a.output) / PAGE}: {len(report.results.rows)} rows"))


def main(arguments):
    try:
        with contextlib.redirect_stdout(io.StringIO()) as said:
            _run(arguments)
    except BadInput as error:
        _complain(str(error))
        return BAD_INPUT
    except SystemExit:  # of --help
        pass
    return _print(said.getvalue())
