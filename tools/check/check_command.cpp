// SPDX-License-Identifier: MIT
// grove check: verifies a plan for an instance.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "io/input_error.h"
#include "io/plan_file.h"
#include "io/plan_import.h"
#include "model/check.h"
#include "tools/common/commands.h"
#include "tools/common/gap_text.h"
#include "tools/common/instance_arguments.h"
#include "tools/common/standard_error.h"

namespace grove::detail {
namespace {

constexpr std::size_t kMaxViolations = 20;

constexpr const char* kCheckFooter =
    R"(Recomputes every path, visit, conflict and cost with code of its own, and compares status, cost,
lower bound and omega with the claims of the file. It shares the file readers and the model of the
world with the search. It does not verify the lower bound; grove-verify does, from a certificate.

PLAN may also be the output of another solver: the path lists of EECBS, CBSH2-RTC and MAPF-LNS2
(--outputPaths) or the text of lacam and pibt. The output then lists what the file does not claim,
which is not checked.

If the plan is valid, prints one line that begins with 'valid:' and exits with 0. Otherwise prints
each violation on standard error and exits with 2. A file without a plan (status unknown or
infeasible) is not valid.

Examples:
  grove check benchmarks/data/first.cts.json plan.json
  grove check room-32-32-4-random-1.scen --agents 20 plan.json
  grove solve my.cts.json --quiet --output - | grove check my.cts.json -)";

struct CheckArguments {
  InstanceArguments instance;
  std::string plan;
};

void print_verdict(const ClaimedPlan& claimed) {
  const Solution& solution = claimed.solution;
  const Plan& plan = *solution.plan;
  const auto claims = [&](const char* what) {
    return std::ranges::count(claimed.unclaimed, what) == 0;
  };
  std::string text = fmt::format("valid: cost {}", plan.cost);
  if (claims("lower bound"))
    text += fmt::format(", lower bound {}, gap {}", solution.lower_bound,
                        gap_text(plan.cost, solution.lower_bound));
  text += fmt::format(", {} agent{}", plan.agents.size(), plan.agents.size() == 1 ? "" : "s");
  if (!claimed.unclaimed.empty())
    text += fmt::format("; not claimed and not checked: {}", fmt::join(claimed.unclaimed, ", "));
  fmt::print("{}\n", text);
}

void print_violations(const std::string& file, const std::vector<Violation>& violations) {
  for (const Violation& violation : violations)
    print_to_stderr(fmt::format("{}: {}: {}", one_line(file), violation.json_pointer,
                                one_line(violation.message)));
  if (violations.size() >= kMaxViolations)
    print_to_stderr(fmt::format("{}: stopped after {} violations", one_line(file), kMaxViolations));
}

LoadedInstance load_before_plan(const InstanceArguments& instance) {
  try {
    return instance.load();
  } catch (const WrongFileKind& error) {
    throw InputError(instance.name(), "",
                     fmt::format("found {}; expected an instance before its plan: 'grove "
                                 "check INSTANCE PLAN'",
                                 error.found()));
  }
}

void run(const CheckArguments& arguments) {
  const LoadedInstance loaded = load_before_plan(arguments.instance);
  print_hints(loaded.hints);
  const std::string plan = arguments.plan == "-" ? "/dev/stdin" : arguments.plan;
  const ClaimedPlan claimed = read_plan_of_any_tool(plan, loaded.instance);
  const auto violations =
      check_in_file(loaded.instance, claimed.solution, claimed.order, kMaxViolations);
  if (violations.empty()) return print_verdict(claimed);
  print_violations(plan, violations);
  throw CommandFailed(kExitBadInput);
}

}  // namespace

void add_check_command(CLI::App& app) {
  const auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command =
      app.add_subcommand("check", "Check a plan with code independent of the search");
  command->footer(kCheckFooter);
  arguments->instance.add_to(*command);
  command
      ->add_option("PLAN", arguments->plan,
                   "plan file, or paths of another solver; -: standard input")
      ->required()
      ->type_name("");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace grove::detail
