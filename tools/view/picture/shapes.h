// SPDX-License-Identifier: MIT
// Shapes and texts that several parts of a picture draw with cairo.
#pragma once

#include <cairo/cairo.h>

#include <cstddef>
#include <string>

#include "model/roadmap.h"
#include "palette.h"

namespace grove::detail {

void set(cairo_t* cairo, const Color& color);
// Sets the dashes of an outline that marks a choice. `unit` is the length of a step.
void set_dashes(cairo_t* cairo, double unit);

// Draws a text of font size `size` centred on `at`; smaller if it would be wider than `max`.
void center_text(cairo_t* cairo, const std::string& text, Point at, double size, double max);
// Draws a text with `at` at the middle of its baseline, and an outline in the colour of the floor.
void outlined_text(cairo_t* cairo, const std::string& text, Point at, double size,
                   const Color& color);
// Returns the id or, if it has more than `max` bytes, its first characters, in at most `max` - 1
// bytes, and an ellipsis.
std::string shortened(const std::string& id, std::size_t max);

void disc(cairo_t* cairo, Point at, double radius, const Color& color);
void diamond(cairo_t* cairo, Point at, double radius, const Color& color, const Color& rim,
             double line);

}  // namespace grove::detail
