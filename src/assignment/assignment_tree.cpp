// SPDX-License-Identifier: MIT
// *Claim: every plan that costs less than the cutoff costs at least the least bound of the open
// nodes and of the node that run() has returned and resolve() has not yet put back.* *Proof.* The
// routes of such a plan (route_relaxation.cpp) make choices. Each branching leaves them in exactly
// one child. Reduced cost fixing removes them only if the plan costs at least the cutoff, and
// propagation removes only choices that no plan makes. So they are left in one node. Its bound, and
// the one given to resolve(), hold for the plan. A node is dropped only if its bound is at least
// the cutoff or it is infeasible. The cutoff never rises, so a dropped node need not be opened
// again.
//
// *Branching.* An exponentially weighted average of the walks of recent subgradient iterations
// approximates a solution of the linear relaxation over walks (volume algorithm: Barahona and Anbil
// 2000). Candidates are the choices whose share in it is nearest to one half. For a few candidates
// both children are evaluated with some iterations (strong branching: Applegate, Bixby, Chvatal and
// Cook 1995). The score is the product of the gains (Achterberg 2007).
//
// *Begun tasks.* An agent that starts while it executes an optional task visits it in every plan,
// so this visit cannot be left out. Then routes need not have exactly `need` visits: an agent
// without a destination could also rest on the task, or more agents than `need` could start on it.
// In both cases the tree is not used.
#include "assignment/assignment_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assignment/routes.h"
#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::size_t kCandidates = 4;
// Scanned legs of the root between two fixings.
constexpr std::int64_t kRootEffort = 30'000'000;
// Scanned legs for `evaluations` evaluations of multipliers, between `least` and `most`.
struct Effort {
  std::int64_t evaluations, least, most;
  std::int64_t of(const RouteBound& bound) const {
    return std::clamp(evaluations * bound.evaluation_effort(), least, most);
  }
};
// For both children of a candidate, and for the children of the chosen one.
constexpr Effort kTrialEffort = {.evaluations = 4, .least = 200'000, .most = 2'000'000};
constexpr Effort kChildEffort = {.evaluations = 15, .least = 1'000'000, .most = 20'000'000};
constexpr std::int64_t kMaxStrong = 500'000;  // legs per evaluation for strong branching
constexpr std::int64_t kMinRise = 64;         // of the root's bound, in its fine units
constexpr double kMinGain = 5;                // in fine units of the bound, for the product

}  // namespace

struct AssignmentTree::Node {
  std::unique_ptr<RouteBound> bound;
  Cost proven = 0;
  int depth = 0;
  bool was_offered = false;
  bool is_leaf = false;
};

// Nodes with a smaller bound first; among equal bounds, deeper nodes first.
struct AssignmentTree::ByBound {
  bool operator()(const Node& a, const Node& b) const {
    return a.proven != b.proven ? a.proven > b.proven : a.depth < b.depth;
  }
};

// A decision: that the agent visits the task, or ends on the goal.
struct AssignmentTree::Branch {
  AgentIndex agent;
  TaskIndex task;  // if there is no goal
  std::optional<Place> goal;
  double distance;  // of its share from one half

  void decide(RouteBound& bound, bool is_chosen) const {
    std::vector<RouteChoices> choices = bound.choices();
    RouteChoices& own = choices[agent];
    if (goal && is_chosen)
      own.goals = {*goal};
    else if (goal)
      std::erase(own.goals, *goal);
    else if (is_chosen)
      own.required.insert(std::ranges::upper_bound(own.required, task), task);
    else
      std::erase(own.visits, task);
    bound.restrict_to(choices);
  }
};

AssignmentTree::AssignmentTree(const Instance& instance, const RouteBound& bound,
                               std::size_t max_bytes)
    : instance_(instance), max_bytes_(max_bytes) {
  push({.bound = std::make_unique<RouteBound>(bound), .proven = bound.lower_bound()});
}

AssignmentTree::~AssignmentTree() = default;

AssignmentTree::Outcome AssignmentTree::run(Cost cutoff, std::int64_t effort, bool offer_nodes,
                                            const Limits& limits) {
  GROVE_ASSERT(!offered_, "the last node is resolved");
  cutoff_ = cutoff;
  for (std::int64_t spent = 0; lower_bound() < cutoff;) {
    if (spent >= effort || limits.stop_requested()) return Outcome::kOpen;
    const bool is_final = open_.front().is_leaf && open_.front().was_offered;
    if (is_final || bytes_ > max_bytes_) return Outcome::kStuck;
    Node node = pop();
    RouteBound& bound = *node.bound;
    const std::int64_t before = bound.effort();
    const bool is_done = expand(node, offer_nodes, limits);
    spent += bound.effort() - before;
    if (!is_done) {
      push(std::move(node));
      return limits.stop_requested() ? Outcome::kOpen : Outcome::kStuck;
    }
    if (offered_) return Outcome::kNode;
  }
  return Outcome::kClosed;
}

// Returns false if the node remains open: choices cannot be fixed, or a limit is reached.
bool AssignmentTree::expand(Node& node, bool offer_nodes, const Limits& limits) {
  RouteBound& bound = *node.bound;
  if (!bound.fix(cutoff_, limits) && (node.depth == 0 || limits.stop_requested())) return false;
  if (node.depth == 0 && !require_begun_tasks(bound)) return false;
  if (!bound.is_feasible()) return true;
  if (node.depth == 0 && improve_root(node, limits)) {
    push(std::move(node));
    return true;
  }
  const std::vector<Branch> candidates = branches(bound);
  node.is_leaf = candidates.empty();
  if (node.is_leaf || (offer_nodes && !node.was_offered)) {
    node.was_offered = true;
    offered_ = std::make_unique<Node>(std::move(node));
    return true;
  }
  for (Node& child : best_children(node, candidates, limits)) {
    ++nodes_;
    if (!child.bound->is_feasible()) continue;
    child.bound->improve(kChildEffort.of(*child.bound), limits);
    child.proven = std::max(node.proven, child.bound->lower_bound());
    if (child.proven < cutoff_) push(std::move(child));
  }
  return true;
}

// Returns true if the bound has risen enough to repeat this after fixing again: with fewer legs the
// iterations are faster.
bool AssignmentTree::improve_root(Node& node, const Limits& limits) const {
  const std::int64_t before = node.bound->fine_bound();
  node.bound->improve(kRootEffort, limits);
  node.proven = std::max(node.proven, node.bound->lower_bound());
  return node.bound->fine_bound() - before >= kMinRise;
}

// Returns false if further visits to a begun task may be necessary, or more agents execute a task
// than it needs.
bool AssignmentTree::require_begun_tasks(RouteBound& bound) const {
  std::vector<int> begun(instance_.tasks().size());
  std::vector<RouteChoices> choices = bound.choices();
  for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
    const auto task = task_at_start(instance_, agent);
    if (!task || instance_.task(*task).needs_all()) continue;
    const bool all_have_goals = std::ranges::all_of(instance_.agents(), &Agent::has_destination);
    if (!all_have_goals || ++begun[*task] > instance_.task(*task).need) return false;
    choices[agent].required = {*task};
  }
  bound.restrict_to(choices);
  return true;
}

std::vector<AssignmentTree::Branch> AssignmentTree::branches(const RouteBound& bound) const {
  std::vector<Branch> branches;
  for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent) {
    const RouteBound::Choices& choices = bound.choices()[agent];
    for (const TaskIndex task : choices.visits)
      if (!std::ranges::binary_search(choices.required, task))
        branches.push_back({.agent = agent,
                            .task = task,
                            .goal = std::nullopt,
                            .distance = std::abs(bound.share(agent, task) - 0.5)});
    if (choices.goals.size() <= 1) continue;
    for (const Place goal : choices.goals)
      branches.push_back({.agent = agent,
                          .task = 0,
                          .goal = goal,
                          .distance = std::abs(bound.share_of_goal(agent, goal) - 0.5)});
  }
  const std::size_t count =
      std::min(branches.size(), bound.evaluation_effort() > kMaxStrong ? 1 : kCandidates);
  std::ranges::partial_sort(branches, branches.begin() + static_cast<std::ptrdiff_t>(count), {},
                            &Branch::distance);
  branches.resize(count);
  return branches;
}

// The children for the candidate with the greatest product of gains, or that closes a child.
std::vector<AssignmentTree::Node> AssignmentTree::best_children(
    const Node& node, const std::vector<Branch>& candidates, const Limits& limits) const {
  std::vector<Node> best;
  double best_score = -1;
  for (const Branch& candidate : candidates) {
    std::vector<Node> children;
    double score = 1;
    bool closes_one = false;
    for (const bool is_chosen : {true, false}) {
      Node& child = children.emplace_back(
          Node{.bound = std::make_unique<RouteBound>(*node.bound), .depth = node.depth + 1});
      candidate.decide(*child.bound, is_chosen);
      if (child.bound->is_feasible()) child.bound->improve(kTrialEffort.of(*child.bound), limits);
      closes_one |= !child.bound->is_feasible() || child.bound->lower_bound() >= cutoff_;
      score *= std::max(kMinGain,
                        static_cast<double>(child.bound->fine_bound() - node.bound->fine_bound()));
    }
    if (closes_one) return children;
    if (score <= best_score) continue;
    best_score = score;
    best = std::move(children);
  }
  return best;
}

RouteBound& AssignmentTree::node() {
  return *offered_->bound;
}

std::optional<Assignment> AssignmentTree::leaf() const {
  if (!offered_->is_leaf) return std::nullopt;
  Assignment leaf;
  for (const RouteBound::Choices& choices : offered_->bound->choices())
    leaf.push_back(
        {.visits = choices.required,
         .goal = choices.goals.empty() ? std::nullopt : std::optional(choices.goals.front())});
  return leaf;
}

void AssignmentTree::resolve(Cost bound) {
  const std::unique_ptr<Node> node = std::exchange(offered_, nullptr);
  node->proven = std::max(node->proven, bound);
  if (node->proven < cutoff_) push(std::move(*node));
}

Cost AssignmentTree::lower_bound() const {
  Cost bound = cutoff_;
  if (offered_) bound = std::min(bound, offered_->proven);
  if (!open_.empty()) bound = std::min(bound, open_.front().proven);
  return bound;
}

void AssignmentTree::push(Node node) {
  bytes_ += node.bound->bytes();
  open_.push_back(std::move(node));
  std::ranges::push_heap(open_, ByBound());
}

AssignmentTree::Node AssignmentTree::pop() {
  std::ranges::pop_heap(open_, ByBound());
  Node node = std::move(open_.back());
  open_.pop_back();
  bytes_ -= node.bound->bytes();
  return node;
}

}  // namespace grove::detail
