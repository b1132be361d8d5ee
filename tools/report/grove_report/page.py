# SPDX-License-Identifier: MIT
"""The HTML page: one file, no script, nothing loaded from anywhere."""
import base64
import html
from collections import Counter
from pathlib import Path

from .anytime import table_times
from .counters import label, other_names, remembered_things
from .groups import grouped
from .lines import method_name, omega_text, seconds_text
from .metrics import by_line
from .report import PROBLEM_NAMES
from .rows import STATUSES_WITH_PLAN
from .speedup import ALL_MAPS, BEST
from .tables import NOTHING, Entry, count, html_table, percent, ratio, seconds, word

# Refuses whatever is not in the file, should something ever ask for it.
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"
MOST_LISTED = 100

GLOSSARY = [
    ("CTS-MAPF", "Agents on a grid, each with a start, cells to visit in any order (its tasks) and a "
     "destination, must not collide. The sum of their finish times, the cost, is to be small."),
    ("MG-MAPF", "The same without destinations: an agent may end on any of its own tasks."),
    ("N, M", "The number of agents; the number of tasks (one task may belong to several agents)."),
    ("ω", "How far from optimal a plan may be, as the method was told: at most (1 + ω) times the least "
     "possible cost. 0: optimal; ∞: no promise. Not every method proves it for the whole problem: one that "
     "first chooses the agents' destinations, say, may stop within ω of the best plan for these, however "
     "much better another choice is."),
    ("Solved", "The run ended by itself with a plan that was re-checked: no more. A run that a limit ended "
     "is a failure, even with a plan. Solved runs may be outside ω."),
    ("Within ω", "A solved run that proves what ω says: the plan is optimal, or costs at most (1 + ω) times "
     "the lower bound that the run proved. The others are outside ω; the plan may still be good, but nothing "
     "shows it. A dash where ω is ∞ or not given: nothing was promised."),
    ("Status", "Of a plan: optimal; bounded, proven to be within ω; feasible, neither."),
    ("Success rate", "Solved runs / all runs. Higher is better."),
    ("Runtime", "Wall time of a run in seconds; a failure counts as the time limit. So the mean of a "
     "method with many failures says little but that. Lower is better."),
    ("Seeds", "Runs that differ in the seed alone are repetitions of one instance: first the mean over these, then "
     "over instances. Success rate of an instance: the share of its runs that are solved."),
    ("Claimed, wrong", "Of other solvers: a run that told a cost and showed no plan; one whose plan is none, as it "
     "collides, jumps or does not arrive. Neither counts as solved, nor as a cost that is known."),
    ("Anytime", "A method that goes on improving its plan until its time limit, which is no failure: it counts as solved, "
     "and its runtime is the time to its first plan."),
    ("SQR, solution quality ratio", "Root cost / cost of the plan, of solved runs. The root cost is what the "
     "agents' best sequences cost together when nobody minds the others: a lower bound on the optimum. 1 "
     "is thus the best there can be, and the optimum may lie below 1. Each method is averaged over the runs "
     "that it solved: one that solves only the easy instances looks better than one that solves the hard "
     "ones too, whose SQR is lower for everybody."),
    ("Common instances", "Those that every method solves, with every seed, which solves any of the cell (map, N, M) or "
     "table: on these costs, times and the mean SQR of methods compare. The weakest method decides which they are, and "
     "they are the easy ones; --method leaves methods out. Of quality over time: those for which all have a plan in the "
     "end."),
    ("Cost ratio", "Cost of the plan / best known cost, of solved runs. The best known cost is the least that "
     "any row here has for the instance, runs that a limit ended included, and what MAPF Tracker has where it was read. 1 is the best, 1.05 is 5 % dearer. "
     "Unlike SQR it does not fall because an instance is hard, so that methods compare even where one "
     "solves more. Where no other method has a plan, it is 1 whatever the plan: nothing better is known."),
    ("PAR-2", "Mean runtime where a failure counts as twice the time limit. Lower is better."),
    ("Roots, rTSP calls", "Constraint trees that the search began, and sequencing problems that it solved to "
     "find them; means over all runs that tell, failures included."),
    ("Gap, lower bound", "No plan costs less than the lower bound; gap = (cost - lower bound) / lower bound."),
    ("Baseline", "A method that others are measured by: dashed lines, hollow markers."),
]


def _text(text):
    return html.escape(str(text))


def _paragraph(text):
    return f"<p>{_text(text)}</p>"


def _data(kind, content):
    return f"data:{kind};base64,{base64.b64encode(content).decode('ascii')}"


def _file(report, before, name):
    """A table to be saved from the page, which holds it: the page may have been moved away from its folder."""
    return f'<p>{_text(before)}: <a download="{name}" href="{_data("text/csv", report.files[name])}">{name}</a>.</p>'


def _figure(figure, caption="", kind=""):
    """`kind`: "column": as wide as a column of a paper"""
    return (f'<figure class="{kind}"><img alt="{_text(figure.title)}" src="{_data("image/svg+xml", figure.svg.encode("utf-8"))}">'
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
                   "instances have one name. No figure below is to be trusted before this is explained."),
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
    told = ", ".join(f"{name}: {number} of a {kind}" for (name, kind), number in sorted(kinds.items()))
    return _box("alarm", [
        f"<h2>FALSE CLAIMS: {len(found)}</h2>",
        _paragraph(f"What solvers say, against what was checked here ({told}). A wrong plan counts as a failure, costs are "
                   "as recounted, and nothing else is built on what they say."),
        _file(report, "All of them", "false_claims.csv"), _list(shown)])


def _errors(report):
    if not report.errors:
        return ""
    rows = [[word(report.lines.label(line)), Entry(str(number)), word(message or "(no message)")]
            for line, number, message in report.errors]
    return _box("note", ["<b>Runs that failed with an error</b>",
                         _paragraph("They crashed or gave a wrong plan; they count as failures."),
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
        ("Runs ended", f"{ended[0]} to {ended[-1]}" if ended else "not told"),
        ("Machines", _span({row.machine for row in rows} - {""}) or "not told"),
        ("Versions", _span({row.version for row in rows} - {""}) or "not told"),
        ("Threads", _span({row.threads for row in rows if row.threads is not None}) or "not told"),
        ("Time limits", _span({row.time_limit_s for row in rows}, seconds_text)),
        ("Seeds", _span({row.seed for row in rows if row.seed is not None}) or "not told"),
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
    """How many of the solved rows of a line, measured as `found`, are within omega."""
    if found.within_omega is None:
        return Entry("–", f"{omega_text(line.omega)}: no promise")
    return Entry(str(found.within_omega))


def _common(found):
    return Entry(ratio(found.common_sqr), f"{found.common} common instances")


# A failure has no time of its own: the paper's convention.
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
    told = [(name, value) for name, value in (("wrong plans", lambda found: found.wrong),
                                              ("only claimed", lambda found: found.claimed))
            if any(map(value, measured))]
    header = ["method", "runs", "solved", *(name for name, _ in told), WITHIN, "success rate", PAR2, MEDIAN, MEAN, SQR, COMMON_SQR, COST_RATIO,
              "solved by it alone",
              *(["solved by no baseline"] if has_baselines else [])]
    rows = []
    for line in problem.lines:
        found = problem.by_line[line]
        rows.append([
            word(lines.label(line)), Entry(str(found.runs)),
            Entry(str(found.solved), strong=found.solved == best_solved),
            *(Entry(str(value(found))) for _, value in told), _within(line, found), Entry(percent(found.success)),
            Entry(seconds(found.par2_s), strong=found.par2_s == best_par2),
            Entry(seconds(found.median_runtime_s)), Entry(seconds(found.mean_runtime_s)),
            Entry(ratio(found.mean_sqr)), _common(found), Entry(ratio(found.mean_cost_ratio)),
            Entry(str(len(problem.only.get(line, ()))))])
        if has_baselines:
            rows[-1].append(Entry("" if lines.is_baseline(line) else
                                  str(problem.beyond.get(line, 0))))
    return html_table(header, rows)


def _matrix(problem, lines, value, show, better):
    """Rows map, N, M; a column for each line; the best of each row is strong."""
    rows = []
    for cell, found in problem.cells.items():
        values = {line: value(measured) for line, measured in found.items()}
        best = _best(values.values(), better) if better and len(set(values.values())) > 1 else None
        row = [word(cell.map), Entry(str(cell.agents)), Entry(str(cell.tasks))]
        for line in problem.lines:
            if line not in found:
                row.append(NOTHING)
                continue
            row.append(Entry(show(values[line]), f"{found[line].solved} of {found[line].runs} solved",
                             strong=best is not None and values[line] == best))
        rows.append(row)
    header = ["map", Entry("N"), Entry("M"), *(Entry(lines.label(line)) for line in problem.lines)]
    return html_table(header, rows)


def _cells(problem, lines):
    """A row for each cell and line."""
    rows = [[word(cell.map), Entry(str(cell.agents)), Entry(str(cell.tasks)), word(lines.label(line)),
             Entry(str(found[line].runs)), Entry(str(found[line].solved)), _within(line, found[line]),
             Entry(percent(found[line].success)), Entry(seconds(found[line].median_runtime_s)),
             Entry(ratio(found[line].mean_sqr)), _common(found[line]),
             Entry(ratio(found[line].mean_cost_ratio))]
            for cell, found in problem.cells.items() for line in problem.lines if line in found]
    return html_table(["map", "N", "M", "method", "runs", "solved", WITHIN, "success rate", MEDIAN, SQR,
                       COMMON_SQR, COST_RATIO], rows)


def _common_table(problem, lines):
    """A row for each cell and line that has a part in it, and one for each line over all cells."""
    places = [(("all", "", ""), problem.by_line)] if len(problem.cells) > 1 else []
    places += [(cell, found) for cell, found in problem.cells.items()]
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
    """At fixed times: how many have a plan, and what it costs."""
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
            _figure(problem.anytime, "Of methods that improve their plans while they run, as their runs tell on the way; the "
                    "last plan was re-checked. Below: the share of all instances with a plan. A lower bound that another "
                    "solver only claims is drawn as it claims it.", "column"),
            "<details><summary>Table: mean cost ratio by time</summary>",
            _paragraph("Mean over the common instances; with a share behind it, over as many of them as have a plan by then. "
                       "Hold the pointer over a number for the share of all instances with a plan."),
            _anytime_table(problem, report.lines), "</details>",
            _file(report, "All of it, with cost / best lower bound, as a file", f"anytime_{problem.name}.csv")]


def _success(report, problem):
    if not problem.success:
        return []
    pooled = len({cell.tasks for cell in problem.cells}) > 1
    return [_figure(problem.success, "Share of the runs that are solved"
                    + (", whatever the number of tasks." if pooled else ".")
                    + " Under the name of a map: what is behind each point of a line.", "column"),
            _file(report, "As a file", f"success_{problem.name}.csv")]


def _common_section(report, problem):
    return ["<h3>Instances that all solve</h3>",
            _paragraph("Costs and times of the instances that every method solves, with every seed, which solves any: of all, "
                       "and of each map, number of agents and number of tasks. Only here means of costs and of times "
                       "compare; the weakest method decides which instances these are (--method leaves it out)."),
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
        return [_paragraph("None of the methods here is a baseline (--baseline names them), so there is "
                           "nothing to compare with.")]
    if not problem.speedups:
        return [_paragraph("On every instance that a baseline solves, the fastest one takes less than a "
                           "second, so there is nothing to compare.")]
    return [_paragraph(
        f"On the {problem.hard} instances that the best baseline (on each instance whichever is the "
        "fastest) solves, but only after more than a second: the median of the baseline's time / the "
        "method's time. Above 1 the method is faster. A failure counts as the time limit: where the median "
        "depends on that, ≥ says that the true ratio may be larger, ≤ smaller, ~ either. Times below a "
        "millisecond count as one. Hold the pointer over a number for times and failures."),
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
        return _paragraph("Every instance that is solved at all is solved by several methods.")
    maps = sorted({cell.map for cell in problem.cells})
    rows = [[word(lines.label(line)), Entry(str(len(problem.only[line]))),
             *(Entry(str(sum(row.map == name for row in problem.only[line]))) for name in maps)]
            for line in problem.lines if line in problem.only]
    return html_table(["method", Entry("all maps"), *map(Entry, maps)], rows)


def _counters(problem, lines):
    """A row for each counter, a column for each line that tells."""
    counters = problem.counters
    told = [line for line in problem.lines if line in counters]
    rows = [[word(label(name)), *(Entry(count(counters[line].mean(name))) for line in told)]
            for name in other_names(counters)]
    for what in remembered_things(counters):
        shares = [counters[line].remembered(what) for line in told]
        rows.append([word(f"{label(what)}: share remembered"),
                     *(Entry("–" if share is None else percent(share)) for share in shares)])
    return html_table(["mean per run", *(Entry(lines.label(line)) for line in told)], rows)


def _search(report, problem):
    if not problem.counters:
        return []
    name = problem.name
    parts = ["<h3>What the search did</h3>"]
    if problem.splits:
        parts.append(_figure(problem.splits, "Of all runs that tell, failures included. Long runs count for more: they "
                             "split more nodes."))
    return [*parts, "<details><summary>Table: other counters</summary>", _counters(problem, report.lines), "</details>",
            _file(report, "All of them, summed over the runs", f"search_{name}.csv")]


def _problem(report, problem):
    name, lines = problem.name, report.lines
    compared = next(iter(problem.by_line.values())).common
    parts = [f'<h2 id="{name}">{_text(PROBLEM_NAMES[name])}: comparison</h2>',
             _paragraph(f"{len(problem.rows)} runs of {problem.instances} instances. Every figure and table "
                        "has one line or column for each method with one ω and one time limit."),
             "<h3>All instances together</h3>", _summary(problem, lines),
             _paragraph("Bold: the best, where all have as many runs. Of these within ω: solved runs that prove "
                        "their plan to be as good as ω asks. Mean SQR of solved runs is over those that each method "
                        "solved: one that solves only the easy instances looks better. Mean SQR of common "
                        f"instances is over the {compared} that all methods solve which solve any, so it compares. "
                        "Solved by it alone: instances that no other method solves. Solved by no baseline: that it "
                        "solves and no baseline that tried does."),
             _file(report, "As a file", f"summary_{name}.csv"), *_success(report, problem),
             _paragraph("The figures have a column for each map and number of agents N (where the number of tasks "
                        "M does not vary: for each map, with N along the axis), a row for each metric. "
                        "Runtime is on a log axis; a failure counts as the time limit (dotted). SQR: higher is "
                        "better; cost ratio: 1 is best. Where lines lie on each other, those below are broader "
                        "and have larger markers. A figure that is saved from this page is an SVG."),
             '<div class="figures">', *(_figure(figure) for figure in problem.comparison), "</div>"]
    parts += ["<details><summary>Table: every cell (map, N, M) and method</summary>", _cells(problem, lines),
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
    parts += [_file(report, "All of it as a file", f"comparison_{name}.csv"),
              "<h3>Solved by a given time</h3>",
              _figure(problem.cactus, "How many instances each method has solved when a given time per "
                      "instance has passed (cactus plot). Further up and further left is better; dotted: "
                      "all there are."),
              *_over_time(report, problem), *_common_section(report, problem),
              *_search(report, problem),
              "<h3>Speed-up over the baselines</h3>",
              *_speedups(problem, lines), _file(report, "As a file", f"speedup_{name}.csv"),
              "<h3>Instances that a single method solves</h3>", _only(problem, lines),
              _file(report, "The instances", f"only_solver_{name}.csv")]
    return "\n".join(parts)


def _study_table(study, lines):
    rows = []
    for cell, found in study.cells.items():
        rows += [[word(cell.map), Entry(str(cell.agents)), Entry(str(cell.tasks)),
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
             _paragraph("The same method with several ω. The larger ω, the longer the search keeps to the trees "
                        "it has before it begins another: fewer roots, fewer sequencing problems (rTSP "
                        "calls), sooner a plan, and perhaps a worse one.")]
    for study in report.studies:
        parts += [_figure(study.figure, f"{PROBLEM_NAMES[study.problem]}, map {study.map}, "
                          f"N = {study.agents}. (b) to (g) by number of tasks M; runtime and numbers on log "
                          "axes. SQR of solved runs is over those solved with each ω: an ω with which only the "
                          "easy instances are solved looks better."),
                  "<details><summary>Table: all maps and numbers of agents</summary>",
                  _study_table(study, report.lines), "</details>",
                  _file(report, "As a file", f"{study.figure.stem}.csv")]
    return "\n".join(parts)


def _flag(value):
    return word("yes" if value else "")


def _best_known(report):
    """What the rows are worth beside MAPF Tracker."""
    told = report.best_known
    if told is None:
        return []
    head = ['<h2 id="tracker">Beside MAPF Tracker</h2>',
            _paragraph(f"{told.entries} entries were read from {', '.join(told.files)}; "
                       f"{len({each.place for each in told.found})} of them are instances here. Costs are of checked plans, "
                       "bounds are Grove's own. Closed: the bound meets the best cost, and did not yet in the archive.")]
    if not told.found:
        return head
    by = grouped(told.found, lambda each: each.line)
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
    news = [each for each in told.found if each.better_plan or each.higher_bound or each.closes]
    parts = [*head, html_table(["method", "instances", "with a plan", "mean cost / best known", "as good", "better plans",
                                "higher bounds", "closed"], rows),
             _file(report, "Every instance as a file", "best_known.csv")]
    if news:
        parts += ["<h3>Better than what is known</h3>", html_table(
            ["instance", "method", Entry("best known bound"), Entry("best known cost"), Entry("cost"),
             Entry("lower bound"), "better plan", "higher bound", "closes"],
            [[word(each.instance), word(report.lines.label(each.line)),
              *(Entry("–" if value is None else str(value)) for value in (*each.known, each.cost, each.bound)),
              _flag(each.better_plan), _flag(each.higher_bound), _flag(each.closes)] for each in news[:MOST_LISTED]])]
        if len(news) > MOST_LISTED:
            parts.append(_paragraph(f"And {len(news) - MOST_LISTED} more in the file."))
    return parts


def _runs(report):
    """Single runs, of their logs."""
    if not report.runs:
        return []
    rows = [[word(run.name), word(run.instance), Entry("–" if run.agents is None else str(run.agents)),
             word(run.status or "the log ends before the run"),
             *(Entry("–" if value is None else str(value)) for value in run.moments[-1][1:] or (None, None)),
             Entry(seconds(run.end_s)), word(run.options)] for run in report.logs if run.moments]
    return ['<h2 id="runs">Single runs</h2>',
            _figure(report.runs, "Bound and best plan over time of the runs whose logs were read. grove view --run shows one "
                    "of them as a page.", "column"),
            html_table(["log", "instance", Entry("N"), "status", Entry("cost"), Entry("lower bound"), Entry("s"),
                        "options"], rows),
            _file(report, "As a file", "runs.csv")]


def _glossary():
    return ("<h2 id=\"words\">What the words mean</h2><dl>" + "".join(
        f"<dt>{_text(name)}</dt><dd>{_text(text)}</dd>" for name, text in GLOSSARY) + "</dl>")


def _origin(report):
    if not report.results.rows:
        return []
    return ['<h2 id="origin">Where the rows come from</h2>', _provenance(report), "<h3>Methods</h3>", _methods(report)]


def page(report):
    """The whole page as text."""
    css = (Path(__file__).parent / "page.css").read_text(encoding="utf-8")
    links = [(problem.name, PROBLEM_NAMES[problem.name].split(" (")[0])
             for problem in report.problems]
    if report.studies:
        links.append(("omega", "The influence of ω"))
    if report.best_known:
        links.append(("tracker", "Beside MAPF Tracker"))
    if report.runs:
        links.append(("runs", "Single runs"))
    links += [("words", "What the words mean"),
              *([("origin", "Where the rows come from")] if report.results.rows else [])]
    parts = [
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">',
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f'<link rel="icon" href="data:,"><title>Grove report</title><style>{css}</style></head><body>',
        "<h1>Grove report</h1>",
        _paragraph("Methods for multi-agent path finding with tasks, compared on the same instances: how "
                   "many they solve, how fast, and how good the plans are."),
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
