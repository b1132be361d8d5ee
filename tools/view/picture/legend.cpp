// SPDX-License-Identifier: MIT
#include "tools/view/picture/legend.h"

#include <algorithm>

#include "tools/view/picture/shapes.h"

namespace grove::detail {
namespace {

constexpr double kSize = 10;  // of a shape, in pixels
constexpr Point kMiddle{kSize / 2, 9};
constexpr double kTextAt = 1.5 * kSize;
constexpr double kBetween = 14;

// Draws the text of a shape and moves the origin to the next shape.
void say(cairo_t* cairo, const char* text) {
  set(cairo, kText);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text, &extents);
  cairo_move_to(cairo, kTextAt, kMiddle.y + 4);
  cairo_show_text(cairo, text);
  cairo_translate(cairo, kTextAt + extents.x_advance + kBetween, 0);
}

void add_robot(cairo_t* cairo, const char* text, int doing) {
  disc(cairo, kMiddle, kSize / 2, kDoing[static_cast<std::size_t>(doing)]);
  say(cairo, text);
}

void add_task(cairo_t* cairo, const char* text, const Color& color, const Color& rim) {
  diamond(cairo, kMiddle, 0.6 * kSize, color, rim, 1);
  say(cairo, text);
}

void add_goal(cairo_t* cairo, const char* text) {
  set(cairo, kGoal);
  cairo_set_line_width(cairo, 1);
  cairo_rectangle(cairo, 0.5, kMiddle.y - kSize / 2, kSize, kSize);
  cairo_stroke(cairo);
  say(cairo, text);
}

bool has_work(const Instance& instance) {
  return std::ranges::any_of(instance.tasks(), [](const Task& t) { return t.duration > 0; });
}

bool has_choice_of_agents(const Instance& instance) {
  return !std::ranges::all_of(instance.tasks(), &Task::needs_all);
}

bool has_goals(const Instance& instance) {
  return std::ranges::any_of(instance.agents(), &Agent::has_destination);
}

bool has_choice_of_goals(const Instance& instance) {
  return std::ranges::any_of(instance.agents(), [](const Agent& a) { return !a.goals.empty(); });
}

// Draws the second row.
void draw_choices(cairo_t* cairo, const Instance& instance) {
  cairo_save(cairo);
  cairo_translate(cairo, 0, kLegendRow);
  set_dashes(cairo, 2 * kSize);
  if (has_choice_of_agents(instance)) add_task(cairo, "needs only some robots", kTaskOpen, kTask);
  if (has_choice_of_goals(instance)) add_goal(cairo, "possible destination");
  cairo_restore(cairo);
}

}  // namespace

int legend_rows(const Instance& instance) {
  return has_choice_of_agents(instance) || has_choice_of_goals(instance) ? 2 : 1;
}

void draw_legend(cairo_t* cairo, const Instance& instance, bool has_plan) {
  cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, 11);
  cairo_save(cairo);
  if (has_plan) {
    add_robot(cairo, "moving", kMoving);
    add_robot(cairo, "waiting", kWaiting);
    if (has_work(instance)) add_robot(cairo, "at work", kWorking);
    add_robot(cairo, "at rest", kResting);
  }
  if (instance.task_count() > 0) {
    add_task(cairo, "open task", kTaskOpen, kTask);
    add_task(cairo, "begun", kTaskBegun, kTask);
    add_task(cairo, "done", kTaskDone, kGoal);
  }
  if (has_goals(instance)) add_goal(cairo, "destination");
  cairo_restore(cairo);
  if (legend_rows(instance) > 1) draw_choices(cairo, instance);
}

}  // namespace grove::detail
