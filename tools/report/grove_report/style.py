# SPDX-License-Identifier: MIT
"""Assigns colour, marker and dashes to each line, the same in every figure."""
from typing import NamedTuple

# The first seven colours are the palette of Okabe and Ito, which colour-blind readers can distinguish. Its yellow is
# omitted, because it is hard to see on white. Then a brown and, from the ninth on, darker and greyer colours. The
# numbers of colours and markers have no common divisor, so that up to 132 lines have distinct pairs of colour and
# marker.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#E69F00", "#56B4E9", "#8C510A",
           "#7B3294", "#7F7F7F", "#A50026", "#66A61E")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", "*", ">", "p")

# Colours of the parts of a bar. They are light, because numbers are printed on them, and differ in lightness, for
# black-and-white print.
KIND_COLOURS = ("#9ECAE1", "#FDD0A2", "#74C476", "#DADAEB", "#E7969C", "#D9D9D9", "#F2E394", "#BC9F8B")

# Colours of the sources of a lower bound. Logs of grove-mpi have `tree` instead of `branching`.
SOURCE_COLOURS = {"individual": "#DDE1E6", "wdg": "#9ECAE1", "branching": "#6F9FD8", "tree": "#6F9FD8",
                  "lagrangian": "#EFE08A", "joint": "#B9A06A", "cores": "#B0528F"}

# Size factors that make different markers look equally large.
EVEN = {"s": 0.86, "D": 0.74, "*": 1.3}

# Dash patterns of baselines, which distinguish them where markers are few and colours are not printed.
DASHES = ((4, 1.6), (1.3, 1.3), (6, 1.3, 1.3, 1.3), (2.4, 1), (6, 1.3, 1.3, 1.3, 1.3, 1.3))


class Style(NamedTuple):
    colour: str
    marker: str
    dashes: object  # dash pattern of a baseline; None: a solid line


def style_of(index, is_baseline):
    """Returns the Style of the line with this index among all lines."""
    return Style(COLOURS[index % len(COLOURS)], MARKERS[index % len(MARKERS)],
                 DASHES[index % len(DASHES)] if is_baseline else None)


def depth(rank, count):
    """Returns the depth of a line, from 0 (drawn last) to at most 1.

    rank: index of the line among the `count` lines in drawing order.
    """
    return (count - 1 - rank) / max(count - 1, 4)


APART = 0.2  # depth of all lines in a figure where few lines coincide


def plot_arguments(style, below):
    """Returns arguments for Axes.plot().

    below: depth() of the line. A deeper line is broader and has larger markers, so that lines that coincide, as many do
    at 100 %, all remain visible.
    """
    size = EVEN.get(style.marker, 1) * (3.4 + 5.4 * below)
    return {"color": style.colour, "marker": style.marker, "linewidth": 0.9 + 1.4 * below,
            "linestyle": (0, style.dashes) if style.dashes else "-", "markersize": size,
            "markerfacecolor": "white" if style.dashes else style.colour,
            "markeredgecolor": style.colour if style.dashes else "white",
            "markeredgewidth": 0.9 if style.dashes else 0.5}
