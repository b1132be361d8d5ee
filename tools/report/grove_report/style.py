# SPDX-License-Identifier: MIT
"""How a line looks: the same in every figure."""
from typing import NamedTuple

# Okabe and Ito's colours, told apart by the colour-blind too, without the yellow, which is hard to
# see on white; and a brown. The numbers of colours and markers have no common divisor, so that their
# pairs repeat late.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#E69F00", "#56B4E9", "#8C510A")
MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", "*", ">", "p")


class Style(NamedTuple):
    colour: str
    marker: str
    dashed: bool  # baselines


def style_of(index, is_baseline):
    """Of the line with this place among all lines."""
    return Style(COLOURS[index % len(COLOURS)], MARKERS[index % len(MARKERS)], is_baseline)


def plot_arguments(style):
    """For Axes.plot()."""
    return {"color": style.colour, "marker": style.marker, "linewidth": 1.2,
            "linestyle": (0, (4, 1.6)) if style.dashed else "-", "markersize": 5.6 if style.marker == "*" else 4.2,
            "markerfacecolor": "white" if style.dashed else style.colour,
            "markeredgecolor": style.colour, "markeredgewidth": 0.9}
