// SPDX-License-Identifier: MIT
// Forward, time step by time step, all (slot, state) pairs that an agent can be in: a slot of
// safe_intervals.h, which says the cell and all that constraints ask of the past, and a state of
// free_goals.h. Then backward: what does not lead to the end is dropped.
//
// *Claim: the ways are exactly the paths of cost C.* The step from time t on is as in the free low
// level, but for one step only: a wait while the slot lasts, or a move that is open at t + 1 into
// the slot that takes arrivals at t + 1. Whoever has counted as early as possible passes such
// states (free_goals.cpp: each touch has one successor, or two, both followed), and the completions
// are widened until they know all sequences of cost C, C < beyond(); so, as there, all states along
// a path of cost C are known and have t + h <= C: none is pruned. A path comes to rest at C by a
// move at C, in a slot to rest in (or stands there at C = 0): the last step is no wait, and any way
// to such an end obeys the constraints, since they are a matter of slots and moves alone.
//
// Reduction. Nodes of one layer with the same cell and the same successors, themselves reduced, are
// one: the same rows of cells follow on them (by induction from the last layer), and no more is
// asked of a path later than where it is when. States and slots are forgotten in this way.
#include "grove/planning/optimal_paths.h"

#include <algorithm>

#include "label_planes.h"
#include "safe_intervals.h"

namespace grove {
namespace {

constexpr std::size_t kNodesPerPoll = 256;

}  // namespace

class OptimalPathsBuilder::Workspace {
 public:
  explicit Workspace(const Grid& grid)
      : grid_(grid), intervals_(grid), newest_at_(grid.cell_count(), kNoNode) {}

  Outcome build(FreeGoals& goals, std::span<const Constraint> constraints, Time cost,
                std::size_t most_nodes, const Limits& limits, OptimalPaths& paths);
  std::int64_t nodes() const { return met_; }

 private:
  using StateId = FreeGoals::StateId;
  using NodeId = OptimalPaths::NodeId;
  static constexpr NodeId kNoNode = -1;

  // A (slot, state) at the time of its layer.
  struct Node {
    std::int32_t slot;
    StateId state;
    std::int32_t first_edge;
  };

  Outcome build_layers(std::size_t most_nodes);
  void start();
  void step(const Node& node, Time time);
  void add(std::int32_t slot, StateId state, Time time);
  bool is_finish(std::int32_t slot, StateId state) const;
  void reduce(OptimalPaths& paths);
  void reduce_layer(NodeId first, NodeId end, OptimalPaths& paths);
  NodeId reduced(Cell cell, std::int32_t first_edge, OptimalPaths& paths);

  const Grid& grid_;
  SafeIntervals intervals_;
  LabelPlanes planes_;  // a label: the time of the layer it was last met in, and the node there
  std::vector<Node> nodes_;
  std::vector<NodeId> edges_;      // to the nodes of the next layer
  std::vector<NodeId> layers_;     // the first node of each
  std::vector<NodeId> reduced_;    // by node; kNoNode: leads nowhere
  std::vector<NodeId> newest_at_;  // by cell: the reduced node of this layer made last
  std::vector<NodeId> older_;      // by reduced node: the one of its cell and layer before it
  std::int64_t met_ = 0;           // nodes, in all calls

  // Of the call under way.
  FreeGoals* goals_ = nullptr;
  const Limits* limits_ = nullptr;
  Time cost_ = 0;
};

OptimalPathsBuilder::OptimalPathsBuilder(const Grid& grid)
    : workspace_(std::make_unique<Workspace>(grid)) {}
OptimalPathsBuilder::~OptimalPathsBuilder() = default;

std::int64_t OptimalPathsBuilder::nodes() const {
  return workspace_->nodes();
}

OptimalPathsBuilder::Outcome OptimalPathsBuilder::build(FreeGoals& goals,
                                                        std::span<const Constraint> constraints,
                                                        Time cost, std::size_t most_nodes,
                                                        const Limits& limits, OptimalPaths& paths) {
  return workspace_->build(goals, constraints, cost, most_nodes, limits, paths);
}

OptimalPathsBuilder::Outcome OptimalPathsBuilder::Workspace::build(
    FreeGoals& goals, std::span<const Constraint> constraints, Time cost, std::size_t most_nodes,
    const Limits& limits, OptimalPaths& paths) {
  paths = OptimalPaths();
  intervals_.assign(constraints);
  if (cost < 0 || cost >= kNever || cost > intervals_.latest_rest() || !goals.plausible())
    return Outcome::kNone;
  if (limits.stop_requested()) return Outcome::kStopped;
  Completions& completions = goals.stops().completions();
  if (completions.beyond() <= cost && !completions.widen(cost, limits)) return Outcome::kStopped;
  goals_ = &goals;
  limits_ = &limits;
  cost_ = cost;
  const Outcome outcome = build_layers(most_nodes);
  met_ += std::ssize(nodes_);
  if (outcome == Outcome::kBuilt) reduce(paths);
  return outcome;
}

OptimalPathsBuilder::Outcome OptimalPathsBuilder::Workspace::build_layers(std::size_t most_nodes) {
  nodes_.clear();
  edges_.clear();
  layers_.assign(1, 0);
  planes_.begin_search(intervals_.slot_count());
  start();
  std::size_t polled = 0;
  for (Time time = 1; time <= cost_; ++time) {
    const NodeId first = layers_.back();
    const auto end = static_cast<NodeId>(nodes_.size());
    layers_.push_back(end);
    if (first == end) break;
    for (NodeId node = first; node < end; ++node) {
      nodes_[node].first_edge = static_cast<std::int32_t>(edges_.size());
      step(nodes_[node], time);
      if (nodes_.size() > most_nodes) return Outcome::kTooLarge;
      if (++polled % kNodesPerPoll == 0 && limits_->stop_requested()) return Outcome::kStopped;
    }
  }
  if (planes_.exhausted()) return Outcome::kStopped;
  if (layers_.back() == static_cast<NodeId>(nodes_.size())) return Outcome::kNone;
  layers_.push_back(static_cast<NodeId>(nodes_.size()));
  for (NodeId node = layers_[cost_]; node < layers_[cost_ + 1]; ++node)
    nodes_[node].first_edge = static_cast<std::int32_t>(edges_.size());
  return Outcome::kBuilt;
}

void OptimalPathsBuilder::Workspace::start() {
  const Cell cell = goals_->stops().start();
  const StateId state = goals_->first_state();
  const int slot = intervals_.start_slot(cell);
  if (slot < 0 || state == FreeGoals::kOutside) return;
  goals_->on_arrival(state, cell, [&](StateId then) { add(slot, then, 0); });
  edges_.clear();
}

// All that can be done in one step, arriving at `time`.
void OptimalPathsBuilder::Workspace::step(const Node& from, Time time) {
  const Node node = from;  // nodes_ will grow
  if (time < cost_ && time <= intervals_.end_of(node.slot)) add(node.slot, node.state, time);
  intervals_.for_each_move(grid_, node.slot, time - 1, [&](int slot, Cell cell, Time first) {
    if (first == time)
      goals_->on_arrival(node.state, cell, [&](StateId then) { add(slot, then, time); });
  });
}

void OptimalPathsBuilder::Workspace::add(std::int32_t slot, StateId state, Time time) {
  if (goals_->distance(state, intervals_.cell_of(slot)) > cost_ - time) return;
  if (time == cost_ && !is_finish(slot, state)) return;
  if (!planes_.open(state, *limits_)) return;
  LabelPlanes::Label& l = planes_.label(slot, state);
  if (!planes_.is_current(l) || l.time != time) {
    l.time = time;
    l.parent_slot = static_cast<std::int32_t>(nodes_.size());
    l.stamp = planes_.stamp();
    nodes_.push_back({slot, state, 0});
  }
  edges_.push_back(l.parent_slot);
}

bool OptimalPathsBuilder::Workspace::is_finish(std::int32_t slot, StateId state) const {
  return goals_->is_rest(goals_->state(state), intervals_.cell_of(slot)) &&
         intervals_.may_rest(slot);
}

void OptimalPathsBuilder::Workspace::reduce(OptimalPaths& paths) {
  reduced_.assign(nodes_.size(), kNoNode);
  older_.clear();
  for (Time time = cost_; time >= 0; --time) {
    paths.first_of_layer_.push_back(paths.node_count());
    reduce_layer(layers_[time], layers_[time + 1], paths);
  }
  paths.first_of_layer_.push_back(paths.node_count());
  paths.first_successor_.push_back(static_cast<std::int32_t>(paths.successors_.size()));
}

void OptimalPathsBuilder::Workspace::reduce_layer(NodeId first, NodeId end, OptimalPaths& paths) {
  const bool last = static_cast<std::size_t>(end) == nodes_.size();
  const NodeId first_made = paths.node_count();
  for (NodeId node = first; node < end; ++node) {
    const std::int32_t end_edge = static_cast<std::size_t>(node) + 1 < nodes_.size()
                                      ? nodes_[node + 1].first_edge
                                      : static_cast<std::int32_t>(edges_.size());
    const auto first_new = static_cast<std::int32_t>(paths.successors_.size());
    for (std::int32_t edge = nodes_[node].first_edge; edge < end_edge; ++edge)
      if (reduced_[edges_[edge]] != kNoNode) paths.successors_.push_back(reduced_[edges_[edge]]);
    const auto begin = paths.successors_.begin() + first_new;
    if (begin == paths.successors_.end() && !last) continue;
    std::sort(begin, paths.successors_.end());
    paths.successors_.erase(std::unique(begin, paths.successors_.end()), paths.successors_.end());
    reduced_[node] = reduced(intervals_.cell_of(nodes_[node].slot), first_new, paths);
  }
  for (NodeId node = first_made; node < paths.node_count(); ++node)
    newest_at_[paths.cells_[node]] = kNoNode;
}

// The node with this cell and the successors from `first_new` on, which go if it is there already.
OptimalPaths::NodeId OptimalPathsBuilder::Workspace::reduced(Cell cell, std::int32_t first_new,
                                                             OptimalPaths& paths) {
  const auto begin = paths.successors_.begin() + first_new;
  for (NodeId known = newest_at_[cell]; known != kNoNode; known = older_[known]) {
    const std::int32_t first = paths.first_successor_[known];
    const std::int32_t end =
        known + 1 < paths.node_count() ? paths.first_successor_[known + 1] : first_new;
    if (!std::equal(paths.successors_.begin() + first, paths.successors_.begin() + end, begin,
                    paths.successors_.end()))
      continue;
    paths.successors_.erase(begin, paths.successors_.end());
    return known;
  }
  const NodeId made = paths.node_count();
  paths.cells_.push_back(cell);
  paths.first_successor_.push_back(first_new);
  older_.push_back(newest_at_[cell]);
  newest_at_[cell] = made;
  return made;
}

}  // namespace grove
