// SPDX-License-Identifier: MIT
// Global bounds of a run: incumbent and proven lower bound. There is one object per run.
#pragma once

#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <string_view>

#include "engine/live_nodes.h"
#include "engine/run_events.h"
#include "engine/shared_bounds.h"
#include "model/limits.h"
#include "search/global_bounds.h"

namespace grove::detail {

// Updates GlobalBounds from the live nodes and the trees. The proof is at the head of the .cpp.
// Thread-safe, except for resume_at(), which must be called before the search.
class CentralBounds : public SharedBounds {
 public:
  // All references must outlive this object. `trees_from`: lower bound on all trees of the run.
  CentralBounds(const Instance& instance, Omega omega, const Limits& limits, LiveNodes& nodes,
                RunEvents& run_events, Cost trees_from)
      : limits_(limits),
        nodes_(nodes),
        run_events_(run_events),
        global_bounds_(instance, omega),
        trees_from_(trees_from) {}

  bool over() const override {
    return global_bounds_.finished() || out_of_nodes_ || limits_.stop_requested();
  }
  Cost cutoff() const override { return global_bounds_.incumbent_cost().value_or(kInfiniteCost); }
  std::optional<Plan> plan_below(Cost cost) const override;
  Cost lower_bound() const override { return global_bounds_.lower_bound(); }
  void post(Plan plan, PlanSource source) override;
  void prove(Cost bound, ComponentId by) override;
  void nodes_changed() override;
  // Adds, by source, the number of better plans and the total cost reduction by them. Thread-safe.
  void add_counts(Counters& counters) const;

  // For queries about decisions of GlobalBounds.
  const GlobalBounds& global_bounds() const { return global_bounds_; }
  // True if the search over joint states proved infeasibility; the reason is then kNoJointPlan.
  bool has_no_joint_plan() const { return ended_outside_; }
  static constexpr std::string_view kNoJointPlan =
      "the search visited all joint states that the agents can reach";
  // Raises the lower bound to that of an earlier run, which this run resumes.
  void resume_at(Cost lower_bound);
  // Sets the lower bound on all trees not yet instantiated; kInfiniteCost: no such tree is left.
  // During the search, must be called after the roots of the instantiated trees were pushed.
  void expect_trees_from(Cost bound) { trees_from_ = bound; }
  Cost trees_from() const { return trees_from_; }
  // Ends the run although GlobalBounds::finished() is false, because no node is left and none will
  // be added.
  void end() { out_of_nodes_ = true; }

 private:
  void count(PlanSource source, Cost gain);

  const Limits& limits_;
  LiveNodes& nodes_;
  RunEvents& run_events_;
  GlobalBounds global_bounds_;
  std::atomic<Cost> trees_from_;
  std::atomic<bool> out_of_nodes_{false};
  std::atomic<bool> ended_outside_{false};

  struct Found {
    std::int64_t plans = 0;
    Cost gain = 0;
  };
  std::mutex posting_;  // serialises the events about plans
  mutable std::mutex counting_;
  std::array<Found, kPlanSources.size()> found_;  // guarded by counting_
};

}  // namespace grove::detail
