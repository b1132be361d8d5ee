// SPDX-License-Identifier: MIT
// Finds joint routes if no task is shared: only the resources couple the agents. The best member of
// a class is then an assignment problem. Rows are the agents without a fixed route. Columns are the
// resources, and for each row a column of its own for the ends that use no resource. The cost of a
// pair is that of the agent's cheapest route with such an end. This is the problem of which CBS-TA
// (Hoenig et al. 2018) enumerates the best solutions.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "model/assert.h"
#include "sequencing/assignment.h"
#include "sequencing/joint_route_solver.h"
#include "sequencing/route_table.h"

namespace grove::detail {
namespace {

class JointRouteMatching : public JointRouteSolver {
 public:
  JointRouteMatching(const JointRouteProblem& problem, const Limits& limits)
      : problem_(problem), limits_(limits) {}

  JointRouteAnswer best(const JointRouteClass& joint_class) override {
    using Kind = JointRouteAnswer::Kind;
    if (!is_built_ && !build()) return {Kind::kStopped};
    const auto first = static_cast<std::size_t>(joint_class.next_agent());
    Row row;
    if (!find_routes(first, joint_class, row)) return {Kind::kStopped};
    std::vector<const Row*> rows{&row};
    for (std::size_t agent = first + 1; agent < free_.size(); ++agent)
      rows.push_back(&free_[agent]);

    const auto taken = taken_by(joint_class.fixed);
    if (!taken) return {Kind::kInfeasible};
    const auto matching = min_cost_assignment(costs(rows, *taken));
    if (!matching) return {Kind::kInfeasible};
    JointRouteAnswer answer{Kind::kExact, {0, joint_class.fixed}};
    for (std::size_t i = 0; i < rows.size(); ++i)
      answer.route.routes.push_back(route_at(*rows[i], matching->columns[i]));
    for (std::size_t agent = 0; agent < free_.size(); ++agent)
      answer.route.cost += route_cost(problem_.agents[agent], answer.route.routes[agent]);
    return answer;
  }

 private:
  // Cheapest routes of one agent.
  struct Row {
    std::vector<Time> costs;         // by resource, and last for ends without one; or kNever
    std::vector<AgentRoute> routes;  // in the same order
  };

  std::size_t own_column() const { return static_cast<std::size_t>(problem_.resources); }
  std::size_t column_of(const RouteEnd& end) const {
    return end.resource == RouteEnd::kNoResource ? own_column()
                                                 : static_cast<std::size_t>(end.resource);
  }

  bool build() {
    free_.assign(problem_.agents.size(), {});
    for (std::size_t agent = 0; agent < free_.size(); ++agent)
      if (!find_routes(agent, {}, free_[agent])) return false;
    is_built_ = true;
    return true;
  }

  // Returns false if a limit was reached.
  bool find_routes(std::size_t agent, const JointRouteClass& joint_class, Row& row) {
    const AgentRoutes& of = problem_.agents[agent];
    if (!table_.compute(of, joint_class.prefix, joint_class.forbidden_stops, ~StopSet{0}, limits_))
      return false;
    row.costs.assign(own_column() + 1, kNever);
    row.routes.assign(own_column() + 1, {});
    const auto is_allowed = [&](int end) {
      return std::ranges::count(joint_class.forbidden_ends, end) == 0;
    };
    table_.for_each_route(is_allowed, [&](StopSet visited, int end, Time cost) {
      const std::size_t column = column_of(of.ends[static_cast<std::size_t>(end)]);
      if (cost >= row.costs[column]) return;
      row.costs[column] = cost;
      row.routes[column] = table_.route(visited, end);
    });
    return true;
  }

  // The resources that the fixed routes use; nullopt if two of them use the same.
  std::optional<std::vector<bool>> taken_by(const std::vector<AgentRoute>& fixed) const {
    std::vector<bool> taken(own_column());
    for (std::size_t agent = 0; agent < fixed.size(); ++agent) {
      const int resource =
          problem_.agents[agent].ends[static_cast<std::size_t>(fixed[agent].end)].resource;
      if (resource == RouteEnd::kNoResource) continue;
      if (taken[static_cast<std::size_t>(resource)]) return std::nullopt;
      taken[static_cast<std::size_t>(resource)] = true;
    }
    return taken;
  }

  std::vector<std::vector<std::int64_t>> costs(const std::vector<const Row*>& rows,
                                               const std::vector<bool>& taken) const {
    std::vector<std::vector<std::int64_t>> matrix(
        rows.size(), std::vector<std::int64_t>(own_column() + rows.size(), kForbidden));
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t column = 0; column <= own_column(); ++column) {
        const Time cost = rows[i]->costs[column];
        if (cost >= kNever || (column < own_column() && taken[column])) continue;
        matrix[i][column < own_column() ? column : own_column() + i] = cost;
      }
    return matrix;
  }

  const AgentRoute& route_at(const Row& row, int column) const {
    return row.routes[std::min(static_cast<std::size_t>(column), own_column())];
  }

  const JointRouteProblem& problem_;
  const Limits& limits_;
  RouteTable table_;
  bool is_built_ = false;
  std::vector<Row> free_;  // by agent: its routes without restrictions
};

}  // namespace

std::unique_ptr<JointRouteSolver> make_joint_route_matching(const JointRouteProblem& problem,
                                                            const Limits& limits) {
  const auto is_small = [](const AgentRoutes& agent) {
    return agent.stops() <= RouteTable::kMaxStops;
  };
  if (!problem.needs.empty() || !std::ranges::all_of(problem.agents, is_small)) return nullptr;
  return std::make_unique<JointRouteMatching>(problem, limits);
}

}  // namespace grove::detail
