# SPDX-License-Identifier: MIT
"""How a line looks: the same in every figure."""
from typing import NamedTuple

# Okabe and Ito's colours, told apart by the colour-blind too, without the yellow, which is hard to
# see on white; a brown, and for those after the first eight darker and greyer ones. The numbers of
# colours and markers have no common divisor, so that their pairs repeat late.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#E69F00", "#56B4E9", "#8C510A",
           "#7B3294", "#7F7F7F", "#A50026", "#66A61E")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", "*", ">", "p")

# Of the parts of a bar: light, as numbers stand on them, and of different lightness for those who print.
KIND_COLOURS = ("#9ECAE1", "#FDD0A2", "#74C476", "#DADAEB", "#E7969C", "#D9D9D9", "#F2E394", "#BC9F8B")

# Factors that make markers of one size look it.
EVEN = {"s": 0.86, "D": 0.74, "*": 1.3}


# Of baselines: to be told apart where markers are few and colours are not printed.
DASHES = ((4, 1.6), (1.3, 1.3), (6, 1.3, 1.3, 1.3), (2.4, 1), (6, 1.3, 1.3, 1.3, 1.3, 1.3))


class Style(NamedTuple):
    colour: str
    marker: str
    dashes: object  # of baselines; None: a whole line


def style_of(index, is_baseline):
    """Of the line with this place among all lines."""
    return Style(COLOURS[index % len(COLOURS)], MARKERS[index % len(MARKERS)],
                 DASHES[index % len(DASHES)] if is_baseline else None)


def depth(rank, count):
    """Of the line drawn as number `rank` of `count`: from 0, drawn last, to at most 1."""
    return (count - 1 - rank) / max(count - 1, 4)


APART = 0.2  # for all lines of a figure where few lie on each other


def plot_arguments(style, below):
    """For Axes.plot(). `below`: depth() where lines lie on each other, as many do at 100 %. The deeper, the
    broader is the line and the larger are its markers: so all are seen."""
    size = EVEN.get(style.marker, 1) * (3.4 + 5.4 * below)
    return {"color": style.colour, "marker": style.marker, "linewidth": 0.9 + 1.4 * below,
            "linestyle": (0, style.dashes) if style.dashes else "-", "markersize": size,
            "markerfacecolor": "white" if style.dashes else style.colour,
            "markeredgecolor": style.colour if style.dashes else "white",
            "markeredgewidth": 0.9 if style.dashes else 0.5}
