// SPDX-License-Identifier: MIT
#include "batch/row.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "io/csv.h"

namespace grove::detail::batch {
namespace {

using Json = nlohmann::ordered_json;

template <typename Value>
Json optional_json(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

// Rounded to a multiple of 1e-6.
double rounded(double value) {
  return std::round(value * 1e6) / 1e6;
}

Json text_or_null(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}

Json ratio(std::optional<Cost> numerator, std::optional<Cost> denominator) {
  if (!numerator || !denominator || *denominator == 0) return nullptr;
  return rounded(static_cast<double>(*numerator) / static_cast<double>(*denominator));
}

// (cost - lower bound) / lower bound; 0 if both are equal. Returns null if one of them is missing,
// or if only the lower bound is 0.
Json gap(const Outcome& outcome) {
  if (!outcome.cost || !outcome.lower_bound) return nullptr;
  if (*outcome.cost == *outcome.lower_bound) return 0.0;
  return ratio(*outcome.cost - *outcome.lower_bound, outcome.lower_bound);
}

// The columns, defined once for all formats.
std::vector<std::pair<std::string, Json>> columns(const Row& row) {
  const Settings& settings = row.run.settings;
  const InstanceMetadata& facts = row.facts;
  const Outcome& outcome = row.outcome;
  const bool is_known = !facts.problem.empty();
  return {
      {"instance", row.run.instance},
      {"method", settings.method},
      {"options", settings.options},
      {"map", text_or_null(facts.map)},
      {"scenario", optional_json(facts.scenario)},
      {"agents", is_known ? Json(facts.agents) : Json(nullptr)},
      {"tasks", is_known ? Json(facts.tasks) : Json(nullptr)},
      {"problem", text_or_null(facts.problem)},
      {"omega", settings.omega},
      {"seed", settings.seed},
      {"time_limit_s", settings.time_limit_s},
      {"solved", outcome.solved},
      {"status", outcome.status},
      {"cost", optional_json(outcome.cost)},
      {"lower_bound", optional_json(outcome.lower_bound)},
      {"gap", gap(outcome)},
      {"root_cost", optional_json(row.root_cost)},
      {"sqr", outcome.solved ? ratio(row.root_cost, outcome.cost) : Json(nullptr)},
      {"runtime_s", rounded(row.runtime_s())},
      {"wall_s", rounded(row.wall_s)},
      {"first_plan_s", outcome.first_plan_s ? Json(rounded(*outcome.first_plan_s)) : Json(nullptr)},
      {"roots", optional_json(outcome.roots)},
      {"rtsp_calls", optional_json(outcome.rtsp_calls)},
      {"nodes", optional_json(outcome.nodes)},
      {"low_level_calls", optional_json(outcome.low_level_calls)},
      {"peak_memory_mb", optional_json(outcome.peak_memory_mb)},
      {"version", outcome.version},
      {"machine", row.machine},
      {"ended_at", row.ended_at},
      {"error", text_or_null(outcome.error)},
      {"ranks", row.ranks},
      {"threads", row.threads},
      {"memory_limit_gb", optional_json(settings.memory_limit_gb)},
      {"plan_file", text_or_null(row.plan_file)},
      {"instance_digest", row.run.digest},
      {"counts", text_or_null(outcome.counts)},
      {"solver", text_or_null(row.solver)},
      {"claimed_cost", optional_json(outcome.claimed_cost)},
      {"claimed_lower_bound", optional_json(outcome.claimed_lower_bound)},
      {"claimed_s", outcome.claimed_s ? Json(rounded(*outcome.claimed_s)) : Json(nullptr)},
      {"anytime", outcome.anytime},
      {"trace", text_or_null(trace_text(outcome.trace))},
      {"certified", optional_json(outcome.certified)},
      {"verify_s", outcome.verify_s ? Json(rounded(*outcome.verify_s)) : Json(nullptr)},
      {"proof_bytes", optional_json(outcome.proof_bytes)}};
}

template <typename Value>
std::optional<Value> optional_member(const nlohmann::json& json, const char* key) {
  const auto& value = json.at(key);
  if (value.is_null()) return std::nullopt;
  return value.get<Value>();
}

// Reads a column that older tables lack; nullopt if it is missing.
template <typename Value>
std::optional<Value> later_member(const nlohmann::json& json, const char* key) {
  return json.contains(key) ? optional_member<Value>(json, key) : std::nullopt;
}

std::string text_member(const nlohmann::json& json, const char* key) {
  return optional_member<std::string>(json, key).value_or("");
}

Settings settings_of(const nlohmann::json& json) {
  return {.method = json.at("method").get<std::string>(),
          .options = json.at("options").get<std::string>(),
          .omega = json.at("omega").get<std::string>(),
          .seed = json.at("seed").get<std::int64_t>(),
          .time_limit_s = json.at("time_limit_s").get<double>(),
          .memory_limit_gb = optional_member<double>(json, "memory_limit_gb")};
}

InstanceMetadata metadata_of(const nlohmann::json& json) {
  return {.map = text_member(json, "map"),
          .scenario = optional_member<std::int64_t>(json, "scenario"),
          .agents = optional_member<std::int64_t>(json, "agents").value_or(0),
          .tasks = optional_member<std::int64_t>(json, "tasks").value_or(0),
          .problem = text_member(json, "problem")};
}

// Tables from before version 0.1 use different words for two statuses.
std::string current_status(const std::string& status) {
  if (status == "wrong") return kInvalidPlan;
  if (status == "unsuitable") return kUnsupported;
  return status;
}

Outcome outcome_of(const nlohmann::json& json) {
  Outcome outcome{.status = current_status(json.at("status").get<std::string>()),
                  .solved = json.at("solved").get<bool>(),
                  .cost = optional_member<Cost>(json, "cost"),
                  .lower_bound = optional_member<Cost>(json, "lower_bound"),
                  .first_plan_s = optional_member<double>(json, "first_plan_s"),
                  .roots = optional_member<std::int64_t>(json, "roots"),
                  .rtsp_calls = optional_member<std::int64_t>(json, "rtsp_calls"),
                  .nodes = optional_member<std::int64_t>(json, "nodes"),
                  .low_level_calls = optional_member<std::int64_t>(json, "low_level_calls"),
                  .peak_memory_mb = optional_member<double>(json, "peak_memory_mb"),
                  .counts = later_member<std::string>(json, "counts").value_or(""),
                  .version = json.at("version").get<std::string>(),
                  .error = text_member(json, "error"),
                  .claimed_cost = later_member<Cost>(json, "claimed_cost"),
                  .claimed_lower_bound = later_member<Cost>(json, "claimed_lower_bound"),
                  .claimed_s = later_member<double>(json, "claimed_s"),
                  .trace = parse_trace(later_member<std::string>(json, "trace").value_or("")),
                  .certified = later_member<bool>(json, "certified"),
                  .verify_s = later_member<double>(json, "verify_s"),
                  .proof_bytes = later_member<std::int64_t>(json, "proof_bytes"),
                  .anytime = later_member<bool>(json, "anytime").value_or(false)};
  constexpr std::array<std::string_view, 4> kWithoutResult{kError, kInvalidPlan, kClaimed,
                                                           kUnsupported};
  const bool has_result = std::ranges::find(kWithoutResult, outcome.status) == kWithoutResult.end();
  if (has_result && !parse_status(outcome.status))
    throw std::invalid_argument(fmt::format("status '{}'", outcome.status));
  if (!has_result && (outcome.error.empty() || outcome.solved))
    throw std::invalid_argument(fmt::format("status '{}' without an error", outcome.status));
  return outcome;
}

std::string csv_cell(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return grove::detail::csv_cell(value.get<std::string>());
  return value.dump();
}

}  // namespace

std::string json_line(const Row& row) {
  Json json = Json::object();
  for (auto& [name, value] : columns(row)) json[name] = std::move(value);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Row parse_json_line(std::string_view line) {
  try {
    const auto json = nlohmann::json::parse(line);
    return {.run = {.instance = json.at("instance").get<std::string>(),
                    .digest = json.at("instance_digest").get<std::string>(),
                    .settings = settings_of(json)},
            .facts = metadata_of(json),
            .outcome = outcome_of(json),
            .root_cost = optional_member<Cost>(json, "root_cost"),
            .wall_s = json.at("wall_s").get<double>(),
            .machine = json.at("machine").get<std::string>(),
            .ended_at = json.at("ended_at").get<std::string>(),
            .ranks = json.at("ranks").get<std::int64_t>(),
            .threads = json.at("threads").get<std::int64_t>(),
            .plan_file = text_member(json, "plan_file"),
            .solver = later_member<std::string>(json, "solver").value_or("")};
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(error.what());
  }
}

std::string csv_header() {
  std::vector<std::string> names;
  for (const auto& [name, value] : columns({})) names.push_back(name);
  return fmt::format("{}\n", fmt::join(names, ","));
}

std::string csv_line(const Row& row) {
  std::vector<std::string> cells;
  for (const auto& [name, value] : columns(row)) cells.push_back(csv_cell(value));
  return fmt::format("{}\n", fmt::join(cells, ","));
}

}  // namespace grove::detail::batch
