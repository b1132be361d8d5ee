// SPDX-License-Identifier: MIT
// If the guide used only the traffic of the last plan, all agents would avoid the same places at
// once, and successive plans would oscillate. Therefore it uses a mean over plans: the first
// traffic_plans plans have equal weights, and each later plan has the weight 1 / traffic_plans.
//
// *Measured* on one core, scenario 1 of Moving AI maps: cost of LaCAM's first plan, best cost after
// ten rounds, and duration of these rounds. (Costs of lacam3 after 10 s on the first three
// instances: 124,057, 87,887, 203,246.)
//
//                                         first    guided    time
//   warehouse-10-20-10-2-1, 900 agents  206,729   114,663   2.6 s
//   random-64-64-20, 1,000              106,945    77,061   2.0 s
//   den312d, 900                        230,397   166,422   1.7 s
//   random-32-32-20, 400                 27,806    20,123   0.3 s
//   room-64-64-8, 600                   114,028    88,729   1.2 s
//
// *No better in measurements*: traffic of paths planned beforehand; the best of ten candidates for
// each joint step (as in lacam3).
#include "primal/traffic_guided_lacam.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"
#include "model/effort.h"

namespace grove::detail {

TrafficGuidedLacam::TrafficGuidedLacam(const Problem& problem, std::vector<Sequence> orders,
                                       double mean_cost, std::uint64_t seed, const Tuning& tuning)
    : problem_(problem),
      tuning_(tuning),
      orders_(std::move(orders)),
      dice_(seed),
      traffic_(problem.instance.world(), std::max(1.0, mean_cost), tuning),
      next_field_(fields_.end()) {
  const Instance& instance = problem.instance;
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    for (const TaskIndex task : instance.agent(agent).stops)
      fields_.try_emplace(problem.distances.to_task(task));
    if (!instance.rests_on_last_stop(agent)) fields_.try_emplace(problem.distances.to_rest(agent));
  }
}

void TrafficGuidedLacam::learn(const Plan& plan) {
  GROVE_CHECK(!lacam_ && next_field_ == fields_.end(), "a plan is learnt between rounds");
  ++learnt_;
  const double weight = 1.0 / static_cast<double>(std::min(learnt_, tuning_.traffic_plans));
  traffic_.fade(1 - weight);
  for (AgentIndex agent = 0; agent < problem_.instance.agent_count(); ++agent) {
    const Path path = walked_path(problem_.instance, agent, plan.agents[agent]);
    traffic_.add(path, weight);
    work_ += static_cast<std::int64_t>(path.size()) / effort::kMovedSteps;
  }
  traffic_.update_edge_costs();
  next_field_ = fields_.begin();
  lacam_.reset();
}

TrafficGuidedLacam::Outcome TrafficGuidedLacam::run(const Limits& limits, std::int64_t slice) {
  GROVE_CHECK(learnt_ > 0, "a round has the traffic of a plan");
  const std::int64_t end = work_ + slice;
  for (; next_field_ != fields_.end(); ++next_field_) {
    if (work_ >= end) return Outcome::kWorking;
    if (!make_field(limits)) return Outcome::kStopped;
  }
  return search(limits, std::max<std::int64_t>(end - work_, 1));
}

bool TrafficGuidedLacam::make_field(const Limits& limits) {
  auto& [distance, field] = *next_field_;
  const auto states = static_cast<std::size_t>(problem_.instance.world().state_count());
  const std::size_t bytes = states * sizeof(Time);
  if (limits.stop_requested() || (field.empty() && !limits.memory_allows(2 * bytes))) return false;
  field = traffic_.field(distance);
  work_ += static_cast<std::int64_t>(states) / effort::kFieldStates;
  return true;
}

TrafficGuidedLacam::Outcome TrafficGuidedLacam::search(const Limits& limits, std::int64_t slice) {
  const std::int64_t agents = problem_.instance.agent_count();
  if (!lacam_) {
    const LegFields fields = leg_fields();
    lacam_ = std::make_unique<Lacam>(problem_, orders_, dice_.next(), &fields);
    steps_left_ = tuning_.lacam_first_steps;
  }
  const std::int64_t allowed = std::clamp<std::int64_t>(slice / agents, 1, steps_left_);
  std::int64_t unused = allowed;
  const Lacam::Outcome outcome = lacam_->run(limits, unused);
  const std::int64_t made = allowed - unused;
  GROVE_CHECK(0 <= made && made <= allowed, "a search makes at most the steps of its slice");
  steps_left_ -= made;
  joint_steps_ += made;
  work_ += made * agents;
  if (outcome == Lacam::Outcome::kStopped) return Outcome::kStopped;
  if (outcome == Lacam::Outcome::kFound) {
    plan_ = *lacam_->plan();
    lacam_.reset();
    return Outcome::kFound;
  }
  if (outcome == Lacam::Outcome::kWorking && steps_left_ > 0) return Outcome::kWorking;
  lacam_.reset();
  return Outcome::kFailed;
}

LegFields TrafficGuidedLacam::leg_fields() const {
  const Instance& instance = problem_.instance;
  LegFields fields;
  fields.to_task.resize(static_cast<std::size_t>(instance.task_count()));
  fields.to_rest.resize(static_cast<std::size_t>(instance.agent_count()));
  for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
    for (const TaskIndex task : instance.agent(agent).stops)
      fields.to_task[task] = DistanceView(fields_.at(problem_.distances.to_task(task)));
    if (!instance.rests_on_last_stop(agent))
      fields.to_rest[agent] = DistanceView(fields_.at(problem_.distances.to_rest(agent)));
  }
  return fields;
}

}  // namespace grove::detail
