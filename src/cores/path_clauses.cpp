// SPDX-License-Identifier: MIT
// *Literals.* One for each node of the graph, "the walk contains the node"; for each presence of
// the agent; for each limit on its cost; and for each constraint. A presence that belongs to only
// one node has the literal of this node, which halves the number of variables of agents with tasks.
// When a second node is found, the presence gets a variable. Its clauses with the first literal
// remain; they hold, because the node implies the presence, and presences occur only negated. All
// clauses are implications:
//
//   node and within(e)         -> one of its successors with excess <= e   (e >= its excess)
//   node                       -> one of its successors, once the graph has all of them
//   within(e)                  -> one of the starts with excess <= e
//   within(e)                  -> within(e + 1)
//   node                       -> its presence
//   satisfies(c) and presence  -> false, if the presence violates c
//   satisfies(c) and two presences of a move -> false, if c bars the move
//   counts(s) and final node   -> false, if the walk has not counted s; "not s" in the same way
//
// (traversal_clauses.cpp has those of traversals.)
//
// *Claim: the contract of the class holds.* *Proof.* Let p be a path that costs least_cost + e
// or less, for the least such e. By the claim in path_graph.cpp there is a walk with the same
// places, the same last arrival and a cost that is not greater; it satisfies the same constraints,
// which depend on nothing else (constraint.h). Make true: its nodes and their presences, within(e')
// for e' >= e, and satisfies(c) for the constraints that p satisfies. The nodes of a walk with
// excess <= e have excess <= e, so each of them has a successor as required, or is final. The other
// clauses are obvious. If the cost of p is beyond the levels, all within(e) that occur in node
// clauses are false, and no node is needed, only the presences of p that have literals.
//
// A model of the clauses may contain more than one walk. walk() returns one of them; it satisfies
// the constraints whose literals are true, because no presence of the model violates one of them.
#include "cores/path_clauses.h"

#include <algorithm>
#include <utility>

#include "model/assert.h"

namespace grove::detail {

PathClauses::PathClauses(SatSolver& solver, AgentIndex agent, const PathGraph& graph,
                         const Corridors& corridors, PlaceConflicts& conflicts)
    : solver_(solver),
      agent_(agent),
      graph_(graph),
      corridors_(corridors),
      conflicts_(conflicts),
      is_node_presence_(graph.has_one_node_per_presence()),
      active_(solver.new_variable(FormulaKind::kActive, {agent})) {}

void PathClauses::grow() {
  const bool is_complete = grow(graph_.count());
  GROVE_CHECK(is_complete, "all nodes have their clauses");
}

bool PathClauses::grow(PathGraph::Node max_nodes) {
  if (next_ == 0) start_level();
  const PathGraph::Node end = std::min(graph_.count(), next_ + max_nodes);
  for (; next_ < end; ++next_)
    if (graph_.excess(next_) <= levels_) add_walk_clauses(next_);
  if (next_ < graph_.count()) return false;
  ++levels_;
  next_ = 0;
  return true;
}

void PathClauses::start_level() {
  solver_.log(FormulaKind::kAgent, {agent_, levels_});
  nodes_.resize(graph_.count(), 0);
  has_all_successors_.resize(graph_.count(), 0);
  std::vector<Literal> clause{-within(levels_)};
  for (const PathGraph::Node node : graph_.starts())
    if (graph_.excess(node) <= levels_) clause.push_back(literal_of(node));
  solver_.add(clause);
}

// A final node needs no successor. Once a node has all its successors, one clause covers all
// levels.
void PathClauses::add_walk_clauses(PathGraph::Node node) {
  if (graph_.is_final(node) || has_all_successors_[node] != 0) return;
  const Time level = levels_;
  std::vector<Literal> clause{-literal_of(node)};
  for (const PathGraph::Node next : graph_.successors(node))
    if (graph_.excess(next) <= level) clause.push_back(literal_of(next));
  GROVE_ASSERT(clause.size() > 1, "a node within the level has a successor within the level");
  if (graph_.has_all_successors(node))
    has_all_successors_[node] = 1;
  else
    clause.push_back(-within(level));
  solver_.add(clause);
}

Literal PathClauses::within(Time excess) {
  while (std::ssize(within_) <= excess) {
    within_.push_back(solver_.new_variable(FormulaKind::kWithin, {agent_, std::ssize(within_)}));
    if (within_.size() > 1) solver_.add({-within_[within_.size() - 2], within_.back()});
  }
  return within_[excess];
}

Literal PathClauses::literal_of(PathGraph::Node node) {
  Literal& known = nodes_[node];
  if (known != 0) return known;
  const Time arrival = graph_.arrival(node);
  const Presence presence{graph_.place(node), graph_.time(node), arrival != PathGraph::kOnTheWay};
  known = is_node_presence_ ? new_presence_variable(presence) : new_node_variable(node);
  solver_.add({-known, active_});
  if (graph_.is_final(node))
    for (const CountLiteral& by : counts_) restrict_end(by, node);
  if (!presence.is_last || arrival == presence.time) add_to_presence(known, presence);
  return known;
}

Literal PathClauses::new_node_variable(PathGraph::Node node) {
  const PathGraph::Position at = graph_.position(node);
  const bool is_priced_end = graph_.has_prices() && graph_.is_final(node);
  return solver_.new_variable(
      FormulaKind::kNode,
      {agent_, graph_.time(node), graph_.place(node), at.pose,
       static_cast<std::int64_t>(at.stops_done), at.stop < 0 ? at.stop : graph_.task_of(at.stop),
       at.steps_done, graph_.arrival(node), is_priced_end ? 1 : 0});
}

Literal PathClauses::new_presence_variable(const Presence& presence) {
  return solver_.new_variable(presence.is_last ? FormulaKind::kLast : FormulaKind::kVisit,
                              {agent_, presence.place, presence.time});
}

void PathClauses::add_to_presence(Literal node, const Presence& presence) {
  Literal literal = presences_.find(presence);
  if (literal == 0) {
    of_one_node_.insert(node);
    set_presence(presence, node);
    return;
  }
  if (of_one_node_.erase(literal) > 0) {
    const Literal first = std::exchange(literal, new_presence_variable(presence));
    solver_.add({-first, literal});
    set_presence(presence, literal);
  }
  solver_.add({-node, literal});
}

void PathClauses::set_presence(const Presence& presence, Literal literal) {
  presences_.set(presence, literal);
  conflicts_.add(agent_, presence, literal);
  for (TraversalClauses& traversals : traversals_) traversals.add(presence, literal, presences_);
  if (const auto on = constraints_on_.find(presence.place); on != constraints_on_.end())
    for (const std::size_t index : on->second) restrict_presence(constraints_[index], presence);
  if (presence.is_last)
    for (const std::size_t index : rest_bys_) restrict_presence(constraints_[index], presence);
}

Literal PathClauses::satisfies(const Constraint& constraint) {
  GROVE_CHECK(!is_about_sequence(constraint), "a path decides the constraint");
  const std::size_t index = constraints_.size();
  Constraints& on = constraints_on_[constraint.cell];
  for (const std::size_t known : on)
    if (constraints_[known].constraint == constraint) return constraints_[known].literal;
  const Literal literal = solver_.new_variable(
      FormulaKind::kMeets, {agent_, constraint.cell, constraint.from, constraint.begin,
                            constraint.end, static_cast<std::int64_t>(constraint.kind)});
  constraints_.push_back({constraint, literal});
  on.push_back(index);
  if (constraint.kind == ConstraintKind::kNoTraversal) {
    traversals(constraint).forbid(constraint.begin, constraint.end, literal);
    return literal;
  }
  if (constraint.is_move()) constraints_on_[constraint.from].push_back(index);
  if (constraint.kind == ConstraintKind::kRestBy) rest_bys_.push_back(index);
  for (const auto& [presence, of_presence] : presences_.all())
    restrict_presence(constraints_.back(), presence);
  return literal;
}

Literal PathClauses::counts(int stop, bool counts) {
  for (const CountLiteral& known : counts_)
    if (known.stop == stop && known.counts == counts) return known.literal;
  const Literal literal = solver_.new_variable(counts ? FormulaKind::kCounts : FormulaKind::kSkips,
                                               {agent_, graph_.task_of(stop)});
  counts_.push_back({stop, counts, literal});
  for (PathGraph::Node node = 0; node < std::ssize(nodes_); ++node)
    if (nodes_[node] != 0 && graph_.is_final(node)) restrict_end(counts_.back(), node);
  return literal;
}

void PathClauses::restrict_end(const CountLiteral& by, PathGraph::Node node) {
  const bool is_counted = (graph_.stops_left(node) & bit(by.stop)) == 0;
  if (is_counted != by.counts) solver_.add({-by.literal, -nodes_[node]});
}

void PathClauses::restrict_presence(const ConstraintLiteral& by, const Presence& presence) {
  if (by.constraint.is_move()) return restrict_move(by, presence);
  if (violates(by.constraint, presence.place, presence.time, presence.is_last))
    solver_.add({-by.literal, -presences_.find(presence)});
}

void PathClauses::restrict_move(const ConstraintLiteral& by, const Presence& presence) {
  const Constraint& c = by.constraint;
  const auto [place, time, is_last] = presence;
  const Literal literal = presences_.find(presence);
  const auto is_barred = [&](Time arrival) { return c.begin <= arrival && arrival <= c.end; };
  if (place == c.cell && is_barred(time))
    if (const Literal before = presences_.find({c.from, time - 1, false}))
      solver_.add({-by.literal, -before, -literal});
  if (place == c.from && !is_last && is_barred(time + 1))
    presences_.for_each_at(c.cell, time + 1, [&](Literal after) {
      solver_.add({-by.literal, -literal, -after});
    });
}

TraversalClauses& PathClauses::traversals(const Constraint& constraint) {
  for (TraversalClauses& known : traversals_)
    if (known.is_about(constraint)) return known;
  TraversalClauses& made = traversals_.emplace_back(solver_, agent_, corridors_, constraint);
  PresenceLiterals added;
  for (const auto& [presence, literal] : presences_.all()) {
    added.set(presence, literal);
    made.add(presence, literal, added);
  }
  return made;
}

std::optional<std::vector<PathGraph::Node>> PathClauses::walk() const {
  Time level = 0;
  while (level < levels_ && !solver_.is_true(within_[level])) ++level;
  if (level == levels_) return std::nullopt;
  const auto next_of = [&](std::span<const PathGraph::Node> nodes) {
    const auto at = std::ranges::find_if(nodes, [&](PathGraph::Node node) {
      return graph_.excess(node) <= level && nodes_[node] != 0 && solver_.is_true(nodes_[node]);
    });
    GROVE_CHECK(at != nodes.end(), "a model contains a walk");
    return *at;
  };
  std::vector<PathGraph::Node> walk{next_of(graph_.starts())};
  while (!graph_.is_final(walk.back())) walk.push_back(next_of(graph_.successors(walk.back())));
  return walk;
}

void PathClauses::prefer(const std::vector<PathGraph::Node>& walk) {
  for (const Literal literal : std::exchange(preferred_, {})) solver_.end_preference(literal);
  for (const PathGraph::Node node : walk)
    if (nodes_[node] != 0) preferred_.push_back(nodes_[node]);
  for (const Literal literal : preferred_) solver_.prefer(literal);
}

}  // namespace grove::detail
