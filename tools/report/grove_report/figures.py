# SPDX-License-Identifier: MIT
"""Draws plots that compare methods. The plot functions return a matplotlib Figure; drawn() converts it to SVG and PNG.

All figures are narrow, so that text is at least 10 pixels high at a width of 500 pixels, which is half the screen of a
laptop or the whole screen of a phone.

This package does not use pyplot, because pyplot keeps figures and settings for the whole process.
"""
import io
import itertools
import math
import textwrap
import warnings
from typing import NamedTuple

import matplotlib
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, MaxNLocator, NullLocator

from .counters import kind_label, split_kinds
from .lines import omega_text
from .metrics import solved_over_time
from .scales import dodged, first_time
from .style import APART, KIND_COLOURS, depth, plot_arguments

SETTINGS = {
    "svg.hashsalt": "grove report", "svg.fonttype": "path", "font.family": "DejaVu Sans",
    "font.size": 8.5, "axes.titlesize": 8.5, "axes.labelsize": 8, "xtick.labelsize": 7.5,
    "ytick.labelsize": 7.5, "legend.fontsize": 8, "axes.linewidth": 0.6, "axes.grid": True,
    "grid.color": "#E3E3E3", "grid.linewidth": 0.5, "axes.axisbelow": True,
    "axes.spines.top": False, "axes.spines.right": False, "xtick.major.width": 0.6,
    "ytick.major.width": 0.6, "savefig.facecolor": "white", "axes.unicode_minus": False,
    "axes.titley": 1.0, "text.parse_math": False, "text.color": "#222222", "axes.labelcolor": "#222222",
    "xtick.color": "#222222", "ytick.color": "#222222", "axes.edgecolor": "#555555"}
WIDTH = 5.2  # width of a figure, inches
COLUMN = 3.4  # width of a column of a paper, inches
SMALLEST = 7.5  # smallest font size, points; at a width of 500 pixels, 500 / WIDTH * 7.5 / 72 = 10 pixels
PNG_DPI = 160
PNG_COMPRESSION = 3  # from 0 to 9; twice as fast as level 6, with files two per cent larger
FAINT = "#767676"
# Shorter times are drawn as this time, which is the resolution of the clock; a log axis needs positive times.
SHORTEST_S = 0.001


class Metric(NamedTuple):
    label: str
    value: object        # function: Measures -> number or None
    axis: str = "plain"  # "percent", "seconds", "ratio" (at most 1), "excess" (at least 1), "count"


SUCCESS = Metric("success rate (%)", lambda m: 100 * m.success, "percent")
RUNTIME = Metric("mean runtime (s)", lambda m: max(m.mean_runtime_s, SHORTEST_S), "seconds")
SQR = Metric("mean SQR\n(solved runs)", lambda m: m.mean_sqr, "ratio")
COMMON_SQR = Metric("mean SQR\n(common)", lambda m: m.common_sqr, "ratio")
COST_RATIO = Metric("mean cost ratio\n(1 = best)", lambda m: m.mean_cost_ratio, "excess")
ROOTS = Metric("mean number of roots", lambda m: m.mean_roots, "count")
RTSP_CALLS = Metric("mean number of rTSP calls", lambda m: m.mean_rtsp_calls, "count")


# Captions are part of the image, so that it is understandable outside the report.
SQR_CAPTION = ("SQR of solved runs: over the runs that each method solved, so a method that solves only easy instances "
               "looks better. Common: over the instances that all methods solve (of those that solve any), so these "
               "values compare.")
RATIO_CAPTION = ("Cost ratio: cost / least cost that any method found for the instance, of solved runs; 1 is "
                 "best. It carries no information where only one method has a plan.")


def drawn(figure):
    """Returns the figure as SVG (text) and PNG (bytes). Equal figures give equal files."""
    with matplotlib.rc_context(SETTINGS), warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Glyph .* missing")  # matplotlib draws a box for a missing glyph
        FigureCanvasAgg(figure)
        png, svg = io.BytesIO(), io.StringIO()
        figure.savefig(png, format="png", dpi=PNG_DPI, metadata={"Software": None},
                       pil_kwargs={"compress_level": PNG_COMPRESSION})
        figure.savefig(svg, format="svg", metadata={"Date": None, "Creator": None})
    return svg.getvalue(), png.getvalue()


def new_figure(height, width=WIDTH):
    return Figure(figsize=(width, height), facecolor="white")


def _longest_tick(ax):
    """Returns the length of the longest tick label on the vertical axis, in characters."""
    low, high = sorted(ax.get_ylim())
    name = ax.yaxis.get_major_formatter()
    return max((len(name(tick)) for tick in ax.get_yticks() if low <= tick <= high), default=0)


def pin_labels(axes, left):
    """Places axis labels at fixed distances from the axes. `left`: least distance of the y labels, inches.

    Long tick labels increase this distance. Replaces matplotlib's automatic placement, which takes as long as the rest
    of the figure. axes: all panels of the figure, which must have the same size.
    """
    figure, box = axes[0][0].figure, axes[0][0].get_position()
    left = max(left, 0.16 + 0.062 * max(_longest_tick(row[0]) for row in axes))
    for ax in axes.flat:
        ax.yaxis.set_label_coords(-left / box.width / figure.get_figwidth(), 0.5)
        ax.xaxis.set_label_coords(0.5, -0.23 / box.height / figure.get_figheight())


def number(value, _=None):
    return f"{value:g}"


def _set_log_range(ax, lowest, highest):
    """Sets the range of a log axis, with ticks between powers of ten if the range has few of them."""
    ax.set_ylim(lowest, highest)
    ax.yaxis.set_major_locator(LogLocator(
        subs=(1, 2, 5) if highest / lowest < 100 else (1,), numticks=12))


def _set_axis(ax, metric, values, limits):
    """Sets scale and ticks of the y axis. `values`: all values that the axis must show."""
    if metric.axis == "percent":
        ax.set_ylim(-6, 106)
        ax.yaxis.set_major_locator(FixedLocator([0, 25, 50, 75, 100]))
    elif metric.axis == "seconds":
        ax.set_yscale("log")
        _set_log_range(ax, min(min(values, default=1) / 1.7, max(limits) / 10), max(limits) * 2.6)
    elif metric.axis == "ratio":
        lowest = min(values, default=0.95)
        step = 0.01 if lowest > 0.97 else 0.02 if lowest > 0.93 else 0.05 if lowest > 0.8 else 0.1
        bottom = math.floor(lowest / step - 0.1) * step
        ax.set_ylim(bottom, 1 + 0.06 * (1 - bottom))
        ax.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
    elif metric.axis == "excess":
        excess = max(max(values, default=1) - 1, 0.005)
        ax.set_ylim(1 - 0.08 * excess, 1 + 1.1 * excess)
        ax.yaxis.set_major_locator(MaxNLocator(6, steps=[1, 2, 5, 10]))
    elif metric.axis == "count":
        lowest, highest = min(values, default=1), max(values, default=1)
        if lowest > 0:
            ax.set_yscale("log")
            _set_log_range(ax, lowest / 1.5, max(highest * 1.6, lowest * 12))
        elif highest > 30:
            ax.set_yscale("symlog", linthresh=1)
            ax.set_ylim(-0.2, highest * 1.6)
        else:
            ax.set_ylim(-0.05 * max(highest, 1), 1.1 * max(highest, 1))
    ax.yaxis.set_minor_locator(NullLocator())
    ax.yaxis.set_major_formatter(FuncFormatter(number))


def _show_limits(ax, limits, named):
    if len(limits) > 3:
        return
    for limit in limits:
        ax.axhline(limit, color=FAINT, linewidth=0.7, linestyle=(0, (1, 1.5)), zorder=1)
    if named:
        ax.annotate("limit", (0, max(limits)), xycoords=("axes fraction", "data"), fontsize=SMALLEST,
                    xytext=(2, 1.5), textcoords="offset points", color=FAINT)


def _x_ticks(x_values):
    if len(x_values) <= 6:
        return x_values
    return [*x_values[::math.ceil(len(x_values) / 5)]]


def _set_x(ax, x_values, name):
    ax.xaxis.set_major_locator(FixedLocator(_x_ticks(x_values)))
    ax.xaxis.set_major_formatter(FuncFormatter(number))
    gap = min((b - a for a, b in zip(x_values, x_values[1:])), default=max(x_values[0], 2) / 2)
    ax.set_xlim(x_values[0] - 0.5 * gap, x_values[-1] + 0.5 * gap)
    if name:
        ax.set_xlabel(name)


def plot_metric(ax, configurations, x_of, lines, metric, looks, offsets):
    """Plots one panel. `configurations`: {configuration: {line: Measures}}; a line is interrupted at a
    configuration without its Measures."""
    drawn = False
    for rank, line in enumerate(lines):
        points = [(x_of(configuration) + offsets[line], metric.value(found[line]) if line in found else None)
                  for configuration, found in sorted(configurations.items(), key=lambda item: x_of(item[0]))]
        drawn |= any(y is not None for _, y in points)
        ax.plot([x for x, _ in points], [math.nan if y is None else y for _, y in points],
                **plot_arguments(looks.style(line), depth(rank, len(lines))))
    if not drawn:
        ax.text(0.5, 0.5, "no data" if configurations else "no runs", transform=ax.transAxes, ha="center",
                va="center", color=FAINT)


def _legend_columns(labels, width=WIDTH):
    """Returns the number of columns for a legend with these labels."""
    entry = 0.62 + 0.068 * max(map(len, labels)) if width == WIDTH else 0.4 + 0.062 * max(map(len, labels))
    fitting = max(1, int((width - 0.1) / entry))
    lines = math.ceil(len(labels) / fitting)
    return math.ceil(len(labels) / lines)  # rows of about equal length


def _handles(lines, labels, looks, nested):
    # A space before the label, because matplotlib omits labels that start with "_".
    depths = [depth(rank, len(lines)) if nested else APART for rank in range(len(lines))]
    return [Line2D([], [], label=" " * label.startswith("_") + label,
                   **plot_arguments(looks.style(line), below))
            for line, label, below in zip(lines, labels, depths)]


def legend_height(lines, looks, width=WIDTH):
    labels = [looks.label(line) for line in lines]
    return 0.17 * math.ceil(len(labels) / _legend_columns(labels, width)) + 0.05


def add_legend(figure, lines, looks, nested):
    """Adds a legend at the top, as wide as the figure."""
    labels = [looks.label(line) for line in lines]
    is_wide = figure.get_figwidth() == WIDTH
    figure.legend(handles=_handles(lines, labels, looks, nested), loc="upper center", frameon=False,
                  ncol=_legend_columns(labels, figure.get_figwidth()), handlelength=2.6 if is_wide else 2.2,
                  columnspacing=1.6 if is_wide else 0.9, handletextpad=0.8 if is_wide else 0.5, borderaxespad=0.2)


def _values(configurations, lines, metric):
    values = [metric.value(found[line]) for found in configurations.values() for line in lines
              if line in found]
    return [value for value in values if value is not None]


class Columns(NamedTuple):
    """Columns and x axis of a comparison."""
    keys: list        # keys of the columns, ordered by map; key[0] is the map
    key_of: object    # function: configuration -> key
    x_of: object      # function: configuration -> x
    x_name: str
    title_of: object  # function: key -> title of the column


def columns_of(configurations):
    """Returns the Columns: one per map and N with M on the x axis, as in the paper.

    If M does not vary, returns one per map and M with N on the x axis.
    """
    if len({configuration.tasks for configuration in configurations}) > 1:
        keys = sorted({(configuration.map, configuration.agents) for configuration in configurations})
        return Columns(keys, lambda each: (each.map, each.agents), lambda each: each.tasks,
                       "M (tasks)", lambda key: f"N = {key[1]}")
    keys = sorted({(configuration.map, configuration.tasks) for configuration in configurations})
    return Columns(keys, lambda each: (each.map, each.tasks), lambda each: each.agents,
                   "N (agents)", lambda key: f"M = {key[1]}" if key[1] else "")


def comparison(configurations, all_configurations, lines, looks,
               metrics=(SUCCESS, RUNTIME, SQR, COMMON_SQR, COST_RATIO)):
    """Plots one row of panels per metric: those of the paper's Fig. 5, then SQR on common instances and the cost ratio.

    configurations: {configuration: {line: Measures}}, a subset of all_configurations, which determines the ranges of
    the axes.
    """
    with matplotlib.rc_context(SETTINGS):
        columns = columns_of(all_configurations)
        keys = sorted(set(map(columns.key_of, configurations)))
        metrics = [metric for metric in metrics if _values(all_configurations, lines, metric)]
        notes = [text for metric, text in ((SQR, SQR_CAPTION), (COST_RATIO, RATIO_CAPTION))
                 if metric in metrics]
        caption = wrapped(notes)
        left, right, bottom = 0.76, 0.08, 0.5 + 0.13 * len(caption)
        legend = legend_height(lines, looks)
        top = legend + 0.5
        height = top + bottom + 1.35 * len(metrics)
        figure = new_figure(height)
        axes = figure.subplots(len(metrics), len(keys), sharey="row", sharex="col", squeeze=False,
                               gridspec_kw={"left": left / WIDTH, "right": 1 - right / WIDTH,
                                            "bottom": bottom / height, "top": 1 - top / height,
                                            "wspace": 0.1, "hspace": 0.14})
        limits = sorted({line.time_limit_s for line in lines})
        for column, key in enumerate(keys):
            here = {configuration: found for configuration, found in configurations.items()
                    if columns.key_of(configuration) == key}
            x_values = sorted({columns.x_of(configuration) for configuration in here})
            offsets = dodged(x_values, lines)
            for row, metric in enumerate(metrics):
                ax = axes[row][column]
                plot_metric(ax, here, columns.x_of, lines, metric, looks, offsets)
                if metric.axis == "seconds":
                    _show_limits(ax, limits, named=column == 0)
                if column == 0:
                    _set_axis(ax, metric, _values(all_configurations, lines, metric), limits)
                    ax.set_ylabel(metric.label)
                else:
                    ax.tick_params(axis="y", length=0)
            _set_x(axes[-1][column], x_values, columns.x_name)
            axes[0][column].set_title(columns.title_of(key), pad=4)
        pin_labels(axes, 0.36)
        _name_maps(figure, keys, axes, (height - legend - 0.17) / height)
        add_legend(figure, lines, looks, nested=True)
        add_caption(figure, caption)
        return figure


def wrapped(texts, width=WIDTH):
    """Joins texts to a caption and returns its lines, wrapped to the width of a figure in inches."""
    return textwrap.wrap(" ".join(texts), int(width / 0.062))


def add_caption(figure, lines):
    """Adds a caption at the bottom left; each line is 0.13 inches high."""
    figure.text(0.1 / figure.get_figwidth(), 0.06 / figure.get_figheight(), "\n".join(lines), va="bottom",
                fontsize=SMALLEST, linespacing=1.2, color="#555555")


def _name_maps(figure, keys, axes, y):
    """Writes each map's name above its columns, with a rule below it."""
    for name in sorted({key[0] for key in keys}):
        group = [index for index, key in enumerate(keys) if key[0] == name]
        left = axes[0][group[0]].get_position().x0
        right = axes[0][group[-1]].get_position().x1
        figure.text((left + right) / 2, y, name, ha="center", va="center", fontsize=9,
                    fontweight="bold")
        rule = y - 0.1 / figure.get_figheight()
        figure.add_artist(Line2D([left, right], [rule, rule], color="#555555", linewidth=0.6))


def _thinned(times, first, last, bins=300):
    """Returns [(time, number solved by then)] with only the last of several points that are close on the log axis."""
    scale = bins / math.log(last / first)
    points = {}
    for count, time in enumerate(times, 1):
        time = max(time, first)
        points[int(scale * math.log(time / first))] = (time, count)
    return list(points.values())


def _plot_solved(ax, rows, first, last, arguments, phase):
    """Plots the number of solved instances from time `first` to `last`, with 5 markers shifted by `phase` (0 to 1)."""
    points = _thinned(solved_over_time(rows), first, last)
    xs = [first, *[x for x, _ in points], last]
    ys = [0, *[y for _, y in points], points[-1][1] if points else 0]
    marker = {key: arguments.pop(key) for key in list(arguments) if key.startswith("marker")}
    ax.plot(xs, ys, drawstyle="steps-post", **arguments)
    spots = [first * (last / first) ** ((index + 0.15 + 0.7 * phase) / 5) for index in range(5)]
    heights = [max(y for x, y in zip(xs, ys) if x <= spot) for spot in spots]
    ax.plot(spots, heights, linestyle="", color=arguments["color"], **marker)


def cactus(groups, lines, looks, per_row=2):
    """Plots the number of solved instances over time, one panel per title. `groups`: {title: {line: rows}}."""
    with matplotlib.rc_context(SETTINGS):
        limits = [line.time_limit_s for line in lines]
        first = first_time([row for group in groups.values() for rows in group.values()
                            for row in rows])
        across = min(len(groups), per_row)
        down = math.ceil(len(groups) / across)
        legend = legend_height(lines, looks)
        height = legend + 0.27 + 2.3 * down
        figure = new_figure(height)
        axes = figure.subplots(down, across, squeeze=False, gridspec_kw={
            "left": 0.55 / WIDTH, "right": 1 - 0.12 / WIDTH, "bottom": 0.45 / height,
            "top": 1 - (legend + 0.27) / height, "wspace": 0.22, "hspace": 0.35})
        for ax, (title, group) in zip(axes.flat, groups.items()):
            for place, line in enumerate(lines):
                if line in group:
                    _plot_solved(ax, group[line], first, max(line.time_limit_s, first * 10),
                                 plot_arguments(looks.style(line), APART),
                                 place / max(len(lines) - 1, 1))
            most = max(len(rows) for rows in group.values())
            ax.axhline(most, color=FAINT, linewidth=0.7, linestyle=(0, (1, 1.5)), zorder=1)
            ax.annotate("all", (0, most), xycoords=("axes fraction", "data"), fontsize=SMALLEST,
                        xytext=(2, 1.5), textcoords="offset points", color=FAINT)
            ax.set_xscale("log")
            ax.set_xlim(first, max(max(limits), first * 10) * 1.05)
            ax.set_ylim(0, most * 1.09)
            ax.yaxis.set_major_locator(MaxNLocator(6, integer=True))
            ax.xaxis.set_major_locator(LogLocator(numticks=9))
            ax.xaxis.set_minor_locator(NullLocator())
            ax.xaxis.set_major_formatter(FuncFormatter(number))
            ax.set_title(title, pad=5, fontweight="bold")
            ax.set_xlabel("time (s)")
        for ax in list(axes.flat)[len(groups):]:
            ax.set_axis_off()
        for row in axes:
            row[0].set_ylabel("instances solved")
        pin_labels(axes, 0.34)
        add_legend(figure, lines, looks, nested=False)
        return figure


def _omega_labels(family, lines, looks):
    """Returns the labels of a study. A label of the family is only its omega if omegas are unique and either all its
    lines have one method or longer labels would not fit; otherwise it is omega and the name."""
    labels = [omega_text(line.omega) for line in family]
    longer = [f"{omega_text(line.omega)}: {looks.name(line)}" for line in lines]
    longer = [label if len(label) <= 32 else label[:30] + "..." for label in longer]
    distinct = len(set(labels)) == len(labels)
    if distinct and (len({line.method for line in family}) == 1 or max(map(len, longer)) >= 32):
        return labels + longer[len(labels):]
    return longer


def omega_study(configurations, family, lines, looks, setting):
    """Plots the influence of omega like the paper's Fig. 6.

    Panel (a) has the legend and the setting, panel (g) SQR on common instances. configurations: those of one map
    and N.
    lines: the lines of the family, then others. setting: lines of text.
    """
    with matplotlib.rc_context(SETTINGS):
        caption = wrapped([SQR_CAPTION])
        labels = _omega_labels(family, lines, looks)
        settings = [text for line in setting for text in textwrap.wrap(line, 42)]
        head, bottom = 0.3 + 0.16 * max(len(settings), len(labels)), 0.5 + 0.13 * len(caption)
        height = head + bottom + 0.35 + 3 * 1.75
        figure = new_figure(height)
        axes = figure.subplots(3, 2, gridspec_kw={"left": 0.6 / WIDTH, "right": 1 - 0.08 / WIDTH,
                                                  "bottom": bottom / height, "top": 1 - (head + 0.35) / height,
                                                  "wspace": 0.24, "hspace": 0.5})
        figure.text(0.1 / WIDTH, 1 - 0.08 / height, "(a) setting", va="top", fontweight="bold")
        figure.text(0.1 / WIDTH, 1 - 0.28 / height, "\n".join(settings), va="top", linespacing=1.35)
        figure.legend(handles=_handles(lines, labels, looks, nested=True), frameon=False, handlelength=2.6,
                      loc="upper left", bbox_to_anchor=(0.52, 1 - 0.08 / height), borderaxespad=0, borderpad=0)
        limits = sorted({line.time_limit_s for line in lines})
        x_values = sorted({configuration.tasks for configuration in configurations})
        offsets = dodged(x_values, lines)
        panels = zip("bcdefg", axes.flat, (SUCCESS, RUNTIME, SQR, COMMON_SQR, ROOTS, RTSP_CALLS))
        for letter, ax, metric in panels:
            plot_metric(ax, configurations, lambda configuration: configuration.tasks, lines, metric, looks, offsets)
            if metric.axis == "seconds":
                _show_limits(ax, limits, named=True)
            _set_axis(ax, metric, _values(configurations, lines, metric), limits)
            _set_x(ax, x_values, "M (tasks)")
            ax.set_title(f"({letter}) {metric.label}".replace("\n", " "), loc="left", fontweight="bold")
        pin_labels(axes, 0.4)
        add_caption(figure, caption)
        return figure


def _plot_shares(ax, place, numbers, colours):
    """Draws a bar at y = `place`, divided into the shares of the kinds. `numbers`: {kind: number}."""
    left = 0.0
    for kind, colour in colours.items():
        share = 100 * numbers.get(kind, 0) / sum(numbers.values())
        ax.barh(place, share, 0.42, left, color=colour, edgecolor="white", linewidth=0.6)
        if share >= 9:
            ax.text(left + share / 2, place, f"{share:.0f} %", ha="center", va="center", fontsize=SMALLEST)
        left += share


def _numbered(number, what):
    return f"{number:,} {what}" + "s" * (number != 1)


def splits(counters, lines, looks):
    """Plots the shares of the kinds of splits, one bar per line. `lines`: lines with at least one split."""
    with matplotlib.rc_context(SETTINGS):
        colours = dict(zip(split_kinds(counters), itertools.cycle(KIND_COLOURS)))
        labels = [kind_label(kind) for kind in colours]
        columns = _legend_columns(labels)
        bars = 0.42 * len(lines)
        height = 0.17 * math.ceil(len(labels) / columns) + 0.55 + bars
        figure = new_figure(height)
        ax = figure.add_axes([0.15 / WIDTH, 0.42 / height, 1 - 0.35 / WIDTH, bars / height])
        for place, line in enumerate(lines):
            found = counters[line].splits()
            _plot_shares(ax, place, found, colours)
            ax.text(0, place - 0.25, f"{looks.label(line)}: {_numbered(sum(found.values()), 'split')} in "
                    f"{_numbered(counters[line].runs, 'run')}", va="bottom")
        ax.set(xlim=(0, 100), ylim=(len(lines) - 0.7, -0.7), xlabel="share of all splits (%)", yticks=[])
        ax.spines["left"].set_visible(False)
        ax.grid(False)
        figure.legend(handles=[Patch(facecolor=colours[kind], label=kind_label(kind)) for kind in colours],
                      loc="upper center", frameon=False, ncol=columns, handlelength=1.2, columnspacing=1.6,
                      borderaxespad=0.2)
        return figure
