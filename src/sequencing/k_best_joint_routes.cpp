// SPDX-License-Identifier: MIT
// The K best joint routes by the partition method (Lawler 1972, after Murty 1968). CBS-TA (Hoenig
// et al. 2018) and CBSS (Ren et al. 2023) enumerate assignments and joint sequences in this way.
//
// *Partition.* The routes of the agents, one after the other, are a list of decisions: to continue
// to a stop, or to end in one of the possible ways. Let m be the best member of a class. The class
// without m is split into the classes
//
//   the decisions before d are those of m, and d is not decided as in m; if the class begins with
//   the decisions before d, d is also none of the decisions that the class forbids
//
// for each decision d that the class does not fix. They are disjoint, and each other member differs
// from m in a first decision. So every joint route is returned exactly once. In each class the
// routes of the first agents are fixed and those of the last ones are free (JointRouteClass).
//
// *Lazy evaluation.* A class enters the queue with the cost of m, which is a lower bound on its
// members. When it reaches the top, the solver finds its best member, and the class is pushed again
// with that cost. Hence the order is correct, and the key at the top is a lower bound on all later
// joint routes. Among equal keys solved classes come first, because they require no further search.
#include "sequencing/k_best_joint_routes.h"

#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

#include "model/assert.h"
#include "sequencing/keyed_stacks.h"

namespace grove::detail {

class KBestJointRoutes::Partition {
 public:
  Partition(const JointRouteProblem& problem, std::unique_ptr<JointRouteSolver> solver,
            const Limits& limits)
      : problem_(problem), solver_(std::move(solver)), limits_(limits) {
    queue_.push({0, kBounded}, {});
  }

  Cost lower_bound() const { return queue_.empty() ? kInfiniteCost : queue_.top_key().first; }

  std::optional<JointRoute> next() {
    while (!queue_.empty() && !limits_.stop_requested()) {
      const auto [bound, knowledge] = queue_.top_key();
      Entry entry = queue_.pop();
      if (knowledge == kSolved) return return_next(entry);
      const JointRouteClass joint_class = class_of(entry);
      ++solver_calls_;
      JointRouteAnswer answer = solver_->best(joint_class);
      if (answer.kind == JointRouteAnswer::Kind::kStopped) {
        queue_.push({bound, kBounded}, entry);
        break;
      }
      if (answer.kind == JointRouteAnswer::Kind::kInfeasible) continue;
      GROVE_CHECK(answer.route.cost >= bound,
                  "no joint route costs less than the bound of its class");
      GROVE_ASSERT(is_member(answer.route, joint_class),
                   "a joint route is found in a class that contains it");
      const Cost cost = answer.route.cost;
      entry.best = std::make_shared<const JointRoute>(std::move(answer.route));
      queue_.push({cost, kSolved}, entry);
    }
    return std::nullopt;
  }

  std::int64_t solver_calls() const { return solver_calls_; }

 private:
  enum Knowledge : std::uint8_t { kSolved, kBounded };
  using Key = std::pair<Cost, Knowledge>;

  // A class: the decisions of `parent` before one of `agent`, and what this decision is not.
  struct Entry {
    std::shared_ptr<const JointRoute> parent;  // nullptr: the class of all joint routes
    std::size_t agent = 0;
    std::size_t position = 0;  // of the decision in the route of the agent
    StopSet forbidden_stops = 0;
    std::vector<int> forbidden_ends;
    std::shared_ptr<const JointRoute> best;  // of a solved class
  };

  static JointRouteClass class_of(const Entry& entry) {
    JointRouteClass joint_class;
    joint_class.forbidden_stops = entry.forbidden_stops;
    joint_class.forbidden_ends = entry.forbidden_ends;
    if (!entry.parent) return joint_class;
    const auto& routes = entry.parent->routes;
    joint_class.fixed.assign(routes.begin(),
                             routes.begin() + static_cast<std::ptrdiff_t>(entry.agent));
    const Sequence& stops = routes[entry.agent].stops;
    joint_class.prefix.assign(stops.begin(),
                              stops.begin() + static_cast<std::ptrdiff_t>(entry.position));
    return joint_class;
  }

  // Is the decision after the prefix of the class allowed, and are all decisions before it those of
  // the class?
  bool is_member(const JointRoute& joint, const JointRouteClass& joint_class) const {
    const std::size_t agent = joint_class.fixed.size();
    if (joint.routes.size() != problem_.agents.size() ||
        !std::equal(joint_class.fixed.begin(), joint_class.fixed.end(), joint.routes.begin()))
      return false;
    const AgentRoute& route = joint.routes[agent];
    const Sequence& prefix = joint_class.prefix;
    if (route.stops.size() < prefix.size() ||
        !std::equal(prefix.begin(), prefix.end(), route.stops.begin()))
      return false;
    if (route.stops.size() == prefix.size())
      return std::ranges::count(joint_class.forbidden_ends, route.end) == 0;
    return (joint_class.forbidden_stops & bit(route.stops[prefix.size()])) == 0;
  }

  JointRoute return_next(const Entry& entry) {
    const JointRoute& best = *entry.best;
    GROVE_CHECK(best.cost >= last_cost_, "joint routes are returned in ascending order of cost");
    last_cost_ = best.cost;
    for (std::size_t agent = entry.agent; agent < best.routes.size(); ++agent) {
      const std::size_t begin = agent == entry.agent ? entry.position : 0;
      for (std::size_t i = begin; i <= best.routes[agent].stops.size(); ++i)
        push_class(entry, agent, i);
    }
    return best;
  }

  // Pushes the class that first differs from entry.best in decision `position` of `agent`.
  void push_class(const Entry& entry, std::size_t agent, std::size_t position) {
    const AgentRoute& route = entry.best->routes[agent];
    Entry other;
    other.parent = entry.best;
    other.agent = agent;
    other.position = position;
    if (agent == entry.agent && position == entry.position) {
      other.forbidden_stops = entry.forbidden_stops;
      other.forbidden_ends = entry.forbidden_ends;
    }
    if (position < route.stops.size())
      other.forbidden_stops |= bit(route.stops[position]);
    else
      other.forbidden_ends.push_back(route.end);
    queue_.push({entry.best->cost, kBounded}, other);
  }

  const JointRouteProblem& problem_;
  std::unique_ptr<JointRouteSolver> solver_;
  const Limits& limits_;
  KeyedStacks<Key, Entry> queue_;
  Cost last_cost_ = 0;
  std::int64_t solver_calls_ = 0;
};

KBestJointRoutes::KBestJointRoutes(const JointRouteProblem& problem,
                                   std::unique_ptr<JointRouteSolver> solver, const Limits& limits)
    : partition_(std::make_unique<Partition>(problem, std::move(solver), limits)) {}
KBestJointRoutes::~KBestJointRoutes() = default;
KBestJointRoutes::KBestJointRoutes(KBestJointRoutes&&) noexcept = default;

Cost KBestJointRoutes::lower_bound() const {
  return partition_->lower_bound();
}
std::optional<JointRoute> KBestJointRoutes::next() {
  return partition_->next();
}
std::int64_t KBestJointRoutes::solver_calls() const {
  return partition_->solver_calls();
}

}  // namespace grove::detail
