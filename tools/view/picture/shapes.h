// SPDX-License-Identifier: MIT
// Colours of pictures, and shapes and texts that are drawn more than once.
#pragma once

#include <cairo/cairo.h>

#include <array>
#include <cstddef>
#include <string>

#include "model/roadmap.h"

namespace grove::detail {

struct Color {
  double red, green, blue;
};

constexpr Color hex(unsigned value) {
  return {(value >> 16) / 255.0, (value >> 8 & 255) / 255.0, (value & 255) / 255.0};
}

// The light palette of the page (page/colors.ts).
constexpr Color kFloor = hex(0xffffff);
constexpr Color kWall = hex(0x5f6670);
constexpr Color kLines = hex(0xeceef1);
constexpr Color kRoad = hex(0xcfd5dc);
constexpr Color kVertex = hex(0x8b949e);
constexpr Color kGoal = hex(0x8a929c);
constexpr Color kTask = hex(0x7a5c00);
constexpr Color kTaskOpen = hex(0xfff3c4);
constexpr Color kTaskBegun = hex(0xf0e442);
constexpr Color kTaskDone = hex(0xd7dbe0);
constexpr Color kText = hex(0x1c2128);
constexpr Color kOnRobot = hex(0xffffff);
constexpr Color kOnPale = hex(0x1c2128);
constexpr Color kFaint = hex(0x656d76);
constexpr Color kCollision = hex(0xd0021b);

// Activities of robots, as indices of kDoing.
constexpr int kMoving = 0;
constexpr int kWaiting = 1;
constexpr int kWorking = 2;
constexpr int kResting = 3;
constexpr std::array kDoing{hex(0x0072b2), hex(0xe69f00), hex(0x009e73), hex(0x8a929c)};

void set(cairo_t* cairo, const Color& color);

// Centred on `at`; reduced in size if it would be wider than `most`.
void center_text(cairo_t* cairo, const std::string& text, Point at, double size, double most);
// The middle of the baseline is at `at`. The text has an outline in the colour of the floor.
void outlined_text(cairo_t* cairo, const std::string& text, Point at, double size,
                   const Color& color);
// Shortens an id to at most `most` bytes, between characters.
std::string shortened(const std::string& id, std::size_t most);

void disc(cairo_t* cairo, Point at, double radius, const Color& color);
void diamond(cairo_t* cairo, Point at, double radius, const Color& color, const Color& rim,
             double line);

}  // namespace grove::detail
