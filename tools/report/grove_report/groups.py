# SPDX-License-Identifier: MIT
"""Groups items by a key."""
from collections import defaultdict


def grouped(items, key):
    """Returns {key of an item: all items that have it}, in the order of `items`."""
    groups = defaultdict(list)
    for item in items:
        groups[key(item)].append(item)
    return dict(groups)


def values_by(items, key, value):
    """Returns {key of an item: the distinct values of all items that have it}."""
    return {key: set(map(value, group)) for key, group in grouped(items, key).items()}
