# SPDX-License-Identifier: MIT
"""Makes Markdown tables from result rows."""

import math
import statistics

PROVEN = ("optimal", "bounded")


def grouped(rows, *columns):
    """Groups rows by the values of columns; returns {values: rows} in the order of first appearance."""
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row[column] for column in columns), []).append(row)
    return groups


def values(rows, column):
    return [row[column] for row in rows if row[column] is not None]


def percents(rows):
    """Returns the rows with the gap in percent."""
    return [row | {"gap": row["gap"] and 100 * row["gap"]} for row in rows]


def median(numbers, digits=2):
    return f"{statistics.median(numbers):.{digits}f}" if numbers else "-"


def largest(numbers, digits=2):
    return f"{max(numbers):.{digits}f}" if numbers else "-"


def listed(rows, column, digits=None):
    def text(value):
        return "-" if value is None else str(value) if digits is None else f"{value:.{digits}f}"
    return ", ".join(text(row[column]) for row in rows)


def count(rows, *statuses):
    return sum(row["status"] in statuses for row in rows)


def within_one_percent(row):
    return row["cost"] is not None and row["lower_bound"] is not None and \
        100 * (row["cost"] - row["lower_bound"]) <= row["lower_bound"]


def table(head, lines):
    rule = "|" + "---|" * len(head)
    rows = ["| " + " | ".join(str(entry) for entry in line) + " |" for line in [head, *lines]]
    return "\n".join([rows[0], rule, *rows[1:]])


def cells(rows):
    """Returns a table with a line per cell (map, N, M). Each entry lists the values for the scenarios of the cell."""
    return table(
        ["map", "N", "M", "proven", "status", "cost", "bound", "gap %", "roots", "rTSP calls",
         "nodes", "s"],
        [[*key, f"{count(group, *PROVEN)}/{len(group)}", listed(group, "status"),
          listed(group, "cost"), listed(group, "lower_bound"), listed(percents(group), "gap", 2),
          listed(group, "roots"), listed(group, "rtsp_calls"), listed(group, "nodes"),
          listed(group, "wall_s", 2)]
         for key, group in grouped(rows, "map", "agents", "tasks").items()])


def proofs(rows):
    """Returns a table of proven results by map and N, and in total."""
    def line(name, agents, group):
        return [name, agents, len(group), count(group, "optimal"),
                sum(map(within_one_percent, group)), sum(row["cost"] is None for row in group),
                median(values(group, "wall_s"))]
    groups = grouped(rows, "map", "agents").items()
    return table(["map", "N", "instances", "proven optimal", "within 1 % proven", "no plan",
                  "median s"],
                 [*(line(*key, group) for key, group in groups), line("all", "", rows)])


def plans(rows):
    """Returns a table of the times of first plans and the final gaps."""
    return table(
        ["map", "N/M", "plans", "first plan s, median", "worst", "gap %, median", "worst",
         "proven", "memory MB"],
        [[name, f"{agents}/{tasks}", f"{len(values(group, 'cost'))}/{len(group)}",
          median(values(group, "first_plan_s")), largest(values(group, "first_plan_s")),
          median(values(percents(group), "gap")), largest(values(percents(group), "gap")),
          f"{count(group, *PROVEN)}/{len(group)}", largest(values(group, "peak_memory_mb"), 0)]
         for (name, agents, tasks), group in grouped(rows, "map", "agents", "tasks").items()])


def comparison(rows):
    """Returns a table that compares solvers by solved instances and the median time on these instances."""
    solvers = list(dict.fromkeys(row["method"] for row in rows))

    def entries(group, solver):
        own = [row for row in group if row["method"] == solver]
        solved = [row for row in own if row["solved"]]
        return [f"{len(solved)}/{len(own)}", median(values(solved, "wall_s"))]
    head = ["map", "agents"]
    for solver in solvers:
        head += [f"{solver}: solved", "median s"]
    groups = grouped(rows, "map", "agents").items()
    return table(head, [[*key, *(entry for solver in solvers for entry in entries(group, solver))]
                        for key, group in groups])


def ratio(pairs):
    """Returns the geometric mean of a/b over the pairs (a, b) as text; "-" if there are no pairs."""
    logs = [math.log(a / b) for a, b in pairs]
    return f"{math.exp(statistics.fmean(logs)):.2f}" if logs else "-"


def ablation(rows, reference):
    """Returns a table that compares each solver with the solver `reference`. Ratios are over instances that both prove.
    """
    def key(row):
        return row["instance"]
    full = {key(row): row for row in rows if row["method"] == reference}
    lines = []
    for (solver,), group in grouped(rows, "method").items():
        both = [(row, full[key(row)]) for row in group
                if row["status"] in PROVEN and full[key(row)]["status"] in PROVEN]
        lines.append([
            solver, f"{count(group, *PROVEN)}/{len(group)}", count(group, "optimal"),
            sum(map(within_one_percent, group)), len(both),
            ratio([(row["nodes"] + 1, other["nodes"] + 1) for row, other in both]),
            ratio([(row["wall_s"] + 0.001, other["wall_s"] + 0.001) for row, other in both])])
    return table(["", "solved", "optimal", "within 1 %", "both solved", "nodes ratio",
                  "time ratio"], lines)
