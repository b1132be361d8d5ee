// SPDX-License-Identifier: MIT
// Shapes and texts that are drawn with cairo more than once.
#pragma once

#include <cairo/cairo.h>

#include <cstddef>
#include <string>

#include "model/roadmap.h"
#include "palette.h"

namespace grove::detail {

void set(cairo_t* cairo, const Color& color);

// Centred on `at`; reduced in size if it would be wider than `max`.
void center_text(cairo_t* cairo, const std::string& text, Point at, double size, double max);
// The middle of the baseline is at `at`. The text has an outline in the colour of the floor.
void outlined_text(cairo_t* cairo, const std::string& text, Point at, double size,
                   const Color& color);
// Shortens an id to at most `max` bytes, between characters.
std::string shortened(const std::string& id, std::size_t max);

void disc(cairo_t* cairo, Point at, double radius, const Color& color);
void diamond(cairo_t* cairo, Point at, double radius, const Color& color, const Color& rim,
             double line);

}  // namespace grove::detail
