# SPDX-License-Identifier: MIT
"""Draws plots as wide as a column of a paper: success over the number of agents, quality over time, single runs and
the sources of their lower bounds."""
import itertools
import math

import matplotlib
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, MaxNLocator, NullLocator

from .figures import (COLUMN, FAINT, SETTINGS, SHORTEST_S, SMALLEST, add_caption, add_legend, legend_height, new_figure,
                      number, pin_labels, wrapped)
from .logs import bound_sources
from .scales import dodged, rounded_down
from .style import COLOURS, DASHES, KIND_COLOURS, MARKERS, SOURCE_COLOURS, depth, plot_arguments

TITLE = 0.4  # height of two lines, inches
LEFT, RIGHT = 0.46, 0.06
DIGITS = 0.13  # additional left margin for numbers of four digits, inches
RUN_DASHES = [pattern for pattern in DASHES if pattern[0] > 2]  # without dotted patterns, which are for bounds
MAX_STEPS = 300  # maximum number of steps that are drawn per curve

ANYTIME_CAPTION = (
    "Cost ratio: cost / best known cost, mean over the common instances (all methods end with a plan). Thin: while "
    "some of these have no plan yet, mean over those that have one. Dotted, below 1, if reported: lower bound / best "
    "known cost.")


def _grid(count, widest=2):
    across = min(count, widest)
    return across, math.ceil(count / across)


def _range(numbers):
    low, high = min(numbers), max(numbers)
    return str(low) if low == high else f"{low} to {high}"


def behind(points):
    """Returns a text such as '25 instances, 3 seeds' for the points of a panel. `points`: list of Measures."""
    instances, seeds = _range([point.instances for point in points]), _range([point.seeds for point in points])
    return (f"{instances} instance{'s' * (instances != '1')}"
            + (f", {seeds} seeds" if seeds != "1" else ""))


def success(groups, lines, looks):
    """Plots the success rate over the number of agents, one panel per map.

    groups: {map: {agents: {line: Measures}}}.
    """
    with matplotlib.rc_context(SETTINGS):
        across, down = _grid(len(groups))
        legend = legend_height(lines, looks, COLUMN)
        panel, bottom = 1.15, 0.42
        height = legend + down * (panel + TITLE + bottom)
        figure = new_figure(height, COLUMN)
        axes = figure.subplots(down, across, squeeze=False, sharey=True, gridspec_kw={
            "left": LEFT / COLUMN, "right": 1 - RIGHT / COLUMN, "bottom": bottom / height,
            "top": 1 - (legend + TITLE) / height, "wspace": 0.12, "hspace": (TITLE + bottom) / panel})
        for ax, (name, by_agents) in zip(axes.flat, groups.items()):
            numbers = sorted(by_agents)
            offsets = dodged(numbers, lines)
            for rank, line in enumerate(lines):
                points = [(agents + offsets[line], 100 * by_agents[agents][line].success) for agents in numbers
                          if line in by_agents[agents]]
                ax.plot(*zip(*points) if points else ([], []),
                        **plot_arguments(looks.style(line), 0.6 * depth(rank, len(lines))))
            _set_agents(ax, numbers)
            ax.set_ylim(-6, 106)
            ax.yaxis.set_major_locator(FixedLocator([0, 25, 50, 75, 100]))
            _name_panel(ax, name, behind([each for found in by_agents.values() for each in found.values()]))
            ax.set_xlabel("agents")
        for row in axes:
            row[0].set_ylabel("success rate (%)")
        _finish(figure, axes, len(groups), lines, looks)
        return figure


def _set_agents(ax, numbers):
    ax.xaxis.set_major_locator(FixedLocator(numbers) if len(numbers) <= 5 else MaxNLocator(5, integer=True))
    gap = (numbers[-1] - numbers[0]) * 0.05 or max(numbers[0], 2) / 4
    ax.set_xlim(numbers[0] - gap, numbers[-1] + gap)


def _name_panel(ax, title, below):
    ax.set_title(f"{title}\n", pad=3, fontweight="bold", linespacing=1.35)
    ax.annotate(below, (0.5, 1), xycoords="axes fraction", xytext=(0, 3), textcoords="offset points", ha="center",
                va="bottom", fontsize=SMALLEST, color="#555555")


def _finish(figure, axes, used, lines, looks):
    for ax in list(axes.flat)[used:]:
        ax.set_axis_off()
    pin_labels(axes, 0.3)
    add_legend(figure, lines, looks, nested=False)


def _thin(points, most=MAX_STEPS):
    """Thins out more than `most` points: keeps the first, and the last in each small interval of a log axis."""
    if len(points) <= most:
        return points
    first, last = max(points[0][0], SHORTEST_S), max(points[-1][0], 2 * SHORTEST_S)
    scale = most / math.log(last / first)
    kept = {int(scale * math.log(max(time, first) / first)): (time, value) for time, value in points[1:]}
    return [points[0], *kept.values()]


def _stairs(ax, points, last, arguments, marks):
    """Plots a step function through `points` up to time `last` with about `marks` markers (0: none)."""
    points = _thin([(max(time, SHORTEST_S), value) for time, value in points])
    times, values = [time for time, _ in points], [value for _, value in points]
    marker = {key: arguments.pop(key) for key in list(arguments) if key.startswith("marker")}
    ax.plot([*times, max(last, times[-1])], [*values, values[-1]], drawstyle="steps-post", **arguments)
    if marks:
        spots = [0, *range(max(1, len(points) // marks), len(points), max(1, len(points) // marks))]
        ax.plot([times[at] for at in spots], [values[at] for at in spots], linestyle="", color=arguments["color"],
                **marker)


def _quality(ax, curve, limit, style):
    arguments = plot_arguments(style, 0.15)
    known = [step for step in curve.steps if step.cost_ratio is not None]
    few = [step for step in known if step.common_with_plan < 1 - 1e-9]
    full = [step for step in known if step.common_with_plan >= 1 - 1e-9]
    if few:
        _stairs(ax, [(step.seconds, step.cost_ratio) for step in few], full[0].seconds if full else limit,
                arguments | {"linewidth": 0.6, "alpha": 0.8}, 0)
    if full:
        _stairs(ax, [(step.seconds, step.cost_ratio) for step in full], limit, dict(arguments), 4)
    bounds = [(step.seconds, step.bound_ratio) for step in curve.steps if step.bound_ratio is not None]
    if bounds:
        _stairs(ax, bounds, limit, arguments | {"linewidth": 0.8, "linestyle": (0, (1, 1))}, 2)
    return [step.cost_ratio for step in full or few] + [bound for _, bound in bounds]


def _with_plan(ax, curve, limit, style):
    points = [(step.seconds, 100 * step.with_plan) for step in curve.steps]
    _stairs(ax, [(points[0][0], 0), *points], limit, plot_arguments(style, 0.15) | {"linewidth": 0.9}, 3)


def _set_time(ax, first, last, most=6):
    ax.set_xscale("log")
    ax.set_xlim(first, last * 1.05)
    ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5) if last / first < 30 else (1,), numticks=most))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.xaxis.set_major_formatter(FuncFormatter(number))


def anytime(panels, lines, looks):
    """Plots quality over time, and below it the share of instances with a plan. `panels`: anytime.panels()."""
    with matplotlib.rc_context(SETTINGS):
        across, down = _grid(len(panels))
        caption = wrapped([ANYTIME_CAPTION], COLUMN)
        legend, end = legend_height(lines, looks, COLUMN), 0.13 * len(caption) + 0.06
        upper, lower, between, bottom = 1.35, 0.6, 0.1, 0.42
        block = TITLE + upper + between + lower + bottom
        height = legend + down * block + end
        figure = new_figure(height, COLUMN)
        gap = 0.44
        width = (COLUMN - LEFT - DIGITS - RIGHT - gap * (across - 1)) / across
        limit = max(line.time_limit_s for line in lines)
        seen = [step.seconds for panel in panels for curve in panel.curves.values() for step in curve.steps]
        first = rounded_down(min(max(min(seen), SHORTEST_S), limit / 10))
        rows = []
        for place, panel in enumerate(panels):
            left = LEFT + DIGITS + (place % across) * (width + gap)
            top = height - legend - (place // across) * block - TITLE
            above = figure.add_axes([left / COLUMN, (top - upper) / height, width / COLUMN, upper / height])
            below = figure.add_axes([left / COLUMN, (top - upper - between - lower) / height, width / COLUMN,
                                     lower / height])
            values = []
            for line, curve in panel.curves.items():
                values += _quality(above, curve, line.time_limit_s, looks.style(line))
                _with_plan(below, curve, line.time_limit_s, looks.style(line))
            _set_ratio(above, values)
            below.set_ylim(-6, 106)
            below.yaxis.set_major_locator(FixedLocator([0, 50, 100]))
            for ax in (above, below):
                _set_time(ax, first, limit, 6 if across == 1 else 4)
            above.tick_params(labelbottom=False)
            below.set_xlabel("time (s)")
            if place % across == 0:
                above.set_ylabel("mean cost ratio")
                below.set_ylabel("plans (%)")
            _name_panel(above, panel.title, f"{panel.common} common of {panel.instances}")
            rows += [[above, below]]
        _pin_blocks(rows)
        add_legend(figure, lines, looks, nested=False)
        add_caption(figure, caption)
        return figure


def _pin_blocks(rows):
    for above, below in rows:
        for ax in (above, below):
            box = ax.get_position()
            ax.yaxis.set_label_coords(-(0.3 + DIGITS) / box.width / COLUMN, 0.5)
            ax.xaxis.set_label_coords(0.5, -0.23 / box.height / ax.figure.get_figheight())


def _set_ratio(ax, values):
    ax.axhline(1, color=FAINT, linewidth=0.7, zorder=1)
    if not values:
        ax.text(0.5, 0.5, "no common instances", transform=ax.transAxes, ha="center", va="center", color=FAINT)
    low, high = min([1, *values]), max([1, *values])
    margin = 0.07 * max(high - low, 0.002)
    ax.set_ylim(low - margin, high + margin)
    ax.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
    ax.yaxis.set_major_formatter(FuncFormatter(number))


def runs(groups):
    """Plots lower bound and plan cost of single runs over time, one panel per title. `groups`: {title: [logs.Run]}."""
    with matplotlib.rc_context(SETTINGS):
        panel, bottom = 1.6, 0.42
        heights = [TITLE + panel + bottom + 0.17 * len(found) + 0.05 for found in groups.values()]
        height = sum(heights) + 0.3
        figure = new_figure(height, COLUMN)
        left, top = 0.56, height
        for (title, found), block in zip(groups.items(), heights):
            ax = figure.add_axes([left / COLUMN, (top - TITLE - panel) / height, 1 - (left + RIGHT) / COLUMN,
                                  panel / height])
            _plot_runs(ax, found)
            ax.set_title(title, pad=4, fontweight="bold")
            ax.set(xlabel="time (s)", ylabel="cost")
            box = ax.get_position()
            ax.yaxis.set_label_coords(-0.44 / box.width / COLUMN, 0.5)
            ax.xaxis.set_label_coords(0.5, -0.23 / box.height / height)
            ax.legend(handles=[Line2D([], [], label=" " * run.name.startswith("_") + run.name, **_look(place))
                               for place, run in enumerate(found)], loc="upper left", frameon=False, handlelength=2.6,
                      bbox_to_anchor=(0, -0.36 / panel), borderaxespad=0)
            top -= block
        add_caption(figure, ["Falling: cost of the best plan. Rising, thin: proven", "lower bound."])
        return figure


def _look(place):
    return {"color": COLOURS[place % len(COLOURS)], "marker": MARKERS[place % len(MARKERS)], "markersize": 3.6,
            "markeredgecolor": "white", "markeredgewidth": 0.4, "linewidth": 1.1,
            "linestyle": "-" if place == 0 else (0, RUN_DASHES[(place - 1) % len(RUN_DASHES)])}


def _plot_runs(ax, found):
    costs = []
    for place, run in enumerate(found):
        plans = [(moment.seconds, moment.cost) for moment in run.moments if moment.cost is not None]
        bounds = [(moment.seconds, moment.bound) for moment in run.moments if moment.bound is not None]
        if plans:
            _stairs(ax, plans, run.end_s, _look(place), 4)
        if bounds:
            _stairs(ax, bounds, run.end_s, _look(place) | {"linewidth": 0.8, "linestyle": (0, (1, 1))}, 2)
        costs += [cost for _, cost in plans + bounds]
    seen = [moment.seconds for run in found for moment in run.moments]
    end = max((run.end_s for run in found), default=1)
    first = rounded_down(max(min(seen, default=SHORTEST_S), SHORTEST_S))
    _set_time(ax, first, max(end, 2 * first))
    if costs:
        low, high = min(costs), max(costs)
        margin = 0.07 * max(high - low, 1)
        ax.set_ylim(low - margin, high + margin)
    ax.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    ax.yaxis.set_major_formatter(FuncFormatter(number))


SOURCES_CAPTION = ("Black: lower bound. Areas: what each source has raised it by, from bottom to top in the order of "
                   "the legend. The axis does not begin at 0.")


def sources(found):
    """Plots the lower bound over time, divided into the shares of its sources. `found`: logs.Runs, one panel each."""
    with matplotlib.rc_context(SETTINGS):
        labels = bound_sources(found)
        colours = {source: SOURCE_COLOURS.get(source, KIND_COLOURS[5]) for source in labels}
        caption = wrapped([SOURCES_CAPTION], COLUMN)
        legend, end = 0.17 * math.ceil(len(labels) / 2) + 0.08, 0.13 * len(caption) + 0.06
        panel, title, bottom, left = 1.2, 0.24, 0.42, 0.6
        height = legend + len(found) * (title + panel + bottom) + end
        figure = new_figure(height, COLUMN)
        axes = figure.subplots(len(found), 1, squeeze=False, gridspec_kw={
            "left": left / COLUMN, "right": 1 - RIGHT / COLUMN, "bottom": (bottom + end) / height,
            "top": 1 - (legend + title) / height, "hspace": (title + bottom) / panel})
        for ax, run in zip(axes.flat, found):
            _plot_sources(ax, run, colours)
            ax.set_title(run.name, pad=4, fontweight="bold")
            ax.set(xlabel="time (s)", ylabel="lower bound")
        pin_labels(axes, 0.42)
        figure.legend(handles=[Patch(facecolor=colour, label=labels[source]) for source, colour in colours.items()],
                      loc="upper center", frameon=False, ncol=2, handlelength=1.2, columnspacing=1.6, borderaxespad=0.2)
        add_caption(figure, caption)
        return figure


def _plot_sources(ax, run, colours):
    times = [rise.seconds for rise in run.rises]
    last = max(run.end_s, times[-1])
    bounds = [rise.bound for rise in run.rises]
    above = bounds
    for source, colour in reversed(colours.items()):
        raised = itertools.accumulate(rise.steps.get(source, 0) for rise in run.rises)
        below = [value - steps for value, steps in zip(above, raised)]
        ax.fill_between([*times, last], [*below, below[-1]], [*above, above[-1]], step="post", color=colour,
                        linewidth=0)
        above = below
    ax.plot([*times, last], [*bounds, bounds[-1]], drawstyle="steps-post", color="black", linewidth=0.8)
    ax.set_xlim(0, 1.02 * max(last, SHORTEST_S))
    margin = 0.07 * max(bounds[-1] - bounds[0], 1)
    ax.set_ylim(bounds[0] - margin, bounds[-1] + margin)
    ax.yaxis.set_major_locator(MaxNLocator(5, integer=True))
    ax.yaxis.set_major_formatter(FuncFormatter(number))
