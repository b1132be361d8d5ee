// SPDX-License-Identifier: MIT
#include "tools/solve/json_log.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>

#include "tools/common/machine.h"
#include "tools/common/version.h"
#include "tools/solve/constraint_text.h"

namespace grove::detail {
namespace {

using Json = nlohmann::ordered_json;

// Replaces invalid UTF-8 instead of throwing, because file names can contain any bytes.
std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json rounded(double number, double steps) {
  return std::round(number * steps) / steps;
}

Json seconds_json(double seconds) {
  return rounded(seconds, 1e3);
}

Json cost_json(std::optional<Cost> cost) {
  return cost ? Json(*cost) : Json();
}

// Returns (cost - lower_bound) / lower_bound; null if there is no cost or the gap is infinite.
Json gap_json(std::optional<Cost> cost, Cost lower_bound) {
  if (!cost) return {};
  if (*cost == lower_bound) return 0;
  if (lower_bound <= 0) return {};
  return static_cast<double>(*cost - lower_bound) / static_cast<double>(lower_bound);
}

const char* name_of(RunEvent event) {
  switch (event) {
    case RunEvent::kIncumbent:
      return "incumbent";
    case RunEvent::kBound:
      return "bound";
    case RunEvent::kTree:
      return "tree";
    case RunEvent::kProgress:
    case RunEvent::kEnd:
      break;
  }
  return "progress";
}

Json map_json(const Instance& instance) {
  if (const Roadmap* roadmap = instance.roadmap())
    return {{"vertices", roadmap->vertices().size()},
            {"roads", roadmap->roads().size()},
            {"places", roadmap->place_count()}};
  return {{"width", instance.grid().width()}, {"height", instance.grid().height()}};
}

bool turns(const Agent& agent) {
  return agent.motion.turn_steps > 0;
}

bool takes_time(const Task& task) {
  return task.duration > 0;
}

Json stats_json(const Stats& stats) {
  Json json = Json::object();
  for (const auto& [name, value] : stats.texts) json[name] = value;
  for (const auto& [name, value] : stats.measures) json[name] = value;
  for (const auto& [name, value] : stats.counts) json[name] = value;
  return json;
}

Json megabytes_json(std::int64_t bytes) {
  return rounded(static_cast<double>(bytes) / 1e6, 10);
}

Json memory_json(const MemoryUse& memory) {
  return {{"process", megabytes_json(memory.process)},
          {"nodes", megabytes_json(memory.nodes)},
          {"subproblems", megabytes_json(memory.prices)},
          {"mdds", megabytes_json(memory.path_sets)},
          {"dependencies", megabytes_json(memory.groups)}};
}

// Returns an object of arrays with one entry per rank; an entry is null if unknown.
Json ranks_json(const RunStatistics& statistics) {
  Json json{{"nodes", Json::array()},           {"open", Json::array()},
            {"lower_bound", Json::array()},     {"memory_mb", Json::array()},
            {"low_level_calls", Json::array()}, {"branching_cost_queries", Json::array()}};
  for (int number = 0; number < statistics.rank_count; ++number) {
    const auto found = statistics.ranks.find(number);
    if (found == statistics.ranks.end()) {
      for (Json& column : json) column.push_back(nullptr);
      continue;
    }
    const RankStatistics& rank = found->second;
    json["nodes"].push_back(rank.expanded);
    json["open"].push_back(rank.open);
    json["lower_bound"].push_back(cost_json(rank.bound));
    json["memory_mb"].push_back(megabytes_json(rank.memory));
    json["low_level_calls"].push_back(rank.low_level_calls);
    json["branching_cost_queries"].push_back(rank.branching_cost_queries);
  }
  return json;
}

Json standing_json(const Node& node) {
  return {{"bound", node.bound()}, {"cost", node.cost()}};
}

const char* outcome_of(const Expansion& expansion) {
  if (expansion.plan) return "plan";
  if (expansion.children.empty()) return "pruned";
  return expansion.branching ? "split" : "bound_raised";
}

}  // namespace

void JsonLog::head(const LogHead& h) {
  const Instance& instance = h.loaded.instance;
  instance_ = &instance;
  Json header{{"event", "header"},
              {"version", version_text()},
              {"machine", machine_text()},
              {"options", h.options},
              {"method", h.method.empty() ? "auto" : h.method},
              {"threads", h.workers},
              {"instance", h.instance},
              {"agents", instance.agent_count()},
              {"tasks", instance.task_count()},
              {"turning_agents", std::ranges::count_if(instance.agents(), &turns)},
              {"tasks_taking_time", std::ranges::count_if(instance.tasks(), &takes_time)},
              {"map", h.loaded.map_path.string()}};
  header.update(map_json(instance));
  sink_.line(line_of(header));
}

void JsonLog::warning(std::string_view text) {
  sink_.line(line_of({{"event", "warning"}, {"text", text}}));
}

void JsonLog::resumed(const CheckpointHeader& checkpoint) {
  const auto cost = checkpoint.incumbent ? std::optional(checkpoint.incumbent->cost) : std::nullopt;
  sink_.line(line_of({{"event", "resumed"},
                      {"seconds_before", seconds_json(checkpoint.seconds)},
                      {"lower_bound", checkpoint.lower_bound},
                      {"incumbent", cost_json(cost)}}));
}

void JsonLog::row(const LogRow& row) {
  const Progress& p = row.progress;
  Json json{{"event", name_of(row.event)},
            {"time_s", seconds_json(row.seconds)},
            {"nodes", p.nodes_expanded},
            {"open", p.nodes_open},
            {"trees", p.trees},
            {"lower_bound", p.lower_bound},
            {"incumbent", cost_json(p.incumbent)},
            {"gap", gap_json(p.incumbent, p.lower_bound)},
            {"memory_mb", rounded(static_cast<double>(row.memory_bytes) / 1e6, 10)}};
  if (row.event == RunEvent::kIncumbent) json["source"] = name_of(row.source);
  if (!row.raised_by.empty()) json["raised_by"] = row.raised_by;
  sink_.line(line_of(json));
}

void JsonLog::statistics(const RunStatistics& statistics, double seconds) {
  Json json{{"event", "counts"},
            {"time_s", seconds_json(seconds)},
            {"counts", statistics.whole.counts},
            {"memory_mb", memory_json(statistics.whole.memory)}};
  if (statistics.rank_count > 0) json["ranks"] = ranks_json(statistics);
  sink_.line(line_of(json));
}

void JsonLog::root(const RootRow& row, double seconds) {
  Json json{{"event", "root"},
            {"time_s", seconds_json(seconds)},
            {"node", row.number},
            {"tree", row.root.tree().number}};
  json.update(standing_json(row.root));
  sink_.line(line_of(json));
}

void JsonLog::node(const NodeRow& row, double seconds) {
  const Expansion& e = row.expansion;
  Json json{{"event", "node"},
            {"time_s", seconds_json(seconds)},
            {"node", row.number},
            {"worker", row.worker},
            {"outcome", outcome_of(e)}};
  if (e.plan) json["cost"] = e.plan->cost;
  if (e.branching) {
    json["conflict"] = text_of(e.branching->conflict, *instance_);
    json["split"] = split_name(e.branching->split[1].constraint.kind);
  }
  Json& children = json["children"] = Json::array();
  for (std::size_t i = 0; i < e.children.size(); ++i) {
    Json child{{"node", row.children[i]}};
    child.update(standing_json(*e.children[i]));
    if (e.branching) {
      child["conflicts"] = e.children[i]->conflicts();
      child["constraint"] = text_of(e.children[i]->added(), *instance_);
    }
    children.push_back(std::move(child));
  }
  sink_.line(line_of(json));
}

void JsonLog::infeasible(std::string_view reason) {
  sink_.line(line_of({{"event", "infeasible"}, {"text", reason}}));
}

void JsonLog::note(std::string_view text, double seconds) {
  sink_.line(line_of({{"event", "note"}, {"time_s", seconds_json(seconds)}, {"text", text}}));
}

void JsonLog::checkpoint(const CheckpointReport& report, double seconds) {
  Json json{{"event", "checkpoint"},
            {"time_s", seconds_json(seconds)},
            {"nodes", report.nodes},
            {"took_s", seconds_json(report.seconds)}};
  if (!report.failure.empty()) {
    json["failure"] = report.failure;
    sink_.warn_if_log_hidden("Checkpoint failed: " + report.failure);
  }
  sink_.line(line_of(json));
}

void JsonLog::end(const LogEnd& end) {
  const Solution& solution = end.solution;
  const auto cost = solution.plan ? std::optional(solution.plan->cost) : std::nullopt;
  Json json{{"event", "summary"},
            {"status", to_string(solution.status)},
            {"cost", cost_json(cost)},
            {"lower_bound", solution.lower_bound},
            {"gap", gap_json(cost, solution.lower_bound)},
            {"plan_file", end.is_unwritten ? Json() : Json(end.plan_file)}};
  if (end.kept) json["kept_cost"] = *end.kept;
  json["stats"] = stats_json(solution.stats);
  sink_.line(line_of(json));
}

}  // namespace grove::detail
