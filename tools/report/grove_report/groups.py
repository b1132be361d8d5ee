# SPDX-License-Identifier: MIT
"""Groups items by a key."""
from collections import defaultdict


def grouped(items, key):
    """Returns {key: all items with this key}; keys and items are in the order of `items`."""
    groups = defaultdict(list)
    for item in items:
        groups[key(item)].append(item)
    return dict(groups)


def values_by(items, key, value):
    """Returns {key: set of the values of all items with this key}."""
    return {key: set(map(value, group)) for key, group in grouped(items, key).items()}
