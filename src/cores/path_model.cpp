// SPDX-License-Identifier: MIT
// *Formula.* The clauses are those of the agents' paths (path_clauses.cpp), those that keep agents
// from being on one place (place_conflicts.cpp), those of add() and limit(), and for conflicts that
// models had:
//
//   satisfies_a(c) or satisfies_b(d)               for each split (c, d) of a conflict
//   satisfies_a(RestBy) -> satisfies_b(bar)        for the bar that RestBy implies for other agents
//
// *Claim: for each valid plan within the limits of limit() there is an assignment that satisfies
// all clauses, in which within_a(e) is true exactly if agent a costs at most its least cost + e.*
// *Proof.* Take for each agent the assignment of its path (path_clauses.h), in which satisfies(c)
// is true exactly if the path satisfies c. A valid plan satisfies at least one constraint of each
// split (splits.h), and if an agent comes to rest on a place by time T, no other agent is there
// from T on. A statement that agents a, b, ... together cost at least k more than individually
// excludes, for all i + j + ... = k - 1, that a costs at most i more, b at most j more, and so on.
// Each of these clauses holds by itself, so some of them may be left out.
//
// *Prices.* Each task is counted as often as its need says, and a goal with a price that is used
// has an agent that comes to rest there. These conditions are clauses over counts_a(s), "not s" and
// satisfies(RestBy) with time kNever, and hold for the plans that Prices describes.
//
// *Agents that are not needed.* solve() assumes that the agents on which the assumptions do not
// depend are not active, so that the solver assigns their literals by propagation. *Claim: this
// does not change whether there is a model.* *Proof.* Change a model as follows for each such
// agent: within(e), all nodes and presences, and the literals that count its presences
// (place_conflicts, traversal_clauses) become false, satisfies(RestBy) false, the other
// satisfies(c) and counts(s) true, and the outputs of totalizers over its within(e) true, which no
// assumption denies. "The goal is used" becomes false, unless an assumption depends on it; then all
// agents that may end there are needed. A clause that requires within(e) or satisfies(RestBy) of
// the agent could be violated: the first are only those of limit(), whose agents are always needed,
// and a split has RestBy only together with NoRestBy of the same agent, which is true.
// (Certificates do not contain this argument. With a proof, a refutation that uses such an
// assumption is repeated without it.)
#include "cores/path_model.h"

#include <algorithm>

#include "cores/totalizer.h"
#include "model/assert.h"
#include "model/effort.h"
#include "search/splits.h"

namespace grove::detail {
namespace {

constexpr std::size_t kMaxNodes = std::size_t{1} << 21;  // of one agent's graph
constexpr int kMaxExcessClauses = 100;                   // of a statement of add()
constexpr int kNodesPerStep = 10'000;                    // of grow()

}  // namespace

PathModel::PathModel(const Problem& problem, const AgentStopsCache& stops, Techniques techniques,
                     const Limits& limits, ProofLog* proof, const Prices* prices)
    : problem_(problem),
      techniques_(techniques),
      limits_(limits),
      prices_(prices),
      need_clauses_(prices ? prices->needs.size() : 0),
      is_goal_returned_(prices ? prices->goals.size() : 0),
      stops_(stops),
      low_level_(problem.instance.world()),
      finder_(problem.instance.world(), problem.instance.may_follow()),
      first_paths_(problem.instance.world()),
      solver_(limits, proof),
      paths_(static_cast<std::size_t>(problem.instance.agent_count())),
      least_sum_(prices ? -prices->constant : 0) {
  if (prices_ == nullptr) return;
  for (const Prices::Need& need : prices_->needs)
    if (need.price > 0) solver_.log(FormulaKind::kTask, {need.task, need.price});
  for (const AgentPrices::Goal& goal : prices_->goals)
    solver_.log(FormulaKind::kGoal, {goal.place, goal.price});
}

PathModel::Outcome PathModel::plan_next_agent() {
  const auto index = static_cast<AgentIndex>(agents_.size());
  AgentStops& stops = stops_.of(index);
  std::optional<Time> least = least_cost(stops);
  if (!least) return limits_.stop_requested() ? Outcome::kStopped : Outcome::kTooLarge;
  Agent agent;
  for (; !agent.graph || !agent.graph->has_least_cost(); ++*least) {
    agent.graph = std::make_unique<PathGraph>(stops, *least);
    const Outcome grown = grow(*agent.graph, 0, kMaxNodes);
    if (grown != Outcome::kDone) return grown;
  }
  agent.walk = walk_with_fewest_conflicts(*agent.graph);
  least_sum_ += agent.graph->least_cost();
  paths_[index] = path_of(agent);
  first_paths_.add(paths_[index]);
  agents_.push_back(std::move(agent));
  return Outcome::kDone;
}

// The least cost of a path, or a lower bound on its price; nullopt: there is no path, or it is not
// known.
std::optional<Time> PathModel::least_cost(AgentStops& stops) {
  work_ += effort::kUnitsPerCall;
  SequenceStages goals(stops, SequenceClass{});
  if (!stops.has_prices()) {
    Path path;
    const std::int64_t labels = low_level_.expanded();
    const PathOutcome outcome = low_level_.find(goals, PathQuery{}, limits_, path);
    work_ += low_level_.expanded() - labels;
    if (outcome != PathOutcome::kFound) return std::nullopt;
    return static_cast<Time>(path.size()) - 1;
  }
  for (;;) {  // the distance is a lower bound if it is below the outside bound
    const auto first = goals.first_stage();
    const Time outside_bound = goals.cost_to_go().outside_bound();
    const Time price =
        first == SequenceStages::kOutside ? kNever : goals.distance(first, stops.start());
    if (price < outside_bound) return price;
    if (outside_bound >= kNever || !goals.cost_to_go().extend(outside_bound, limits_))
      return std::nullopt;
  }
}

// Of the walks of least cost, one with the fewest conflicts with the first paths of the agents
// before. The graph has grown once, so its nodes are numbered in order of time.
std::vector<PathGraph::Node> PathModel::walk_with_fewest_conflicts(const PathGraph& graph) const {
  constexpr PathGraph::Node kNone = -1;
  std::vector<int> conflicts(static_cast<std::size_t>(graph.count()));
  std::vector<PathGraph::Node> next(conflicts.size(), kNone);
  for (PathGraph::Node node = graph.count(); node-- > 0;) {
    if (graph.excess(node) > 0) continue;
    if (graph.is_final(node)) {
      conflicts[node] = first_paths_.conflicts_of_resting(graph.place(node), graph.arrival(node));
      continue;
    }
    for (const PathGraph::Node to : graph.successors(node)) {
      if (graph.excess(to) > 0) continue;
      const int then = conflicts[to] +
                       first_paths_.conflicts(graph.place(node), graph.place(to), graph.time(to));
      if (next[node] == kNone || then < conflicts[node]) {
        next[node] = to;
        conflicts[node] = then;
      }
    }
  }
  PathGraph::Node node = kNone;
  for (const PathGraph::Node start : graph.starts())
    if (graph.excess(start) == 0 && (node == kNone || conflicts[start] < conflicts[node]))
      node = start;
  std::vector<PathGraph::Node> walk;
  for (; node != kNone; node = next[node]) walk.push_back(node);
  return walk;
}

PathModel::Outcome PathModel::grow(PathGraph& graph, Time excess, std::size_t max_visits) {
  const std::int64_t visited = graph.visited();
  const auto grown = graph.grow(excess, max_visits, kMaxNodes, limits_);
  work_ += graph.visited() - visited;
  switch (grown) {
    case PathGraph::Outcome::kGrown:
      return Outcome::kDone;
    case PathGraph::Outcome::kGrowing:
      return Outcome::kWorking;
    case PathGraph::Outcome::kTooLarge:
      return Outcome::kTooLarge;
    case PathGraph::Outcome::kStopped:
      return Outcome::kStopped;
  }
  GROVE_CHECK(false, "growth has one of four outcomes");
}

PathModel::Outcome PathModel::grow(AgentIndex index) {
  Agent& agent = agents_[index];
  const Time excess = agent.clauses->levels();
  if (agent.graph->grown() < excess) {
    const Outcome outcome = grow(*agent.graph, excess, kNodesPerStep);
    return outcome == Outcome::kDone ? Outcome::kWorking : outcome;
  }
  return agent.clauses->grow(kNodesPerStep) ? Outcome::kDone : Outcome::kWorking;
}

void PathModel::limit(AgentIndex agent, Time excess) {
  solver_.add({within(agent, excess)});
  agents_[agent].is_limited = true;
}

void PathModel::add(const GroupExcess& excess) {
  std::vector<Literal> clause;
  int clauses = 0;
  // Excludes the assignments in which the agents from `agent` on cost at most `rest` more together.
  const auto exclude = [&](auto& self, std::size_t agent, Time rest) -> void {
    const bool is_last = agent + 1 == excess.agents.size();
    for (Time own = is_last ? rest : 0; own <= rest && clauses < kMaxExcessClauses; ++own) {
      clause.push_back(-within(excess.agents[agent], own));
      if (is_last) {
        solver_.add(clause);
        ++clauses;
      } else {
        self(self, agent + 1, rest - own);
      }
      clause.pop_back();
    }
  };
  exclude(exclude, 0, static_cast<Time>(excess.excess) - 1);
}

SatSolver::Result PathModel::solve(std::vector<Literal> assumptions,
                                   std::span<const AgentIndex> needed, int max_conflicts) {
  std::vector<std::uint8_t> is_needed(agents_.size(), 0);
  for (const AgentIndex agent : needed) is_needed[agent] = 1;
  const auto count = std::ssize(assumptions);
  for (std::size_t agent = 0; agent < agents_.size(); ++agent)
    if (agents_[agent].clauses && is_needed[agent] == 0 && !agents_[agent].is_limited)
      assumptions.push_back(-agents_[agent].clauses->active());
  const SatSolver::Result result = solver_.solve(assumptions, max_conflicts);
  if (result != SatSolver::Result::kUnsatisfiable || !solver_.has_proof()) return result;
  // The core must follow by unit propagation without these assumptions.
  const auto others = std::span(assumptions).subspan(static_cast<std::size_t>(count));
  if (std::ranges::none_of(others, [&](Literal literal) { return solver_.failed(literal); }))
    return result;
  return solver_.solve(std::span(assumptions).first(static_cast<std::size_t>(count)),
                       max_conflicts);
}

void PathModel::read_walks() {
  for (std::size_t index = 0; index < agents_.size(); ++index) {
    Agent& agent = agents_[index];
    if (!agent.clauses) continue;
    auto walk = agent.clauses->walk();
    agent.has_path = walk.has_value();
    if (!walk || *walk == agent.walk) continue;
    agent.walk = *std::move(walk);
    paths_[index] = path_of(agent);
  }
}

std::int64_t PathModel::add_conflicts() {
  read_walks();
  std::vector<AgentIndex> with_path;
  for (AgentIndex index = 0; index < std::ssize(agents_); ++index)
    if (agents_[index].has_path) with_path.push_back(index);
  std::vector<Conflict> conflicts;
  finder_.all(paths_, with_path, conflicts);
  for (const Path& path : paths_) work_ += std::ssize(path) / effort::kScannedSteps;
  std::vector<Split> splits;
  for (const Conflict& conflict : conflicts) {
    splits.clear();
    splits_of(conflict, paths_, problem_, techniques_, splits);
    for (const Split& split : splits) add_split(conflict, split);
  }
  path_conflicts_ += std::ssize(conflicts);
  return std::ssize(conflicts) + add_needs();
}

// The number of agents that count the task. An agent that may cost more than the clauses cover has
// no path; it counts if `without_path` is true.
int PathModel::visits_of(const Prices::Need& need, bool without_path) const {
  return static_cast<int>(std::ranges::count_if(need.visits, [&](const Prices::Visit& visit) {
    const Agent& agent = agents_[visit.agent];
    if (!agent.has_path) return without_path;
    return (agent.graph->stops_left(agent.walk.back()) & bit(visit.stop)) == 0;
  }));
}

// Adds clauses for tasks that the paths visit too seldom or too often. Returns their number.
std::int64_t PathModel::add_needs() {
  std::int64_t added = 0;
  for (std::size_t i = 0; i < need_clauses_.size(); ++i) {
    const Prices::Need& need = prices_->needs[i];
    NeedClauses& known = need_clauses_[i];
    const auto literals = [&](bool counts) {
      std::vector<Literal> result;
      for (const Prices::Visit& visit : need.visits)
        result.push_back(-clauses_of(visit.agent).counts(visit.stop, counts));
      return result;
    };
    if (!known.at_least && visits_of(need, true) < need.count) {
      known.at_least = true;
      ++added;
      add_at_most(literals(true), need.visits.size() - static_cast<std::size_t>(need.count));
    }
    if (!known.at_most && need.is_exact && visits_of(need, false) > need.count) {
      known.at_most = true;
      ++added;
      add_at_most(literals(false), static_cast<std::size_t>(need.count));
    }
  }
  return added;
}

void PathModel::add_at_most(std::vector<Literal> literals, std::size_t count) {
  const auto log = [&](std::int64_t sum) {
    solver_.log(FormulaKind::kAtMost, {sum, static_cast<std::int64_t>(count)});
  };
  if (count == 0) {
    log(solver_.log_sum(literals));
    for (const Literal literal : literals) solver_.add({-literal});
  } else if (count + 1 == literals.size()) {
    log(solver_.log_sum(literals));
    for (Literal& literal : literals) literal = -literal;
    solver_.add(literals);
  } else if (count < literals.size()) {
    Totalizer totalizer(solver_, literals);
    log(totalizer.number());
    solver_.add({-totalizer.at_least(count + 1)});
  }
}

bool PathModel::pays_for(AgentIndex agent, Place goal) const {
  const std::optional<AgentPrices>& prices = prices_->agents[agent];
  return prices &&
         std::ranges::find(prices->goals, goal, &AgentPrices::Goal::place) != prices->goals.end();
}

std::vector<PathModel::UnusedGoal> PathModel::take_unused_goals() {
  std::vector<UnusedGoal> unused;
  for (std::size_t i = 0; i < is_goal_returned_.size(); ++i) {
    const AgentPrices::Goal& goal = prices_->goals[i];
    std::vector<AgentIndex> payers;
    for (AgentIndex agent = 0; agent < std::ssize(agents_); ++agent)
      if (pays_for(agent, goal.place)) payers.push_back(agent);
    const auto ends_there = [&](AgentIndex agent) {
      return agents_[agent].graph->place(agents_[agent].walk.back()) == goal.place;
    };
    if (is_goal_returned_[i] || std::ranges::any_of(payers, ends_there)) continue;
    is_goal_returned_[i] = true;
    UnusedGoal found{goal.place, goal.price,
                     solver_.new_variable(FormulaKind::kUsed, {goal.place, 0}), payers};
    std::vector<Literal> clause{-found.is_used};
    for (const AgentIndex agent : payers)
      clause.push_back(
          clauses_of(agent).satisfies({goal.place, kNoCell, 0, kNever, ConstraintKind::kRestBy}));
    solver_.add(clause);
    unused.push_back(std::move(found));
  }
  return unused;
}

std::vector<CountedPath> PathModel::counted_paths() const {
  std::vector<CountedPath> paths;
  for (const Agent& agent : agents_) {
    CountedPath path{path_of(agent), {}};
    StopSet left = agent.graph->all_stops();
    for (const PathGraph::Node node : agent.walk) {
      const StopSet now = agent.graph->stops_left(node);
      for_each_stop(left & ~now,
                    [&](int stop) { path.counted.emplace_back(agent.graph->time(node), stop); });
      left = now;
    }
    paths.push_back(std::move(path));
  }
  return paths;
}

void PathModel::prefer_paths() {
  for (const Agent& agent : agents_)
    if (agent.clauses) agent.clauses->prefer(agent.walk);
}

void PathModel::add_split(const Conflict& conflict, const Split& split) {
  std::vector<Literal> clause;
  std::vector<std::int64_t> sides;
  for (const AgentConstraint& side : split) {
    const Literal literal = clauses_of(side.agent).satisfies(side.constraint);
    clause.push_back(literal);
    sides.push_back(literal);
    if (!constrains_all_agents(side.constraint)) continue;
    const AgentIndex other = side.agent == conflict.first ? conflict.second : conflict.first;
    solver_.add({-literal, clauses_of(other).satisfies(*constraint_on(other, side))});
  }
  solver_.log(FormulaKind::kSplit, sides);
  solver_.add(clause);
}

// Makes the clauses of the agent when they are first needed.
PathClauses& PathModel::clauses_of(AgentIndex index) {
  Agent& agent = agents_[index];
  if (!agent.clauses) {
    agent.clauses = std::make_unique<PathClauses>(solver_, index, *agent.graph, problem_.corridors,
                                                  place_conflicts_);
    agent.clauses->grow();
    agent.clauses->prefer(agent.walk);
    new_agents_.push_back(index);
  }
  return *agent.clauses;
}

bool PathModel::has_all_paths() const {
  return std::ranges::all_of(agents_, &Agent::has_path);
}

Path PathModel::path_of(const Agent& agent) const {
  Path path;
  for (const PathGraph::Node node : agent.walk) path.push_back(agent.graph->state(node));
  return path;
}

Plan PathModel::plan() const {
  GROVE_CHECK(is_complete() && has_all_paths(), "a plan has a path for each agent");
  Plan plan;
  for (AgentIndex index = 0; index < std::ssize(agents_); ++index) {
    plan.agents.push_back(plan_of_path(problem_.instance, index, paths_[index]));
    plan.cost += plan.agents.back().cost;
  }
  return plan;
}

std::size_t PathModel::bytes() const {
  std::size_t bytes = solver_.bytes();
  for (const Agent& agent : agents_) bytes += agent.graph->bytes();
  return bytes;
}

}  // namespace grove::detail
