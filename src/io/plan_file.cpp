// SPDX-License-Identifier: MIT
#include "io/plan_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/json_text.h"
#include "io/json_value.h"
#include "io/known_keys.h"
#include "io/path_entry.h"
#include "io/text_file.h"
#include "model/assert.h"
#include "model/check.h"

namespace grove::detail {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::int64_t kLargestCost = kInfiniteCost;

// --- writing ---

OrderedJson omega_json(const Omega& omega) {
  if (omega.is_infinite()) return "inf";
  return OrderedJson::parse(omega.to_string());  // shortest decimal
}

OrderedJson agent_json(const Instance& instance, AgentIndex index, const AgentPlan& plan) {
  OrderedJson sequence = OrderedJson::array();
  for (TaskIndex task : plan.sequence) sequence.push_back(instance.task(task).id);
  OrderedJson path = OrderedJson::array();
  const Agent& agent = instance.agent(index);
  for (const State state : plan.path)
    path.push_back(pose_json(instance.map(), agent.motion, instance.pose_of(state)));
  OrderedJson json{{"id", agent.id}, {"sequence", std::move(sequence)}, {"cost", plan.cost}};
  if (!plan.work.empty()) {
    OrderedJson& work = json["work"] = OrderedJson::array();
    for (const WorkTime& w : plan.work)
      work.push_back({{"task", instance.task(w.task).id}, {"begin", w.begin}, {"end", w.end}});
  }
  json["path"] = std::move(path);
  return json;
}

OrderedJson stats_json(const Stats& stats) {
  OrderedJson json = OrderedJson::object();
  for (const auto& [name, value] : stats.texts) json[name] = value;
  for (const auto& [name, value] : stats.measures) json[name] = value;
  for (const auto& [name, value] : stats.counts) json[name] = value;
  return json;
}

OrderedJson solution_json(const Instance& instance, const Solution& solution) {
  OrderedJson json;
  json["status"] = to_string(solution.status);
  if (solution.plan) json["cost"] = solution.plan->cost;
  json["lower_bound"] = solution.lower_bound;
  json["omega"] = omega_json(solution.omega);
  if (!instance.may_follow() || !solution.may_follow)
    json["following"] = false;  // the claims hold only without following
  if (solution.plan) {
    OrderedJson& agents = json["agents"] = OrderedJson::array();
    for (std::size_t i = 0; i < solution.plan->agents.size(); ++i)
      agents.push_back(agent_json(instance, static_cast<AgentIndex>(i), solution.plan->agents[i]));
  }
  json["stats"] = stats_json(solution.stats);
  return json;
}

// --- reading ---

using IndexById = std::unordered_map<std::string, std::int32_t>;

template <typename Items>
IndexById index_by_id(const Items& items) {
  IndexById index;
  for (const auto& item : items) index.emplace(item.id, static_cast<std::int32_t>(index.size()));
  GROVE_CHECK(index.size() == items.size(), "the ids of an instance are distinct");
  return index;
}

std::int32_t find_id(const IndexById& index, const JsonValue& id, std::string_view kind) {
  const auto it = index.find(id.text());
  if (it == index.end())
    id.fail(fmt::format("there is no {} '{}' in the instance; expected the id of one of its {}s",
                        kind, id.text(), kind));
  return it->second;
}

Status read_status(const JsonValue& value) {
  const auto status = parse_status(value.text());
  if (!status) value.fail_expected("optimal, bounded, feasible, infeasible or unknown");
  return *status;
}

Omega read_omega(const JsonValue& value) {
  const bool is_infinite = value.json().is_string() && value.text() == "inf";
  if (is_infinite) return Omega::infinite();
  try {
    if (value.json().is_number()) return Omega::parse(value.json().dump());
  } catch (const std::invalid_argument&) {
    // Fall through: one message for all cases.
  }
  value.fail_expected("a number from 0 to 1e6 with at most 9 decimals, or \"inf\"");
}

class PlanReader {
 public:
  explicit PlanReader(const Instance& instance)
      : instance_(instance),
        agents_(index_by_id(instance.agents())),
        tasks_(index_by_id(instance.tasks())) {}

  Plan read(const JsonValue& root, AgentOrder& order) const {
    Plan plan;
    plan.cost = root.member("cost").integer(0, kLargestCost);
    plan.agents.resize(instance_.agent_count());
    std::vector<bool> seen(instance_.agent_count());
    const JsonValue agents = root.member("agents");
    for (std::size_t i = 0; i < agents.size(); ++i) {
      const JsonValue id = agents.element(i).member("id");
      const AgentIndex index = find_id(agents_, id, "agent");
      if (seen[index])
        id.fail(fmt::format("agent '{}' appears twice; expected each agent once", id.text()));
      seen[index] = true;
      order.push_back(index);
      plan.agents[index] = read_agent(index, agents.element(i));
    }
    return plan;
  }

 private:
  AgentPlan read_agent(AgentIndex agent, const JsonValue& value) const {
    AgentPlan plan;
    plan.cost = static_cast<Time>(value.member("cost").integer(0, kNever));
    const JsonValue sequence = value.member("sequence");
    for (std::size_t k = 0; k < sequence.size(); ++k)
      plan.sequence.push_back(find_id(tasks_, sequence.element(k), "task"));
    const JsonValue path = value.member("path");
    plan.path.reserve(path.size());
    for (std::size_t t = 0; t < path.size(); ++t)
      plan.path.push_back(instance_.state_of(
          agent, read_pose(instance_.map(), instance_.agent(agent).motion, path.element(t))));
    GROVE_ASSERT(std::ranges::all_of(plan.path,
                                     [&](State state) {
                                       return instance_.world().kind(state) ==
                                              instance_.agent(agent).kind;
                                     }),
                 "a path holds base states of the agent's kind");
    if (const auto work = value.find("work"))
      for (std::size_t k = 0; k < work->size(); ++k)
        plan.work.push_back(read_work(work->element(k)));
    std::ranges::stable_sort(plan.work, {}, &WorkTime::begin);
    return plan;
  }
  WorkTime read_work(const JsonValue& value) const {
    const auto time = [&](const char* key) {
      return static_cast<Time>(value.member(key).integer(-kNever, kNever));
    };
    return {find_id(tasks_, value.member("task"), "task"), time("begin"), time("end")};
  }

  const Instance& instance_;
  IndexById agents_;
  IndexById tasks_;
};

// Converts a counter's name in plan files from versions before 0.1 to its current name.
std::string current_counter(const std::string& name) {
  static const std::unordered_map<std::string, std::string> kRenamed{
      {"batches", "node_batches"},
      {"facts_sent", "learned_bounds_sent"},
      {"gain_configurations", "gain_lacam"},
      {"gain_neighborhood", "gain_lns"},
      {"gain_priorities", "gain_prioritized"},
      {"helps", "assists"},
      {"joint_pairs", "joint_mdd_nodes"},
      {"path_sets_asked", "mdd_queries"},
      {"path_sets_known", "mdd_hits"},
      {"plans_configurations", "plans_lacam"},
      {"plans_neighborhood", "plans_lns"},
      {"plans_priorities", "plans_prioritized"},
      {"prices_asked", "branching_cost_queries"},
      {"prices_known", "branching_cost_hits"},
      {"prices_of_ranks", "remote_pricings"},
      {"primal_joint_steps", "primal_lacam_steps"},
      {"primal_neighborhoods", "primal_lns_iterations"},
      {"silent_ranks", "unresponsive_ranks"},
      {"splits_bar", "splits_vertex_edge"},
      {"splits_no_rest_by", "splits_cost"},
      {"splits_no_traversal", "splits_corridor"},
      {"splits_rest_by", "splits_target"},
      {"splits_stop_is_not", "splits_sequence"},
      {"trees_prepared_in_vain", "trees_prepared_unused"},
  };
  const auto found = kRenamed.find(name);
  return found == kRenamed.end() ? name : found->second;
}

Stats read_stats(const JsonValue& value) {
  if (!value.json().is_object()) value.fail_expected("an object");
  Stats stats;
  for (const auto& [name, entry] : value.json().items()) {
    if (entry.is_number_integer()) stats.counts[current_counter(name)] = entry.get<std::int64_t>();
    if (entry.is_number_float()) stats.measures[name] = entry.get<double>();
    if (entry.is_string()) stats.texts[name] = entry.get<std::string>();
  }
  return stats;
}

}  // namespace

std::string solution_text(const Instance& instance, const Solution& solution) {
  require_valid_plan(instance, solution);
  return dump_by_lines(solution_json(instance, solution));
}

void write_solution(const std::filesystem::path& path, const Instance& instance,
                    const Solution& solution, Durability durability) {
  write_file_atomically(path, solution_text(instance, solution), durability);
}

Solution read_solution(const std::filesystem::path& path, const Instance& instance,
                       AgentOrder* order) {
  return parse_solution(read_text(path), path.string(), instance, order);
}

Solution parse_solution(std::string_view text, const std::string& name, const Instance& instance,
                        AgentOrder* order) {
  const JsonDocument document(text, name);
  const JsonValue root = document.root();
  require_known_keys(root, plan_keys());

  Solution solution;
  solution.status = read_status(root.member("status"));
  solution.lower_bound =
      root.member("lower_bound").integer(std::numeric_limits<Cost>::min(), kLargestCost);
  solution.omega = read_omega(root.member("omega"));
  if (const auto following = root.find("following")) solution.may_follow = following->boolean();
  const bool has_plan = root.find("cost") || root.find("agents");
  AgentOrder agents;
  if (has_plan) solution.plan = PlanReader(instance).read(root, agents);
  if (order) *order = std::move(agents);
  if (const auto stats = root.find("stats")) solution.stats = read_stats(*stats);
  return solution;
}

std::vector<Violation> check_in_file(const Instance& instance, const Solution& solution,
                                     const AgentOrder& order, std::size_t limit) {
  constexpr std::string_view kAgents = "/agents/";
  std::vector<Violation> violations = check(instance, solution, limit);
  for (Violation& violation : violations) {
    std::string& pointer = violation.json_pointer;
    if (!pointer.starts_with(kAgents)) continue;
    const std::size_t end = std::min(pointer.find('/', kAgents.size()), pointer.size());
    const auto agent =
        static_cast<AgentIndex>(std::stoi(pointer.substr(kAgents.size(), end - kAgents.size())));
    const auto place = std::ranges::find(order, agent);
    if (place != order.end())
      pointer.replace(kAgents.size(), end - kAgents.size(), std::to_string(place - order.begin()));
    else if (!order.empty())
      pointer = "/agents";
  }
  return violations;
}

}  // namespace grove::detail
