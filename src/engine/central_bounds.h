// SPDX-License-Identifier: MIT
// The one ledger of a run: what is proven and what is found.
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

// The gate, with the numbers that it decides by kept up to date. The argument is at the head of the
// .cpp.
class CentralBounds : public SharedBounds {
 public:
  // All must outlive this. `trees_from`: no tree of the run costs less.
  CentralBounds(const Instance& instance, Omega omega, const Limits& limits, LiveNodes& nodes,
                RunEvents& announcements, Cost trees_from)
      : limits_(limits),
        nodes_(nodes),
        announcements_(announcements),
        gate_(instance, omega),
        trees_from_(trees_from) {}

  bool over() const override {
    return gate_.finished() || out_of_nodes_ || limits_.stop_requested();
  }
  Cost cutoff() const override { return gate_.incumbent_cost().value_or(kInfiniteCost); }
  std::optional<Plan> plan_below(Cost cost) const override;
  Cost lower_bound() const override { return gate_.lower_bound(); }
  void post(Plan plan, PlanSource source) override;
  void prove(Cost bound, BoundSource by) override;
  void nodes_changed() override;
  // Where better plans came from, and what each source took off the cost. From any thread.
  void add_counts(Stats& stats) const;

  // For decisions that are the gate's.
  const GlobalBounds& gate() const { return gate_; }
  // Was it proven beside the trees that there is no plan? And why there is none, then.
  bool has_no_joint_plan() const { return ended_beside_; }
  static constexpr std::string_view kNoJointPlan =
      "everything was searched that the agents can come to together";
  // What an earlier run proved.
  void resume_at(Cost lower_bound);
  // No tree that is still to come costs less; kInfiniteCost: none is to come. To be said after the
  // roots of the others were pushed.
  void expect_trees_from(Cost bound) { trees_from_ = bound; }
  Cost trees_from() const { return trees_from_; }
  // No node is left and none will come, though the gate does not call the run finished.
  void end() { out_of_nodes_ = true; }

 private:
  void count(PlanSource source, Cost gain);

  const Limits& limits_;
  LiveNodes& nodes_;
  RunEvents& announcements_;
  GlobalBounds gate_;
  std::atomic<Cost> trees_from_;
  std::atomic<bool> out_of_nodes_{false};
  std::atomic<bool> ended_beside_{false};

  struct Found {
    std::int64_t plans = 0;
    Cost gain = 0;
  };
  std::mutex posting_;  // orders what is announced of plans
  mutable std::mutex counting_;
  std::array<Found, kPlanSources.size()> found_;  // under counting_
};

}  // namespace grove::detail
