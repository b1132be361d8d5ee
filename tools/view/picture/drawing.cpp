// SPDX-License-Identifier: MIT
#include "tools/view/picture/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <variant>

#include "tools/view/picture/shapes.h"

namespace grove::detail {
namespace {

constexpr double kMinLabeled = 16.0;  // minimum length of a step for ids on robots, in pixels
constexpr double kTagSize = 9.0;      // pixels

// Returns the time from which the agent rests: the end of its last move, turn or task execution.
Time rest_of(const AgentPlan& plan) {
  Time rest = 0;
  for (std::size_t t = 1; t < plan.path.size(); ++t)
    if (plan.path[t] != plan.path[t - 1]) rest = static_cast<Time>(t);
  for (const WorkTime& work : plan.work) rest = std::max(rest, work.end);
  return rest;
}

}  // namespace

Drawing::Drawing(const Instance& instance, const Plan* plan)
    : instance_(instance), standing_(standing_plan(instance)), plan_(plan ? plan : &standing_) {
  if (const Roadmap* roadmap = instance.roadmap()) {
    measure_roadmap(*roadmap);
  } else {
    width_ = instance.grid().width();
    height_ = instance.grid().height();
  }
  visits_.resize(static_cast<std::size_t>(instance.task_count()));
  begins_.resize(visits_.size(), std::numeric_limits<Time>::max());
  for (std::size_t i = 0; i < plan_->agents.size(); ++i) {
    rests_.push_back(rest_of(plan_->agents[i]));
    if (!has_plan()) continue;
    end_ = std::max(end_, rests_.back());
    note_visits(static_cast<AgentIndex>(i), plan_->agents[i]);
  }
}

// Sets the origin, size and unit of the drawing. The size covers all places, because curved roads
// may leave the bounding box of the vertices.
void Drawing::measure_roadmap(const Roadmap& roadmap) {
  double length = 0;
  double steps = 0;
  for (const Road& road : roadmap.roads()) {
    const Point a = roadmap.vertices()[static_cast<std::size_t>(road.from)].at;
    const Point b = roadmap.vertices()[static_cast<std::size_t>(road.to)].at;
    length += std::hypot(a.x - b.x, a.y - b.y);
    steps += road.steps;
  }
  unit_ = length > 0 ? length / steps : 1;
  Point least = point(0);
  Point most = least;
  for (Place place = 1; place < roadmap.place_count(); ++place) {
    const Point at = point(place);
    least = {std::min(least.x, at.x), std::min(least.y, at.y)};
    most = {std::max(most.x, at.x), std::max(most.y, at.y)};
  }
  const double margin = kMargin * unit_;
  origin_ = {least.x - margin, -(least.y - margin)};
  width_ = most.x - least.x + 2 * margin;
  height_ = most.y - least.y + 2 * margin;
}

// The plan states the visits of some tasks, and an agent visits the others by being on their place.
// A plan may be invalid and state a visit twice, or one of a task of other agents.
void Drawing::note_visits(AgentIndex agent, const AgentPlan& plan) {
  std::set<TaskIndex> noted;
  for (const WorkTime& work : plan.work) {
    const Task& task = instance_.task(work.task);
    if (!task.has_stated_visits() || std::ranges::count(task.agents, agent) == 0) continue;
    if (!noted.insert(work.task).second) continue;
    Time& begin = begins_[static_cast<std::size_t>(work.task)];
    visits_[static_cast<std::size_t>(work.task)].push_back(work.end);
    begin = std::min(begin, work.begin);
  }
  for (const TaskIndex task : instance_.agent(agent).tasks) {
    if (instance_.task(task).has_stated_visits()) continue;
    auto& visits = visits_[static_cast<std::size_t>(task)];
    Time& begin = begins_[static_cast<std::size_t>(task)];
    const auto is_there = [&](State s) {
      return instance_.world().place(s) == instance_.task(task).cell;
    };
    const auto first = std::ranges::find_if(plan.path, is_there);
    if (first == plan.path.end()) continue;
    visits.push_back(static_cast<Time>(first - plan.path.begin()));
    begin = std::min(begin, visits.back());
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

// Shifts a place on a road from the straight line `at` to where the page draws it (page/world.ts):
// roads that join the same vertices are curves beside each other, and a road from a vertex to
// itself is a circle.
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
  else if (time >= rests_[static_cast<std::size_t>(agent)])
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

// Marks robots that are on one place at the last whole step, robots that swap places in the current
// step and, in its second half, robots that move to one place. At a whole step it marks the robots
// that swapped places in the previous step instead.
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
  const Time from = part == 0 ? std::max(0, step - 1) : step;
  std::map<Place, std::size_t> before;
  for (std::size_t i = 0; i < robots.size(); ++i)
    if (!plan_->agents[i].path.empty()) before.emplace(place(i, from), i);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    if (plan_->agents[i].path.empty() || place(i, from) == place(i, from + 1)) continue;
    const auto other = before.find(place(i, from + 1));
    if (other != before.end() && place(other->second, from + 1) == place(i, from))
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
  if (!instance_.is_on_grid()) draw_vertex_names(cairo);
  const auto all = robots(time);
  for (const Robot& robot : all) draw_robot(cairo, robot);
  const bool named = unit_ >= kMinLabeled * pixel(cairo) || all.size() <= kMaxTags;
  for (std::size_t i = 0; named && i < all.size(); ++i)
    draw_name(cairo, all[i], instance_.agent(static_cast<AgentIndex>(i)).id);
  cairo_restore(cairo);
}

// Returns the length of a pixel in world units.
double Drawing::pixel(cairo_t* cairo) const {
  double length = 1;
  double none = 0;
  cairo_device_to_user_distance(cairo, &length, &none);
  return length;
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
  // Draws each horizontal run of blocked cells as one rectangle.
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

// Adds an arrow in the middle of a one-way road, in its direction, to the path.
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

// Draws destinations and, dashed, places that an agent may choose as its destination but no agent
// does.
void Drawing::draw_goals(cairo_t* cairo) const {
  set(cairo, kGoal);
  cairo_set_line_width(cairo, 0.05 * unit_);
  std::set<Place> taken;
  std::set<Place> possible;
  for (std::size_t i = 0; i < plan_->agents.size(); ++i) {
    const Agent& agent = instance_.agent(static_cast<AgentIndex>(i));
    const Path& path = plan_->agents[i].path;
    possible.insert(agent.goals.begin(), agent.goals.end());
    if (agent.goal) taken.insert(*agent.goal);
    if (!has_plan() || path.empty()) continue;
    const Place end = instance_.world().place(path.back());
    if (std::ranges::count(agent.goals, end) > 0) taken.insert(end);
  }
  for (const Place place : taken) add_square(cairo, place);
  cairo_stroke(cairo);
  set_dashes(cairo, unit_);
  for (const Place place : possible)
    if (!taken.contains(place)) add_square(cairo, place);
  cairo_stroke(cairo);
  cairo_set_dash(cairo, nullptr, 0, 0);
}

void Drawing::add_square(cairo_t* cairo, Place place) const {
  const Point at = point(place);
  const double r = kGoalRadius * unit_;
  cairo_rectangle(cairo, at.x - r, at.y - r, 2 * r, 2 * r);
}

// Draws the tasks on each place as a stack of diamonds with their number: pale before the first
// visit or task execution starts, then yellow, and grey when all tasks have as many visits as they
// need. The outline is dashed if agents choose to visit one of the tasks.
void Drawing::draw_tasks(cairo_t* cairo, double time) const {
  struct Progress {
    int tasks = 0;
    bool done = true;
    bool begun = false;
    bool has_choice = false;
  };
  std::map<Place, Progress> places;
  for (TaskIndex task = 0; task < instance_.task_count(); ++task) {
    const Task& shown = instance_.task(task);
    Progress& progress = places[shown.cell];
    ++progress.tasks;
    progress.done = progress.done && visits_by(task, time) >= shown.need;
    progress.has_choice = progress.has_choice || !shown.needs_all();
    progress.begun = progress.begun || begins_[static_cast<std::size_t>(task)] <= time;
  }
  for (const auto& [place, progress] : places) {
    const Point at = point(place);
    const bool done = progress.done;
    const Color& color = done ? kTaskDone : progress.begun ? kTaskBegun : kTaskOpen;
    if (progress.has_choice) set_dashes(cairo, unit_);
    for (int k = std::min(kMaxStacked, progress.tasks) - 1; k >= 0; --k)
      diamond(cairo, {at.x + kStackOffset * k * unit_, at.y - kStackOffset * k * unit_},
              kTaskRadius * unit_, color, done ? kGoal : kTask, 0.05 * unit_);
    cairo_set_dash(cairo, nullptr, 0, 0);
    if (progress.tasks == 1) continue;
    set(cairo, kText);
    center_text(cairo, std::to_string(progress.tasks), at, 0.36 * unit_, 0.6 * unit_);
  }
}

// Draws the names below the vertices. If names would overlap, draws only the first of them. Draws
// no names if they would be too dense.
void Drawing::draw_vertex_names(cairo_t* cairo) const {
  const double size = kTagSize * pixel(cairo);
  const auto& vertices = instance_.roadmap()->vertices();
  const double room = width_ * height_ / (pixel(cairo) * pixel(cairo));
  if (static_cast<double>(vertices.size()) * kAreaPerName > room) return;
  std::vector<Point> taken;
  for (int v = 0; v < static_cast<int>(vertices.size()); ++v) {
    const Point on = point(instance_.roadmap()->place_of_vertex(v));
    const Point at{on.x, on.y + kTaskRadius * unit_ + 1.1 * size};
    const auto is_near = [&](Point other) {
      return std::abs(other.x - at.x) < 4 * size && std::abs(other.y - at.y) < 1.2 * size;
    };
    if (std::ranges::any_of(taken, is_near)) continue;
    taken.push_back(at);
    outlined_text(cairo, shortened(vertices[static_cast<std::size_t>(v)].id, 14), at, size, kFaint);
  }
}

void Drawing::draw_robot(cairo_t* cairo, const Robot& robot) const {
  const double r = kRobotRadius * unit_;
  const Point at = robot.at;
  if (robot.collides) {
    set(cairo, kCollision);
    for (int k = 0; k < 16; ++k) {
      const double length = (k % 2 == 0 ? 1.4 : 0.9) * r;
      const double angle = k * std::numbers::pi / 8;
      cairo_line_to(cairo, at.x + length * std::cos(angle), at.y + length * std::sin(angle));
    }
    cairo_close_path(cairo);
    cairo_fill(cairo);
  } else {
    disc(cairo, at, r, kDoing[static_cast<std::size_t>(robot.doing)]);
  }
  if (robot.turns) {
    const double dx = std::sin(robot.angle);
    const double dy = -std::cos(robot.angle);
    set(cairo, kText);
    constexpr double kHalf = kHeadingTip - kHeadingBase;
    cairo_move_to(cairo, at.x + dx * kHeadingTip * r, at.y + dy * kHeadingTip * r);
    cairo_line_to(cairo, at.x + (kHeadingBase * dx - kHalf * dy) * r,
                  at.y + (kHeadingBase * dy + kHalf * dx) * r);
    cairo_line_to(cairo, at.x + (kHeadingBase * dx + kHalf * dy) * r,
                  at.y + (kHeadingBase * dy - kHalf * dx) * r);
    cairo_close_path(cairo);
    cairo_fill(cairo);
  }
}

// Draws the id on the robot or, if the robot is small, above it.
void Drawing::draw_name(cairo_t* cairo, const Robot& robot, const std::string& id) const {
  const double r = kRobotRadius * unit_;
  if (unit_ >= kMinLabeled * pixel(cairo)) {
    set(cairo, robot.collides || robot.doing == kMoving ? kOnRobot : kOnPale);
    center_text(cairo, shortened(id, 14), robot.at, 0.34 * unit_, 1.5 * r);
    return;
  }
  const double size = kTagSize * pixel(cairo);
  outlined_text(cairo, shortened(id, 14), {robot.at.x, robot.at.y - r - 0.2 * size}, size, kText);
}

}  // namespace grove::detail
