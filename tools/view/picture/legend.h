// SPDX-License-Identifier: MIT
// Legend of the shapes and colours of pictures.
#pragma once

#include <cairo/cairo.h>

#include "model/instance.h"

namespace grove::detail {

inline constexpr int kLegendRow = 26;  // height of a row, in pixels

// Returns 2 if the instance has choices, whose shapes are in a row of their own, otherwise 1.
int legend_rows(const Instance& instance);
// Draws the legend from the origin. Leaves out shapes that cannot occur in the picture.
void draw_legend(cairo_t* cairo, const Instance& instance, bool has_plan);

}  // namespace grove::detail
