// SPDX-License-Identifier: MIT
#include "tools/solve/plan_output.h"

#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>
#include <string>

#include "io/input_error.h"
#include "io/plan_file.h"
#include "tools/common/standard_error.h"
#include "tools/solve/start_plan.h"

namespace grove::detail {
namespace {

// Returns the cost of the plan in the file. Returns nullopt if the file contains no plan that is
// valid for the instance.
std::optional<Cost> valid_cost(const std::filesystem::path& file, const Instance& instance) {
  if (!std::filesystem::is_regular_file(file)) return std::nullopt;
  try {
    return read_valid_plan(file, instance).cost;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

void require_no_contradiction(const std::filesystem::path& file, Cost cost,
                              const Solution& solution) {
  const bool none = solution.status == Status::kInfeasible;
  if (!none && cost >= solution.lower_bound) return;
  throw std::logic_error(fmt::format(
      "the search claims that {}, but {} has a valid plan of cost {}; please "
      "report this error with the instance",
      none ? "there is no plan" : fmt::format("no plan costs less than {}", solution.lower_bound),
      file.string(), cost));
}

void print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);  // run_program() checks stdout for errors
}

std::string ending_text(const Solution& solution) {
  const auto stopped = solution.stats.texts.find("stopped_by");
  std::string text(to_string(solution.status));
  if (stopped != solution.stats.texts.end())
    text += fmt::format(", stopped by: {}", stopped->second);
  if (solution.status != Status::kInfeasible)
    text += fmt::format(", lower bound {}", solution.lower_bound);
  if (const auto reason = solution.stats.texts.find("reason"); reason != solution.stats.texts.end())
    text += ": " + reason->second;
  return text;
}

}  // namespace

std::optional<Cost> write_plan(const std::filesystem::path& file, const Instance& instance,
                               const Solution& solution, bool keeps_cheaper) {
  if (file == kStandardOutput) {
    print(solution_text(instance, solution));
    return std::nullopt;
  }
  const std::optional<Cost> there = valid_cost(file, instance);
  if (there) require_no_contradiction(file, *there, solution);
  const bool is_better =
      solution.plan && (!there || solution.plan->cost <= *there || !keeps_cheaper);
  if (there && !is_better) return there;
  write_solution(file, instance, solution);
  return std::nullopt;
}

void report_missing_plan(const Solution& solution, const std::filesystem::path& file,
                         std::optional<Cost> kept) {
  if (solution.plan && !kept) return;
  print_to_stderr(fmt::format(
      "grove: {} ({}){}",
      solution.plan ? fmt::format("the plan found costs {}", solution.plan->cost)
                    : std::string("no plan was found"),
      ending_text(solution),
      kept ? fmt::format("; {} keeps its valid plan of cost {}", file.string(), *kept) : ""));
}

}  // namespace grove::detail
