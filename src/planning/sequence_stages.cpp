// SPDX-License-Identifier: MIT
// Stages of the sequence class "prefix, then a stop outside F, then any order".
//
// A stage is the set of stops left to count, because the order of the stops that are already
// counted does not affect the continuations. While the prefix lasts, only its next stop may be
// counted next. Immediately after the prefix, any stop outside F may be next; later, any stop.
//
// *Claim: every visit can count.* If an agent is on a stop that may be counted next, counting it
// excludes no continuation. *Proof.* A continuation that counts the stop later also realizes a
// sequence of the class if the stop is counted now instead. If it is then the first free stop, it
// is not in F, so it may be the first. *Consequence.* Each visit has one successor stage, except in
// the case below. (The claim does not imply that fewer stops left are always better: a stop of F
// that is visited immediately after the prefix is not counted, and must be visited again.)
//
// *Exception.* Without a destination, an agent whose stops take no time rests on the last stop of
// its sequence. So every path has one last stop, and the classes of a partition share no sequence.
// The agent is on that stop at the end of its path, and this visit can be the one that counts.
// Therefore a path that has counted all stops may rest on any free stop v, if moving v to the end
// of the counted order gives a sequence of the class. This fails only if v was the first free stop
// to be counted and F is not empty, because the new first free stop could be in F. So the agent may
// not rest on the stop w that was counted first, unless w is the only free stop or F is empty. The
// stage stores this in `rests`. Because counting w first removes a place of rest, a visit of a
// possible first stop need not count it: the search follows both alternatives. This is exact: for a
// realized sequence with first free stop w and last stop v != w, the search counts w at its visit,
// skips the possible first stops before it, and counts every other stop at its first visit after
// that. If only one stop can be the first, no continuation can skip it, and the search omits this
// alternative. The agent may rest on a stop of the prefix only if it is the last stop of a complete
// prefix.
//
// *Prices.* An agent may leave out a stop at a price above 0, even if it passes the stop, because
// the number of agents that count it can be limited. So a visit of such a stop, if it takes no
// time, has two successor stages. The claim holds for each set of counted stops.
//
// *Task executions.* A stop that takes time is counted when its execution is completed. An agent
// starts an execution only on a stop that may be counted next. The execution ends with this count,
// because nothing else can be counted during it: its states are those of its own stop, also if the
// place has a stop that takes no time. An execution that does not count would be equivalent to
// waiting. A task is not executed again at the end of the path. So if a stop takes time, an agent
// without a destination may rest on any of its own places, no matter which stop it counted last. As
// with a destination, the order then does not determine where the agent rests.
//
// *Distance.* The distance from a state is the least dist(state, u) + onward(u) over the stops u
// that may be next, where onward(u) is the least cost from u through the other stops left. Let D(u,
// w) be the greatest distance to w from any state on u. *Claim: if onward(u) >= D(u, w) +
// onward(w), then u is not needed if w is kept, for any state.* *Proof.* dist(state, w) <=
// dist(state, u) + D(u, w). *Consequence.* Usually only a few stops are needed. (No two stops rule
// out each other: on two places D is positive, and of two stops on one place at least one takes
// time, so that D to it is positive.) Onward costs are minima over the states in which the agent
// can leave a stop, so they never exceed the actual cost.
//
// *Ports.* If agents turn and the world is of moderate size, each stop has four ports
// (cost_matrix.h), and all of the above holds for ports instead of stops. With ports, onward costs
// are exact. An agent counts u in a heading, or within a turn after which it has a heading on u.
// (Agents that start within a turn have no ports.) So a path that counts u costs at least
// dist(state, port) + onward(port) from the state on, for the port with that heading. If a stop
// takes time, none of its ports rules out another one, because an agent that executes the task in
// one heading would have to start again in the other heading.
#include "planning/sequence_stages.h"

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

#include "model/assert.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/direct_legs.h"
#include "sequencing/optional_stops_dag.h"

namespace grove::detail {
namespace {

bool holds(StopSet set, int stop) {
  return (set & bit(stop)) != 0;
}

// Within a task execution, which has no breaks?
bool is_executing(const World& world, State state) {
  return world.is_working(state) && !world.work(state).completed;
}

// By state: the least sum of the distance to a goal and its price.
DistanceField prices_to_goals(const Instance& instance, AgentIndex agent,
                              std::span<const AgentPrices::Goal> goals) {
  const World& world = instance.world();
  std::vector<std::vector<State>> by_price(1);
  DistanceField prices(static_cast<std::size_t>(world.state_count()), kNever);
  for (const AgentPrices::Goal& goal : goals) {
    by_price.resize(std::max<std::size_t>(by_price.size(), goal.price + 1));
    world.for_each_state(goal.place, [&](State state) {
      if (!is_executing(world, state) && instance.may_rest(agent, state))
        by_price[goal.price].push_back(state);
    });
  }
  for (std::size_t price = 0; price < by_price.size(); ++price)
    for (std::size_t i = 0; i < by_price[price].size(); ++i) {
      const State state = by_price[price][i];
      if (prices[state] <= static_cast<Time>(price)) continue;
      prices[state] = static_cast<Time>(price);
      by_price.resize(std::max(by_price.size(), price + 2));
      for (const State before : world.moves_to(state)) by_price[price + 1].push_back(before);
    }
  return prices;
}

bool is_within_turn(const Instance& instance, State state) {
  return instance.pose_of(state).steps > 0;
}

// By state: the distance to a state that is not within a turn.
DistanceField distances_to_any_rest(const Instance& instance, AgentIndex agent) {
  const World& world = instance.world();
  std::vector<State> states;
  for (State state = 0; state < world.state_count(); ++state)
    if (world.kind(world.base(state)) == instance.agent(agent).kind &&
        !is_executing(world, state) && !is_within_turn(instance, state))
      states.push_back(state);
  return distance_field(world, states);
}

// Returns the set of the stops of a prefix.
StopSet checked_set(const Sequence& prefix, StopSet all) {
  StopSet set = 0;
  for (Stop stop : prefix) {
    if (stop >= kMaxTasksPerAgent || !holds(all & ~set, stop))
      throw std::invalid_argument("a prefix must hold stops of its agent, each at most once");
    set |= bit(stop);
  }
  return set;
}

}  // namespace

PortDistances::PortDistances(const Instance& instance, const DistanceFields& distances,
                             AgentIndex agent, int per_stop)
    : per_stop_(per_stop) {
  const World& world = instance.world();
  const Agent& who = instance.agent(agent);
  const std::size_t ports = who.stops.size() * static_cast<std::size_t>(per_stop);
  longest_legs_.resize(ports * ports);
  for (std::size_t port = 0; port < ports; ++port) {
    const TaskIndex stop = who.stops[port / static_cast<std::size_t>(per_stop)];
    const DistanceView field =
        per_stop == 1 ? distances.to_task(stop)
                      : distances.to_port(stop, who.kind, static_cast<int>(port) % per_stop);
    to_port_.push_back(field);
    for (std::size_t from = 0; from < ports; ++from) {
      const Place here = instance.task(who.stops[from / static_cast<std::size_t>(per_stop)]).cell;
      longest_legs_[from * ports + port] =
          per_stop == 1
              ? max_distance_from(world, here, who.kind, field)
              : field[world.bases(here, who.kind).first + static_cast<int>(from) % per_stop];
    }
  }
}

AgentStops::AgentStops(const Instance& instance, const DistanceFields& distances, AgentIndex agent)
    : AgentStops(
          instance, distances, agent,
          CostToGo(port_matrix(instance, agent, distances),
                   distances.array(ArrayKind::kSequenceTable, static_cast<std::size_t>(agent)),
                   [&instance, &distances, agent] {
                     return direct_legs(instance, agent, port_matrix(instance, agent, distances));
                   })) {}

AgentStops::AgentStops(const Instance& instance, const DistanceFields& distances, AgentIndex agent,
                       CostToGo cost_to_go)
    : instance_(&instance),
      world_(&instance.world()),
      agent_(agent),
      kind_(instance.agent(agent).kind),
      turn_steps_(instance.agent(agent).motion.turn_steps),
      start_(instance.agent(agent).start),
      destination_(instance.agent(agent).goal),
      cost_to_go_(std::move(cost_to_go)),
      ports_(instance, distances, agent, cost_to_go_.matrix().ports) {
  const Agent& who = instance.agent(agent);
  for (std::size_t stop = 0; stop < who.stops.size(); ++stop) {
    const Task& task = instance.task(who.stops[stop]);
    places_.push_back(task.cell);
    durations_.push_back(task.duration);
    if (task.duration > 0) work_stops_ |= bit(static_cast<int>(stop));
  }
  GROVE_CHECK(ports_.count() == count() * ports(), "each stop has its ports");
  stop_at_ = stops_of_states(
      instance, distances.array(ArrayKind::kStopsOfStates, static_cast<std::size_t>(agent)));
  if (!instance.rests_on_last_stop(agent)) to_rest_ = distances.to_rest(agent);
}

AgentStops::AgentStops(const Instance& instance, const DistanceFields& distances, AgentIndex agent,
                       AgentPrices prices)
    : AgentStops(instance, distances, agent,
                 CostToGo::with_prices(cost_matrix(instance, agent, distances), prices.skip, {})) {
  GROVE_CHECK(std::ssize(prices.skip) == count(), "each stop has a price");
  for (int stop = 0; stop < count(); ++stop)
    if (prices.skip[stop] > 0 && prices.skip[stop] < kNever) optional_ |= bit(stop);
  if (prices.rests_anywhere)
    prices_to_rest_ = std::make_shared<const DistanceField>(distances_to_any_rest(instance, agent));
  else if (!prices.goals.empty())
    prices_to_rest_ =
        std::make_shared<const DistanceField>(prices_to_goals(instance, agent, prices.goals));
  if (prices_to_rest_) to_rest_ = DistanceView(*prices_to_rest_);
  CostMatrix matrix = cost_to_go_.matrix();
  for (int stop = 0; stop < count() && to_rest_; ++stop)
    matrix.cost(stop, count()) = min_distance_from(*world_, places_[stop], kind_, to_rest_);
  cost_to_go_ = CostToGo::with_prices(std::move(matrix), prices.skip, prices.neighborhoods);
  prices_ = std::make_shared<const AgentPrices>(std::move(prices));
}

Time AgentStops::price_of_rest(State state, StopSet left) const {
  if (is_executing(*world_, state)) return kNever;
  const Place here = world_->place(state);
  if (!prices_ || prices_->goals.empty())
    return to_rest_[state] == 0 && !lacks_visit_to_rest(here, left) ? 0 : kNever;
  const auto goal = std::ranges::find(prices_->goals, here, &AgentPrices::Goal::place);
  const bool may_rest = goal != prices_->goals.end() && instance_->may_rest(agent_, state);
  return may_rest ? goal->price : kNever;
}

bool AgentStops::lacks_visit_to_rest(Place place, StopSet left) const {
  if (!prices_ || prices_->rest_requires == 0) return false;
  StopSet required = 0;
  for_each_stop(prices_->rest_requires, [&](int stop) {
    if (places_[stop] == place) required |= bit(stop);
  });
  return required != 0 && (required & ~left) == 0;
}

bool AgentStops::may_turn_to_rest(State state) const {
  if (kind_ == 0 || rests_on_last_stop()) return false;
  bool is_possible = false;
  world_->for_each_state(world_->place(state),
                         [&](State other) { is_possible |= price_of_rest(other, 0) < kNever; });
  return is_possible;
}

Time AgentStops::price_without(StopSet left) const {
  if (left == 0) return 0;
  return prices_ ? detail::price_without(prices_->skip, left) : kNever;
}

std::shared_ptr<const std::int8_t[]> AgentStops::stops_of_states(const Instance& instance,
                                                                 SharedArray shared) const {
  const auto states = static_cast<std::size_t>(instance.world().state_count());
  const auto fill = [&](std::int8_t* stop_at) {
    const World& world = instance.world();
    std::fill_n(stop_at, states, std::int8_t{kNoStop});
    for (State state = 0; state < world.state_count(); ++state)
      if (world.is_working(state)) stop_at[state] = kForeignWork;
    const std::vector<TaskIndex>& stops = instance.agent(agent_).stops;
    const auto fill_stop = [&](std::size_t stop) {
      world.for_each_state(instance.task(stops[stop]).cell, [&](State state) {
        if (instance.is_visited(stops[stop], state))
          stop_at[state] = static_cast<std::int8_t>(stop);
        else if (world.is_working(state) && world.work(state).task == stops[stop])
          stop_at[state] = static_cast<std::int8_t>(kFirstWork - static_cast<int>(stop));
      });
    };
    // The states of task executions belong to these tasks.
    for (const bool takes_time : {false, true})
      for (std::size_t stop = 0; stop < stops.size(); ++stop)
        if ((instance.task(stops[stop]).duration > 0) == takes_time) fill_stop(stop);
    return true;
  };
  const std::byte* const made = shared.get(
      Limits(), [&](std::byte* begin) { return fill(reinterpret_cast<std::int8_t*>(begin)); });
  if (made) return {std::shared_ptr<void>(), reinterpret_cast<const std::int8_t*>(made)};
  const std::shared_ptr<std::int8_t[]> own(new std::int8_t[states]);
  fill(own.get());
  return own;
}

// After its last arrival, when no constraint bars the place any more, an agent need not wait. It
// executes at most all of its tasks there, and turns for at most max_turn_time() in total.
Time AgentStops::longest_finish(Place place) const {
  Time longest = world_->max_turn_time(kind_);
  for (std::size_t stop = 0; stop < places_.size(); ++stop)
    if (places_[stop] == place) longest += durations_[stop];
  return longest;
}

Time AgentStops::turn(State state, int port) const {
  const State base = world_->base(state);
  const int heading = base - world_->bases(world_->place(base), kind_).first;
  if (ports() == 1 || heading >= ports()) return world_->max_turn_time(kind_);
  const int quarters = std::abs(heading - port % ports());
  return std::min(quarters, ports() - quarters) * turn_steps_;
}

SequenceStages::SequenceStages(AgentStops& stops, SequenceClass sequence_class)
    : stops_(stops),
      cost_to_go_(&stops.cost_to_go()),
      class_(std::move(sequence_class)),
      free_(stops.all() & ~checked_set(class_.prefix, stops.all())),
      first_free_(free_ & ~class_.forbidden_next),
      rest_is_not_first_(stops.rests_on_last_stop() && first_free_ != free_ &&
                         std::popcount(free_) > 1),
      stride_(static_cast<std::size_t>(stops.count())) {
  own_ = stops.cost_to_go().of_class(class_);
  if (own_) cost_to_go_ = &*own_;
}

SequenceStages::SequenceStages(AgentStops& stops, SequenceClass sequence_class,
                               CostToGo& cost_to_go)
    : SequenceStages(stops, std::move(sequence_class)) {
  own_.reset();
  cost_to_go_ = &cost_to_go;
}

bool SequenceStages::plausible() const {
  if (free_ != 0 && first_free_ == 0) return false;
  for (int stop = 0; stop < stops_.count(); ++stop)
    if (stops_.distance(stops_.start(), stop) >= kNever) return false;
  return stops_.rests_on_last_stop() || stops_.to_rest(stops_.start()) < kNever;
}

SequenceStages::StageId SequenceStages::first_stage() {
  if (built_outside_bound_ == cost_to_go_->outside_bound()) return first_stage_;
  built_outside_bound_ = cost_to_go_->outside_bound();
  stages_.clear();
  after_.clear();
  onward_.clear();
  index_.assign(rest_is_not_first_ ? stride_ + 1 : 1, {});
  const StopSet rests = free_ != 0 ? free_ : class_.prefix.empty() ? 0 : bit(class_.prefix.back());
  return first_stage_ = make_stage(stops_.all(), rests);
}

Time SequenceStages::to_rest(const Stage& stage, State state) const {
  if (!stops_.rests_on_last_stop()) return stops_.to_rest(state);
  Time best = kNever;
  for (StopSet rests = stage.rests; rests != 0; rests &= rests - 1)
    best = std::min(best, stops_.distance(state, std::countr_zero(rests)));
  return best;
}

// Returns the stops of `left` that may be counted next.
StopSet SequenceStages::next_of(StopSet left) const {
  for (Stop stop : class_.prefix)
    if (holds(left, stop)) return bit(stop);
  return left == free_ ? first_free_ : left;
}

StopSet SequenceStages::rests_after(const Stage& stage, int stop) const {
  const bool first = rest_is_not_first_ && stage.left == free_;
  return first ? stage.rests & ~bit(stop) : stage.rests;
}

// Returns the least cost from each port of `stop`, which is counted next, through the other stops
// of `left` to the end.
SequenceStages::PortCosts SequenceStages::onward_costs(StopSet left, int stop) const {
  const int ports = stops_.ports();
  const int first = stop * ports;
  left &= ~bit(stop);
  const CostToGo& cost_to_go = *cost_to_go_;
  PortCosts costs;
  costs.fill(kNever);
  if (left == 0 || (left != free_ && (left & ~free_) == 0)) {
    for (int port = 0; port < ports; ++port)
      costs[port] = cost_to_go.cost_to_go(left, first + port);
    return costs;
  }
  for (StopSet next = next_of(left); next != 0; next &= next - 1) {
    const int then = std::countr_zero(next);
    const PortCosts rest = onward_costs(left, then);
    for (int from = 0; from < ports; ++from)
      for (int to = 0; to < ports; ++to) {
        const Time leg = cost_to_go.matrix().between(first + from, then * ports + to);
        if (leg < kNever && rest[to] < kNever) costs[from] = std::min(costs[from], leg + rest[to]);
      }
  }
  return costs;
}

SequenceStages::StageId SequenceStages::make_after(StageId id, int stop) {
  const Stage from = stages_[id];
  const StageId to = make_stage(from.left & ~bit(stop), rests_after(from, stop));
  after_[static_cast<std::size_t>(id) * stride_ + static_cast<std::size_t>(stop)] = to;
  return to;
}

SequenceStages::StageId SequenceStages::make_stage(StopSet left, StopSet rests) {
  const StopSet barred = rest_is_not_first_ ? free_ & ~rests : 0;
  StopSetIndex& index = index_[barred == 0 ? 0 : 1 + std::countr_zero(barred)];
  if (const std::uint32_t known = index.find(left); known != StopSetIndex::kAbsent)
    return static_cast<StageId>(known);

  Stage stage{
      .left = left, .price = stops_.price_without(left), .next = next_of(left), .rests = rests};
  GROVE_ASSERT((left & ~free_) == 0 || (free_ & ~left) == 0,
               "stops are counted in the order of the prefix");
  stage.may_skip = rest_is_not_first_ && left == free_ && std::popcount(first_free_) > 1;
  add_onward(stage);
  if (stage.count == 0 && stage.price >= kNever) return kOutside;
  const auto id = static_cast<StageId>(stages_.size());
  index.insert(left, static_cast<std::uint32_t>(id));
  stages_.push_back(stage);
  after_.resize(after_.size() + stride_, kUnknown);
  return id;
}

void SequenceStages::add_onward(Stage& stage) {
  stage.first = static_cast<std::int32_t>(onward_.size());
  const int ports = stops_.ports();
  for (StopSet next = stage.next; next != 0; next &= next - 1) {
    const int stop = std::countr_zero(next);
    const PortCosts costs = onward_costs(stage.left, stop);
    for (int port = 0; port < ports; ++port)
      if (costs[port] < kNever) onward_.push_back({stop * ports + port, costs[port]});
  }
  stage.count = static_cast<std::int32_t>(onward_.size()) - stage.first;
  const auto ways = onward_.begin() + stage.first;
  const auto needed = [&](const Onward& u) {
    return std::none_of(ways, onward_.end(), [&](const Onward& w) {
      if (w.port / ports == u.port / ports &&
          (w.port == u.port || stops_.takes_time(u.port / ports)))
        return false;
      return u.cost >= stops_.longest_leg(u.port, w.port) + w.cost;
    });
  };
  std::vector<Onward> sorted;
  std::copy_if(ways, onward_.end(), std::back_inserter(sorted), needed);
  stage.nearest = static_cast<std::int32_t>(sorted.size());
  std::remove_copy_if(ways, onward_.end(), std::back_inserter(sorted), needed);
  std::ranges::copy(sorted, ways);
  GROVE_ASSERT(stage.nearest > 0 || stage.count == 0, "some onward port determines the distance");
}

Sequence realized_sequence(const SequenceStages& goals, const Path& path) {
  const AgentStops& stops = goals.stops();
  const SequenceClass& sequence_class = goals.sequence_class();
  const auto next_in_class = [&](const Sequence& so_far, int stop) {
    if (std::ranges::count(so_far, stop) > 0) return false;
    if (so_far.size() < sequence_class.prefix.size())
      return sequence_class.prefix[so_far.size()] == stop;
    return so_far.size() > sequence_class.prefix.size() ||
           !holds(sequence_class.forbidden_next, stop);
  };
  const auto stop_count = static_cast<std::size_t>(stops.count());
  const int last = !stops.rests_on_last_stop() || path.empty() ? AgentStops::kNoStop
                                                               : stops.stop_at(path.back());
  Sequence sequence;
  for (const State state : path) {
    const int stop = stops.stop_at(state);
    if (stop < 0 || !next_in_class(sequence, stop)) continue;
    if (stop != last || sequence.size() + 1 == stop_count)
      sequence.push_back(static_cast<Stop>(stop));
  }
  const bool rests = stops.rests_on_last_stop() ? !sequence.empty() && sequence.back() == last
                                                : !path.empty() && stops.to_rest(path.back()) == 0;
  if (sequence.size() != stop_count || !rests)
    throw std::invalid_argument("the path realizes no sequence of the class");
  return sequence;
}

}  // namespace grove::detail
