// SPDX-License-Identifier: MIT
#include "tools/view/picture/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <variant>

namespace grove {
namespace {

struct Color {
  double red, green, blue;
};

constexpr Color hex(unsigned value) {
  return {(value >> 16) / 255.0, (value >> 8 & 255) / 255.0, (value & 255) / 255.0};
}

// The page's light palette (page/colors.ts).
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
constexpr Color kCollision = hex(0xd0021b);
constexpr int kMoving = 0;
constexpr int kWaiting = 1;
constexpr int kWorking = 2;
constexpr int kResting = 3;
constexpr std::array kDoing{hex(0x0072b2), hex(0xe69f00), hex(0x009e73), hex(0x8a929c)};

constexpr double kBend = 0.35;          // between roads that join the same vertices, in steps
constexpr double kMargin = 1.5;         // of a roadmap, in steps
constexpr double kLeastLabeled = 16.0;  // pixels of a step from which on robots have their ids

void set(cairo_t* cairo, const Color& color) {
  cairo_set_source_rgb(cairo, color.red, color.green, color.blue);
}

// The time from which on it stays: after its last step and its last work.
Time rest_of(const AgentPlan& plan) {
  Time rest = 0;
  for (std::size_t t = 1; t < plan.path.size(); ++t)
    if (plan.path[t] != plan.path[t - 1]) rest = static_cast<Time>(t);
  for (const WorkTime& work : plan.work) rest = std::max(rest, work.end);
  return rest;
}

void center_text(cairo_t* cairo, const std::string& text, Point at, double size, double most) {
  cairo_set_font_size(cairo, size);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text.c_str(), &extents);
  if (extents.width > most) {
    size *= most / extents.width;
    cairo_set_font_size(cairo, size);
    cairo_text_extents(cairo, text.c_str(), &extents);
  }
  cairo_move_to(cairo, at.x - extents.width / 2 - extents.x_bearing,
                at.y - extents.height / 2 - extents.y_bearing);
  cairo_show_text(cairo, text.c_str());
}

}  // namespace

Drawing::Drawing(const Instance& instance, const Plan* plan) : instance_(instance), plan_(plan) {
  if (const Roadmap* roadmap = instance.roadmap()) {
    double length = 0;
    double steps = 0;
    for (const Road& road : roadmap->roads()) {
      const Point a = roadmap->vertices()[static_cast<std::size_t>(road.from)].at;
      const Point b = roadmap->vertices()[static_cast<std::size_t>(road.to)].at;
      length += std::hypot(a.x - b.x, a.y - b.y);
      steps += road.steps;
    }
    unit_ = length > 0 ? length / steps : 1;
    Point least = roadmap->vertices().front().at;
    Point most = least;
    for (const Vertex& vertex : roadmap->vertices()) {
      least = {std::min(least.x, vertex.at.x), std::min(least.y, vertex.at.y)};
      most = {std::max(most.x, vertex.at.x), std::max(most.y, vertex.at.y)};
    }
    const double margin = kMargin * unit_;
    origin_ = {least.x - margin, most.y + margin};
    width_ = most.x - least.x + 2 * margin;
    height_ = most.y - least.y + 2 * margin;
  } else {
    width_ = instance.grid().width();
    height_ = instance.grid().height();
  }
  visits_.resize(static_cast<std::size_t>(instance.task_count()));
  if (plan_ == nullptr) return;
  for (std::size_t i = 0; i < plan_->agents.size(); ++i) {
    const AgentPlan& agent = plan_->agents[i];
    end_ = std::max(end_, rest_of(agent));
    for (const TaskIndex task : instance.agent(static_cast<AgentIndex>(i)).tasks) {
      auto& visits = visits_[static_cast<std::size_t>(task)];
      if (instance.task(task).duration > 0) {
        const auto work = std::ranges::find(agent.work, task, &WorkTime::task);
        if (work != agent.work.end()) visits.push_back(work->end);
        continue;
      }
      const auto is_there = [&](State s) {
        return instance.world().place(s) == instance.task(task).cell;
      };
      const auto first = std::ranges::find_if(agent.path, is_there);
      if (first != agent.path.end())
        visits.push_back(static_cast<Time>(first - agent.path.begin()));
    }
  }
}

Point Drawing::point(Place place) const {
  if (const Roadmap* roadmap = instance_.roadmap()) {
    const Point at = roadmap->at(place);
    const Roadmap::Spot spot = roadmap->spot(place);
    const Point drawn{at.x - origin_.x, origin_.y - at.y};
    return spot.road < 0 ? drawn : beside(drawn, spot);
  }
  const Position at = instance_.grid().position(place);
  return {at.x + 0.5, at.y + 0.5};
}

// Roads that join the same vertices lie beside each other, and a road from a vertex to itself is a
// circle, as on the page (page/world.ts).
Point Drawing::beside(Point at, const Roadmap::Spot& spot) const {
  const Roadmap& roadmap = *instance_.roadmap();
  const Road& road = roadmap.roads()[static_cast<std::size_t>(spot.road)];
  const double part = static_cast<double>(spot.steps) / road.steps;
  if (road.from == road.to) {
    const double angle = 2 * std::numbers::pi * part;
    return {at.x + unit_ * std::sin(angle), at.y - unit_ * (1 - std::cos(angle))};
  }
  const auto row = roadmap.roads_between(road.from, road.to);
  if (row.size() < 2) return at;
  const auto rank = static_cast<double>(std::ranges::find(row, spot.road) - row.begin());
  const double bend = (rank - static_cast<double>(row.size() - 1) / 2) * 2 * kBend * unit_;
  const Point a = point(roadmap.place_of_vertex(std::min(road.from, road.to)));
  const Point b = point(roadmap.place_of_vertex(std::max(road.from, road.to)));
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (length == 0) return at;
  const double aside = bend * std::sin(std::numbers::pi * part) / length;
  return {at.x - (b.y - a.y) * aside, at.y + (b.x - a.x) * aside};
}

int Drawing::visits_by(TaskIndex task, double time) const {
  return static_cast<int>(std::ranges::count_if(visits_[static_cast<std::size_t>(task)],
                                                [&](Time visit) { return visit <= time; }));
}

Drawing::Robot Drawing::robot(AgentIndex agent, double time) const {
  const AgentPlan& plan = plan_->agents[static_cast<std::size_t>(agent)];
  const auto step = static_cast<Time>(std::floor(time));
  const double part = time - step;
  const State from = state_at(plan.path, step);
  const State to = state_at(plan.path, step + 1);
  const Point a = point(instance_.world().place(from));
  const Point b = point(instance_.world().place(to));
  Robot robot{{a.x + (b.x - a.x) * part, a.y + (b.y - a.y) * part}, 0, false, kMoving, false};
  const Time turn_steps = instance_.agent(agent).motion.turn_steps;
  if (turn_steps > 0) {
    robot.turns = true;
    const auto quarters = [&](State state) {
      const Pose pose = instance_.pose_of(state);
      const double heading = static_cast<double>(pose.heading);
      const double done = static_cast<double>(pose.steps) / turn_steps;
      return pose.steps == 0 ? heading
                             : heading + (pose.to == left_of(pose.heading) ? -done : done);
    };
    const double begin = quarters(from);
    double by = quarters(to) - begin;
    if (by > 2) by -= 4;
    if (by < -2) by += 4;
    robot.angle = (begin + by * part) * std::numbers::pi / 2;
  }
  const auto at_work = [&](const WorkTime& work) { return work.begin <= time && time < work.end; };
  if (std::ranges::any_of(plan.work, at_work))
    robot.doing = kWorking;
  else if (time >= rest_of(plan))
    robot.doing = kResting;
  else if (from == to)
    robot.doing = kWaiting;
  return robot;
}

std::vector<Drawing::Robot> Drawing::robots(double time) const {
  std::vector<Robot> all;
  for (std::size_t i = 0; i < plan_->agents.size(); ++i)
    all.push_back(plan_->agents[i].path.empty() ? Robot{{-1e9, -1e9}, 0, false, kResting, false}
                                                : robot(static_cast<AgentIndex>(i), time));
  mark_collisions(all, time);
  return all;
}

// On one place at this step, or, between two steps, exchanging places or coming to one.
void Drawing::mark_collisions(std::vector<Robot>& robots, double time) const {
  const auto step = static_cast<Time>(std::floor(time));
  const double part = time - step;
  std::map<Place, std::size_t> here;
  std::map<Place, std::size_t> next;
  const auto place = [&](std::size_t i, Time t) {
    return place_at(instance_.world(), plan_->agents[i].path, t);
  };
  const auto meet = [&](std::map<Place, std::size_t>& taken, std::size_t i, Time t) {
    const auto [other, is_first] = taken.emplace(place(i, t), i);
    if (!is_first) robots[i].collides = robots[other->second].collides = true;
  };
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (plan_->agents[i].path.empty()) continue;
    meet(here, i, step);
    if (part >= 0.5) meet(next, i, step + 1);
  }
  if (part == 0) return;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (plan_->agents[i].path.empty() || place(i, step) == place(i, step + 1)) continue;
    const auto other = here.find(place(i, step + 1));
    if (other != here.end() && place(other->second, step + 1) == place(i, step))
      robots[i].collides = robots[other->second].collides = true;
  }
}

void Drawing::draw(cairo_t* cairo, double width, double time) const {
  cairo_save(cairo);
  cairo_scale(cairo, width / width_, width / width_);
  cairo_rectangle(cairo, 0, 0, width_, height_);
  cairo_clip(cairo);
  set(cairo, kFloor);
  cairo_paint(cairo);
  cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_BOLD);
  if (instance_.is_on_grid())
    draw_grid(cairo);
  else
    draw_roads(cairo);
  draw_goals(cairo);
  draw_tasks(cairo, time);
  if (plan_ != nullptr) {
    const auto all = robots(time);
    for (std::size_t i = 0; i < all.size(); ++i)
      draw_robot(cairo, all[i], instance_.agent(static_cast<AgentIndex>(i)).id);
  }
  cairo_restore(cairo);
}

void Drawing::draw_grid(cairo_t* cairo) const {
  const Grid& grid = instance_.grid();
  set(cairo, kLines);
  cairo_set_line_width(cairo, 0.04);
  for (int x = 1; x < grid.width(); ++x) {
    cairo_move_to(cairo, x, 0);
    cairo_line_to(cairo, x, grid.height());
  }
  for (int y = 1; y < grid.height(); ++y) {
    cairo_move_to(cairo, 0, y);
    cairo_line_to(cairo, grid.width(), y);
  }
  cairo_stroke(cairo);
  // Runs of blocked cells: fewer shapes.
  set(cairo, kWall);
  for (int y = 0; y < grid.height(); ++y)
    for (int x = 0; x < grid.width();) {
      int end = x;
      while (end < grid.width() && !grid.passable(grid.cell({end, y}))) ++end;
      if (end > x) cairo_rectangle(cairo, x, y, end - x, 1);
      x = std::max(end, x + 1);
    }
  cairo_fill(cairo);
}

void Drawing::draw_roads(cairo_t* cairo) const {
  const Roadmap& roadmap = *instance_.roadmap();
  set(cairo, kRoad);
  cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_width(cairo, 0.5 * unit_);
  const int roads = static_cast<int>(roadmap.roads().size());
  for (int r = 0; r < roads; ++r)
    for (Time step = 0; step <= roadmap.roads()[static_cast<std::size_t>(r)].steps; ++step) {
      const Point at = point(roadmap.place_on_road(r, step));
      if (step == 0)
        cairo_move_to(cairo, at.x, at.y);
      else
        cairo_line_to(cairo, at.x, at.y);
    }
  cairo_stroke(cairo);
  set(cairo, kVertex);
  for (int r = 0; r < roads; ++r)
    if (roadmap.roads()[static_cast<std::size_t>(r)].one_way) draw_arrow(cairo, r);
  cairo_fill(cairo);
  for (int v = 0; v < static_cast<int>(roadmap.vertices().size()); ++v) {
    const Point at = point(roadmap.place_of_vertex(v));
    cairo_arc(cairo, at.x, at.y, 0.18 * unit_, 0, 2 * std::numbers::pi);
    cairo_fill(cairo);
  }
}

// In the middle of a road, in its direction.
void Drawing::draw_arrow(cairo_t* cairo, int road) const {
  const Roadmap& roadmap = *instance_.roadmap();
  const Time middle = (roadmap.roads()[static_cast<std::size_t>(road)].steps - 1) / 2;
  const Point a = point(roadmap.place_on_road(road, middle));
  const Point b = point(roadmap.place_on_road(road, middle + 1));
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  if (length == 0) return;
  const double dx = 0.3 * unit_ * (b.x - a.x) / length;
  const double dy = 0.3 * unit_ * (b.y - a.y) / length;
  const Point at{(a.x + b.x) / 2, (a.y + b.y) / 2};
  cairo_move_to(cairo, at.x + dx, at.y + dy);
  cairo_line_to(cairo, at.x - dx - dy, at.y - dy + dx);
  cairo_line_to(cairo, at.x - dx + dy, at.y - dy - dx);
  cairo_close_path(cairo);
}

void Drawing::draw_goals(cairo_t* cairo) const {
  set(cairo, kGoal);
  cairo_set_line_width(cairo, 0.05 * unit_);
  for (const Agent& agent : instance_.agents()) {
    if (!agent.goal) continue;
    const Point at = point(*agent.goal);
    const double r = 0.4 * unit_;
    cairo_rectangle(cairo, at.x - r, at.y - r, 2 * r, 2 * r);
  }
  cairo_stroke(cairo);
}

// All tasks on a place are one diamond: pale, yellow once begun, grey when done.
void Drawing::draw_tasks(cairo_t* cairo, double time) const {
  struct Progress {
    int visits = 0;
    int total = 0;
  };
  std::map<Place, Progress> places;
  for (TaskIndex task = 0; task < instance_.task_count(); ++task) {
    Progress& progress = places[instance_.task(task).cell];
    progress.visits += visits_by(task, time);
    progress.total += static_cast<int>(instance_.task(task).agents.size());
  }
  cairo_set_line_width(cairo, 0.05 * unit_);
  for (const auto& [place, progress] : places) {
    const Point at = point(place);
    const double r = 0.42 * unit_;
    cairo_move_to(cairo, at.x, at.y - r);
    cairo_line_to(cairo, at.x + r, at.y);
    cairo_line_to(cairo, at.x, at.y + r);
    cairo_line_to(cairo, at.x - r, at.y);
    cairo_close_path(cairo);
    set(cairo, progress.visits >= progress.total ? kTaskDone
               : progress.visits > 0             ? kTaskBegun
                                                 : kTaskOpen);
    cairo_fill_preserve(cairo);
    set(cairo, kTask);
    cairo_stroke(cairo);
  }
}

void Drawing::draw_robot(cairo_t* cairo, const Robot& robot, const std::string& id) const {
  const double r = 0.34 * unit_;
  const Point at = robot.at;
  if (robot.collides) {
    set(cairo, kCollision);
    for (int k = 0; k < 16; ++k) {
      const double length = (k % 2 == 0 ? 1.4 : 0.9) * r;
      const double angle = k * std::numbers::pi / 8;
      cairo_line_to(cairo, at.x + length * std::cos(angle), at.y + length * std::sin(angle));
    }
    cairo_close_path(cairo);
  } else {
    set(cairo, kDoing[static_cast<std::size_t>(robot.doing)]);
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, at.x, at.y, r, 0, 2 * std::numbers::pi);
  }
  cairo_fill(cairo);
  if (robot.turns) {
    const double dx = std::sin(robot.angle);
    const double dy = -std::cos(robot.angle);
    set(cairo, kText);
    cairo_move_to(cairo, at.x + dx * 1.25 * r, at.y + dy * 1.25 * r);
    cairo_line_to(cairo, at.x + (0.75 * dx - 0.5 * dy) * r, at.y + (0.75 * dy + 0.5 * dx) * r);
    cairo_line_to(cairo, at.x + (0.75 * dx + 0.5 * dy) * r, at.y + (0.75 * dy - 0.5 * dx) * r);
    cairo_close_path(cairo);
    cairo_fill(cairo);
  }
  double pixel = 1;
  double none = 0;
  cairo_device_to_user_distance(cairo, &pixel, &none);
  if (unit_ < kLeastLabeled * pixel) return;
  set(cairo, kOnRobot);
  center_text(cairo, id, at, 0.34 * unit_, 1.5 * r);
}

}  // namespace grove
