// SPDX-License-Identifier: MIT
// What an agent pays at least, penalties included: its price.
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

// In Penalties::kUnit.
using ScaledCost = std::int64_t;
constexpr ScaledCost kNoCost = -1;  // where none is known

// The cheapest path of one agent alone, all orders of its stops considered. Its price is its cost,
// the penalties of its steps and of its rest for ever, and one on the time at which it finishes.
// Holds the workspace of one thread: reuse it, do not share it.
class PenalizedSearch {
 public:
  static constexpr ScaledCost kMostPrice = ScaledCost{1} << 30;

  // `penalties` must outlive this, and may change between searches.
  explicit PenalizedSearch(const Penalties& penalties);

  // Proven: a path costs at least the price, which is at most `below`. `on_finish`: what finishing
  // at a time costs, 0 beyond its end. `path`, not null, becomes one of that price if it is less
  // than `below` and the search was not cut short; else it stays as it is.
  ScaledCost search(SequenceStages& goals, std::span<const Penalties::Amount> on_finish,
                    ScaledCost below, std::int64_t label_limit, const Limits& limits, Path* path);

  // Puts in the place of `path`, whose price is `price`, the cheapest one that goes around others,
  // as it does, and finishes by `latest`. False: none is cheaper, or it would take more labels.
  bool improve(SequenceStages& goals, std::span<const Penalties::Amount> on_finish,
               const ReservationTable& others, Time latest, ScaledCost price,
               std::int64_t label_limit, const Limits& limits, Path& path);

  // Labels met so far.
  std::int64_t labels() const { return labels_met_; }

 private:
  using Amount = Penalties::Amount;
  using StageId = SequenceStages::StageId;
  static constexpr std::uint32_t kNone = UINT32_MAX;

  struct Label {
    State state;
    StageId stage;
    Amount paid;
    Time distance;  // to where it may rest, alone
    std::uint32_t parent;
  };
  struct Mark {
    std::uint32_t label;
    Time time;
    Time distance;
    std::uint32_t stamp;
  };

  bool lets_arrive(Place from, Place to) const {
    return others_ == nullptr || others_->lets_arrive(from, to, time_);
  }
  void look_at_ends();
  void start();
  // From so far away, at a time.
  ScaledCost to_pay(Time distance, Time time) const {
    const auto end = static_cast<std::size_t>(time) + static_cast<std::size_t>(distance);
    return ScaledCost{distance} * Penalties::kUnit + ends_[std::min(end, ends_.size() - 1)];
  }
  void expand(std::uint32_t label);
  void arrive(std::uint32_t from, State state, StageId stage, Amount paid);
  Time reach(std::uint32_t from, State state, StageId stage, Amount paid);
  void come_to_rest(const Label& label);
  Amount rest_from(Place place, Time time);
  Path path_to(const Label& label) const;

  const Penalties& penalties_;
  const World& world_;
  std::vector<std::vector<Mark>> marks_;  // by stage, then state
  std::uint32_t stamp_ = 0;
  std::vector<Label> labels_;                                 // layer by layer
  std::vector<std::pair<Place, std::vector<Amount>>> rests_;  // what resting from a time on costs
  std::vector<Amount> ends_;                                  // see look_at_ends()
  std::int64_t labels_met_ = 0;

  // Of the call under way.
  SequenceStages* goals_ = nullptr;
  std::span<const Amount> on_finish_;
  Time time_ = 0;           // of the labels that are being made
  Penalties::Layer layer_;  // then
  ScaledCost below_ = 0;
  std::optional<Label> best_;
  const ReservationTable* others_ = nullptr;  // null: nobody else is there
  Time latest_ = kNever;
};

}  // namespace grove::detail
