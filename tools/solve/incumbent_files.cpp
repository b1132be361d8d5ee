// SPDX-License-Identifier: MIT
#include "tools/solve/incumbent_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "io/input_error.h"
#include "io/plan_file.h"
#include "tools/common/standard_error.h"
#include "tools/common/version.h"

namespace grove::detail {
namespace {

constexpr std::string_view kSuffix = ".plan.json";

}  // namespace

std::filesystem::path IncumbentFiles::file(const std::string& prefix, int k) {
  return fmt::format("{}-{}{}", prefix, k, kSuffix);
}

void IncumbentFiles::remove_old(const std::string& prefix) {
  std::error_code ignored;
  for (int k = 1; std::filesystem::remove(file(prefix, k), ignored);) ++k;
}

bool IncumbentFiles::matches_name(const std::string& prefix, const std::filesystem::path& path) {
  const std::filesystem::path first = file(prefix, 1);
  const auto folder = [](const std::filesystem::path& of) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(of).parent_path());
  };
  if (path.empty() || folder(path) != folder(first)) return false;
  std::string name = path.filename().string();
  const std::string start = std::filesystem::path(prefix + "-").filename().string();
  if (!name.starts_with(start) || !name.ends_with(kSuffix) ||
      name.size() <= start.size() + kSuffix.size())
    return false;
  const std::string_view number =
      std::string_view(name).substr(start.size(), name.size() - start.size() - kSuffix.size());
  return std::ranges::all_of(number, [](char c) { return '0' <= c && c <= '9'; });
}

void IncumbentFiles::on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) {
  if (!failed_) write(plan, progress);
  next().on_incumbent(plan, source, progress);
}

void IncumbentFiles::write(const Plan& plan, const Progress& progress) {
  Solution solution;
  solution.plan = plan;
  solution.lower_bound = progress.lower_bound;
  solution.omega = omega_;
  solution.status = status_of(plan.cost, progress.lower_bound, omega_);
  solution.stats.counts["nodes_expanded"] = progress.nodes_expanded;
  solution.stats.texts["version"] = version_text();
  try {
    if (!best_.empty()) write_file(best_, solution);
    if (!prefix_.empty()) write_file(file(prefix_, ++written_), solution);
  } catch (const InputError& error) {
    print_to_stderr(fmt::format("grove: warning: {}; no plan is written until the end of the run",
                                error.what()));
    failed_ = true;
  }
}

void IncumbentFiles::write_file(const std::filesystem::path& file, const Solution& solution) {
  write_solution(file, instance_, solution, Durability::kProcess);
  if (!flusher_) flusher_.emplace();
  flusher_->flush(file);
}

}  // namespace grove::detail
