// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "model/roadmap.h"

namespace grove::detail {

// A non-uniform rational B-spline (NURBS). `knots` is non-decreasing and has degree + 1 more
// entries than `points`. There are more points than the degree. The weights are positive.
struct Nurbs {
  int degree = 1;
  std::vector<double> knots;
  std::vector<Point> points;
  std::vector<double> weights;  // one per point
};

// The length of the curve, approximated by a polyline through many of its points, so slightly too
// small for a bent curve.
double length_of(const Nurbs& curve);

}  // namespace grove::detail
