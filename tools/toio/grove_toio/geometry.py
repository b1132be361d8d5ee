# SPDX-License-Identifier: MIT
"""Computes distances between points and paths in the plane. A path is a list of at least one point."""
import math


def distance(a, b):
    return math.hypot(a[0] - b[0], a[1] - b[1])


def turn_between(angle, wanted):
    """Returns the smaller rotation from `angle` to `wanted`, in degrees from -180 to 180."""
    return (wanted - angle + 180) % 360 - 180


def point_to_segment(p, a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    square = dx * dx + dy * dy
    if square == 0:
        return distance(p, a)
    share = max(0.0, min(1.0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / square))
    return math.hypot(p[0] - a[0] - share * dx, p[1] - a[1] - share * dy)


def _side(a, b, p):
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])


def segment_to_segment(a, b, c, d):
    if _side(a, b, c) * _side(a, b, d) < 0 and _side(c, d, a) * _side(c, d, b) < 0:
        return 0.0
    return min(point_to_segment(a, c, d), point_to_segment(b, c, d),
               point_to_segment(c, a, b), point_to_segment(d, a, b))


def _segments(path):
    return list(zip(path, path[1:])) or [(path[0], path[0])]


def _length(path):
    return sum(distance(a, b) for a, b in zip(path, path[1:]))


def path_to_path(one, other):
    return min(segment_to_segment(*s, *t) for s in _segments(one) for t in _segments(other))


def nearer(one, other, least):
    """Returns whether the distance between two paths is below `least`.

    First compares their first points and lengths, which usually suffices.
    """
    if distance(one[0], other[0]) >= least + _length(one) + _length(other):
        return False
    return path_to_path(one, other) < least
