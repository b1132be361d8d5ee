// SPDX-License-Identifier: MIT
// grove convert --fix-choices: fixes the choices of an instance as a plan makes them.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <utility>

#include "assignment/assignment.h"
#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/plan_file.h"
#include "tools/common/commands.h"
#include "tools/common/instance_arguments.h"
#include "tools/convert/convert_parts.h"

namespace grove::detail {
namespace {

// Reads and checks the plan.
Solution read_valid_plan(const std::string& file, const Instance& instance) {
  AgentOrder order;
  Solution solution = read_solution(file, instance, &order);
  const auto violations = check_in_file(instance, solution, order, 1);
  if (!violations.empty())
    throw InputError(file, violations.front().json_pointer, violations.front().message);
  if (!solution.plan) throw InputError(file, "", "has no plan; expected one to fix the choices");
  return solution;
}

// The solution of the fixed instance. The bound of the whole instance also holds for it, unless the
// fixed instance allows agents more places of rest.
Solution of_fixed(const Instance& whole, Solution solution, Plan plan) {
  if (forbids_rest_within_turns(whole)) solution.lower_bound = 0;
  solution.status = status_of(plan.cost, solution.lower_bound, solution.omega);
  solution.plan = std::move(plan);
  return solution;
}

}  // namespace

void convert_choices(const ConvertArguments& arguments, InstanceFormat from, InstanceFormat to) {
  if (to != InstanceFormat::kGrove)
    throw CLI::ValidationError("--fix-choices", "OUT has another format; expected a *.cts.json");
  const LoadedInstance loaded = load(arguments, from);
  print_warnings(loaded.warnings);
  require_distinct_files(arguments.output, loaded.map_path, "the map");
  const std::string plan_file = without_suffix(arguments.output) + ".plan.json";
  require_distinct_files(plan_file, arguments.fix_choices, "the plan with the choices");
  require_distinct_files(plan_file, arguments.instance, "the instance");
  require_writable(plan_file);
  Solution solution = read_valid_plan(arguments.fix_choices, loaded.instance);
  write_representable(arguments, loaded.instance, from, [&] {
    FixedChoices fixed = fix_choices(loaded.instance, *solution.plan);
    if (const auto error = destination_within_a_road(fixed.instance))
      throw InputError(arguments.fix_choices, "/agents", *error);
    write_converted(arguments, loaded, fixed.instance, to);
    solution = of_fixed(loaded.instance, std::move(solution), std::move(fixed.plan));
    write_solution(plan_file, fixed.instance, solution);
  });
  fmt::print("wrote {}: {} paths, cost {}\n", plan_file, loaded.instance.agent_count(),
             solution.plan->cost);
}

}  // namespace grove::detail
