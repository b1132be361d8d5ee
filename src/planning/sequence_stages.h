// SPDX-License-Identifier: MIT
// What an agent must visit when the low level chooses the order itself, within a sequence class.
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
#include "sequencing/cost_to_go.h"
#include "sequencing/rtsp.h"
#include "sequencing/sequence_dag.h"

namespace grove::detail {

// One agent's stops, with all that does not depend on the class: shared by its SequenceStages.
// Copies share what does not change; a copy may go to another thread.
class AgentStops {
 public:
  static constexpr int kNoStop = -1;

  // `instance` and `distances` must outlive this. What is large shares the memory of the distances,
  // if that is shared.
  AgentStops(const Instance& instance, const DistanceFields& distances, AgentIndex agent);

  const Instance& instance() const { return *instance_; }
  AgentIndex agent() const { return agent_; }
  int count() const { return static_cast<int>(places_.size()); }
  State start() const { return start_; }
  Place start_place() const { return start_place_; }
  std::optional<Place> destination() const { return destination_; }
  Place place(int stop) const { return places_[stop]; }
  // The stop where an agent in this state is: on its place or, if it takes time, with the work just
  // completed. kNoStop: none. Less: it is at work, see stop_of_work().
  int stop_at(State state) const { return stop_at_[state]; }
  // For what is less than kNoStop: the stop at which an agent is at work; kNoStop: none of its own.
  static int stop_of_work(int at) { return at == kForeignWork ? kNoStop : kFirstWork - at; }
  // Does the stop take time?
  bool takes_time(int stop) const { return (work_stops_ >> stop & 1) != 0; }
  StopSet all() const { return all_stops(count()); }

  // It rests on the last stop of its sequence; else where to_rest() is 0, whatever the sequence.
  bool rests_on_last_stop() const { return !to_rest_; }
  // How long an agent may have still to turn and to work, at most, where it came to rest for good,
  // if it does not tarry.
  Time longest_finish(Place place) const;

  // How many ports each stop has (CostMatrix). Where there is but one, a port is its stop.
  int ports() const { return ports_; }
  // From a state to a port.
  Time to_port(State state, int port) const { return to_port_[port][state]; }
  // To a stop, by whatever port.
  Time distance(State state, int stop) const {
    Time least = to_port(state, stop * ports_);
    for (int port = 1; port < ports_; ++port)
      least = std::min(least, to_port(state, stop * ports_ + port));
    return least;
  }
  // From a state to where the agent may rest, unless it rests on its last stop.
  Time to_rest(State state) const { return to_rest_[state]; }
  // From a port of one stop to a port of another, at most, whatever the base state on the stop.
  Time longest_leg(int from, int to) const {
    return longest_legs_[static_cast<std::size_t>(from) * port_count() + to];
  }
  // How long it takes at most to turn from a state on a stop to where a port of it is left: in its
  // heading, or where there is but one port in any base state.
  Time turn(State state, int port) const;

  // Of all sequences.
  const CostToGo& cost_to_go() const { return completions_; }
  CostToGo& cost_to_go() { return completions_; }

 private:
  std::size_t port_count() const { return places_.size() * static_cast<std::size_t>(ports_); }
  std::shared_ptr<const std::int8_t[]> stops_of_states(const Instance& instance,
                                                       SharedArray shared) const;

  // What stands for work on stop s is kFirstWork - s.
  static constexpr int kFirstWork = -2;
  static constexpr int kForeignWork = -128;

  const Instance* instance_;
  const World* world_;
  AgentIndex agent_;
  int kind_;
  Time turn_steps_;
  State start_;
  Place start_place_;
  std::optional<Place> destination_;
  std::vector<Place> places_;
  std::vector<Time> durations_;  // by stop
  StopSet work_stops_ = 0;
  std::shared_ptr<const std::int8_t[]> stop_at_;  // by state; owns nothing where that is shared
  std::vector<DistanceView> to_port_;
  std::vector<Time> longest_legs_;  // by port, then port
  int ports_ = 1;
  DistanceView to_rest_;
  CostToGo completions_;
};

// The stages of one agent under one sequence class - how far it has come with its stops -, numbered
// as the search comes upon them. A
// path *realizes* a sequence if it is on its stops one after the other and, without a destination,
// rests on the last one. For one thread; several SequenceStages may share their AgentStops within
// it.
class SequenceStages {
 public:
  using StageId = std::int32_t;
  static constexpr StageId kOutside = -1;

  struct Stage {
    StopSet left = 0;          // not counted yet
    StopSet next = 0;          // those of them that may be counted next
    StopSet rests = 0;         // if it rests on its last stop: where it may come to rest
    bool may_skip = false;     // of the next: touching need not count
    std::int32_t first = 0;    // its onward ways, in onward()
    std::int32_t nearest = 0;  // so many of them settle the distance
    std::int32_t count = 0;
  };
  // A port of a stop that may come next, and the least cost from there through all that is then
  // left.
  struct Onward {
    std::int32_t port;
    Time cost;
  };

  // `stops` must outlive this. Throws std::invalid_argument for a prefix that repeats a stop or
  // names one that the agent does not have.
  SequenceStages(AgentStops& stops, SequenceClass work);
  // The same with other completions than those of `stops`, of this class and over as many stops.
  // They must outlive this.
  SequenceStages(AgentStops& stops, SequenceClass work, CostToGo& cost_to_go);

  AgentStops& stops() { return stops_; }
  const AgentStops& stops() const { return stops_; }
  const SequenceClass& sequence_class() const { return class_; }
  const CostToGo& cost_to_go() const { return *completions_; }
  CostToGo& cost_to_go() { return *completions_; }

  // False if the class is empty or something in it cannot be reached at all.
  bool plausible() const;

  // The first stage: nothing counted. Forgets all stages if the completions were widened since;
  // to be called before each search.
  // kOutside if the completions know no member of the class.
  StageId first_stage();
  const Stage& stage(StageId id) const { return stages_[id]; }
  int stage_count() const { return static_cast<int>(stages_.size()); }

  // The stage after counting `stop`, which must be one of the next. kOutside if the completions do
  // not know it.
  StageId after(StageId id, int stop) {
    GROVE_ASSERT(stages_[id].next >> stop & 1, "a stop that is counted may be next");
    const StageId known = after_[static_cast<std::size_t>(id) * stride_ + stop];
    return known == kUnknown ? make_after(id, stop) : known;
  }

  // Calls reach(stage) for each stage that an agent of stage `id` may be of once it has come to
  // `state`. False: there is another one, which the completions do not know.
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
    if (stages_[id].may_skip && !stops_.takes_time(at)) reach(id);
    const StageId then = after(id, at);
    if (then == kOutside) return false;
    reach(then);
    return true;
  }

  // The least cost from a state through all that is left, over the ways known; kNever or more when
  // there is none.
  Time distance(StageId id, State state) const {
    const Stage& s = stages_[id];
    if (s.left == 0) return to_rest(s, state);
    Time best = kNever;
    for (const Onward& o : std::span(&onward_[s.first], static_cast<std::size_t>(s.nearest)))
      best = std::min(best, stops_.to_port(state, o.port) + o.cost);
    return best;
  }
  // All ways known from a stage; the first Stage::nearest of them settle distance().
  std::span<const Onward> onward(const Stage& stage) const {
    return {onward_.data() + stage.first, static_cast<std::size_t>(stage.count)};
  }

  // May the agent come to rest here?
  bool is_rest(const Stage& stage, State state) const {
    if (stage.left != 0) return false;
    if (!stops_.rests_on_last_stop()) return stops_.to_rest(state) == 0;
    const int stop = stops_.stop_at(state);
    return stop >= 0 && (stage.rests >> stop & 1) != 0;
  }

 private:
  static constexpr StageId kUnknown = -2;

  // Work is begun only on what may be counted next.
  static bool may_work(const Stage& stage, int at) {
    const int stop = AgentStops::stop_of_work(at);
    return stop != AgentStops::kNoStop && (stage.next >> stop & 1) != 0;
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
  std::optional<CostToGo> own_;  // of the class, if that is not all sequences
  CostToGo* completions_;
  SequenceClass class_;
  StopSet free_;            // the stops that are not in the prefix
  StopSet first_free_;      // those of them that may be the first
  bool rest_is_not_first_;  // without a destination: see the .cpp
  std::size_t stride_;      // of after_
  Time built_beyond_ = -1;  // completions().beyond() when the states were made
  StageId first_stage_ = kOutside;
  std::vector<Stage> stages_;
  std::vector<StageId> after_;  // by state, then stop
  std::vector<Onward> onward_;
  std::vector<StopSetIndex> index_;  // states by what is left; [1 + s]: that may not rest on s
};

// The sequence of the class that a path realizes: each stop counted as early as may be, without a
// destination the one it rests on last. Throws std::invalid_argument if it realizes none.
Sequence realized_sequence(const SequenceStages& goals, const Path& path);

}  // namespace grove::detail
