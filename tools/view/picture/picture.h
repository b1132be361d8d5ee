// SPDX-License-Identifier: MIT
// Files of pictures, as bytes.
#pragma once

#include <span>
#include <string>

#include "tools/view/picture/drawing.h"

namespace grove::detail {

// Moments side by side, from left to right and row by row; each `width` pixels wide.
std::string svg_picture(const Drawing& drawing, std::span<const double> moments, int width);
std::string png_picture(const Drawing& drawing, std::span<const double> moments, int width);

// The whole plan, played at so many steps a second, over and over with a rest at the end.
std::string gif_picture(const Drawing& drawing, int width, double steps_per_second);

}  // namespace grove::detail
