// SPDX-License-Identifier: MIT
// Stops of one agent, and the stages of a sequence class. A stage is the progress of an agent in
// the low level that chooses the order of visits itself.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/assert.h"
#include "model/distance_field.h"
#include "model/instance.h"
#include "model/plan.h"
#include "planning/agent_prices.h"
#include "sequencing/cost_to_go.h"
#include "sequencing/rtsp.h"
#include "sequencing/stop_set_index.h"

namespace grove::detail {

// Distances of one agent to the ports of its stops (sequencing/cost_matrix.h). Port p is one of the
// ports of stop p / per_stop(). Immutable: any thread may read it.
class PortDistances {
 public:
  // `per_stop`: the number of ports of each stop. `distances` must outlive this object.
  PortDistances(const Instance& instance, const DistanceFields& distances, AgentIndex agent,
                int per_stop);

  int per_stop() const { return per_stop_; }
  int count() const { return static_cast<int>(to_port_.size()); }
  // Distance from a state to a port.
  Time to_port(State state, int port) const { return to_port_[port][state]; }
  // Distance from a state to a stop: the minimum over the ports of the stop.
  Time to_stop(State state, int stop) const {
    Time least = to_port(state, stop * per_stop_);
    for (int port = 1; port < per_stop_; ++port)
      least = std::min(least, to_port(state, stop * per_stop_ + port));
    return least;
  }
  // Upper bound on the distance from port `from` to port `to`. With one port per stop it is the
  // maximum over the base states on the first stop.
  Time longest_leg(int from, int to) const {
    return longest_legs_[static_cast<std::size_t>(from) * to_port_.size() + to];
  }

 private:
  int per_stop_;
  std::vector<DistanceView> to_port_;
  std::vector<Time> longest_legs_;  // by first port, then second port
};

// Stops of one agent, with all data that does not depend on the sequence class. All SequenceStages
// of the agent share it. Copies share the immutable data, and different threads may use different
// copies.
class AgentStops {
 public:
  static constexpr int kNoStop = -1;

  // `instance` and `distances` must outlive this object. If the distances are in shared memory, the
  // large arrays are there, too.
  AgentStops(const Instance& instance, const DistanceFields& distances, AgentIndex agent);
  // As above, for an agent that pays for its choices. The costs of all paths, to rest and to go are
  // then prices. There is one port per stop, also if turns take time; then distances and costs to
  // go are lower bounds.
  AgentStops(const Instance& instance, const DistanceFields& distances, AgentIndex agent,
             AgentPrices prices);

  const Instance& instance() const { return *instance_; }
  AgentIndex agent() const { return agent_; }
  int count() const { return static_cast<int>(places_.size()); }
  State start() const { return start_; }
  Place start_place() const { return world_->place(start_); }
  std::optional<Place> destination() const { return destination_; }
  Place place(int stop) const { return places_[stop]; }
  // The stop that the agent visits in this state: the state is on the place of the stop and, if the
  // stop takes time, it is the state in which the task execution ends. kNoStop: none. Less than
  // kNoStop: the agent is executing a task; see stop_of_work().
  int stop_at(State state) const { return stop_at_[state]; }
  // For a value of stop_at() less than kNoStop: the stop at which the agent is executing a task.
  // Returns kNoStop if the task is not one of its own stops.
  static int stop_of_work(int at) { return at == kForeignWork ? kNoStop : kFirstWork - at; }
  // Does the stop take time?
  bool takes_time(int stop) const { return (work_stops_ >> stop & 1) != 0; }
  StopSet all() const { return all_stops(count()); }

  // True if the agent rests on the last stop of its sequence. Otherwise it rests in a state with
  // to_rest() == 0, for every sequence.
  bool rests_on_last_stop() const { return !to_rest_; }
  // Upper bound on the steps from the last arrival of the agent on `place` to its finish there, if
  // it does not wait in between: all its turns and all its task executions there.
  Time longest_finish(Place place) const;

  // Number of ports of each stop (CostMatrix). If it is 1, port s is the port of stop s.
  int ports() const { return ports_.per_stop(); }
  // Distance from a state to a port, or to a stop.
  Time to_port(State state, int port) const { return ports_.to_port(state, port); }
  Time distance(State state, int stop) const { return ports_.to_stop(state, stop); }
  // Distance from a state to the nearest state in which the agent may rest. With prices: the least
  // sum of this distance and the price of the goal. Requires !rests_on_last_stop().
  Time to_rest(State state) const { return to_rest_[state]; }
  // The price of the goal on which the agent rests in this state, if it has not counted the stops
  // of `left`; 0 without prices. kNever: it may not rest there. Requires !rests_on_last_stop().
  Time price_of_rest(State state, StopSet left) const;
  // Can the agent come to rest by turning on the place of this state? Requires prices.
  bool may_turn_to_rest(State state) const;
  bool has_prices() const { return prices_ != nullptr; }
  // The price for leaving out all stops of `left`; kNever: it must visit one of them.
  Time price_without(StopSet left) const;
  // Stops that the agent may leave out at a price above 0.
  StopSet optional() const { return optional_; }
  // Upper bound on the distance from port `from` to port `to`; see PortDistances.
  Time longest_leg(int from, int to) const { return ports_.longest_leg(from, to); }
  // Upper bound on the turning time, in steps, from a state on a stop to the state in which the
  // agent leaves by `port` of this stop: the state with the heading of the port or, with one port
  // per stop, any base state.
  Time turn(State state, int port) const;

  // Costs to go, or prices to go, over all sequences, not only those of a class.
  const CostToGo& cost_to_go() const { return cost_to_go_; }
  CostToGo& cost_to_go() { return cost_to_go_; }

 private:
  AgentStops(const Instance& instance, const DistanceFields& distances, AgentIndex agent,
             CostToGo cost_to_go);
  std::shared_ptr<const std::int8_t[]> stops_of_states(const Instance& instance,
                                                       SharedArray shared) const;
  bool lacks_visit_to_rest(Place place, StopSet left) const;

  // Values in stop_at_: kFirstWork - s while the agent executes the task at stop s, kForeignWork
  // while it executes a task that is not one of its stops.
  static constexpr int kFirstWork = -2;
  static constexpr int kForeignWork = -128;

  const Instance* instance_;
  const World* world_;
  AgentIndex agent_;
  int kind_;
  Time turn_steps_;
  State start_;
  std::optional<Place> destination_;
  std::vector<Place> places_;
  std::vector<Time> durations_;  // by stop
  StopSet work_stops_ = 0;
  std::shared_ptr<const std::int8_t[]> stop_at_;  // by state; owns nothing if the array is shared
  DistanceView to_rest_;
  std::shared_ptr<const AgentPrices> prices_;            // nullptr: none
  std::shared_ptr<const DistanceField> prices_to_rest_;  // of to_rest_, with prices
  StopSet optional_ = 0;
  CostToGo cost_to_go_;
  PortDistances ports_;
};

// Stages of one agent under one sequence class, numbered in the order of their creation. A stage is
// the progress of the agent: the stops left to count and, if the agent rests on its last stop, the
// stops where it may rest. The agent *counts* a stop by one of its visits there, which is then the
// visit that the sequence refers to. A path *realizes* a sequence if it visits the stops in that
// order and ends at rest, on the last of them if rests_on_last_stop(). One thread at a time;
// several SequenceStages of the same thread may share their AgentStops.
class SequenceStages {
 public:
  using StageId = std::int32_t;
  static constexpr StageId kOutside = -1;

  struct Stage {
    StopSet left = 0;          // stops not counted yet
    Time price = kNever;       // for leaving out `left`; kNever: the agent must visit one of them
    StopSet next = 0;          // stops of `left` that may be counted next
    StopSet rests = 0;         // if the agent rests on its last stop: the stops where it may rest
    bool may_skip = false;     // a visit of a stop in `next` need not count it
    std::int32_t first = 0;    // index in onward_ of the first onward port of the stage
    std::int32_t nearest = 0;  // number of onward ports that determine distance(); they come first
    std::int32_t count = 0;    // number of onward ports
  };
  // A port of a stop that may be counted next, and the least cost from this port through all other
  // stops that are left to the end.
  struct Onward {
    std::int32_t port;
    Time cost;
  };

  // `stops` must outlive this object. Throws std::invalid_argument if the prefix repeats a stop or
  // contains a stop that the agent does not have.
  SequenceStages(AgentStops& stops, SequenceClass sequence_class);
  // As above, but with `cost_to_go` in place of the costs to go of `stops`. It must be valid for
  // this class and have the same number of stops and ports, and must outlive this object.
  SequenceStages(AgentStops& stops, SequenceClass sequence_class, CostToGo& cost_to_go);

  AgentStops& stops() { return stops_; }
  const AgentStops& stops() const { return stops_; }
  const SequenceClass& sequence_class() const { return class_; }
  const CostToGo& cost_to_go() const { return *cost_to_go_; }
  CostToGo& cost_to_go() { return *cost_to_go_; }

  // Returns false if the class is empty or if a stop or the place of rest is unreachable from the
  // start, even without constraints.
  bool plausible() const;

  // Returns the first stage, in which no stop is counted. Returns kOutside if the costs to go cover
  // no member of the class. Deletes all stages if outside_bound() of the costs to go has changed
  // since the last call. Call it before each search.
  StageId first_stage();
  const Stage& stage(StageId id) const { return stages_[id]; }
  int stage_count() const { return static_cast<int>(stages_.size()); }

  // The stage after the agent counts `stop`, which must be in Stage::next. Returns kOutside if the
  // costs to go do not cover that stage.
  StageId after(StageId id, int stop) {
    GROVE_ASSERT(stages_[id].next >> stop & 1, "a counted stop is a possible next stop");
    const StageId known = after_[static_cast<std::size_t>(id) * stride_ + stop];
    return known == kUnknown ? make_after(id, stop) : known;
  }

  // Calls reach(stage) for each stage in which an agent of stage `id` can be after it arrives in
  // `state`. Returns false if the costs to go do not cover one of these stages.
  template <class Reach>
  bool on_arrival(StageId id, State state, Reach reach) {
    const int at = stops_.stop_at(state);
    if (at < 0) {
      if (at == AgentStops::kNoStop || may_work(stages_[id], at)) reach(id);
      return true;
    }
    if (!(stages_[id].next >> at & 1)) {
      if (!stops_.takes_time(at)) reach(id);
      return true;
    }
    if ((stages_[id].may_skip || (stops_.optional() >> at & 1) != 0) && !stops_.takes_time(at))
      reach(id);
    const StageId then = after(id, at);
    if (then == kOutside) return false;
    reach(then);
    return true;
  }

  // Least cost from a state through all stops that are left to the place of rest, over the known
  // onward ports. With prices: through some of them, plus the price of the others and of the place.
  // Returns kNever or more if no route is known.
  Time distance(StageId id, State state) const {
    const Stage& s = stages_[id];
    Time best = kNever;
    if (s.price < kNever) {
      best = s.price + to_rest(s, state);
      if (s.left == 0) return best;
    }
    for (const Onward& o : std::span(onward_.data() + s.first, static_cast<std::size_t>(s.nearest)))
      best = std::min(best, stops_.to_port(state, o.port) + o.cost);
    return best;
  }
  // All known onward ports of a stage; the first Stage::nearest of these determine distance().
  std::span<const Onward> onward(const Stage& stage) const {
    return {onward_.data() + stage.first, static_cast<std::size_t>(stage.count)};
  }

  // May the agent come to rest in this state? Requires an agent without prices.
  bool is_rest(const Stage& stage, State state) const {
    if (stage.left != 0) return false;
    if (!stops_.rests_on_last_stop()) return stops_.to_rest(state) == 0;
    return is_last_stop(stage, state);
  }
  // What the agent pays if it comes to rest in this state; 0 without prices. kNever: it may not.
  Time price_of_rest(const Stage& stage, State state) const {
    if (stage.price >= kNever) return kNever;
    if (stops_.rests_on_last_stop()) return is_last_stop(stage, state) ? stage.price : kNever;
    return add_costs(stage.price, stops_.price_of_rest(state, stage.left));
  }

 private:
  static constexpr StageId kUnknown = -2;

  // An agent starts a task execution only on a stop that may be counted next.
  static bool may_work(const Stage& stage, int at) {
    const int stop = AgentStops::stop_of_work(at);
    return stop != AgentStops::kNoStop && (stage.next >> stop & 1) != 0;
  }
  bool is_last_stop(const Stage& stage, State state) const {
    const int stop = stops_.stop_at(state);
    return stop >= 0 && (stage.rests >> stop & 1) != 0;
  }
  Time to_rest(const Stage& stage, State state) const;
  StopSet next_of(StopSet left) const;
  StopSet rests_after(const Stage& stage, int stop) const;
  using PortCosts = std::array<Time, DistanceFields::kPorts>;
  PortCosts onward_costs(StopSet left, int stop) const;
  StageId make_after(StageId id, int stop);
  StageId make_stage(StopSet left, StopSet rests);
  void add_onward(Stage& stage);

  AgentStops& stops_;
  std::optional<CostToGo> own_;  // costs to go of the class; nullopt: another object's serve it
  CostToGo* cost_to_go_;
  SequenceClass class_;
  StopSet free_;            // stops that are not in the prefix
  StopSet first_free_;      // stops of free_ that may be the first of them
  bool rest_is_not_first_;  // may it not rest on the free stop counted first? See the .cpp.
  std::size_t stride_;      // row length of after_: number of stops
  Time built_outside_bound_ =
      -1;  // outside_bound() of the costs to go for which the stages are valid
  StageId first_stage_ = kOutside;
  std::vector<Stage> stages_;
  std::vector<StageId> after_;  // by stage, then stop
  std::vector<Onward> onward_;
  std::vector<StopSetIndex> index_;  // find a stage by its `left`; [0]: rest is allowed
                                     // everywhere, [1 + s]: no rest on stop s
};

// Returns the sequence of the class that a path realizes, where each stop is counted as early as
// possible. If the agent rests on its last stop, the stop on which the path rests is counted last.
// Throws std::invalid_argument if the path realizes no sequence of the class.
Sequence realized_sequence(const SequenceStages& goals, const Path& path);

}  // namespace grove::detail
