# SPDX-License-Identifier: MIT
"""Defines the exception for errors in the user's input."""


class BadInput(Exception):
    """An input error. Its text is the line that is printed for the user."""


def at(file, place, found, expected):
    """Returns a BadInput for a place in a file. `place` is "" for the whole file."""
    return BadInput(f"{file}: {place}: found {found}; expected {expected}" if place
                    else f"{file}: found {found}; expected {expected}")
