// SPDX-License-Identifier: MIT
// *Formula.* The hard clauses are those of the agents' paths (path_clauses.cpp), and two kinds for
// conflicts that models had:
//
//   satisfies_a(c) or satisfies_b(d)               for each split (c, d) of a conflict
//   satisfies_a(RestBy) -> satisfies_b(bar)        for the bar that RestBy implies for other agents
//
// *Claim: for each valid plan there is an assignment that satisfies all hard clauses, in which
// within_a(e) is true exactly if agent a costs at most its least cost + e.* *Proof.* Take for each
// agent the assignment of its path (path_clauses.h), in which satisfies(c) is true exactly if the
// path satisfies c. A valid plan satisfies at least one constraint of each split (splits.h), and if
// an agent comes to rest on a place by time T, no other agent is there from T on.
//
// *Bound.* Let x_a be the excess of agent a in a valid plan: the number of e with within_a(e) false.
// The cost of the plan is the sum of the least costs plus the sum of all x_a. The algorithm (OLL)
// maintains a set of soft literals of weight 1, at first within_a(0) for all a, and the invariant
//
//   sum of x_a  >=  raised + number of false soft literals                                     (1)
//
// for every valid plan and its assignment. If the hard clauses contradict a set C of soft literals
// (a *core*), at least one of them is false. Let k >= 1 be a number such that at least k are false.
// Let f be the number of false literals of C, f >= k, and let L_j be literals with: "f >= j implies
// L_j" (totalizer.h); for the assignment, L_j is true exactly if f >= j. Then f = k + number of true
// L_j, k < j <= |C|. So C can be replaced by the soft literals not L_j, and `raised` by raised + k.
// It suffices to add not L_(k+1) at first and the next one when it is in a core, because with fewer
// soft literals (1) is weaker. In the same way, if within_a(e) is in a core, within_a(e + 1) becomes
// a soft literal; it is false only if within_a(e) is, and x_a counts both.
// The sum of the least costs plus `raised` is therefore a lower bound, after each core.
//
// *Groups.* Let S be a set of agents such that each core so far depends on agents of S only, or on
// none of them. The steps above then prove (1) for the sum over S, with the increases by the cores
// of S and the soft literals of S: S costs at least that much more than the sum of its least costs.
// In the other direction, x_a + x_b + ... >= k excludes all i + j + ... = k - 1 with x_a <= i and
// x_b <= j and ...; each such clause holds by itself, so that some of them may be left out.
//
// *Cutoff.* Agent a of a plan that costs less than the cutoff has an excess of at most E = cutoff -
// 1 - sum of least costs. If within_a(e) with e >= E is in a core, it becomes a hard clause instead,
// which holds for all plans below the cutoff; so does the bound from then on. (The cutoff only
// falls, so the clause stays valid.)
//
// *Plans.* A model of all soft literals whose paths have no conflict is a valid plan of cost
// lower_bound(), because each soft literal that is true contributes nothing to the sum. Each round
// that does not end so adds a clause that the model violates, to finitely many possible ones.
//
// *Order.* Cores of disjoint sets are found first: a relaxed core adds its soft literals only after
// the next model. A core is minimised by leaving out one literal at a time, and k is raised while
// the solver refutes "at most k".
#include "cores/core_search.h"

#include <algorithm>

#include "model/assert.h"
#include "model/effort.h"
#include "search/splits.h"

namespace grove::detail {
namespace {

constexpr int kConflictsPerStep = 300;
constexpr int kConflictsToMinimize = 200;
constexpr int kConflictsToExhaust = 300;
constexpr int kRetries = 4;
constexpr int kMaxExcessClauses = 100;  // of a statement of add()
constexpr std::size_t kMaxNodes = std::size_t{1} << 21;  // of one agent's graph

}  // namespace

CoreSearch::CoreSearch(const Problem& problem, const AgentStopsCache& stops, Techniques techniques,
                       std::size_t max_bytes, const Limits& limits)
    : problem_(problem),
      instance_(problem.instance),
      techniques_(techniques),
      max_bytes_(max_bytes),
      limits_(limits),
      stops_(stops),
      low_level_(problem.instance.world()),
      finder_(problem.instance.world(), problem.instance.may_follow()),
      first_paths_(problem.instance.world()),
      solver_(limits),
      paths_(static_cast<std::size_t>(problem.instance.agent_count())) {}

CoreSearch::~CoreSearch() = default;

CoreSearch::Outcome CoreSearch::step(Cost cutoff) {
  GROVE_CHECK(cutoff <= cutoff_, "the cutoff never rises");
  cutoff_ = cutoff;
  if (limits_.stop_requested()) return Outcome::kStopped;
  if (phase_ != Phase::kSetUp && lower_bound_ >= cutoff_) return Outcome::kSolved;
  if (bytes() > max_bytes_) return Outcome::kExhausted;
  switch (phase_) {
    case Phase::kSetUp:
      return set_up();
    case Phase::kSolve:
      return solve();
    case Phase::kMinimize:
      return minimize();
    case Phase::kExhaust:
      return exhaust();
  }
  GROVE_CHECK(false, "the search is in one of its phases");
}

// Plans one agent.
CoreSearch::Outcome CoreSearch::set_up() {
  const auto index = static_cast<AgentIndex>(agents_.size());
  AgentStops& stops = stops_.of(index);
  SequenceStages goals(stops, SequenceClass{});
  Path path;
  const std::int64_t labels = low_level_.expanded();
  const PathOutcome outcome = low_level_.find(goals, PathQuery{}, limits_, path);
  work_ += low_level_.expanded() - labels + effort::kUnitsPerCall;
  if (outcome != PathOutcome::kFound)
    return limits_.stop_requested() ? Outcome::kStopped : Outcome::kExhausted;
  Agent agent{.graph = std::make_unique<PathGraph>(stops, static_cast<Time>(path.size()) - 1)};
  const auto grown = agent.graph->grow(0, kMaxNodes, limits_);
  work_ += agent.graph->visited() / effort::kTimedNodes;
  if (grown != PathGraph::Outcome::kGrown)
    return limits_.stop_requested() ? Outcome::kStopped : Outcome::kExhausted;
  agent.walk = walk_with_fewest_conflicts(*agent.graph);
  least_sum_ += agent.graph->least_cost();
  paths_[index] = path_of(agent);
  first_paths_.add(paths_[index]);
  agents_.push_back(std::move(agent));
  if (std::ssize(agents_) == instance_.agent_count()) {
    lower_bound_ = least_sum_;
    phase_ = Phase::kSolve;
  }
  return Outcome::kWorking;
}

// Of the walks of least cost, one with the fewest conflicts with the first paths of the agents
// before. The graph has grown once, so its nodes are numbered in order of time.
std::vector<PathGraph::Node> CoreSearch::walk_with_fewest_conflicts(const PathGraph& graph) const {
  using Node = PathGraph::Node;
  constexpr Node kNone = -1;
  std::vector<int> conflicts(static_cast<std::size_t>(graph.count()));
  std::vector<Node> next(conflicts.size(), kNone);
  for (Node node = graph.count(); node-- > 0;) {
    if (graph.excess(node) > 0) continue;
    if (graph.is_final(node)) {
      conflicts[node] = first_paths_.conflicts_of_resting(graph.place(node), graph.arrival(node));
      continue;
    }
    for (const Node to : graph.successors(node)) {
      if (graph.excess(to) > 0) continue;
      const int then = conflicts[to] +
                       first_paths_.conflicts(graph.place(node), graph.place(to), graph.time(to));
      if (next[node] == kNone || then < conflicts[node]) {
        next[node] = to;
        conflicts[node] = then;
      }
    }
  }
  Node node = kNone;
  for (const Node start : graph.starts())
    if (graph.excess(start) == 0 && (node == kNone || conflicts[start] < conflicts[node]))
      node = start;
  std::vector<Node> walk;
  for (; node != kNone; node = next[node]) walk.push_back(node);
  return walk;
}

CoreSearch::Outcome CoreSearch::solve() {
  switch (solve(active_, kConflictsPerStep)) {
    case SatSolver::Result::kUnknown:
      return limits_.stop_requested() ? Outcome::kStopped : Outcome::kWorking;
    case SatSolver::Result::kSatisfiable:
      read_walks();
      if (add_conflicts() > 0) return Outcome::kWorking;
      if (!deferred_.empty()) {
        active_.insert(active_.end(), deferred_.begin(), deferred_.end());
        deferred_.clear();
        return Outcome::kWorking;
      }
      if (!std::ranges::all_of(agents_, &Agent::has_path)) return Outcome::kExhausted;
      plan_ = make_plan();
      return Outcome::kSolved;
    case SatSolver::Result::kUnsatisfiable:
      core_ = failed(active_);
      if (core_.empty()) {
        lower_bound_ = cutoff_;
        return Outcome::kSolved;
      }
      next_in_core_ = 0;
      retries_ = kRetries;
      phase_ = Phase::kMinimize;
      return Outcome::kWorking;
  }
  GROVE_CHECK(false, "the solver has one of three results");
}

SatSolver::Result CoreSearch::solve(std::span<const Soft> assumed, int max_conflicts) {
  std::vector<Literal> literals;
  for (const Soft& soft : assumed) literals.push_back(soft.literal);
  std::vector<std::uint8_t> is_needed(agents_.size(), 0);
  for (const AgentIndex agent : agents_of(assumed)) is_needed[agent] = 1;
  for (std::size_t agent = 0; agent < agents_.size(); ++agent)
    if (agents_[agent].clauses && is_needed[agent] == 0 && !agents_[agent].is_limited)
      literals.push_back(-agents_[agent].clauses->active());
  return solver_.solve(literals, max_conflicts);
}

// The agents on which soft literals depend.
std::vector<AgentIndex> CoreSearch::agents_of(std::span<const Soft> softs) const {
  std::vector<AgentIndex> agents;
  for (const Soft& soft : softs) {
    if (soft.agent >= 0)
      agents.push_back(soft.agent);
    else
      agents.insert(agents.end(), counts_[soft.totalizer].agents.begin(),
                    counts_[soft.totalizer].agents.end());
  }
  std::ranges::sort(agents);
  const auto rest = std::ranges::unique(agents);
  agents.erase(rest.begin(), rest.end());
  return agents;
}

std::vector<CoreSearch::Soft> CoreSearch::failed(std::span<const Soft> assumed) const {
  std::vector<Soft> core;
  for (const Soft& soft : assumed)
    if (solver_.failed(soft.literal)) core.push_back(soft);
  return core;
}

// Leaves out one literal of the core.
CoreSearch::Outcome CoreSearch::minimize() {
  if (next_in_core_ == core_.size() || core_.size() == 1) {
    violated_ = 1;
    phase_ = Phase::kExhaust;
    const auto in_core = [&](const Soft& soft) {
      return std::ranges::find(core_, soft.literal, &Soft::literal) != core_.end();
    };
    std::erase_if(active_, in_core);
    ++cores_;
    ++lower_bound_;
    if (core_.size() > 1) {
      std::vector<Literal> inputs;
      for (const Soft& soft : core_) inputs.push_back(-soft.literal);
      counts_.push_back({Totalizer(solver_, inputs), agents_of(core_)});
    }
    return Outcome::kWorking;
  }
  std::vector<Soft> rest = core_;
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(next_in_core_));
  switch (solve(rest, kConflictsToMinimize)) {
    case SatSolver::Result::kUnsatisfiable:
      core_ = failed(rest);
      retries_ = kRetries;
      next_in_core_ = std::min(next_in_core_, core_.size());
      if (core_.empty()) {
        lower_bound_ = cutoff_;
        return Outcome::kSolved;
      }
      return Outcome::kWorking;
    case SatSolver::Result::kSatisfiable:
      read_walks();
      if (retries_-- > 0 && add_conflicts() > 0) return Outcome::kWorking;
      break;
    case SatSolver::Result::kUnknown:
      if (limits_.stop_requested()) return Outcome::kStopped;
      break;
  }
  ++next_in_core_;
  retries_ = kRetries;
  return Outcome::kWorking;
}

// Tests whether more literals of the core are violated.
CoreSearch::Outcome CoreSearch::exhaust() {
  if (violated_ == core_.size()) return relax();
  const Soft at_most = count_soft(counts_.size() - 1, violated_);
  if (solve({&at_most, 1}, kConflictsToExhaust) != SatSolver::Result::kUnsatisfiable)
    return limits_.stop_requested() ? Outcome::kStopped : relax();
  solver_.add({-at_most.literal});
  ++violated_;
  ++lower_bound_;
  return Outcome::kWorking;
}

// "At most `count` inputs of the totalizer are true".
CoreSearch::Soft CoreSearch::count_soft(std::size_t index, std::size_t count) {
  return {.literal = -counts_[index].totalizer.at_least(count + 1),
          .totalizer = static_cast<std::int32_t>(index),
          .count = count};
}

// Replaces the core by further soft literals.
CoreSearch::Outcome CoreSearch::relax() {
  connect_core();
  if (violated_ < core_.size())
    deferred_.push_back(count_soft(counts_.size() - 1, violated_));
  for (const Soft& soft : core_) {
    if (soft.agent >= 0) {
      if (!raise(soft.agent, soft.excess + 1))
        return limits_.stop_requested() ? Outcome::kStopped : Outcome::kExhausted;
    } else if (soft.count + 1 < counts_[soft.totalizer].totalizer.input_count()) {
      deferred_.push_back(count_soft(soft.totalizer, soft.count + 1));
    }
  }
  core_.clear();
  phase_ = Phase::kSolve;
  return Outcome::kWorking;
}

// Joins the components of the agents of the core.
void CoreSearch::connect_core() {
  CoreComponent joined{{}, static_cast<Cost>(violated_)};
  for (const AgentIndex agent : agents_of(core_)) {
    const AgentIndex component = agents_[agent].component;
    if (component < 0) {
      joined.agents.push_back(agent);
      continue;
    }
    CoreComponent& old = components_[component];
    joined.raised += std::exchange(old.raised, 0);
    joined.agents.insert(joined.agents.end(), old.agents.begin(), old.agents.end());
    old.agents.clear();
  }
  std::ranges::sort(joined.agents);
  const auto number = static_cast<AgentIndex>(components_.size());
  for (const AgentIndex agent : joined.agents) agents_[agent].component = number;
  GROVE_CHECK(std::ranges::adjacent_find(joined.agents) == joined.agents.end(),
              "each agent is in one component");
  if (!depends_on_cutoff_ && joined.agents.size() > 1 && joined.agents.size() <= kMaxGroup)
    excesses_.push_back({joined.agents, joined.raised});
  components_.push_back(std::move(joined));
}

void CoreSearch::add(const GroupExcess& excess) {
  if (!is_set_up() || excess.excess >= kInfiniteCost) return;
  std::vector<Literal> clause;
  int clauses = 0;
  // Excludes the assignments in which the agents from `agent` on cost at most `rest` more together.
  const auto exclude = [&](auto& self, std::size_t agent, Time rest) -> void {
    PathClauses& clauses_of_agent = clauses_of(excess.agents[agent]);
    const bool is_last = agent + 1 == excess.agents.size();
    for (Time own = is_last ? rest : 0; own <= rest && clauses < kMaxExcessClauses; ++own) {
      clause.push_back(-clauses_of_agent.within(own));
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

// Lets the agent cost up to its least cost + `excess` at a price.
bool CoreSearch::raise(AgentIndex index, Time excess) {
  Agent& agent = agents_[index];
  if (cutoff_ < kInfiniteCost && excess > cutoff_ - 1 - least_sum_) {
    solver_.add({agent.clauses->within(excess - 1)});
    agent.is_limited = true;
    depends_on_cutoff_ = true;
    return true;
  }
  const std::int64_t visited = agent.graph->visited();
  const auto grown = agent.graph->grow(excess, kMaxNodes, limits_);
  work_ += (agent.graph->visited() - visited) / effort::kTimedNodes;
  if (grown != PathGraph::Outcome::kGrown) return false;
  agent.clauses->grow();
  deferred_.push_back(
      {.literal = agent.clauses->within(excess), .agent = index, .excess = excess});
  return true;
}

void CoreSearch::read_walks() {
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

// Adds clauses for all conflicts of the paths of the last model. Returns the number of conflicts.
std::int64_t CoreSearch::add_conflicts() {
  std::vector<AgentIndex> with_path;
  for (AgentIndex index = 0; index < instance_.agent_count(); ++index)
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
  return std::ssize(conflicts);
}

void CoreSearch::add_split(const Conflict& conflict, const Split& split) {
  std::vector<Literal> clause;
  for (const AgentConstraint& side : split) {
    const Literal literal = clauses_of(side.agent).satisfies(side.constraint);
    clause.push_back(literal);
    if (!constrains_all_agents(side.constraint)) continue;
    const AgentIndex other = side.agent == conflict.first ? conflict.second : conflict.first;
    solver_.add({-literal, clauses_of(other).satisfies(*constraint_on(other, side))});
  }
  solver_.add(clause);
}

// Makes the clauses of the agent when they are first needed.
PathClauses& CoreSearch::clauses_of(AgentIndex index) {
  Agent& agent = agents_[index];
  if (!agent.clauses) {
    agent.clauses = std::make_unique<PathClauses>(solver_, index, *agent.graph,
                                                  problem_.corridors, place_conflicts_);
    agent.clauses->grow();
    agent.clauses->prefer(agent.walk);
    active_.push_back({.literal = agent.clauses->within(0), .agent = index, .excess = 0});
  }
  return *agent.clauses;
}

Path CoreSearch::path_of(const Agent& agent) const {
  Path path;
  for (const PathGraph::Node node : agent.walk) path.push_back(agent.graph->state(node));
  return path;
}

Plan CoreSearch::make_plan() const {
  Plan plan;
  for (AgentIndex index = 0; index < instance_.agent_count(); ++index) {
    plan.agents.push_back(plan_of_path(instance_, index, paths_[index]));
    plan.cost += plan.agents.back().cost;
  }
  GROVE_CHECK(plan.cost <= lower_bound_, "a model of all soft literals costs the lower bound");
  return plan;
}

std::int64_t CoreSearch::work() const {
  return work_ + solver_.work();
}

std::size_t CoreSearch::bytes() const {
  std::size_t bytes = solver_.bytes();
  for (const Agent& agent : agents_) bytes += agent.graph->bytes();
  return bytes;
}

}  // namespace grove::detail
