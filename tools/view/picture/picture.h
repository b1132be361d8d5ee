// SPDX-License-Identifier: MIT
// Encodes pictures as files, in memory.
#pragma once

#include <span>
#include <string>

#include "tools/view/picture/drawing.h"

namespace grove::detail {

// Moments side by side, row by row; each `width` pixels wide.
std::string svg_picture(const Drawing& drawing, std::span<const double> moments, int width);
std::string png_picture(const Drawing& drawing, std::span<const double> moments, int width);

// The whole plan in an endless loop, with a pause at the end.
std::string gif_picture(const Drawing& drawing, int width, double steps_per_second);

}  // namespace grove::detail
