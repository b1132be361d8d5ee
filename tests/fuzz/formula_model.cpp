// SPDX-License-Identifier: MIT
#include "tests/fuzz/formula_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "cores/sat_solver.h"
#include "model/limits.h"
#include "planning/constraint.h"
#include "planning/corridors.h"

namespace grove::detail::fuzz {
namespace {

// Evaluates the definitions of variables for a plan.
class Meanings {
 public:
  Meanings(const Instance& instance, const Plan& plan)
      : instance_(instance), world_(instance.world()), corridors_(instance.world()) {
    for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent) {
      paths_.push_back(walked_path(instance, agent, plan.agents[static_cast<std::size_t>(agent)]));
      last_.push_back(static_cast<Time>(paths_.back().size()) - 1);
      while (last_.back() > 0 && place(agent, last_.back() - 1) == place(agent, last_.back()))
        --last_.back();
    }
  }

  // The value of the variable; nullopt if it is left open.
  std::optional<bool> value(const std::string& definition) const {
    std::istringstream words(definition);
    std::string kind;
    AgentIndex agent = 0;
    words >> kind;
    if (kind == "used") return is_used(words);
    words >> agent;
    if (kind == "meets") return satisfies(world_, paths_.at(agent), constraint(words), corridors_);
    if (kind == "node") return node(agent, words);
    if (kind != "visit" && kind != "last" && kind != "rests") return std::nullopt;
    Place place = 0;
    words >> place;
    const Time time = until(words);
    const Time last = last_.at(agent);
    if (kind == "visit") return time < last && this->place(agent, time) == place;
    const bool is_there = this->place(agent, last) == place;
    return is_there && (kind == "last" ? time == last : last <= time);
  }

 private:
  Place place(AgentIndex agent, Time time) const {
    return world_.place(paths_.at(agent).at(static_cast<std::size_t>(time)));
  }

  // False if the agent is elsewhere at this time, or makes its last arrival at another time.
  std::optional<bool> node(AgentIndex agent, std::istringstream& words) const {
    Time time = 0;
    Place place = 0;
    words >> time >> place;
    std::optional<Time> since;
    for (std::string word; words >> word;)
      if (word == "since") words >> since.emplace();
    const Time last = last_.at(agent);
    const bool is_arrival_right = since ? *since == last : time < last;
    if (!is_arrival_right || this->place(agent, std::min(time, last)) != place) return false;
    return std::nullopt;
  }

  // True if an agent that chooses among goals rests on this one.
  bool is_used(std::istringstream& words) const {
    Place goal = 0;
    words >> goal;
    for (AgentIndex agent = 0; agent < instance_.agent_count(); ++agent)
      if (!instance_.agent(agent).goals.empty() && place(agent, last_.at(agent)) == goal)
        return true;
    return false;
  }

  static Time until(std::istringstream& words) {
    std::string word;
    words >> word;
    return word == "inf" ? kNever : std::stoi(word);
  }

  static Constraint constraint(std::istringstream& words) {
    std::string kind;
    Constraint c;
    words >> kind;
    if (kind == "move" || kind == "pass") words >> c.from;
    words >> c.cell;
    if (kind == "norest" || kind == "rest") {
      c.kind = kind == "rest" ? ConstraintKind::kRestBy : ConstraintKind::kNoRestBy;
      c.end = until(words);
      return c;
    }
    if (kind == "pass") c.kind = ConstraintKind::kNoTraversal;
    words >> c.begin;
    c.end = until(words);
    return c;
  }

  const Instance& instance_;
  const World& world_;
  const Corridors corridors_;
  std::vector<Path> paths_;
  std::vector<Time> last_;  // by agent: its last arrival
};

bool defines_variable(const std::string& line) {
  constexpr std::array<std::string_view, 13> kKinds{
      "within ", "active ", "visit ", "last ",   "rests ", "node ", "meets ",
      "counts ", "skips ",  "used ",  "inside ", "ends ",  "count "};
  return std::ranges::any_of(kKinds, [&](auto kind) { return line.starts_with(kind); });
}

}  // namespace

std::vector<std::string> definitions_only(std::span<const std::string> certificate, Cost cost) {
  std::vector<std::string> lines;
  bool has_formula = false;
  for (const std::string& line : certificate) {
    has_formula |= line == "formula";
    if (line.starts_with("theorem "))
      lines.push_back(fmt::format("theorem {}", cost + 1));
    else if (!line.starts_with("clause") && !line.starts_with("drop ") &&
             !line.starts_with("core "))
      lines.push_back(line);
  }
  return has_formula ? lines : std::vector<std::string>();
}

bool has_model(const std::filesystem::path& clauses, std::span<const std::string> definitions,
               const Instance& instance, const Plan& plan) {
  std::ifstream in(clauses);
  std::string word;
  std::int64_t variables = 0, count = 0;
  in >> word >> word >> variables >> count;
  if (!in) throw std::runtime_error("the checker has written no clauses");
  const Limits limits;
  SatSolver solver(limits);
  for (std::int64_t i = 0; i < variables; ++i) solver.new_variable(FormulaKind::kActive, {0});
  std::vector<Literal> clause;
  for (Literal literal = 0; in >> literal;) {
    if (literal != 0) {
      clause.push_back(literal);
      continue;
    }
    solver.add(clause);
    clause.clear();
    --count;
  }
  if (count != 0) throw std::runtime_error("the clauses of the checker are incomplete");
  const Meanings meanings(instance, plan);
  std::vector<Literal> assumptions;
  Literal variable = 0;
  for (const std::string& line : definitions) {
    if (!defines_variable(line)) continue;
    ++variable;
    if (const auto value = meanings.value(line))
      assumptions.push_back(*value ? variable : -variable);
  }
  return solver.solve(assumptions, 1'000'000) == SatSolver::Result::kSatisfiable;
}

}  // namespace grove::detail::fuzz
