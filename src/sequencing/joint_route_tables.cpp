// SPDX-License-Identifier: MIT
// Finds joint routes by dynamic programming over the agents.
//
// *State.* How many visits each shared task still needs, and which resources are free. A route of
// an agent uses up a part of the state, its *use*. Let F[a][s] be the least cost of routes of the
// agents a, a + 1, ... that use up exactly the needs of s, and some of its resources:
//
//   F[n][s] = 0 if s has no needs, else infinite,
//   F[a][s] = min over uses u <= s of (cost of a cheapest route of a with use u) + F[a+1][s - u].
//
// The cheapest routes of an agent by use come from its RouteTable. So F is exact. In a class the
// first agents are fixed and the last ones free. Its best member is therefore the minimum, over the
// routes of the agent between them, of the cost plus an entry of F.
//
// *Representation.* A state is a number in a mixed radix; subtracting a use subtracts its number.
// It is also a word with 4 bits per need or resource, of which the highest is a guard: u <= s if
// and only if subtracting u from s with all guards set clears no guard.
//
// *Cost.* Building F takes (states * uses) additions per agent, at most kMaxWork in total.
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "model/assert.h"
#include "sequencing/joint_route_solver.h"
#include "sequencing/route_table.h"

namespace grove::detail {
namespace {

constexpr int kDigits = 16;
constexpr int kBitsPerDigit = 4;
constexpr int kMaxDigit = 7;
constexpr std::uint64_t kGuards = 0x8888888888888888;
constexpr std::size_t kMaxStateCount = std::size_t{1} << 16;
constexpr double kMaxWork = 3e8;  // additions, together about 0.3 s

// The states of a problem.
class UseCounts {
 public:
  // A part of a state, in both representations.
  struct Use {
    std::uint64_t digits = 0;
    std::uint32_t number = 0;
    friend auto operator<=>(const Use&, const Use&) = default;
  };

  // `resources`: those that several agents can use, by number, in ascending order.
  UseCounts(const JointRouteProblem& problem, std::vector<int> resources)
      : needs_(static_cast<int>(problem.needs.size())), resources_(std::move(resources)) {
    for (const int need : problem.needs) add_digit(need);
    for (std::size_t i = 0; i < resources_.size(); ++i) add_digit(1);
  }

  bool fits() const { return fits_; }
  std::size_t count() const { return count_; }
  // The state of the whole problem.
  Use all() const { return all_; }
  bool has_needs(std::uint64_t digits) const {
    return needs_ > 0 && (digits << (kDigits - needs_) * kBitsPerDigit) != 0;
  }
  static bool contains(std::uint64_t state, std::uint64_t use) {
    return (((state | kGuards) - use) & kGuards) == kGuards;
  }
  static Use difference(Use state, Use use) {
    return {state.digits - use.digits, state.number - use.number};
  }

  Use use_of(const AgentRoutes& agent, StopSet visited, const RouteEnd& end) const {
    Use use;
    for_each_stop(visited, [&](int stop) {
      if (const int task = agent.tasks[static_cast<std::size_t>(stop)]; task >= 0) add(use, task);
    });
    const auto shared = std::ranges::lower_bound(resources_, end.resource);
    if (shared != resources_.end() && *shared == end.resource)
      add(use, needs_ + static_cast<int>(shared - resources_.begin()));
    return use;
  }

  // The digits of all states, by number.
  std::vector<std::uint64_t> states() const {
    std::vector<std::uint64_t> states(count_);
    for (std::size_t number = 0; number < count_; ++number)
      for (std::size_t digit = 0; digit < radix_.size(); ++digit)
        states[number] |= std::uint64_t{number / stride_[digit] % radix_[digit]}
                          << digit * kBitsPerDigit;
    return states;
  }

 private:
  void add_digit(int max) {
    fits_ = fits_ && max <= kMaxDigit && radix_.size() < kDigits &&
            count_ * static_cast<std::size_t>(max + 1) <= kMaxStateCount;
    if (!fits_) return;
    stride_.push_back(static_cast<std::uint32_t>(count_));
    radix_.push_back(static_cast<std::uint32_t>(max + 1));
    count_ *= radix_.back();
    for (int i = 0; i < max; ++i) add(all_, static_cast<int>(radix_.size()) - 1);
  }
  void add(Use& use, int digit) const {
    use.digits += std::uint64_t{1} << digit * kBitsPerDigit;
    use.number += stride_[static_cast<std::size_t>(digit)];
  }

  int needs_;
  std::vector<int> resources_;
  std::vector<std::uint32_t> stride_;  // by digit
  std::vector<std::uint32_t> radix_;
  std::size_t count_ = 1;
  Use all_;
  bool fits_ = true;
};

// The resources that several agents can use.
std::vector<int> shared_resources(const JointRouteProblem& problem) {
  std::map<int, int> users;
  for (const AgentRoutes& agent : problem.agents) {
    std::vector<int> of_agent;
    for (const RouteEnd& end : agent.ends)
      if (end.resource != RouteEnd::kNoResource) of_agent.push_back(end.resource);
    std::ranges::sort(of_agent);
    of_agent.erase(std::unique(of_agent.begin(), of_agent.end()), of_agent.end());
    for (const int resource : of_agent) ++users[resource];
  }
  std::vector<int> shared;
  for (const auto& [resource, count] : users)
    if (count > 1) shared.push_back(resource);
  return shared;
}

class JointRouteTables : public JointRouteSolver {
 public:
  JointRouteTables(const JointRouteProblem& problem, const Limits& limits)
      : problem_(problem), limits_(limits), counts_(problem, shared_resources(problem)) {}

  bool fits() const {
    if (!counts_.fits()) return false;
    double work = 0;
    for (const AgentRoutes& agent : problem_.agents) {
      if (agent.stops() > RouteTable::kMaxStops) return false;
      const int optional = agent.stops() - std::popcount(agent.required);
      work += static_cast<double>(counts_.count() * agent.ends.size()) *
              static_cast<double>(std::size_t{1} << optional);
    }
    return work <= kMaxWork;
  }

  JointRouteAnswer best(const JointRouteClass& joint_class) override {
    using Kind = JointRouteAnswer::Kind;
    if (!is_built_ && !build()) return {Kind::kStopped};
    const auto left = state_after(joint_class.fixed);
    if (!left) return {Kind::kInfeasible};
    const int agent = joint_class.next_agent();
    if (!compute(agent, joint_class.prefix, joint_class.forbidden_stops)) return {Kind::kStopped};
    Option best;
    Cost least = kInfiniteCost;
    const auto is_allowed = [&](int end) {
      return std::ranges::count(joint_class.forbidden_ends, end) == 0;
    };
    table_.for_each_route(is_allowed, [&](StopSet visited, int end, Time cost) {
      const Use use = use_of(agent, visited, end);
      if (!UseCounts::contains(left->digits, use.digits)) return;
      const Cost rest = rest_[static_cast<std::size_t>(agent) + 1][left->number - use.number];
      if (rest >= kInfiniteCost || cost + rest >= least) return;
      least = cost + rest;
      best = {use, cost, visited, end};
    });
    if (least >= kInfiniteCost) return {Kind::kInfeasible};
    JointRouteAnswer answer{Kind::kExact, {least, joint_class.fixed}};
    for (std::size_t i = 0; i < joint_class.fixed.size(); ++i)
      answer.route.cost += route_cost(problem_.agents[i], joint_class.fixed[i]);
    answer.route.routes.push_back(table_.route(best.visited, best.end));
    if (!complete(UseCounts::difference(*left, best.use), answer.route.routes))
      return {Kind::kStopped};
    return answer;
  }

 private:
  using Use = UseCounts::Use;
  // A cheapest route of an agent with one use.
  struct Option {
    Use use;
    Time cost = 0;
    StopSet visited = 0;
    int end = 0;
  };

  Use use_of(int agent, StopSet visited, int end) const {
    const AgentRoutes& of = problem_.agents[static_cast<std::size_t>(agent)];
    return counts_.use_of(of, visited, of.ends[static_cast<std::size_t>(end)]);
  }

  bool compute(int agent, const Sequence& prefix, StopSet forbidden,
               StopSet allowed = ~StopSet{0}) {
    return table_.compute(problem_.agents[static_cast<std::size_t>(agent)], prefix, forbidden,
                          allowed, limits_);
  }

  // What the routes of the first agents leave; nullopt if they use more than there is.
  std::optional<Use> state_after(const std::vector<AgentRoute>& routes) const {
    Use left = counts_.all();
    for (std::size_t agent = 0; agent < routes.size(); ++agent) {
      const Use use =
          use_of(static_cast<int>(agent), stops_of(routes[agent].stops), routes[agent].end);
      if (!UseCounts::contains(left.digits, use.digits)) return std::nullopt;
      left = UseCounts::difference(left, use);
    }
    return left;
  }

  // Builds the options of all agents, and rest_. Returns false if a limit was reached.
  bool build() {
    const std::size_t agents = problem_.agents.size();
    if (!limits_.memory_allows((agents + 1) * counts_.count() * sizeof(Cost))) {
      limits_.memory_exhausted();
      return false;
    }
    options_.resize(agents);
    for (std::size_t agent = 0; agent < agents; ++agent)
      if (!find_options(static_cast<int>(agent))) return false;
    const std::vector<std::uint64_t> states = counts_.states();
    rest_.assign(agents + 1, std::vector<Cost>(counts_.count(), kInfiniteCost));
    for (std::size_t state = 0; state < states.size(); ++state)
      if (!counts_.has_needs(states[state])) rest_[agents][state] = 0;
    for (std::size_t agent = agents; agent-- > 0;) {
      for (std::size_t state = 0; state < states.size(); ++state) {
        Cost& least = rest_[agent][state];
        for (const Option& option : options_[agent])
          if (UseCounts::contains(states[state], option.use.digits))
            least = std::min(least, option.cost + rest_[agent + 1][state - option.use.number]);
        least = std::min(least, kInfiniteCost);
        if (state % kPollStates == 0 && limits_.stop_requested()) return false;
      }
    }
    is_built_ = true;
    return true;
  }

  bool find_options(int agent) {
    if (!compute(agent, {}, 0)) return false;
    std::map<Use, Option> by_use;
    const auto all = [](int) { return true; };
    table_.for_each_route(all, [&](StopSet visited, int end, Time cost) {
      const Use use = use_of(agent, visited, end);
      if (!UseCounts::contains(counts_.all().digits, use.digits)) return;
      const auto [known, is_new] = by_use.try_emplace(use, Option{use, cost, visited, end});
      if (cost < known->second.cost) known->second = {use, cost, visited, end};
    });
    std::vector<Option>& options = options_[static_cast<std::size_t>(agent)];
    options.clear();
    for (const auto& [use, option] : by_use) options.push_back(option);
    return true;
  }

  // Appends cheapest routes of the agents that have none, which use up the state `left`. Returns
  // false if a limit was reached.
  bool complete(Use left, std::vector<AgentRoute>& routes) {
    for (std::size_t agent = routes.size(); agent < problem_.agents.size(); ++agent) {
      const auto is_best = [&](const Option& option) {
        return UseCounts::contains(left.digits, option.use.digits) &&
               option.cost + rest_[agent + 1][left.number - option.use.number] ==
                   rest_[agent][left.number];
      };
      const auto best = std::ranges::find_if(options_[agent], is_best);
      GROVE_CHECK(best != options_[agent].end(), "an entry of a table has a route");
      if (!compute(static_cast<int>(agent), {}, 0, best->visited)) return false;
      routes.push_back(table_.route(best->visited, best->end));
      left = UseCounts::difference(left, best->use);
    }
    return true;
  }

  static constexpr std::size_t kPollStates = 64;

  const JointRouteProblem& problem_;
  const Limits& limits_;
  const UseCounts counts_;
  RouteTable table_;
  bool is_built_ = false;
  std::vector<std::vector<Option>> options_;  // by agent
  std::vector<std::vector<Cost>> rest_;       // F, by agent and state
};

}  // namespace

std::unique_ptr<JointRouteSolver> make_joint_route_tables(const JointRouteProblem& problem,
                                                          const Limits& limits) {
  auto tables = std::make_unique<JointRouteTables>(problem, limits);
  if (!tables->fits()) return nullptr;
  return tables;
}

}  // namespace grove::detail
