# SPDX-License-Identifier: MIT
"""Writes the HTML page of a report as a single file without scripts and external resources."""
import base64
import html
from collections import Counter
from pathlib import Path

from .anytime import table_times
from .counters import cache_names, label, other_names
from .groups import grouped
from .lines import method_name, omega_text, seconds_text
from .logs import bound_sources
from .metrics import by_line
from .report import PROBLEM_NAMES
from .rows import STATUSES_WITH_PLAN
from .speedup import ALL_MAPS, BEST
from .tables import NOTHING, Entry, count, html_table, percent, ratio, seconds, word

# Content security policy that blocks everything from outside the file.
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"
MOST_LISTED = 100

GLOSSARY = [
    ("CTS-MAPF", "Each agent on a grid has a start, cells to visit in any order (its tasks) and a "
     "destination. Agents must not collide. The cost, to be minimised, is the sum of their finish times."),
    ("MG-MAPF", "The same without destinations: an agent may end on any of its own tasks."),
    ("N, M", "The number of agents; the number of tasks (one task may belong to several agents)."),
    ("ω", "Relative tolerance that the method was called with: a plan may cost at most (1 + ω) times the least "
     "possible cost. 0: optimal; ∞: no guarantee. Not every method proves it for the whole problem. For example, a "
     "method that first chooses the agents' destinations may stop within ω of the best plan for this choice, even if "
     "another choice is much better."),
    ("Solved", "The run ended by itself, not at a limit, with a plan that was checked. A run that ended at a limit "
     "is a failure, even with a plan. Solved runs may be outside ω."),
    ("Within ω", "A solved run that proves its tolerance: the plan is optimal, or costs at most (1 + ω) times "
     "the lower bound that the run proved. The others are outside ω; their plans may still be good, but this is not "
     "proven. A dash: ω is ∞ or not given, so nothing was guaranteed."),
    ("Status", "Of a plan: optimal; bounded: proven to be within ω; feasible: neither."),
    ("Success rate", "Solved runs / all runs. Higher is better."),
    ("Runtime", "Wall time of a run in seconds; a failure counts as the time limit. So the mean of a "
     "method with many failures mainly reflects its failures. Lower is better."),
    ("Seeds", "Runs that differ only in the seed are repetitions of one instance: means are taken over these first, "
     "then over instances. Success rate of an instance: the share of its runs that are solved."),
    ("Claimed, invalid", "Of other solvers. Claimed: a run that reported a cost without a plan. Invalid: a run in "
     "whose plan agents collide, jump or do not arrive. Neither counts as solved, and its cost does not count as "
     "known."),
    ("Anytime", "A method that improves its plan until its time limit. Reaching the limit is not a failure: a run with "
     "a plan counts as solved, and its runtime is the time to its first plan."),
    ("SQR, solution quality ratio", "Root cost / cost of the plan, of solved runs. The root cost is the "
     "cost of the agents' best sequences without regard to collisions: a lower bound on the optimum. So SQR is at "
     "most 1, and an optimal plan may have less. Each method is averaged over the runs that it solved: a method that "
     "solves only easy instances looks better than one that also solves hard ones, whose SQR is lower for all "
     "methods."),
    ("Common instances", "Instances that all methods solve with every seed, not counting methods that solve no "
     "instance of the configuration (map, N, M) or table. On these, costs, times and the mean SQR of methods are "
     "comparable. The weakest method determines the common instances, and they are the easy ones; --method excludes "
     "methods. For quality over time: instances for which all methods end with a plan."),
    ("Cost ratio", "Cost of the plan / best known cost, of solved runs. The best known cost is the least cost of "
     "any row for the instance, including runs that ended at a limit, and of MAPF Tracker if it was read. 1 is best; "
     "1.05 costs 5 % more. Unlike SQR it does not get worse because an instance is hard, so methods are comparable "
     "even if one solves more instances. If no other method has a plan, it is 1 for any plan, because nothing "
     "better is known."),
    ("PAR-2", "Mean runtime where a failure counts as twice the time limit. Lower is better."),
    ("Roots, rTSP calls", "Constraint trees that the search began, and sequencing problems that it solved to "
     "find them; means over all runs that report them, including failures."),
    ("Gap, lower bound", "No plan costs less than the lower bound; gap = (cost - lower bound) / lower bound."),
    ("Baseline", "A method that others are compared with: dashed lines, hollow markers."),
]


def _text(text):
    return html.escape(str(text))


def _paragraph(text):
    return f"<p>{_text(text)}</p>"


def _data(kind, content):
    return f"data:{kind};base64,{base64.b64encode(content).decode('ascii')}"


def _file(report, before, name):
    """Returns a download link. The link contains the content of the file, so that the page can be moved on its own."""
    return f'<p>{_text(before)}: <a download="{name}" href="{_data("text/csv", report.files[name])}">{name}</a>.</p>'


def _figure(figure, caption="", kind=""):
    """Returns the HTML of a figure. `kind`: "column" for figures as wide as a column of a paper, otherwise ""."""
    return (f'<figure class="{kind}"><img alt="{_text(figure.title)}" '
            f'src="{_data("image/svg+xml", figure.svg.encode("utf-8"))}">'
            f"<figcaption><b>{_text(figure.title)}.</b> {_text(caption)}</figcaption></figure>")


def _box(kind, parts):
    return f'<div class="box {kind}">' + "\n".join(parts) + "</div>"


def _list(texts):
    return "<ul>" + "".join(f"<li>{_text(text)}</li>" for text in texts) + "</ul>"


def _alarm(report):
    found = report.contradictions
    if not found:
        compared = (f"costs called optimal agree wherever several methods found one ({report.agreements} instances)"
                    if report.agreements else "on no instance did several methods call a cost optimal")
        return _box("good", [_paragraph(
            f"No proofs contradict each other: {compared}, and no plan is cheaper than a proven lower bound.")])
    instances = len({(each.problem, each.instance) for each in found})
    shown = [f"{each.problem}: {each.instance}: {each.what}" for each in found[:MOST_LISTED]]
    if len(found) > MOST_LISTED:
        shown.append(f"and {len(found) - MOST_LISTED} more")
    return _box("alarm", [
        f"<h2>PROOFS CONTRADICT EACH OTHER on {instances} instance{'s' if instances > 1 else ''}</h2>",
        _paragraph("Not all of these claims can be true. Some solver is wrong, or rows of different "
                   "instances have one name. Do not trust any figure below until this is explained."),
        _file(report, "All of them", "contradictions.csv"), _list(shown)])


def _who(report, claim):
    name = method_name(claim.method)
    return name + (f" {omega_text(claim.omega)}" if claim.omega else "") + (
        f" seed {claim.seed}" if len({row.seed for row in report.results.rows}) > 1 and claim.seed is not None else "")


def _false_claims(report):
    found = report.false_claims
    if not found:
        return ""
    shown = [f"{_who(report, each)}: {each.problem}: {each.instance}: {each.what}" for each in found[:MOST_LISTED]]
    if len(found) > MOST_LISTED:
        shown.append(f"and {len(found) - MOST_LISTED} more")
    kinds = Counter((method_name(each.method), each.kind) for each in found)
    numbers = ", ".join(f"{name}: {number} of a {kind}" for (name, kind), number in sorted(kinds.items()))
    return _box("alarm", [
        f"<h2>FALSE CLAIMS: {len(found)}</h2>",
        _paragraph(f"Claims of solvers that contradict checked values ({numbers}). Invalid plans count as failures. "
                   "Costs are the recounted ones. No other result uses these claims."),
        _file(report, "All of them", "false_claims.csv"), _list(shown)])


def _errors(report):
    if not report.errors:
        return ""
    rows = [[word(report.lines.label(line)), Entry(str(number)), word(message or "(no message)")]
            for line, number, message in report.errors]
    return _box("note", ["<b>Runs that failed with an error</b>",
                         _paragraph("These runs crashed or gave an invalid plan. They count as failures."),
                         html_table(["method", "runs", "most frequent message"], rows)])


def _span(values, show=str):
    values = sorted(values)
    return ", ".join(map(show, values)) if len(values) <= 12 else \
        f"{show(values[0])} to {show(values[-1])} ({len(values)} values)"


def _provenance(report):
    rows = report.results.rows
    ended = sorted(row.ended_at for row in rows if row.ended_at)
    entries = [
        ("Rows", f"{len(rows)} runs of {len({(row.problem, row.instance) for row in rows})} instances "
         f"by {len(report.lines.all)} lines of {len({row.method for row in rows})} methods"),
        ("Files", "; ".join(f"{path} ({number} rows)" for path, number in report.results.files)),
        ("Runs ended", f"{ended[0]} to {ended[-1]}" if ended else "not reported"),
        ("Machines", _span({row.machine for row in rows} - {""}) or "not reported"),
        ("Versions", _span({row.version for row in rows} - {""}) or "not reported"),
        ("Threads", _span({row.threads for row in rows if row.threads is not None}) or "not reported"),
        ("Time limits", _span({row.time_limit_s for row in rows}, seconds_text)),
        ("Seeds", _span({row.seed for row in rows if row.seed is not None}) or "not reported"),
        ("Maps", _span({row.map for row in rows})),
        ("N (agents)", _span({row.agents for row in rows})),
        ("M (tasks)", _span({row.tasks for row in rows}))]
    return html_table(["what", ""], [[word(name), word(text)] for name, text in entries])


def _methods(report):
    rows_of = by_line(report.results.rows)
    statuses = {line: Counter(row.status for row in rows if row.solved) for line, rows in rows_of.items()}
    rows = [[word(report.lines.name(line)), word(omega_text(line.omega)),
             Entry(seconds_text(line.time_limit_s)),
             word("yes" if report.lines.is_baseline(line) else ""),
             word(", ".join(f"{statuses[line][status]} {status}" for status in STATUSES_WITH_PLAN
                            if statuses[line][status])),
             word("; ".join(sorted({row.options for row in rows_of[line]})))] for line in report.lines.all]
    return html_table(["method", "ω", "time limit", "baseline", "status of its solved runs", "options"], rows)


def _within(line, found):
    """Returns the Entry with the number of solved runs of a line within omega. `found`: Measures of the line."""
    if found.within_omega is None:
        return Entry("–", f"{omega_text(line.omega)}: no guarantee")
    return Entry(str(found.within_omega))


def _common(found):
    return Entry(ratio(found.common_sqr), f"{found.common} common instances")


# A failure counts as the time limit, as in the paper.
MEDIAN = "median s (failures = limit)"
MEAN = "mean s (failures = limit)"
PAR2 = "PAR-2 s (failures = 2 × limit)"
SQR = "mean SQR (solved runs)"
COMMON_SQR = "mean SQR (common instances)"
COST_RATIO = "mean cost ratio (solved runs)"
WITHIN = "of these within ω"


def _best(values, better):
    values = [value for value in values if value is not None]
    return better(values) if values else None


def _summary(problem, lines):
    measured = problem.by_line.values()
    comparable = len({found.runs for found in measured}) == 1
    best_solved = max(found.solved for found in measured) if comparable else None
    best_par2 = min(found.par2_s for found in measured) if comparable else None
    has_baselines = any(lines.is_baseline(line) for line in problem.lines)
    claims = [(name, value) for name, value in (("invalid plans", lambda found: found.invalid),
                                              ("only claimed", lambda found: found.claimed))
            if any(map(value, measured))]
    header = ["method", "runs", "solved", *(name for name, _ in claims), WITHIN, "success rate", PAR2, MEDIAN, MEAN,
              SQR, COMMON_SQR, COST_RATIO,
              "solved by it alone",
              *(["solved by no baseline"] if has_baselines else [])]
    rows = []
    for line in problem.lines:
        found = problem.by_line[line]
        rows.append([
            word(lines.label(line)), Entry(str(found.runs)),
            Entry(str(found.solved), strong=found.solved == best_solved),
            *(Entry(str(value(found))) for _, value in claims), _within(line, found), Entry(percent(found.success)),
            Entry(seconds(found.par2_s), strong=found.par2_s == best_par2),
            Entry(seconds(found.median_runtime_s)), Entry(seconds(found.mean_runtime_s)),
            Entry(ratio(found.mean_sqr)), _common(found), Entry(ratio(found.mean_cost_ratio)),
            Entry(str(len(problem.only.get(line, ()))))])
        if has_baselines:
            rows[-1].append(Entry("" if lines.is_baseline(line) else
                                  str(problem.beyond.get(line, 0))))
    return html_table(header, rows)


def _matrix(problem, lines, value, show, better):
    """Returns a table with a row for each map, N and M and a column for each line. The best value in a row is bold."""
    rows = []
    for configuration, found in problem.configurations.items():
        values = {line: value(measured) for line, measured in found.items()}
        best = _best(values.values(), better) if better and len(set(values.values())) > 1 else None
        row = [word(configuration.map), Entry(str(configuration.agents)), Entry(str(configuration.tasks))]
        for line in problem.lines:
            if line not in found:
                row.append(NOTHING)
                continue
            row.append(Entry(show(values[line]), f"{found[line].solved} of {found[line].runs} solved",
                             strong=best is not None and values[line] == best))
        rows.append(row)
    header = ["map", Entry("N"), Entry("M"), *(Entry(lines.label(line)) for line in problem.lines)]
    return html_table(header, rows)


def _configurations(problem, lines):
    """Returns a table with a row for each configuration and line."""
    rows = [[word(configuration.map), Entry(str(configuration.agents)), Entry(str(configuration.tasks)),
             word(lines.label(line)),
             Entry(str(found[line].runs)), Entry(str(found[line].solved)), _within(line, found[line]),
             Entry(percent(found[line].success)), Entry(seconds(found[line].median_runtime_s)),
             Entry(ratio(found[line].mean_sqr)), _common(found[line]),
             Entry(ratio(found[line].mean_cost_ratio))]
            for configuration, found in problem.configurations.items() for line in problem.lines if line in found]
    return html_table(["map", "N", "M", "method", "runs", "solved", WITHIN, "success rate", MEDIAN, SQR,
                       COMMON_SQR, COST_RATIO], rows)


def _common_table(problem, lines):
    """Returns a table with a row for each line over all configurations, and for each configuration and line with common
    instances."""
    places = [(("all", "", ""), problem.by_line)] if len(problem.configurations) > 1 else []
    places += [(configuration, found) for configuration, found in problem.configurations.items()]
    rows = [[word(place[0]), Entry(str(place[1])), Entry(str(place[2])), Entry(str(found[line].common)),
             word(lines.label(line)), Entry(cost_text(found[line].common_mean_cost)),
             Entry(cost_text(found[line].common_median_cost)), Entry(ratio(found[line].common_cost_ratio)),
             Entry(seconds(found[line].common_mean_s)), Entry(seconds(found[line].common_median_s))]
            for place, found in places for line in problem.lines
            if line in found and found[line].common_mean_cost is not None]
    return html_table(["map", "N", "M", "instances", "method", "mean cost", "median cost", "mean cost ratio", "mean s",
                       "median s"], rows) if rows else _paragraph("There are none.")


def cost_text(value):
    return f"{value:.0f}" if value == int(value) else f"{value:.1f}"


def _anytime_table(problem, lines):
    """Returns a table of mean cost ratios at fixed times."""
    limit = max(line.time_limit_s for line in problem.lines)
    times = [time for time in table_times(limit) if f"{time:g}"[0] == "1" or time == limit]
    rows = []
    for panel in problem.panels:
        for line, curve in panel.curves.items():
            steps = [curve.at(time) if time <= line.time_limit_s else None for time in times]
            rows.append([word(panel.title), word(lines.label(line)), Entry(str(panel.common)),
                         *(_anytime_entry(step) for step in steps)])
    return html_table(["map", "method", Entry("common"), *(Entry(seconds_text(time)) for time in times)], rows)


def _anytime_entry(step):
    if step is None:
        return Entry("–", "no plan yet")
    some = "" if step.common_with_plan >= 1 - 1e-9 else f" ({100 * step.common_with_plan:.0f} %)"
    return Entry(ratio(step.cost_ratio) + (some if step.cost_ratio is not None else ""),
                 f"{100 * step.with_plan:.0f} % of all instances have a plan")


def _over_time(report, problem):
    if not problem.anytime:
        return []
    return ["<h3>Quality over time</h3>",
            _figure(problem.anytime, "Methods that improve their plans while they run. Intermediate plans are as the "
                    "runs report them; the last plan was checked. Below: the share of all instances with a plan. Lower "
                    "bounds of other solvers are drawn as claimed.", "column"),
            "<details><summary>Table: mean cost ratio by time</summary>",
            _paragraph("Mean over the common instances. If a share follows, the mean is over this share of them, which "
                       "have a plan by then. "
                       "Hold the pointer over a number for the share of all instances with a plan."),
            _anytime_table(problem, report.lines), "</details>",
            _file(report, "All of it, with cost / best lower bound, as a file", f"anytime_{problem.name}.csv")]


def _success(report, problem):
    if not problem.success:
        return []
    pooled = len({configuration.tasks for configuration in problem.configurations}) > 1
    return [_figure(problem.success, "Share of the runs that are solved"
                    + (", whatever the number of tasks." if pooled else ".")
                    + " Below the name of a map: number of instances and seeds of each point.", "column"),
            _file(report, "As a file", f"success_{problem.name}.csv")]


def _common_section(report, problem):
    return ["<h3>Instances that all methods solve</h3>",
            _paragraph("Costs and times of the common instances: those that all methods solve with every seed, not "
                       "counting methods that solve none. Rows: all instances, and each map, number of agents and "
                       "number of tasks. Means of costs and times are comparable only here. The weakest method "
                       "determines which instances these are (--method excludes methods)."),
            _common_table(problem, report.lines), _file(report, "As a file", f"common_{problem.name}.csv")]


def _speedup_entry(found):
    if found is None:
        return NOTHING
    sign = {"exactly": "", "at least": "≥ ", "at most": "≤ ", "about": "~ "}[found.sure]
    hint = (f"{found.instances} instances; median time {seconds(found.baseline_median_s)} s of the "
            f"baseline, {seconds(found.line_median_s)} s of this method; failures: "
            f"{found.baseline_failed} of the baseline, {found.line_failed} of this method")
    digits = 0 if found.median_ratio >= 100 else 1 if found.median_ratio >= 10 else 2
    return Entry(f"{sign}{found.median_ratio:.{digits}f}", hint)


def _speedups(problem, lines):
    if not any(lines.is_baseline(line) for line in problem.lines):
        return [_paragraph("There is no comparison, because none of the methods is a baseline (see --baseline).")]
    if not problem.speedups:
        return [_paragraph("There is no comparison, because on every instance that a baseline solves, the "
                           "fastest baseline takes at most a second.")]
    return [_paragraph(
        f"Median of (time of the baseline / time of the method) on the {problem.hard} instances that the best "
        "baseline (the fastest on each instance) solves in more than a second. Above 1 the method is faster. A "
        "failure counts as the time limit. If the median depends on failures, ≥ means that the true ratio may be "
        "larger, ≤ smaller, ~ either. Times below a millisecond count as one millisecond. Hold the pointer over a "
        "number for times and failures."),
        _speedup_table(problem, lines)]


def _speedup_table(problem, lines):
    found = {(each.map, each.baseline, each.line): each for each in problem.speedups}
    order = {line: index for index, line in enumerate([BEST, *lines.all])}
    keys = sorted({(each.map, each.baseline) for each in problem.speedups},
                  key=lambda key: (key[0], order[key[1]]))
    rows = []
    for name, baseline in keys:
        here = [each.instances for each in problem.speedups
                if (each.map, each.baseline) == (name, baseline)]
        rows.append([word("all maps" if name == ALL_MAPS else name),
                     word(BEST.method if baseline == BEST else lines.label(baseline)),
                     Entry(str(max(here))),
                     *(_speedup_entry(found.get((name, baseline, line)))
                       for line in problem.lines)])
    header = ["map", "baseline", Entry("instances"),
              *(Entry(lines.label(line)) for line in problem.lines)]
    return html_table(header, rows)


def _only(problem, lines):
    if not problem.only:
        return _paragraph("Every solved instance is solved by several methods.")
    maps = sorted({configuration.map for configuration in problem.configurations})
    rows = [[word(lines.label(line)), Entry(str(len(problem.only[line]))),
             *(Entry(str(sum(row.map == name for row in problem.only[line]))) for name in maps)]
            for line in problem.lines if line in problem.only]
    return html_table(["method", Entry("all maps"), *map(Entry, maps)], rows)


def _counters(problem, lines):
    """Returns a table with a row for each counter and a column for each line with counters."""
    counters = problem.counters
    shown = [line for line in problem.lines if line in counters]
    rows = [[word(label(name)), *(Entry(count(counters[line].mean(name))) for line in shown)]
            for name in other_names(counters)]
    for what in cache_names(counters):
        shares = [counters[line].hit_share(what) for line in shown]
        rows.append([word(f"{label(what)}: share of cache hits"),
                     *(Entry("–" if share is None else percent(share)) for share in shares)])
    return html_table(["mean per run", *(Entry(lines.label(line)) for line in shown)], rows)


def _search(report, problem):
    if not problem.counters:
        return []
    name = problem.name
    parts = ["<h3>Search counters</h3>"]
    if problem.splits:
        parts.append(_figure(problem.splits, "Over all runs that report splits, including failures. Long runs have "
                             "more weight, because they split more nodes."))
    return [*parts, "<details><summary>Table: other counters</summary>", _counters(problem, report.lines), "</details>",
            _file(report, "All counters, summed over the runs", f"search_{name}.csv")]


def _problem(report, problem):
    name, lines = problem.name, report.lines
    compared = next(iter(problem.by_line.values())).common
    parts = [f'<h2 id="{name}">{_text(PROBLEM_NAMES[name])}: comparison</h2>',
             _paragraph(f"{len(problem.rows)} runs of {problem.instances} instances. Every figure and table "
                        "has one line or column for each method with one ω and one time limit."),
             "<h3>All instances together</h3>", _summary(problem, lines),
             _paragraph("Bold: the best value, if all methods have equally many runs. Of these within ω: solved runs "
                        "that prove that their plan is within ω. Mean SQR of solved runs is over the runs that each "
                        "method solved: a method that solves only easy instances looks better. Mean SQR of common "
                        f"instances is over the {compared} instances that all methods solve (of those that solve any), "
                        "so it is comparable. Solved by it alone: instances that no other method solves. Solved by no "
                        "baseline: instances that it solves, that a baseline tried, and that no baseline solved."),
             _file(report, "As a file", f"summary_{name}.csv"), *_success(report, problem),
             _paragraph("The figures have a row for each metric and a column for each map and number of agents N. If "
                        "the number of tasks M does not vary, they have a column for each map, with N along the axis. "
                        "Runtime is on a log axis; a failure counts as the time limit (dotted). SQR: higher is "
                        "better; cost ratio: 1 is best. Where lines coincide, the lower ones are broader "
                        "and have larger markers. Figures saved from this page are SVG files."),
             '<div class="figures">', *(_figure(figure) for figure in problem.comparison), "</div>"]
    parts += ["<details><summary>Table: every configuration (map, N, M) and method</summary>",
              _configurations(problem, lines),
              "</details>"]
    for title, value, show, better in (
            ("Success rate", lambda found: found.success, percent, max),
            ("Median runtime in s (failures = limit)", lambda found: found.median_runtime_s, seconds, min),
            ("Mean runtime in s (failures = limit)", lambda found: found.mean_runtime_s, seconds, min),
            ("Mean SQR (solved runs)", lambda found: found.mean_sqr, ratio, None),
            ("Mean SQR (common instances)", lambda found: found.common_sqr, ratio, max),
            ("Mean cost ratio (solved runs)", lambda found: found.mean_cost_ratio, ratio, None)):
        parts += [f"<details><summary>Table: {title}</summary>",
                  _matrix(problem, lines, value, show, better), "</details>"]
    parts += [_file(report, "All values as a file", f"comparison_{name}.csv"),
              "<h3>Solved by a given time</h3>",
              _figure(problem.cactus, "Cactus plot: number of instances that each method solves within a given time "
                      "per instance. Further up and further left is better. Dotted: number of instances."),
              *_over_time(report, problem), *_common_section(report, problem),
              *_search(report, problem),
              "<h3>Speed-up over the baselines</h3>",
              *_speedups(problem, lines), _file(report, "As a file", f"speedup_{name}.csv"),
              "<h3>Instances that only one method solves</h3>", _only(problem, lines),
              _file(report, "The instances", f"only_solver_{name}.csv")]
    return "\n".join(parts)


def _study_table(study, lines):
    rows = []
    for configuration, found in study.configurations.items():
        rows += [[word(configuration.map), Entry(str(configuration.agents)), Entry(str(configuration.tasks)),
                  word(omega_text(line.omega) if line in study.family.lines else lines.label(line), lines.label(line)),
                  Entry(str(found[line].runs)),
                  Entry(str(found[line].solved)), _within(line, found[line]),
                  Entry(percent(found[line].success)), Entry(seconds(found[line].mean_runtime_s)),
                  Entry(ratio(found[line].mean_sqr)), _common(found[line]),
                  Entry(ratio(found[line].mean_cost_ratio)), Entry(count(found[line].mean_roots)),
                  Entry(count(found[line].mean_rtsp_calls))]
                 for line in study.lines if line in found]
    return html_table(["map", "N", "M", "ω", "runs", "solved", WITHIN, "success rate", MEAN, SQR, COMMON_SQR,
                       COST_RATIO, "mean roots", "mean rTSP calls"], rows)


def _studies(report):
    parts = ['<h2 id="omega">The influence of ω</h2>',
             _paragraph("The same method with several values of ω. The larger ω, the longer the search stays in the "
                        "trees that it has before it begins another one: fewer roots, fewer sequencing problems (rTSP "
                        "calls), an earlier plan, which may be worse.")]
    for study in report.studies:
        parts += [_figure(study.figure, f"{PROBLEM_NAMES[study.problem]}, map {study.map}, "
                          f"N = {study.agents}. (b) to (g) by number of tasks M; runtime and numbers on log "
                          "axes. SQR of solved runs is over the runs solved with each ω: an ω with which only "
                          "easy instances are solved looks better."),
                  "<details><summary>Table: all maps and numbers of agents</summary>",
                  _study_table(study, report.lines), "</details>",
                  _file(report, "As a file", f"{study.figure.stem}.csv")]
    return "\n".join(parts)


def _flag(value):
    return word("yes" if value else "")


def _best_known(report):
    """Returns the section that compares the rows with the best known values of MAPF Tracker."""
    known = report.best_known
    if known is None:
        return []
    head = ['<h2 id="tracker">Comparison with MAPF Tracker</h2>',
            _paragraph(f"{known.entries} entries were read from {', '.join(known.files)}; "
                       f"{len({each.place for each in known.found})} of them are instances here. Costs are of checked "
                       "plans, bounds are Grove's own. Closed: the bound meets the best cost, and the bound of the "
                       "archive does not.")]
    if not known.found:
        return head
    by = grouped(known.found, lambda each: each.line)
    rows = []
    for line in report.lines.all:
        group = by.get(line, [])
        ratios = [each.cost_ratio for each in group if each.cost_ratio is not None]
        if group:
            rows.append([word(report.lines.label(line)), Entry(str(len(group))), Entry(str(len(ratios))),
                         Entry(ratio(sum(ratios) / len(ratios) if ratios else None)),
                         Entry(str(sum(value == 1 for value in ratios))),
                         *(Entry(str(sum(getattr(each, name) for each in group)))
                           for name in ("better_plan", "higher_bound", "closes"))])
    better = [each for each in known.found if each.better_plan or each.higher_bound or each.closes]
    parts = [*head,
             html_table(["method", "instances", "with a plan", "mean cost / best known", "as good", "better plans",
                         "higher bounds", "closed"], rows),
             _file(report, "Every instance as a file", "best_known.csv")]
    if better:
        parts += ["<h3>Improvements on the best known values</h3>", html_table(
            ["instance", "method", Entry("best known bound"), Entry("best known cost"), Entry("cost"),
             Entry("lower bound"), "better plan", "higher bound", "closes"],
            [[word(each.instance), word(report.lines.label(each.line)),
              *(Entry("–" if value is None else str(value)) for value in (*each.known, each.cost, each.bound)),
              _flag(each.better_plan), _flag(each.higher_bound), _flag(each.closes)] for each in better[:MOST_LISTED]])]
        if len(better) > MOST_LISTED:
            parts.append(_paragraph(f"And {len(better) - MOST_LISTED} more in the file."))
    return parts


def _runs(report):
    """Returns the section on single runs, from their logs."""
    if not report.runs:
        return []
    rows = [[word(run.name), word(run.instance), Entry("–" if run.agents is None else str(run.agents)),
             word(run.status or "the log is incomplete"),
             *(Entry("–" if value is None else str(value)) for value in run.moments[-1][1:] or (None, None)),
             Entry(seconds(run.end_s)), word(run.options)] for run in report.logs if run.moments]
    return ['<h2 id="runs">Single runs</h2>',
            _figure(report.runs, "Lower bound and best plan over time, from the logs. grove view --run shows one log "
                    "as an interactive page.", "column"),
            html_table(["log", "instance", Entry("N"), "status", Entry("cost"), Entry("lower bound"), Entry("s"),
                        "options"], rows),
            _file(report, "As a file", "runs.csv"), *_bound_sources(report)]


def _bound_sources(report):
    """Returns the part on what raised the lower bound of each run, and by how many steps."""
    if not report.bound_sources:
        return []
    shares = [(run.name, run.shares()) for run in report.logs]
    labels = bound_sources(report.logs)
    rows = [[word(name), *(Entry(str(found.get(source, 0))) for source in labels), Entry(str(sum(found.values())))]
            for name, found in shares if found]
    return [_figure(report.bound_sources, "What each source has raised the lower bound by, in steps.", "column"),
            html_table(["log", *(Entry(label) for label in labels.values()), Entry("sum")], rows),
            _file(report, "As a file", "bound_sources.csv")]


def _glossary():
    return ("<h2 id=\"words\">Terms</h2><dl>" + "".join(
        f"<dt>{_text(name)}</dt><dd>{_text(text)}</dd>" for name, text in GLOSSARY) + "</dl>")


def _origin(report):
    if not report.results.rows:
        return []
    return ['<h2 id="origin">Source of the rows</h2>', _provenance(report), "<h3>Methods</h3>", _methods(report)]


def page(report):
    """Returns the whole page as text."""
    css = (Path(__file__).parent / "page.css").read_text(encoding="utf-8")
    links = [(problem.name, PROBLEM_NAMES[problem.name].split(" (")[0])
             for problem in report.problems]
    if report.studies:
        links.append(("omega", "The influence of ω"))
    if report.best_known:
        links.append(("tracker", "Comparison with MAPF Tracker"))
    if report.runs:
        links.append(("runs", "Single runs"))
    links += [("words", "Terms"),
              *([("origin", "Source of the rows")] if report.results.rows else [])]
    parts = [
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">',
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f'<link rel="icon" href="data:,"><title>Grove report</title><style>{css}</style></head><body>',
        "<h1>Grove report</h1>",
        _paragraph("Comparison of methods for multi-agent path finding with tasks on the same instances: "
                   "number of solved instances, runtime, and quality of the plans."),
        "<nav>" + "".join(f'<a href="#{name}">{_text(text)}</a>' for name, text in links) + "</nav>",
        *([_false_claims(report), _alarm(report)] if report.results.rows else [])]
    if report.notes:
        parts.append(_box("note", ["<b>Before you compare</b>", _list(report.notes)]))
    parts.append(_errors(report))
    parts += [_problem(report, problem) for problem in report.problems]
    if report.studies:
        parts.append(_studies(report))
    parts += [*_best_known(report), *_runs(report), _glossary(), *_origin(report), "</body></html>\n"]
    return "\n".join(part for part in parts if part)
