// SPDX-License-Identifier: MIT
#include "tools/solve/start_plan.h"

#include <fmt/format.h>

#include <utility>

#include "io/input_error.h"
#include "io/plan_file.h"

namespace grove::detail {

Plan read_valid_plan(const std::filesystem::path& path, const Instance& instance) {
  AgentOrder order;
  Solution solution = read_solution(path, instance, &order);
  if (!solution.plan)
    throw InputError(
        path.string(), "/agents",
        fmt::format("found no plan (status {}); expected a valid plan for this instance",
                    to_string(solution.status)));
  solution.lower_bound = 0;
  solution.status = status_of(solution.plan->cost, solution.lower_bound, solution.omega);
  if (const auto violations = check_in_file(instance, solution, order, 1); !violations.empty())
    throw InputError(path.string(), violations[0].json_pointer,
                     fmt::format("not a valid plan of this instance: {}", violations[0].message));
  return std::move(*solution.plan);
}

}  // namespace grove::detail
