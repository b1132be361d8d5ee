// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "model/roadmap.h"

namespace grove::detail {

// A non-uniform rational B-spline. `knots` does not decrease and has one more than the degree more
// entries than `points`, of which there are more than the degree; weights are positive.
struct Nurbs {
  int degree = 1;
  std::vector<double> knots;
  std::vector<Point> points;
  std::vector<double> weights;  // one for each point
};

// The length of the curve, as that of a line through many of its points: a little short where it
// bends.
double length_of(const Nurbs& curve);

}  // namespace grove::detail
