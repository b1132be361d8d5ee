// SPDX-License-Identifier: MIT
// Legend of the shapes and colours of pictures.
#pragma once

#include <cairo/cairo.h>

#include "model/instance.h"

namespace grove::detail {

// Draws the legend in one line from the origin. Leaves out shapes that cannot occur in the picture.
void draw_legend(cairo_t* cairo, const Instance& instance, bool has_plan);

}  // namespace grove::detail
