// SPDX-License-Identifier: MIT
// Encodes pictures as the bytes of SVG, PNG and GIF files.
#pragma once

#include <span>
#include <string>

#include "tools/view/picture/drawing.h"

namespace grove::detail {

// Return a picture of the moments (in steps; at least one), at most four per row, each `width`
// pixels wide. Throw std::invalid_argument if the picture is too large for cairo.
std::string svg_picture(const Drawing& drawing, std::span<const double> moments, int width);
std::string png_picture(const Drawing& drawing, std::span<const double> moments, int width);

// Returns an animation of the whole plan, `width` pixels wide, that repeats endlessly with a pause
// at the end. Throws std::invalid_argument if it is too large for cairo.
std::string gif_picture(const Drawing& drawing, int width, double steps_per_second);

}  // namespace grove::detail
