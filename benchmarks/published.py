#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares the paper's published results with Grove's runs, as Markdown tables.

    published.py           prints the paper's statements with the values of our runs, its study of omega (both are in
                           docs/researchers.md), and every configuration of its comparison
                           (results/paper/configurations.md)
    published.py --write   writes the tables into these pages

Our runs are in results/paper/results.csv, the published values in results/paper/published.csv. This program itself
contains no results.
"""
import argparse
import csv
import functools
import re
import statistics
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
PAPER = HERE / "results/paper"
GUIDE = HERE.parent / "docs/researchers.md"
sys.path[:0] = [str(HERE), str(HERE.parent / "tools/report")]

from grove_report.metrics import best_costs, by_configuration, measures_by_line  # noqa: E402
from grove_report.rows import read_results  # noqa: E402
from harness import tables  # noqa: E402

EXACT = ("optimal-cbs", "hcbs", "mgcbs")
BASELINES = (*EXACT, "s-cbs")
A, B, C = ADAPTATIONS = ("cts-cbs-a", "cts-cbs-b", "cts-cbs-c")
NAMES = {"auto": "Grove", A: "A", B: "B", C: "C", "optimal-cbs": "Optimal-CBS", "hcbs": "HCBS", "mgcbs": "MGCBS",
         "s-cbs": "S-CBS"}
SIMILAR = 0.1  # maximum difference between success rates that count as similar
OMEGAS = ("0", "0.01", "0.1", "inf")


def published():
    with (PAPER / "published.csv").open(encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def our_rows():
    return read_results([str(PAPER / "results.csv")]).rows


def comparison(rows):
    """Returns {configuration: {method: Measures}} for MG-MAPF."""
    rows = [row for row in rows if row.problem == "mg"]
    return {configuration: {line.method: measures for line, measures in lines.items()}
            for configuration, lines in by_configuration(rows, best_costs(rows)).items()}


def study(rows):
    """Returns {(method, omega): Measures} for CTS-MAPF on the rooms map with 5 agents."""
    rows = [row for row in rows if row.problem == "cts"]
    return {(line.method, line.omega): measures for line, measures in measures_by_line(rows, best_costs(rows)).items()}


def said(configuration):
    return f"{configuration.map.split('-')[0]}, N = {configuration.agents}, M = {configuration.tasks}"


def percent(share):
    return f"{100 * share:.0f} %"


def seconds(value):
    return f"{value:.3f}" if value < 1 else f"{value:.2f}"


def pairs(configurations, firsts, others):
    """Returns [(configuration, method, its Measures, other method, its Measures)] for all configurations and pairs of
    methods."""
    return [(configuration, first, lines[first], second, lines[second])
            for configuration, lines in configurations.items() for first in firsts for second in others]


def largest(configurations, ratio):
    """Returns, as text, the largest ratio of an adaptation to a baseline, and the first configuration where it occurs.

    Only configurations count in which each of the two methods solves an instance.
    """
    found = [(ratio(one, other), configuration, name, second)
             for configuration, name, one, second, other in pairs(configurations, ADAPTATIONS, BASELINES)
             if one.solved and other.solved]
    value, configuration, name, second = max(found, key=lambda each: each[0])
    return f"{value:.0f} times at most ({said(configuration)}: {NAMES[name]} against {NAMES[second]})"


def success_ratio(configurations):
    return largest(configurations, lambda a, b: a.success / b.success)


def speed_up(configurations):
    return largest(configurations, lambda a, b: b.mean_runtime_s / a.mean_runtime_s)


def losses(configurations, methods, baselines):
    """Returns [(relative loss of mean SQR against a baseline, configuration, method)].

    Only configurations count in which both methods solve an instance.
    """
    return [(1 - one.mean_sqr / other.mean_sqr, configuration, method)
            for configuration, method, one, _, other in pairs(configurations, methods, baselines)
            if one.solved and other.solved]


def quality_loss(configurations):
    loss, configuration, method = max(losses(configurations, ADAPTATIONS, BASELINES))
    return f"{100 * loss:.1f} % at most ({said(configuration)}: {NAMES[method]})"


def quality_a(configurations):
    found = [loss for loss, _, _ in losses(configurations, [A], EXACT)]
    return f"{100 * min(found):.1f} to {100 * max(found):.1f} % less, " \
        f"in the median {100 * statistics.median(found):.1f} %"


def of(configurations, is_true):
    return f"{sum(map(is_true, configurations.values()))} of {len(configurations)} configurations"


def rooms(configurations):
    return {configuration: lines for configuration, lines in configurations.items()
            if configuration.map.startswith("room")}


def best_success(lines):
    return max(lines[method].success for method in BASELINES)


def room_success_a(configurations):
    some = [lines for lines in rooms(configurations).values() if max(best_success(lines), lines[A].success) > 0]
    higher, lower = (sum(sign * (lines[A].success - best_success(lines)) > 0 for lines in some) for sign in (1, -1))
    return f"than all: {higher} of the {len(some)} configurations in which A or a baseline solves any; " \
        f"lower than the best: {lower}"


def fastest(lines):
    return min(lines[method].mean_runtime_s for method in BASELINES)


def room_runtime_a(configurations):
    ratios = [fastest(lines) / lines[A].mean_runtime_s for lines in rooms(configurations).values()]
    return f"than the fastest: {of(rooms(configurations), lambda lines: lines[A].mean_runtime_s < fastest(lines))}, " \
        f"{max(ratios):.1f} times at most"


def success_b(configurations):
    ratios = [lines[B].success / best_success(lines) for lines in configurations.values() if best_success(lines)]
    none = sum(not best_success(lines) and lines[B].success > 0 for lines in configurations.values())
    return f"of the best baseline's: {min(ratios):.1f} to {max(ratios):.1f} times, in the median " \
        f"{statistics.median(ratios):.1f} times; in {none} configurations B alone solves any"


def runtime_b(configurations):
    ratios = [fastest(lines) / lines[B].mean_runtime_s for lines in configurations.values()]
    return f"than the fastest baseline's: ten times and more in {sum(ratio >= 10 for ratio in ratios)} of " \
        f"{len(ratios)} configurations, {max(ratios):.0f} times at most"


def quality_b(configurations):
    least, configuration = min((lines[B].mean_sqr, configuration) for configuration, lines in configurations.items()
                               if lines[B].solved)
    return f"at least {least:.2f} ({said(configuration)})"


def success_c(configurations):
    return f"within 10 points: {of(configurations, lambda lines: abs(lines[C].success - lines[B].success) <= SIMILAR)}"


def runtime_c(configurations):
    def is_between(lines):
        low, middle, high = (lines[method].mean_runtime_s for method in (B, C, A))
        return low <= middle <= high
    return of(configurations, is_between)


def quality_c(configurations):
    """Returns the mean SQRs of A, C and B in the easiest and the hardest third of the configurations.

    The configurations are ordered by A's success rate.

    Only configurations count in which each of the three solves an instance.
    """
    both = sorted(((lines[A].success, lines) for lines in configurations.values()
                   if lines[A].solved and lines[B].solved and lines[C].solved),
                  key=lambda entry: -entry[0])
    third = max(1, len(both) // 3)
    parts = []
    for name, part in (("easiest", both[:third]), ("hardest", both[-third:])):
        means = [statistics.fmean(lines[method].mean_sqr for _, lines in part) for method in (A, C, B)]
        parts.append(f"{name} third A {means[0]:.3f}, C {means[1]:.3f}, B {means[2]:.3f}")
    return "; ".join(parts)


def conditions(rows):
    limits, machines = ({getattr(row, name) for row in rows} for name in ("time_limit_s", "machine"))
    return {"time-limit": " and ".join(f"{limit:g} s" for limit in sorted(limits)),
            "scenarios": f"{len({row.scenario for row in rows})} of each map",
            "machine": "; ".join(sorted(machines)) + ", one for a run", "rtsp": "dynamic programming"}


CLAIMS = {"success-ratio": success_ratio, "speed-up": speed_up, "quality-loss": quality_loss, "quality-a": quality_a,
          "room-success-a": room_success_a, "room-runtime-a": room_runtime_a, "success-b": success_b,
          "runtime-b": runtime_b, "quality-b": quality_b, "success-c": success_c, "runtime-c": runtime_c,
          "quality-c": quality_c}


def claims_table(rows):
    configurations = comparison(rows)
    ours = conditions(rows) | {name: claim(configurations) for name, claim in CLAIMS.items()}
    return tables.table(["where", "published", "here"],
                        [[each["where"], each["published"], ours[each["claim"]]] for each in published()
                         if each["claim"] in ours])


def omega_table(rows):
    measured = study(rows)
    found = [measured[f"cts-cbs_{omega}", omega] for omega in OMEGAS] + [measured["auto", "0"]]
    shown = {"omega-success": ("success rate", lambda one: percent(one.success)),
             "omega-runtime": ("mean runtime, s", lambda one: seconds(one.mean_runtime_s)),
             "omega-quality": ("mean SQR, of all solved", lambda one: f"{one.mean_sqr:.4f}"),
             "omega-roots": ("roots, mean", lambda one: f"{one.mean_roots:,.0f}"),
             "omega-rtsp-calls": ("rTSP calls, mean", lambda one: f"{one.mean_rtsp_calls:,.0f}")}
    return tables.table(["", "published", *[f"omega {omega}" for omega in OMEGAS], "Grove, omega 0"],
                        [[shown[each["claim"]][0], each["published"], *map(shown[each["claim"]][1], found)]
                         for each in published() if each["claim"] in shown])


MEASURES = {"configurations, success": lambda one: f"{100 * one.success:.0f}",
            "configurations, runtime": lambda one: seconds(one.mean_runtime_s),
            "configurations, quality": lambda one: f"{one.mean_sqr:.3f}" if one.solved else "-"}


def configurations_table(rows, shown):
    return tables.table(["map", "N", "M", *NAMES.values()],
                        [[configuration.map, configuration.agents, configuration.tasks,
                          *[shown(lines[method]) for method in NAMES]]
                         for configuration, lines in comparison(rows).items()])


PARTS = {"claims": (claims_table, GUIDE), "omega": (omega_table, GUIDE)} | {
    name: (functools.partial(configurations_table, shown=shown), PAPER / "configurations.md")
    for name, shown in MEASURES.items()}


def marked(name):
    """Returns a pattern that matches the place of the table `name` in a page."""
    return re.compile(rf"(<!-- published\.py {name} -->\n).*?(?=\n<!-- end -->)", re.S)


def write(rows):
    for name, (table, page) in PARTS.items():
        text = page.read_text(encoding="utf-8")
        new, times = marked(name).subn(lambda found: found.group(1) + table(rows), text)
        if times != 1:
            sys.exit(f"published.py: error: {page}: found {times} places for the table '{name}'; expected one")
        page.write_text(new, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help="write the tables into the pages")
    if parser.parse_args().write:
        write(our_rows())
    else:
        rows = our_rows()
        print("\n\n".join(f"{name}:\n\n{table(rows)}" for name, (table, _) in PARTS.items()))


if __name__ == "__main__":
    main()
