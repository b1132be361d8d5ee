# SPDX-License-Identifier: MIT
"""Errors in the input of a user."""


class BadInput(Exception):
    """An input error; its text is the line that the user reads."""


def at(file, place, found, expected):
    """Returns the BadInput for a place in a file; `place` may be ""."""
    return BadInput(f"{file}: {place}: found {found}; expected {expected}" if place
                    else f"{file}: found {found}; expected {expected}")
