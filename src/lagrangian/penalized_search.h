// SPDX-License-Identifier: MIT
// Subproblem of the Lagrangian relaxation: the least penalised cost of a path of one agent.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "lagrangian/penalties.h"
#include "model/limits.h"
#include "planning/reservation_table.h"
#include "planning/sequence_stages.h"

namespace grove::detail {

// A cost in units of 1 / Penalties::kUnit step.
using ScaledCost = std::int64_t;
constexpr ScaledCost kNoCost = -1;  // no cost is known

// Finds a path of least penalised cost of one agent, over all orders of its stops. The penalised
// cost of a path is its cost, plus the penalties of its steps, of its steps at rest afterwards, and
// of its finish time. Holds the workspace of the search, so reuse it. One thread at a time.
class PenalizedSearch {
 public:
  static constexpr ScaledCost kMaxPenaltyCost = ScaledCost{1} << 30;

  // `penalties` must outlive this object, and may change between searches.
  explicit PenalizedSearch(const Penalties& penalties);

  // Returns min(the least penalised cost of a path, cutoff), where the cutoff is the minimum of
  // `below`, kMaxPenaltyCost and the cost of goals.cost_to_go().outside_bound() steps. If the
  // search stops at `label_limit` or `limits`, the result is only a lower bound on this value. If
  // the search completes with a path below the cutoff, `*path` is set to an optimal path (unless
  // `path` is nullptr); otherwise it is unchanged. `on_finish`: penalty by finish time; 0 for times
  // from its end on.
  ScaledCost search(SequenceStages& goals, std::span<const Penalties::Amount> on_finish,
                    ScaledCost below, std::int64_t label_limit, const Limits& limits, Path* path);

  // Replaces `path`, whose penalised cost is `price`, by a path of least penalised cost among the
  // paths that avoid the reservations `others` and finish at time `latest` or earlier.
  // Precondition: `path` is one of these paths. Returns false, with `path` unchanged, if the search
  // stops at a limit or finds no path of lower penalised cost.
  bool improve(SequenceStages& goals, std::span<const Penalties::Amount> on_finish,
               const ReservationTable& others, Time latest, ScaledCost price,
               std::int64_t label_limit, const Limits& limits, Path& path);

  // The number of labels created by all searches so far.
  std::int64_t labels() const { return labels_created_; }

 private:
  using Amount = Penalties::Amount;
  using StageId = SequenceStages::StageId;
  static constexpr std::uint32_t kNone = UINT32_MAX;

  struct Label {
    State state;
    StageId stage;
    Amount paid;
    Time distance;  // to a state of rest, without regard to other agents
    std::uint32_t parent;
  };
  struct Mark {
    std::uint32_t label;
    Time time;
    Time distance;
    std::uint32_t stamp;
  };

  // Only the marks with the current stamp belong to the current call.
  struct Marks {
    std::vector<std::vector<Mark>> of;  // by stage, then state
    std::uint32_t stamp = 0;
  };

  bool may_arrive(Place from, Place to) const {
    return others_ == nullptr || others_->may_arrive(from, to, time_);
  }
  void compute_end_bounds();
  void start();
  // Lower bound on the remaining penalised cost at `time`, at least `distance` steps before rest.
  ScaledCost to_pay(Time distance, Time time) const {
    const auto end = static_cast<std::size_t>(time) + static_cast<std::size_t>(distance);
    return ScaledCost{distance} * Penalties::kUnit +
           end_bounds_[std::min(end, end_bounds_.size() - 1)];
  }
  void expand(std::uint32_t label);
  void arrive(std::uint32_t from, State state, StageId stage, Amount paid);
  Time reach(std::uint32_t from, State state, StageId stage, Amount paid);
  void rest_at(const Label& label);
  Amount rest_from(Place place, Time time);
  Path path_to(const Label& label) const;

  const Penalties& penalties_;
  const World& world_;
  Marks marks_;
  std::vector<Label> labels_;                                 // in ascending order of time
  std::vector<std::pair<Place, std::vector<Amount>>> rests_;  // penalty of rest by arrival time
  std::vector<Amount> end_bounds_;                            // see compute_end_bounds()
  std::int64_t labels_created_ = 0;

  // Data of the current call.
  SequenceStages* goals_ = nullptr;
  std::span<const Amount> on_finish_;
  Time time_ = 0;           // time of the labels being created
  Penalties::Layer layer_;  // penalties for arrivals at time_
  ScaledCost below_ = 0;
  std::optional<Label> best_;
  const ReservationTable* others_ = nullptr;  // nullptr: no other agents
  Time latest_ = kNever;
};

// The least cost of a path of the agent, in steps, without penalties and other agents; only a lower
// bound if a limit was reached. Extends the agent's cost-to-go store until it contains a sequence
// of that cost.
Time min_cost(SequenceStages& goals, const Limits& limits);

}  // namespace grove::detail
