// SPDX-License-Identifier: MIT
#include "tools/view/picture/shapes.h"

#include <array>
#include <numbers>

namespace grove::detail {

void set(cairo_t* cairo, const Color& color) {
  cairo_set_source_rgb(cairo, color.red, color.green, color.blue);
}

void set_dashes(cairo_t* cairo, double unit) {
  const std::array lengths{0.12 * unit, 0.1 * unit};
  cairo_set_dash(cairo, lengths.data(), static_cast<int>(lengths.size()), 0);
}

void center_text(cairo_t* cairo, const std::string& text, Point at, double size, double max) {
  cairo_set_font_size(cairo, size);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text.c_str(), &extents);
  if (extents.width > max) {
    size *= max / extents.width;
    cairo_set_font_size(cairo, size);
    cairo_text_extents(cairo, text.c_str(), &extents);
  }
  cairo_move_to(cairo, at.x - extents.width / 2 - extents.x_bearing,
                at.y - extents.height / 2 - extents.y_bearing);
  cairo_show_text(cairo, text.c_str());
}

// Draws the outline as shifted copies of the text, because stroked letters would make an SVG file
// large.
void outlined_text(cairo_t* cairo, const std::string& text, Point at, double size,
                   const Color& color) {
  cairo_set_font_size(cairo, size);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text.c_str(), &extents);
  const double x = at.x - extents.width / 2 - extents.x_bearing;
  const auto show = [&](double right, double down) {
    cairo_move_to(cairo, x + 0.12 * size * right, at.y + 0.12 * size * down);
    cairo_show_text(cairo, text.c_str());
  };
  set(cairo, kFloor);
  for (const double right : {-1.0, 1.0})
    for (const double down : {-1.0, 1.0}) show(right, down);
  set(cairo, color);
  show(0, 0);
}

std::string shortened(const std::string& id, std::size_t max) {
  if (id.size() <= max) return id;
  std::size_t end = max - 1;
  while (end > 0 && (static_cast<unsigned char>(id[end]) & 0xc0) == 0x80) --end;
  return id.substr(0, end) + "…";
}

void disc(cairo_t* cairo, Point at, double radius, const Color& color) {
  set(cairo, color);
  cairo_new_sub_path(cairo);
  cairo_arc(cairo, at.x, at.y, radius, 0, 2 * std::numbers::pi);
  cairo_fill(cairo);
}

void diamond(cairo_t* cairo, Point at, double radius, const Color& color, const Color& rim,
             double line) {
  cairo_move_to(cairo, at.x, at.y - radius);
  cairo_line_to(cairo, at.x + radius, at.y);
  cairo_line_to(cairo, at.x, at.y + radius);
  cairo_line_to(cairo, at.x - radius, at.y);
  cairo_close_path(cairo);
  set(cairo, color);
  cairo_fill_preserve(cairo);
  set(cairo, rim);
  cairo_set_line_width(cairo, line);
  cairo_stroke(cairo);
}

}  // namespace grove::detail
