// SPDX-License-Identifier: MIT
// grove-picture view ...: the program that `grove view` executes to draw pictures. It has only the
// view command, and is linked with the drawing libraries.
#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "tools/common/program.h"
#include "tools/view/picture/picture.h"
#include "tools/view/view_command.h"

namespace grove::detail {
namespace {

void draw(const PictureRequest& order, const Instance& instance, const Plan* plan,
          const std::function<void(const std::string&, const std::string&)>& write) {
  const Drawing drawing(instance, plan);
  const int width = static_cast<int>(order.width);
  if (!order.svg.empty()) write(order.svg, svg_picture(drawing, order.moments, width));
  if (!order.png.empty()) write(order.png, png_picture(drawing, order.moments, width));
  if (!order.gif.empty()) write(order.gif, gif_picture(drawing, width, order.speed));
}

}  // namespace
}  // namespace grove::detail

int main(int argc, char** argv) {
  CLI::App app("Pictures of plans: the part of grove view that draws", "grove");
  grove::detail::prepare_program(app);
  grove::detail::add_view_command(app, {.exec_picture_program = {}, .draw = grove::detail::draw});
  return grove::detail::run_only_process(app, argc, argv);
}
