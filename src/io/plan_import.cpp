// SPDX-License-Identifier: MIT
#include "io/plan_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/input_error.h"
#include "io/plan_file.h"
#include "io/plan_steps.h"
#include "io/text_file.h"
#include "io/yaml_value.h"
#include "model/assert.h"
#include "model/parse_number.h"

namespace grove::detail {
namespace {

using Paths = std::vector<Path>;  // by AgentIndex

// Reads a line from left to right. Except for take_if(), the functions take_...() throw InputError
// with the position if the expected item is missing.
class LineReader {
 public:
  LineReader(const std::filesystem::path& path, std::size_t number, std::string_view line)
      : path_(path), number_(number), line_(line), rest_(line) {}

  bool at_end() const { return rest_.empty(); }

  bool take_if(std::string_view text) {
    if (!rest_.starts_with(text)) return false;
    rest_.remove_prefix(text.size());
    return true;
  }
  void take(std::string_view text) {
    if (!take_if(text)) fail(fmt::format("expected '{}'", text));
  }
  std::int64_t take_integer() {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc() || value < 0) fail("expected an integer of at least 0");
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }
  // Reads a cell such as "(3,4)": column and row or, if `row_first`, row and column.
  Cell take_cell(const Grid& grid, bool row_first) {
    const std::string_view before = rest_;
    take("(");
    const std::int64_t first = take_integer();
    take(",");
    const std::int64_t second = take_integer();
    take(")");
    const auto [x, y] = row_first ? std::pair(second, first) : std::pair(first, second);
    if (x < grid.width() && y < grid.height())
      return grid.cell({static_cast<int>(x), static_cast<int>(y)});
    rest_ = before;
    fail(fmt::format("column {}, row {} is outside the map, which has {} columns and {} rows", x, y,
                     grid.width(), grid.height()));
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(path_.string(), line_and_column(number_, 1 + line_.size() - rest_.size()),
                     message);
  }

 private:
  const std::filesystem::path& path_;
  const std::size_t number_;  // from 1
  const std::string_view line_;
  std::string_view rest_;
};

// True if the text is JSON (begins with { or [) or is blank.
bool is_json(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos || text[first] == '{' || text[first] == '[';
}

bool is_visualizer_text(std::string_view line) {
  return line.starts_with("agents=") || line == "solution=";
}

bool is_schedule(std::string_view line) {
  return line == "schedule:";
}

bool is_path_list(std::string_view line) {
  return line.starts_with("Agent ");
}

Paths read_path_lists(const std::filesystem::path& path, const Instance& instance,
                      const std::vector<std::string_view>& lines) {
  Paths paths(instance.agent_count());
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (lines[k].empty()) continue;
    LineReader line(path, k + 1, lines[k]);
    line.take("Agent ");
    const std::int64_t agent = line.take_integer();
    if (agent >= instance.agent_count())
      line.fail(fmt::format("there is no agent {} in the instance; expected less than {}", agent,
                            instance.agent_count()));
    if (!paths[agent].empty()) line.fail(fmt::format("agent {} appears twice", agent));
    line.take(":");
    line.take_if(" ");
    while (!line.at_end()) {
      paths[agent].push_back(line.take_cell(instance.grid(), true));
      if (!line.at_end() && !line.take_if(" ")) line.take("->");
    }
  }
  return paths;
}

// The content of a file: paths, and claims about them.
struct ClaimedPaths {
  std::optional<Paths> paths;  // nullopt: the file has no plan
  std::optional<Cost> cost;
  std::optional<Cost> lower_bound;
};

// The agent with this id. If there is none, "agent7" means the agent with number 7, because some
// tools do not use names.
AgentIndex agent_called(const Instance& instance, const YamlValue& name) {
  const std::string text = name.text();
  const auto agents = instance.agents();
  const auto it = std::ranges::find(agents, text, &Agent::id);
  if (it != agents.end()) return static_cast<AgentIndex>(it - agents.begin());
  constexpr std::string_view kAgent = "agent";
  const auto number =
      text.starts_with(kAgent)
          ? parse_number<AgentIndex>(std::string_view(text).substr(kAgent.size()), 0)
          : std::nullopt;
  if (!number || *number >= instance.agent_count())
    name.fail(
        fmt::format("found '{}', which is not an agent of the instance; expected the name of an "
                    "agent, or agent0 to agent{}",
                    one_line(text), instance.agent_count() - 1));
  return *number;
}

Path read_schedule_of_agent(const Instance& instance, const YamlValue& steps) {
  const Grid& grid = instance.grid();
  Path path;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const YamlValue step = steps.element(k);
    const auto t = step.member("t");
    if (t.integer(0, std::numeric_limits<int>::max()) != static_cast<int>(k))
      t.fail(fmt::format("expected t: {}, because steps are consecutive", k));
    path.push_back(grid.cell({step.member("x").integer(0, grid.width() - 1),
                              step.member("y").integer(0, grid.height() - 1)}));
  }
  return path;
}

// Reads a schedule of libMultiRobotPlanning, MGCBS or ITA-CBS.
ClaimedPaths read_schedule(const std::filesystem::path& path, const Instance& instance,
                           const std::string& name) {
  const YamlDocument document(path);
  ClaimedPaths claimed;
  if (const auto statistics = document.root().find("statistics"))
    if (const auto cost = statistics->find("cost"))
      claimed.cost = cost->integer(0, std::numeric_limits<int>::max());
  const YamlValue schedule = document.root().member("schedule");
  if (schedule.node().IsNull()) return claimed;
  claimed.paths.emplace(instance.agent_count());
  for (const auto& pair : schedule.node()) {
    const YamlValue key(pair.first, name);
    Path& agent = (*claimed.paths)[agent_called(instance, key)];
    if (!agent.empty()) key.fail("an agent appears more than once");
    agent = read_schedule_of_agent(instance, {pair.second, name});
  }
  return claimed;
}

ClaimedPaths read_visualizer_text(const std::filesystem::path& path, const Instance& instance,
                                  const std::vector<std::string_view>& lines) {
  ClaimedPaths text;
  std::size_t k = 0;
  for (; k < lines.size() && lines[k] != "solution="; ++k) {
    LineReader line(path, k + 1, lines[k]);
    if (line.take_if("agents=") && line.take_integer() != instance.agent_count())
      line.fail(fmt::format("expected {} agents, as in the instance", instance.agent_count()));
    if (line.take_if("soc=")) text.cost = line.take_integer();
    if (line.take_if("soc_lb=")) text.lower_bound = line.take_integer();
    if (line.take_if("solved=0")) return {};
  }
  if (k == lines.size()) return {};
  text.paths.emplace(instance.agent_count());
  for (std::size_t t = 0; ++k < lines.size(); ++t) {
    LineReader line(path, k + 1, lines[k]);
    line.take(fmt::format("{}:", t));
    for (Path& agent : *text.paths) {
      agent.push_back(line.take_cell(instance.grid(), false));
      if (!line.at_end()) line.take(",");
    }
    if (!line.at_end()) line.fail("expected the end of the line, after all agents of the instance");
  }
  return text;
}

// The agent's tasks, also those that it visits by choice, in the order of their first visits. For
// an agent without a destination and without stated visits, a task on the last place of the path
// comes last.
std::vector<TaskIndex> order_of_tasks(const Instance& instance, const Agent& agent,
                                      const Path& path, const std::vector<WorkTime>& visits) {
  std::vector<TaskIndex> tasks = agent.tasks;
  for (const WorkTime& visit : visits)
    if (std::ranges::count(tasks, visit.task) == 0) tasks.push_back(visit.task);
  const bool has_last = !agent.has_destination() && visits.empty() && !path.empty();
  std::ranges::stable_sort(tasks, {}, [&](TaskIndex task) {
    const Cell cell = instance.task(task).cell;
    const bool is_last = has_last && cell == path.back();
    const auto visit = std::ranges::find(visits, task, &WorkTime::task);
    const std::ptrdiff_t time =
        visit != visits.end() ? visit->end : std::ranges::find(path, cell) - path.begin();
    return std::pair(is_last, time);
  });
  return tasks;
}

Solution solution_of(const Instance& instance, ClaimedPaths text) {
  Solution solution;
  solution.omega = Omega::infinite();
  solution.lower_bound = text.lower_bound.value_or(0);
  if (!text.paths) return solution;
  Plan& plan = solution.plan.emplace(plan_of_paths(instance, *std::move(text.paths)));
  solution.status = plan.cost == solution.lower_bound ? Status::kOptimal : Status::kFeasible;
  plan.cost = text.cost.value_or(plan.cost);
  return solution;
}

Time finish_of(const Path& path) {
  return static_cast<Time>(std::max<std::size_t>(until_rest(path).size(), 1) - 1);
}

void require_no_stated_choice(const std::filesystem::path& path, const Instance& instance) {
  const auto has_choice = [](const Task& task) { return !task.needs_all(); };
  const auto found = std::ranges::find_if(instance.tasks(), has_choice);
  if (found != instance.tasks().end())
    throw InputError(path.string(), "line 1",
                     fmt::format("expected a plan file (JSON), since task '{}' of the instance has "
                                 "a choice of agents, and other formats do not state who visits it",
                                 found->id));
}

void recompute_costs(Plan& plan) {
  plan.cost = 0;
  for (AgentPlan& agent : plan.agents) {
    agent.cost = finish_of(agent.path);
    plan.cost += agent.cost;
  }
}

// Replaces the claimed omega, lower bound and status by those of a plan without a bound.
void forget_claims(Solution& solution) {
  solution.omega = Omega::infinite();
  solution.lower_bound = 0;
  if (!solution.plan) return;
  solution.status = solution.plan->cost == 0 ? Status::kOptimal : Status::kFeasible;
}

}  // namespace

Plan plan_of_paths(const Instance& instance, std::vector<Path> paths, Visits visits) {
  GROVE_CHECK(std::ssize(paths) == instance.agent_count(), "there is one path for each agent");
  visits.resize(paths.size());
  Plan plan;
  for (const Agent& agent : instance.agents()) {
    Path& path = paths[plan.agents.size()];
    std::vector<WorkTime>& work = visits[plan.agents.size()];
    std::ranges::stable_sort(work, {}, &WorkTime::begin);
    Time finish = finish_of(path);
    for (const WorkTime& visit : work) finish = std::max(finish, visit.end);
    plan.cost += finish;
    auto tasks = order_of_tasks(instance, agent, path, work);
    plan.agents.push_back({finish, std::move(tasks), std::move(path), std::move(work)});
  }
  return plan;
}

bool paths_are_places(const Instance& instance) {
  return std::ranges::none_of(instance.agents(),
                              [](const Agent& agent) { return agent.motion.turn_steps > 0; });
}

bool plans_are_paths(const Instance& instance) {
  return paths_are_places(instance) &&
         std::ranges::none_of(instance.tasks(), &Task::has_stated_visits);
}

RecountedPlan read_and_recount(const std::filesystem::path& path, const Instance& instance) {
  ClaimedPlan claimed = read_plan_of_any_tool(path, instance);
  RecountedPlan result;
  const auto claims = [&](const char* what) {
    return std::ranges::find(claimed.unclaimed, what) == claimed.unclaimed.end();
  };
  if (claimed.solution.plan && claims("cost")) result.claimed_cost = claimed.solution.plan->cost;
  if (claims("lower bound")) result.claimed_lower_bound = claimed.solution.lower_bound;
  result.solution = std::move(claimed.solution);
  if (result.solution.plan && plans_are_paths(instance)) recompute_costs(*result.solution.plan);
  forget_claims(result.solution);
  return result;
}

ClaimedPlan read_plan_of_any_tool(const std::filesystem::path& path, const Instance& instance) {
  const std::string content = read_text(path);
  if (is_json(content)) {
    ClaimedPlan plan;
    plan.solution = parse_solution(content, path.string(), instance, &plan.order);
    return plan;
  }
  if (!instance.is_on_grid())
    throw InputError(path.string(), "line 1",
                     "expected a plan file (JSON), since the instance is on a roadmap");
  require_no_stated_choice(path, instance);
  const std::vector<std::string_view> lines = split_lines(content);
  ClaimedPaths text;
  if (std::ranges::any_of(lines, is_schedule)) {
    text = read_schedule(path, instance, path.string());
  } else if (std::ranges::any_of(lines, is_path_list)) {
    text.paths = read_path_lists(path, instance, lines);
  } else if (std::ranges::any_of(lines, is_visualizer_text)) {
    text = read_visualizer_text(path, instance, lines);
  } else {
    throw InputError(path.string(), "line 1",
                     "expected a plan file (JSON), paths as 'Agent 0: (row,column)->', the text of "
                     "lacam, with 'solution=', or YAML with 'schedule:'");
  }
  ClaimedPlan plan;
  if (!text.cost) plan.unclaimed.emplace_back("cost");
  if (!text.lower_bound) plan.unclaimed.emplace_back("lower bound");
  if (instance.task_count() > 0) plan.unclaimed.emplace_back("order of tasks");
  plan.solution = solution_of(instance, std::move(text));
  return plan;
}

}  // namespace grove::detail
