// SPDX-License-Identifier: MIT
// What the shapes and colours of pictures mean.
#pragma once

#include <cairo/cairo.h>

#include "model/instance.h"

namespace grove::detail {

// One line from the origin on. Of what there is nothing of, nothing is said.
void draw_legend(cairo_t* cairo, const Instance& instance, bool has_plan);

}  // namespace grove::detail
