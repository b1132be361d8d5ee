// SPDX-License-Identifier: MIT
#include "io/nurbs.h"

#include <array>
#include <cmath>

namespace grove::detail {
namespace {

constexpr int kPartsOfSpan = 64;

// De Boor's algorithm on (w x, w y, w), for t between the knots `span` and span + 1.
Point point_at(const Nurbs& curve, int span, double t) {
  const int p = curve.degree;
  std::vector<std::array<double, 3>> d;
  for (int j = span - p; j <= span; ++j) {
    const double w = curve.weights[j];
    d.push_back({w * curve.points[j].x, w * curve.points[j].y, w});
  }
  for (int level = 1; level <= p; ++level)
    for (int j = p; j >= level; --j) {
      const double begin = curve.knots[span - p + j];
      const double end = curve.knots[span + 1 + j - level];
      const double part = (t - begin) / (end - begin);  // begin <= knot span < knot span + 1 <= end
      for (int k = 0; k < 3; ++k) d[j][k] = (1 - part) * d[j - 1][k] + part * d[j][k];
    }
  return {d[p][0] / d[p][2], d[p][1] / d[p][2]};
}

}  // namespace

double length_of(const Nurbs& curve) {
  double length = 0;
  for (int span = curve.degree; span < std::ssize(curve.points); ++span) {
    const double begin = curve.knots[span];
    const double end = curve.knots[span + 1];
    if (!(begin < end)) continue;
    Point last = point_at(curve, span, begin);
    for (int k = 1; k <= kPartsOfSpan; ++k) {
      const Point next = point_at(curve, span, begin + (end - begin) * k / kPartsOfSpan);
      length += std::hypot(next.x - last.x, next.y - last.y);
      last = next;
    }
  }
  return length;
}

}  // namespace grove::detail
