// SPDX-License-Identifier: MIT
#include "mpi/batch/row.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

#include "grove/batch/csv.h"

namespace grove::batch {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kError = "error";

// The columns, once for all formats: names and values. The settings come after the gap.
std::vector<std::pair<std::string, Json>> head_columns(const Row& row) {
  const bool failed = row.failed();
  const auto of_result = [&](const auto& value) -> Json {
    if (failed || !value) return nullptr;
    return *value;
  };
  return {{"id", row.id},
          {"instance", row.instance},
          {"status", row.status_text()},
          {"cost", of_result(row.result.cost)},
          {"lower_bound", of_result(row.result.lower_bound)},
          {"gap", of_result(gap(row.result))}};
}

// To a millionth: nobody reads more.
Json seconds_json(std::optional<double> seconds) {
  if (!seconds) return nullptr;
  return std::round(*seconds * 1e6) / 1e6;
}

std::vector<std::pair<std::string, Json>> tail_columns(const Row& row) {
  return {{"version", row.version},
          {"ranks", row.ranks},
          {"threads", row.threads},
          {"wall_s", seconds_json(row.wall_s)},
          {"nodes_expanded", row.result.nodes_expanded},
          {"first_plan_s", seconds_json(row.result.first_plan_s)},
          {"stopped_by", row.result.stopped_by},
          {"error", row.error},
          {"plan_file", row.result.plan_file},
          {"started_at", row.started_at},
          {"instance_digest", row.digest}};
}

std::string csv_cell(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return csv_quoted(value.get<std::string>());
  if (value.is_number_float() && std::isinf(value.get<double>())) return "inf";
  return value.dump();
}

template <typename Value>
std::optional<Value> optional_member(const nlohmann::json& json, const char* key) {
  const auto& value = json.at(key);
  if (value.is_null()) return std::nullopt;
  return value.get<Value>();
}

Row row_of(const nlohmann::json& json) {
  Row row;
  row.id = json.at("id").get<std::string>();
  row.instance = json.at("instance").get<std::string>();
  const auto text = json.at("status").get<std::string>();
  const auto status = parse_status(text);
  row.error = json.at("error").get<std::string>();
  if (row.failed() != (text == kError) || (!status && !row.failed()))
    throw std::invalid_argument(fmt::format("status '{}' with error '{}'", text, row.error));
  row.result.status = status.value_or(Status::kUnknown);
  row.result.cost = optional_member<Cost>(json, "cost");
  row.result.lower_bound = optional_member<Cost>(json, "lower_bound");
  row.version = json.at("version").get<std::string>();
  row.ranks = json.at("ranks").get<int>();
  row.threads = json.at("threads").get<int>();
  row.wall_s = json.at("wall_s").get<double>();
  row.result.nodes_expanded = json.at("nodes_expanded").get<std::int64_t>();
  row.result.first_plan_s = optional_member<double>(json, "first_plan_s");
  row.result.stopped_by = json.at("stopped_by").get<std::string>();
  row.result.plan_file = json.at("plan_file").get<std::string>();
  row.started_at = json.at("started_at").get<std::string>();
  row.digest = json.at("instance_digest").get<std::string>();
  return row;
}

}  // namespace

Result result_of(const Solution& solution, std::string plan_file) {
  Result result;
  result.status = solution.status;
  if (solution.plan) result.cost = solution.plan->cost;
  if (solution.status != Status::kInfeasible) result.lower_bound = solution.lower_bound;
  if (const auto nodes = solution.stats.counts.find("nodes_expanded");
      nodes != solution.stats.counts.end())
    result.nodes_expanded = nodes->second;
  if (const auto stopped = solution.stats.texts.find("stopped_by");
      stopped != solution.stats.texts.end())
    result.stopped_by = stopped->second;
  result.plan_file = std::move(plan_file);
  return result;
}

std::string_view Row::status_text() const {
  return failed() ? kError : to_string(result.status);
}

std::optional<double> gap(const Result& result) {
  if (!result.cost || !result.lower_bound) return std::nullopt;
  if (*result.cost == *result.lower_bound) return 0;
  if (*result.lower_bound <= 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>(*result.cost - *result.lower_bound) /
         static_cast<double>(*result.lower_bound);
}

std::string json_line(const Row& row, const Settings& settings) {
  Json json;
  for (auto& [name, value] : head_columns(row)) json[name] = std::move(value);
  Json& options = json["options"] = Json::object();
  for (const auto& [name, value] : settings) options[name] = value;
  for (auto& [name, value] : tail_columns(row)) json[name] = std::move(value);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);  // infinity as null
}

RowAndSettings parse_json_line(std::string_view line) {
  try {
    const auto json = nlohmann::json::parse(line);
    return {row_of(json), json.at("options").get<Settings>()};
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(error.what());
  }
}

std::string csv_header(const Settings& settings) {
  std::vector<std::string> names;
  for (const auto& [name, value] : head_columns({})) names.push_back(name);
  for (const auto& [name, value] : settings) names.push_back(csv_quoted(name));
  for (const auto& [name, value] : tail_columns({})) names.push_back(name);
  return fmt::format("{}\n", fmt::join(names, ","));
}

std::string csv_line(const Row& row, const Settings& settings) {
  std::vector<std::string> cells;
  for (const auto& [name, value] : head_columns(row)) cells.push_back(csv_cell(value));
  for (const auto& [name, value] : settings) cells.push_back(csv_quoted(value));
  for (const auto& [name, value] : tail_columns(row)) cells.push_back(csv_cell(value));
  return fmt::format("{}\n", fmt::join(cells, ","));
}

}  // namespace grove::batch
