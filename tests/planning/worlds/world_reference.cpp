// SPDX-License-Identifier: MIT
#include "tests/planning/worlds/world_reference.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "tests/oracle/steps.h"
#include "tests/planning/step_rules.h"

namespace grove::detail::testing {
namespace {

// State of an agent at one time.
struct AgentState {
  Pose pose;
  int at_work = -1;  // index of the stop that it is executing; -1: none
  Time done = 0;
  unsigned counted = 0;  // bit i: stop i is counted as visited
  int last = -1;         // the stop counted last
  Mouth mouth;           // entrance by which it entered its corridor; none: see StepRules
  Time arrival = 0;      // at its place; clamped to the time from which the rules no longer change

  auto key() const {
    return std::tuple(pose.place, pose.heading, pose.to, pose.steps, at_work, done, counted, last,
                      mouth.end, mouth.inner, arrival);
  }
  bool operator<(const AgentState& other) const { return key() < other.key(); }
  bool operator==(const AgentState& other) const { return key() == other.key(); }
};

class Layers {
 public:
  Layers(const Instance& instance, AgentIndex index, const SequenceClass& work,
         const std::vector<Constraint>& constraints)
      : instance_(instance),
        agent_(instance.agent(index)),
        rests_on_last_(instance.rests_on_last_stop(index)),
        work_(work),
        constraints_(constraints),
        rules_(instance.world(), constraints),
        steps_(oracle::steps_on(instance.map())) {
    AgentState start{.pose = instance.pose_of(agent_.start), .mouth = {}};
    if (instance.world().is_working(agent_.start)) {
      const Work& begun = instance.world().work(agent_.start);
      start.at_work =
          static_cast<int>(std::ranges::find(agent_.stops, begun.task) - agent_.stops.begin());
      start.done = begun.done;
      if (!may_follow(0, start.at_work)) return;  // it must count that stop first
    }
    if (!rules_.barred(start.pose.place, 0)) reach(start);
    now_.swap(next_);
  }

  bool finished(Time time) const {
    return std::ranges::any_of(now_, [&](const AgentState& s) { return may_rest(s, time); });
  }

  // Advances to `time`. Returns false if the reachable states can no longer change.
  bool step(Time time) {
    next_.clear();
    for (const AgentState& s : now_) leave(s, time);
    now_.swap(next_);
    return time <= rules_.last_change() || now_ != next_;
  }

 private:
  const Task& stop(int number) const { return instance_.task(agent_.stops[number]); }
  int stops() const { return static_cast<int>(agent_.stops.size()); }

  bool may_follow(unsigned counted, int next) const {
    const auto position = static_cast<std::size_t>(__builtin_popcount(counted));
    if ((counted >> next & 1) != 0) return false;
    if (position < work_.prefix.size()) return work_.prefix[position] == next;
    return position > work_.prefix.size() || (work_.forbidden_next >> next & 1) == 0;
  }

  bool is_home(const AgentState& s) const {
    if (agent_.goal)
      return s.pose.place == *agent_.goal &&
             (!agent_.goal_heading ||
              (s.pose.steps == 0 && s.pose.heading == *agent_.goal_heading));
    if (rests_on_last_) return stop(s.last).cell == s.pose.place;
    if (stops() == 0) return true;
    for (int k = 0; k < stops(); ++k)
      if (stop(k).cell == s.pose.place) return true;
    return false;
  }

  bool may_rest(const AgentState& s, Time time) const {
    if (s.at_work >= 0 || s.counted != (1U << stops()) - 1 || !is_home(s)) return false;
    return std::ranges::all_of(constraints_, [&](const Constraint& c) {
      const bool here = c.cell == s.pose.place;
      switch (c.kind) {
        case ConstraintKind::kNoRestBy:
          return !here || s.arrival > c.end;
        case ConstraintKind::kRestBy:
          return here && s.arrival <= c.end;
        case ConstraintKind::kVertexOrEdge:
          return c.is_move() || !here || c.begin > c.end || c.end < time;
        default:
          return true;
      }
    });
  }

  void leave(const AgentState& s, Time time) {
    const bool stays = !rules_.barred(s.pose.place, time);
    if (s.at_work >= 0) {
      if (stays) work_on(s, s.at_work, s.done + 1);
      return;
    }
    if (stays) {
      reach(s);
      for (int k = 0; k < stops(); ++k)
        if (stop(k).duration > 0 && stop(k).cell == s.pose.place && may_follow(s.counted, k))
          work_on(s, k, 1);
    }
    for (const Pose& pose : oracle::next_poses(instance_, agent_, steps_, s.pose)) {
      if (rules_.barred(pose.place, time)) continue;
      AgentState there = s;
      there.pose = pose;
      if (pose.place != s.pose.place) {
        if (rules_.move_barred(s.pose.place, pose.place, s.mouth, time)) continue;
        there.mouth = rules_.mouth_after(s.pose.place, pose.place, s.mouth);
        there.arrival = std::min(time, rules_.last_change() + 1);
      }
      reach(there);
    }
  }

  void work_on(AgentState s, int k, Time done) {
    s.at_work = k;
    s.done = done;
    if (done == stop(k).duration) {
      s.at_work = -1;
      s.done = 0;
      s.counted |= 1U << k;
      s.last = k;
    }
    reach(s);
  }

  void reach(const AgentState& s) {
    next_.insert(s);
    for (int k = 0; k < stops(); ++k) {
      if (stop(k).duration > 0 || stop(k).cell != s.pose.place || !may_follow(s.counted, k))
        continue;
      AgentState counting = s;
      counting.counted |= 1U << k;
      counting.last = k;
      next_.insert(counting);
    }
  }

  const Instance& instance_;
  const Agent& agent_;
  const bool rests_on_last_;
  const SequenceClass& work_;
  const std::vector<Constraint>& constraints_;
  const StepRules rules_;
  const std::vector<std::vector<Place>> steps_;
  std::set<AgentState> now_;
  std::set<AgentState> next_;
};

}  // namespace

std::optional<Time> world_reference_cost(const Instance& instance, AgentIndex agent,
                                         const SequenceClass& work,
                                         const std::vector<Constraint>& constraints) {
  Layers layers(instance, agent, work, constraints);
  for (Time t = 0;; ++t) {
    if (layers.finished(t)) return t;
    if (!layers.step(t + 1)) return std::nullopt;
  }
}

}  // namespace grove::detail::testing
