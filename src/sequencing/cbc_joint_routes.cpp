// SPDX-License-Identifier: MIT
// Finds joint routes by an integer program with CBC, as CBS-TS does (arXiv 2510.21738). It is not
// limited to few tasks, and serves as an independent check of the dynamic program.
//
// *Formulation.* The program has 0-1 variables for the legs of each agent without a fixed route:
// from its start (for the agent of the class: from the end of the prefix) to stops, between stops,
// and to its ends.
//
//   minimize  sum of costs,
//   each agent leaves its start once,
//   each agent leaves each stop as often as it enters it: at most once, exactly once if it must
//   visit the stop,
//   an end requires one of its stops `any_of`,
//   each shared task gets the visits that it needs beyond those of the fixed routes and of the
//   prefix,
//   each resource is used at most once, and not if a fixed route uses it.
//
// The legs of an agent then form a path from its start to one end, and perhaps cycles that are not
// connected with the path.
//
// *Subtour elimination.* As in cbc_rtsp.cpp, rows against such cycles are added between solves. For
// an agent, a set C of stops and a stop c of C:
//
//   sum of x within C <= sum of visits to the stops of C except c.
//
// A path satisfies the row: if it visits the stops V of C, it has at most |V| - 1 legs within C,
// and none if V is empty. A solution in which C is not connected with the start enters each stop of
// C only from C, so it violates the row if it visits c. A solution without cycles is optimal for
// the full program, because it is optimal for a program with fewer rows.
#include <CoinPackedMatrix.hpp>
#include <CoinPackedVector.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "sequencing/cbc_solver.h"
#include "sequencing/joint_route_solver.h"

namespace grove::detail {
namespace {

// The program of one class.
class JointRouteProgram {
 public:
  JointRouteProgram(const JointRouteProblem& problem, const JointRouteClass& joint_class,
                    const Limits& limits)
      : problem_(problem), class_(joint_class), limits_(limits) {
    cbc::prepare(solver_, limits_);
    taken_.resize(static_cast<std::size_t>(problem_.resources));
    needs_ = problem_.needs;
    for (int agent = 0; agent < first(); ++agent) subtract_fixed(agent);
    subtract_visits(of(first()), class_.prefix);
    for (int agent = first(); agent < agents(); ++agent) add_columns(agent);
    for (int agent = first(); agent < agents(); ++agent) {
      add_flow_rows(agent);
      add_end_rows(agent);
    }
    add_need_rows();
    add_resource_rows();
    load();
  }

  cbc::Outcome solve() {
    using cbc::Outcome;
    if (is_infeasible_) return Outcome::kInfeasible;
    solver_.initialSolve();
    while (!stopped() && solver_.isProvenOptimal() && cut_off_cycles(solver_.getColSolution()))
      solver_.resolve();
    if (!stopped() && solver_.isProvenPrimalInfeasible()) return Outcome::kInfeasible;
    for (std::size_t leg = 0; leg < legs_.size(); ++leg) solver_.setInteger(static_cast<int>(leg));
    do {
      solution_ = cbc::branch_and_bound(solver_, limits_);
    } while (solution_.outcome == Outcome::kOptimal && cut_off_cycles(solution_.values.data()));
    return solution_.outcome;
  }

  // Returns the joint route that the solution describes. Throws std::runtime_error if it describes
  // none, or has another cost.
  JointRoute route() const {
    JointRoute joint{0, class_.fixed};
    for (int agent = first(); agent < agents(); ++agent) joint.routes.push_back(route_of(agent));
    Cost cost_of_legs = -Cost{legs_cost(of(first()), class_.prefix)};
    for (int agent = 0; agent < agents(); ++agent) {
      const Time cost = route_cost(of(agent), joint.routes[static_cast<std::size_t>(agent)]);
      if (cost >= kNever) cbc::fail("a route that does not exist");
      joint.cost += cost;
      if (agent >= first()) cost_of_legs += cost;
    }
    if (std::abs(static_cast<double>(cost_of_legs) - solution_.objective) > 0.5)
      cbc::fail("a wrong cost");
    return joint;
  }

 private:
  // A leg from a stop, or from the start (AgentRoutes::stops()), to a stop or an end.
  struct Leg {
    int agent;
    int from;
    int to;
    bool is_end;
  };
  struct Row {
    std::vector<std::pair<int, double>> entries;  // by column
    double least;
    double most;
  };

  int agents() const { return static_cast<int>(problem_.agents.size()); }
  int first() const { return class_.next_agent(); }
  const AgentRoutes& of(int agent) const {
    return problem_.agents[static_cast<std::size_t>(agent)];
  }
  const RouteEnd& end_of(const Leg& leg) const {
    return of(leg.agent).ends[static_cast<std::size_t>(leg.to)];
  }
  bool stopped() const { return limits_.stop_requested(); }
  StopSet visited_before(int agent) const {
    return agent == first() ? stops_of(class_.prefix) : StopSet{0};
  }

  void subtract_visits(const AgentRoutes& agent, const Sequence& stops) {
    for (const Stop stop : stops)
      if (const int task = agent.tasks[stop]; task >= 0) --needs_[static_cast<std::size_t>(task)];
  }

  void subtract_fixed(int agent) {
    const AgentRoute& route = class_.fixed[static_cast<std::size_t>(agent)];
    subtract_visits(of(agent), route.stops);
    const RouteEnd& end = of(agent).ends[static_cast<std::size_t>(route.end)];
    if (end.resource == RouteEnd::kNoResource) return;
    const auto resource = static_cast<std::size_t>(end.resource);
    is_infeasible_ = is_infeasible_ || taken_[resource];
    taken_[resource] = true;
  }

  void add_leg(const Leg& leg, Time cost) {
    if (cost >= kNever) return;
    legs_.push_back(leg);
    costs_.push_back(cost);
  }

  void add_columns(int agent) {
    const AgentRoutes& routes = of(agent);
    const bool is_first = agent == first();
    const StopSet before = visited_before(agent);
    const int last = is_first && !class_.prefix.empty() ? class_.prefix.back() : routes.stops();
    const StopSet left = all_stops(routes.stops()) & ~before;
    const StopSet next = is_first ? left & ~class_.forbidden_stops : left;
    for_each_stop(next, [&](int to) {
      add_leg({agent, routes.stops(), to, false}, routes.legs(last, to));
    });
    for_each_stop(left, [&](int from) {
      for_each_stop(left & ~bit(from), [&](int to) {
        add_leg({agent, from, to, false}, routes.legs(from, to));
      });
    });
    for (int end = 0; end < static_cast<int>(routes.ends.size()); ++end) {
      const RouteEnd& by = routes.ends[static_cast<std::size_t>(end)];
      const bool is_taken =
          by.resource != RouteEnd::kNoResource && taken_[static_cast<std::size_t>(by.resource)];
      if (is_taken) continue;
      if (!is_first || std::ranges::count(class_.forbidden_ends, end) == 0)
        add_leg({agent, routes.stops(), end, true}, end_cost(routes, by, last));
      for_each_stop(left, [&](int from) {
        add_leg({agent, from, end, true}, by.from_stops[static_cast<std::size_t>(from)]);
      });
    }
  }

  // Adds a row with an entry for each leg for which `entry` returns a number other than 0.
  template <class Entry>
  void add_row(double least, double most, const Entry& entry) {
    Row row{{}, least, most};
    for (std::size_t leg = 0; leg < legs_.size(); ++leg)
      if (const double value = entry(legs_[leg]); value != 0)
        row.entries.emplace_back(static_cast<int>(leg), value);
    if (!row.entries.empty())
      rows_.push_back(std::move(row));
    else if (least > 0 || most < 0)
      is_infeasible_ = true;
  }
  static bool enters(const Leg& leg, int agent, int stop) {
    return leg.agent == agent && !leg.is_end && leg.to == stop;
  }

  void add_flow_rows(int agent) {
    const AgentRoutes& routes = of(agent);
    add_row(1, 1, [&](const Leg& leg) {
      return leg.agent == agent && leg.from == routes.stops() ? 1.0 : 0.0;
    });
    for_each_stop(all_stops(routes.stops()) & ~visited_before(agent), [&](int stop) {
      const bool is_required = (routes.required & bit(stop)) != 0;
      add_row(is_required ? 1 : 0, 1,
              [&](const Leg& leg) { return enters(leg, agent, stop) ? 1.0 : 0.0; });
      add_row(0, 0, [&](const Leg& leg) {
        if (enters(leg, agent, stop)) return 1.0;
        return leg.agent == agent && leg.from == stop ? -1.0 : 0.0;
      });
    });
  }

  void add_end_rows(int agent) {
    const AgentRoutes& routes = of(agent);
    for (int end = 0; end < static_cast<int>(routes.ends.size()); ++end) {
      const RouteEnd& by = routes.ends[static_cast<std::size_t>(end)];
      const auto is_end = [&](const Leg& leg) {
        return leg.agent == agent && leg.is_end && leg.to == end;
      };
      if (by.any_of != 0 && (by.any_of & visited_before(agent)) == 0)
        add_row(0, kUnbounded, [&](const Leg& leg) {
          if (is_end(leg)) return -1.0;
          return leg.agent == agent && !leg.is_end && (by.any_of & bit(leg.to)) != 0 ? 1.0 : 0.0;
        });
    }
  }

  void add_need_rows() {
    for (int task = 0; task < static_cast<int>(needs_.size()); ++task) {
      const double need = needs_[static_cast<std::size_t>(task)];
      add_row(need, need, [&](const Leg& leg) {
        return !leg.is_end && of(leg.agent).tasks[static_cast<std::size_t>(leg.to)] == task ? 1.0
                                                                                            : 0.0;
      });
    }
  }

  void add_resource_rows() {
    for (int resource = 0; resource < problem_.resources; ++resource)
      add_row(0, 1, [&](const Leg& leg) {
        return leg.is_end && end_of(leg).resource == resource ? 1.0 : 0.0;
      });
  }

  void load() {
    if (is_infeasible_) return;
    std::vector<int> rows;
    std::vector<int> columns;
    std::vector<double> values;
    std::vector<double> least;
    std::vector<double> most;
    for (const Row& row : rows_) {
      for (const auto& [column, value] : row.entries) {
        rows.push_back(static_cast<int>(least.size()));
        columns.push_back(column);
        values.push_back(value);
      }
      least.push_back(row.least);
      most.push_back(row.most == kUnbounded ? solver_.getInfinity() : row.most);
    }
    CoinPackedMatrix matrix(true, rows.data(), columns.data(), values.data(),
                            static_cast<CoinBigIndex>(rows.size()));
    matrix.setDimensions(static_cast<int>(least.size()), static_cast<int>(legs_.size()));
    const std::vector<double> zeros(legs_.size(), 0.0);
    const std::vector<double> ones(legs_.size(), 1.0);
    solver_.loadProblem(matrix, zeros.data(), ones.data(), costs_.data(), least.data(),
                        most.data());
  }

  // Adds a row for each set of stops of an agent that are connected by legs of the solution, but
  // not with the start of the agent. Returns true if there is such a set.
  bool cut_off_cycles(const double* x) {
    bool found = false;
    for (int agent = first(); agent < agents(); ++agent)
      for (const StopSet stops : cycles(agent, x)) {
        forbid_cycle(agent, stops, x);
        found = true;
      }
    return found;
  }

  std::vector<StopSet> cycles(int agent, const double* x) const {
    const int start = of(agent).stops();
    std::vector<int> component(static_cast<std::size_t>(start) + 1);
    std::iota(component.begin(), component.end(), 0);
    const auto root = [&](int stop) {
      while (component[static_cast<std::size_t>(stop)] != stop)
        stop = component[static_cast<std::size_t>(stop)];
      return stop;
    };
    StopSet used = 0;
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      const Leg& leg = legs_[i];
      if (leg.agent != agent || x[i] <= cbc::kIntegral) continue;
      component[static_cast<std::size_t>(root(leg.from))] = root(leg.is_end ? start : leg.to);
      if (leg.from != start) used |= bit(leg.from);
    }
    std::vector<StopSet> members(component.size(), 0);
    for_each_stop(used,
                  [&](int stop) { members[static_cast<std::size_t>(root(stop))] |= bit(stop); });
    members[static_cast<std::size_t>(root(start))] = 0;
    std::erase(members, StopSet{0});
    return members;
  }

  // Excludes the stop with most visits, for which the row is violated most.
  void forbid_cycle(int agent, StopSet stops, const double* x) {
    std::vector<double> visits(static_cast<std::size_t>(of(agent).stops()), 0.0);
    const auto is_inner = [&](const Leg& leg) {
      return leg.agent == agent && !leg.is_end && (stops & bit(leg.to)) != 0;
    };
    for (std::size_t i = 0; i < legs_.size(); ++i)
      if (is_inner(legs_[i])) visits[static_cast<std::size_t>(legs_[i].to)] += x[i];
    const auto excluded = static_cast<int>(std::ranges::max_element(visits) - visits.begin());
    CoinPackedVector row;
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      const Leg& leg = legs_[i];
      if (!is_inner(leg)) continue;
      const bool is_within = leg.from != of(agent).stops() && (stops & bit(leg.from)) != 0;
      const double entry = (is_within ? 1.0 : 0.0) - (leg.to == excluded ? 0.0 : 1.0);
      if (entry != 0) row.insert(static_cast<int>(i), entry);
    }
    solver_.addRow(row, -solver_.getInfinity(), 0.0);
  }

  AgentRoute route_of(int agent) const {
    AgentRoute route;
    if (agent == first()) route.stops = class_.prefix;
    int at = of(agent).stops();
    for (int steps = 0; steps <= of(agent).stops(); ++steps) {
      const Leg& leg = leg_from(agent, at);
      at = leg.to;
      route.end = leg.to;
      if (leg.is_end) return route;
      route.stops.push_back(static_cast<Stop>(leg.to));
    }
    cbc::fail("a route without an end");
  }

  const Leg& leg_from(int agent, int from) const {
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      if (legs_[i].agent != agent || legs_[i].from != from) continue;
      const double value = solution_.values[i];
      if (std::abs(value - std::round(value)) > cbc::kIntegral) cbc::fail("a fraction");
      if (value > 0.5) return legs_[i];
    }
    cbc::fail("a route without an end");
  }

  static constexpr double kUnbounded = 1e30;

  const JointRouteProblem& problem_;
  const JointRouteClass& class_;
  const Limits& limits_;
  std::vector<bool> taken_;  // resources that fixed routes use
  std::vector<int> needs_;   // visits that are left for the legs
  std::vector<Leg> legs_;    // by column
  std::vector<double> costs_;
  std::vector<Row> rows_;
  bool is_infeasible_ = false;
  OsiClpSolverInterface solver_;
  cbc::IntegerSolution solution_;
};

class CbcJointRoutes : public JointRouteSolver {
 public:
  CbcJointRoutes(const JointRouteProblem& problem, const Limits& limits)
      : problem_(problem), limits_(limits) {}

  JointRouteAnswer best(const JointRouteClass& joint_class) override {
    using Kind = JointRouteAnswer::Kind;
    const cbc::SolverLock turn(limits_);
    if (!turn.is_locked()) return {Kind::kStopped};
    JointRouteProgram program(problem_, joint_class, limits_);
    switch (program.solve()) {
      case cbc::Outcome::kStopped:
        return {Kind::kStopped};
      case cbc::Outcome::kInfeasible:
        return {Kind::kInfeasible};
      case cbc::Outcome::kOptimal:
        break;
    }
    return {Kind::kExact, program.route()};
  }

 private:
  const JointRouteProblem& problem_;
  const Limits& limits_;
};

}  // namespace

std::unique_ptr<JointRouteSolver> make_joint_route_program(const JointRouteProblem& problem,
                                                           const Limits& limits) {
  return std::make_unique<CbcJointRoutes>(problem, limits);
}

}  // namespace grove::detail
