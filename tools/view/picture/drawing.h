// SPDX-License-Identifier: MIT
// Draws one moment of a plan with cairo, for SVG, PNG and the frames of a GIF.
#pragma once

#include <cairo/cairo.h>

#include <string>
#include <vector>

#include "model/instance.h"
#include "model/plan.h"

namespace grove::detail {

// Draws an instance with a plan or, if `plan` is nullptr, with all agents at their starts. Holds
// references to both, which must outlive it. The plan may be invalid; agents without a path are
// left out.
class Drawing {
 public:
  Drawing(const Instance& instance, const Plan* plan);
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  // Height divided by width.
  double shape() const { return height_ / width_; }
  bool has_plan() const { return plan_ != &standing_; }
  const Instance& instance() const { return instance_; }
  // Time from which on all agents rest, in steps; 0 without a plan.
  Time end() const { return end_; }

  // Fills `width` x (`width` * shape()) units of `cairo` from its origin. `time` is in steps and
  // need not be whole.
  void draw(cairo_t* cairo, double width, double time) const;

 private:
  struct Robot {
    Point at;
    double angle;  // clockwise from up, in radians
    bool turns;    // whether turns take time, so that its heading is drawn
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
  void add_square(cairo_t* cairo, Place place) const;
  void draw_tasks(cairo_t* cairo, double time) const;
  void draw_vertex_names(cairo_t* cairo) const;
  void draw_robot(cairo_t* cairo, const Robot& robot) const;
  void draw_name(cairo_t* cairo, const Robot& robot, const std::string& id) const;
  double pixel(cairo_t* cairo) const;

  const Instance& instance_;
  const Plan standing_;
  const Plan* plan_;
  double width_ = 1;  // in world units: cells or metres
  double height_ = 1;
  Point origin_;
  double unit_ = 1;  // length of a step in world units
  Time end_ = 0;
  std::vector<Time> rests_;                // by agent: time from which on it rests
  std::vector<std::vector<Time>> visits_;  // by task: times at which its agents have visited it
  std::vector<Time> begins_;               // by task: start of the first visit or task execution
};

}  // namespace grove::detail
