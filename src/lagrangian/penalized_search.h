// SPDX-License-Identifier: MIT
// Subproblem of the Lagrangian relaxation: least penalised cost of a path of one agent.
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

// In units of 1 / Penalties::kUnit step.
using ScaledCost = std::int64_t;
constexpr ScaledCost kNoCost = -1;  // no cost is known

// Finds a path of least penalised cost of one agent, over all orders of its stops. The penalised
// cost is the cost, plus the penalties of its steps and of its rest for ever, plus one on its
// finish time. One thread at a time; reuse it, because it holds the workspace.
class PenalizedSearch {
 public:
  static constexpr ScaledCost kMaxPenaltyCost = ScaledCost{1} << 30;

  // `penalties` must outlive this, and may change between searches.
  explicit PenalizedSearch(const Penalties& penalties);

  // Returns a proven lower bound on the penalised cost of every path, at most `below`. `on_finish`:
  // the penalty by finish time, 0 beyond its end. If the search ends within the label limit and
  // `limits`, and finds a path below the cutoff, the bound is exact and `*path` (unless `path` is
  // nullptr) becomes such a path; else it is unchanged. The cutoff is the least of `below`,
  // kMaxPenaltyCost, and outside_bound() of the costs to go.
  ScaledCost search(SequenceStages& goals, std::span<const Penalties::Amount> on_finish,
                    ScaledCost below, std::int64_t label_limit, const Limits& limits, Path* path);

  // Replaces `path`, whose penalised cost is `price`, by a path of least penalised cost among those
  // that go around `others` and finish by `latest`. `path` must do so too. Returns false, with
  // `path` unchanged, if the search ends at a limit or finds no path of lower penalised cost.
  bool improve(SequenceStages& goals, std::span<const Penalties::Amount> on_finish,
               const ReservationTable& others, Time latest, ScaledCost price,
               std::int64_t label_limit, const Limits& limits, Path& path);

  // Labels created so far.
  std::int64_t labels() const { return labels_created_; }

 private:
  using Amount = Penalties::Amount;
  using StageId = SequenceStages::StageId;
  static constexpr std::uint32_t kNone = UINT32_MAX;

  struct Label {
    State state;
    StageId stage;
    Amount paid;
    Time distance;  // to a place of rest, ignoring other agents
    std::uint32_t parent;
  };
  struct Mark {
    std::uint32_t label;
    Time time;
    Time distance;
    std::uint32_t stamp;
  };

  bool may_arrive(Place from, Place to) const {
    return others_ == nullptr || others_->may_arrive(from, to, time_);
  }
  void compute_end_bounds();
  void start();
  // Lower bound on the penalised cost still to come, `distance` steps from rest at `time`.
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
  std::vector<std::vector<Mark>> marks_;  // by stage, then state
  std::uint32_t stamp_ = 0;
  std::vector<Label> labels_;                                 // layer by layer in time
  std::vector<std::pair<Place, std::vector<Amount>>> rests_;  // penalty by first time of rest
  std::vector<Amount> end_bounds_;                            // see compute_end_bounds()
  std::int64_t labels_created_ = 0;

  // Data of the current call.
  SequenceStages* goals_ = nullptr;
  std::span<const Amount> on_finish_;
  Time time_ = 0;           // of the labels that are created
  Penalties::Layer layer_;  // penalties at that time
  ScaledCost below_ = 0;
  std::optional<Label> best_;
  const ReservationTable* others_ = nullptr;  // nullptr: no other agents
  Time latest_ = kNever;
};

// The least cost of a path of the agent; only a lower bound if a limit was reached. Widens the
// costs to go until they contain a sequence of that cost.
Time min_cost(SequenceStages& goals, const Limits& limits);

}  // namespace grove::detail
