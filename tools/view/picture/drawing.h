// SPDX-License-Identifier: MIT
// A moment of a plan, drawn with cairo; the same drawing is used for SVG, PNG and the frames of a
// GIF.
#pragma once

#include <cairo/cairo.h>

#include <string>
#include <vector>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail {

// Draws an instance and, if there is one, a plan; otherwise all agents at their starts. Holds
// references: both must outlive it. The plan may be invalid; agents without a path are left out.
class Drawing {
 public:
  Drawing(const Instance& instance, const Plan* plan);
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  // Height divided by width.
  double shape() const { return height_ / width_; }
  bool has_plan() const { return plan_ != &standing_; }
  const Instance& instance() const { return instance_; }
  // The last time at which something changes, steps.
  Time end() const { return end_; }

  // Fills `width` x (`width` * shape()) units of `cairo` from its origin. `time` may be between two
  // steps.
  void draw(cairo_t* cairo, double width, double time) const;

 private:
  struct Robot {
    Point at;
    double angle;  // clockwise from up, in radians
    bool turns;    // whether it needs time to turn
    int doing;     // index into kDoing
    bool collides;
  };

  void measure_roadmap(const Roadmap& roadmap);
  void note_visits(AgentIndex agent, const AgentPlan& plan);
  Point point(Place place) const;
  Point beside(Point at, const Roadmap::Spot& spot) const;
  Robot robot(AgentIndex agent, double time) const;
  std::vector<Robot> robots(double time) const;
  void mark_collisions(std::vector<Robot>& robots, double time) const;
  int visits_by(TaskIndex task, double time) const;

  void draw_grid(cairo_t* cairo) const;
  void draw_roads(cairo_t* cairo) const;
  void draw_arrow(cairo_t* cairo, int road) const;
  void draw_goals(cairo_t* cairo) const;
  void draw_tasks(cairo_t* cairo, double time) const;
  void draw_vertex_names(cairo_t* cairo) const;
  void draw_robot(cairo_t* cairo, const Robot& robot) const;
  void draw_name(cairo_t* cairo, const Robot& robot, const std::string& id) const;
  double pixel(cairo_t* cairo) const;

  const Instance& instance_;
  const Plan standing_;
  const Plan* plan_;
  double width_ = 1;  // in units of the world: cells or metres
  double height_ = 1;
  Point origin_;
  double unit_ = 1;  // length of a step
  Time end_ = 0;
  std::vector<Time> rests_;                // by agent: time from which it rests
  std::vector<std::vector<Time>> visits_;  // by task: times at which its agents have visited it
  std::vector<Time> begins_;               // by task: start of the first visit or task execution
};

}  // namespace grove::detail
