// SPDX-License-Identifier: MIT
// *Search.* The search proceeds layer by layer in time, because with penalties a later arrival can
// lead to a cheaper path than an earlier one. A label has a time, a state, a stage
// (sequence_stages.h) and the cost paid so far. Of two labels that differ only in the cost paid,
// only the cheaper one is kept, because both have the same completions.
//
// *Pruning.* Since penalties are nonnegative, the remaining cost of a label is at least kUnit for
// each step of its distance, plus the minimum penalty of coming to rest at the resulting time or
// later, where each step of delay costs kUnit. A label is dropped if the cost paid plus this bound
// reaches the cutoff. The search terminates because the cost rises by at least kUnit per layer.
//
// *Bound.* A path whose sequence is not in the cost-to-go store costs at least outside_bound()
// steps, therefore the result never exceeds outside_bound(). If the search stops at a limit, the
// result is the minimum of the cutoff and of the bounds of all labels in the last complete layer,
// because every path that was not completed passes through that layer.
#include "lagrangian/penalized_search.h"

#include <algorithm>
#include <utility>

namespace grove::detail {
namespace {

constexpr std::size_t kLayersPerPoll = 16;

}  // namespace

PenalizedSearch::PenalizedSearch(const Penalties& penalties)
    : penalties_(penalties), world_(penalties.world()) {}

ScaledCost PenalizedSearch::search(SequenceStages& goals, std::span<const Amount> on_finish,
                                   ScaledCost below, std::int64_t label_limit, const Limits& limits,
                                   Path* path) {
  goals_ = &goals;
  on_finish_ = on_finish;
  below_ = std::min(
      {below, kMaxPenaltyCost, ScaledCost{goals.cost_to_go().outside_bound()} * Penalties::kUnit});
  best_.reset();
  labels_.clear();
  rests_.clear();
  if (++marks_.stamp == 0) {
    marks_.of.clear();
    marks_.stamp = 1;
  }
  compute_end_bounds();
  start();
  std::size_t layer = 0;
  std::size_t layers = 0;
  while (layer < labels_.size()) {
    const std::size_t end = labels_.size();
    if (std::ssize(labels_) > label_limit ||
        (++layers % kLayersPerPoll == 0 && limits.stop_requested())) {
      ScaledCost least = below_;
      for (; layer < end; ++layer) {
        const Label& label = labels_[layer];
        least = std::min(least, label.paid + to_pay(label.distance, time_));
      }
      labels_created_ += std::ssize(labels_);
      return least;
    }
    layer_ = penalties_.at(++time_);
    for (; layer < end; ++layer) expand(static_cast<std::uint32_t>(layer));
  }
  labels_created_ += std::ssize(labels_);
  if (best_ && path != nullptr) *path = path_to(*best_);
  return below_;
}

bool PenalizedSearch::improve(SequenceStages& goals, std::span<const Amount> on_finish,
                              const ReservationTable& others, Time latest, ScaledCost price,
                              std::int64_t label_limit, const Limits& limits, Path& path) {
  others_ = &others;
  latest_ = latest;
  Path cheaper;
  search(goals, on_finish, price, label_limit, limits, &cheaper);
  others_ = nullptr;
  latest_ = kNever;
  if (cheaper.empty()) return false;
  path = std::move(cheaper);
  return true;
}

// Computes end_bounds_: by time, the minimum penalty of coming to rest at that time or later, where
// each step of delay adds kUnit. If the agent may rest on several places, the penalties of resting
// on them are omitted.
void PenalizedSearch::compute_end_bounds() {
  const AgentStops& stops = goals_->stops();
  const auto finishes = static_cast<Time>(on_finish_.size());
  const Time last = std::max(finishes, penalties_.end());
  const bool has_one_rest = !stops.rests_on_last_stop() && stops.destination();
  end_bounds_.assign(static_cast<std::size_t>(last) + 1, 0);
  for (Time time = last - 1; time >= 0; --time) {
    Amount then = time < finishes ? on_finish_[time] : 0;
    if (has_one_rest) then += rest_from(*stops.destination(), time);
    end_bounds_[time] = std::min(then, end_bounds_[time + 1] + Penalties::kUnit);
  }
}

void PenalizedSearch::start() {
  time_ = 0;
  const StageId stage = goals_->first_stage();
  if (stage == SequenceStages::kOutside) return;
  const State state = goals_->stops().start();
  goals_->on_arrival(stage, state, [&](StageId then) { arrive(kNone, state, then, 0); });
}

void PenalizedSearch::expand(std::uint32_t at) {
  const Label label = labels_[at];  // a copy, because labels_ grows
  // Prunes the label if a cheaper path was found since it was created.
  if (label.paid + to_pay(label.distance, time_ - 1) >= below_) return;
  const Place place = world_.place(label.state);
  if (may_arrive(place, place))
    reach(at, label.state, label.stage,
          label.paid + Penalties::kUnit + layer_[penalties_.staying(place)]);
  const std::span<const State> moves = world_.moves(label.state);
  const std::span<const Penalties::Arc> arcs = penalties_.arcs(label.state);
  for (std::size_t move = 0; move < moves.size(); ++move) {
    if (!may_arrive(place, world_.place(moves[move]))) continue;
    const Amount paid = label.paid + Penalties::kUnit + layer_[arcs[move]];
    goals_->on_arrival(label.stage, moves[move],
                       [&](StageId then) { arrive(at, moves[move], then, paid); });
  }
}

// Creates a label for an arrival by a move. The agent may come to rest with it.
void PenalizedSearch::arrive(std::uint32_t from, State state, StageId stage, Amount paid) {
  if (reach(from, state, stage, paid) == 0) rest_at({state, stage, paid, 0, from});
}

// Creates or improves the label of a state and stage at time_. Returns the distance from there to a
// state of rest, or kNever if the label is dropped.
Time PenalizedSearch::reach(std::uint32_t from, State state, StageId stage, Amount paid) {
  if (static_cast<std::size_t>(stage) >= marks_.of.size())
    marks_.of.resize(static_cast<std::size_t>(stage) + 1);
  std::vector<Mark>& plane = marks_.of[stage];
  if (plane.empty()) plane.resize(static_cast<std::size_t>(world_.state_count()));
  Mark& mark = plane[state];
  if (mark.stamp != marks_.stamp) mark = {kNone, -1, goals_->distance(stage, state), marks_.stamp};
  if (mark.distance >= kNever || time_ > latest_ - mark.distance ||
      paid + to_pay(mark.distance, time_) >= below_)
    return kNever;
  if (mark.time != time_) {
    mark.time = time_;
    mark.label = static_cast<std::uint32_t>(labels_.size());
    labels_.push_back({state, stage, paid, mark.distance, from});
  } else if (paid < labels_[mark.label].paid) {
    labels_[mark.label].paid = paid;
    labels_[mark.label].parent = from;
  }
  return mark.distance;
}

// Stores the end of a complete path if the path is the cheapest so far.
void PenalizedSearch::rest_at(const Label& label) {
  if (!goals_->is_rest(goals_->stage(label.stage), label.state)) return;
  if (others_ != nullptr && !others_->may_rest_from(world_.place(label.state), time_)) return;
  ScaledCost price = label.paid;
  if (static_cast<std::size_t>(time_) < on_finish_.size()) price += on_finish_[time_];
  if (price >= below_) return;
  price += rest_from(world_.place(label.state), time_);
  if (price >= below_) return;
  below_ = price;
  best_ = label;
}

PenalizedSearch::Amount PenalizedSearch::rest_from(Place place, Time time) {
  const auto known =
      std::ranges::find(rests_, place, &std::pair<Place, std::vector<Amount>>::first);
  const std::vector<Amount>* rests = known == rests_.end() ? nullptr : &known->second;
  if (rests == nullptr) {
    std::vector<Amount> from(static_cast<std::size_t>(std::max(penalties_.end(), 1)));
    for (Time t = penalties_.end() - 1; t > 0; --t)
      from[t - 1] = std::min<Amount>(from[t] + penalties_.of(t, penalties_.staying(place)),
                                     static_cast<Amount>(kMaxPenaltyCost));
    rests_.emplace_back(place, std::move(from));
    rests = &rests_.back().second;
  }
  return static_cast<std::size_t>(time) < rests->size() ? (*rests)[time] : 0;
}

Path PenalizedSearch::path_to(const Label& label) const {
  Path path{label.state};
  for (std::uint32_t at = label.parent; at != kNone; at = labels_[at].parent)
    path.push_back(labels_[at].state);
  std::ranges::reverse(path);
  return path;
}

Time min_cost(SequenceStages& goals, const Limits& limits) {
  CostToGo& cost_to_go = goals.cost_to_go();
  for (;;) {
    const SequenceStages::StageId stage = goals.first_stage();
    const Time outside_bound = cost_to_go.outside_bound();
    if (stage != SequenceStages::kOutside) {
      const Time distance = goals.distance(stage, goals.stops().start());
      if (distance < outside_bound) return distance;
    }
    if (outside_bound >= kNever || !cost_to_go.extend(outside_bound, limits)) return outside_bound;
  }
}

}  // namespace grove::detail
