// SPDX-License-Identifier: MIT
// grove solve: solves an instance and writes a log and a plan file.
#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "engine/method.h"
#include "tools/common/commands.h"
#include "tools/common/signals.h"
#include "tools/solve/incumbent_files.h"
#include "tools/solve/proof_output.h"
#include "tools/solve/solve_arguments.h"
#include "tools/solve/solve_run.h"
#include "tools/solve/start_plan.h"

namespace grove::detail {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kSolveFooter =
    R"(The plan file has the status of the run: optimal, bounded (within omega), feasible (a plan outside
omega), unknown (no plan when a limit was reached) or infeasible (proven). Its lower_bound is proven
with every status except infeasible. Ctrl-C and SIGTERM end the run as a time limit does, with the
best plan so far.

Examples:
  grove solve benchmarks/data/first.cts.json
  grove solve INSTANCE.cts.json --omega 0 --time-limit 60 --output plan.json
  grove solve room-32-32-4-random-1.scen --agents 20)";

void run_solve(const CLI::App& app, SolveArguments& a) {
  const Clock::time_point start = Clock::now();
  stop_on_signals();
  SolveOptions options = solve_options(a);
  const LoadedInstance loaded = load(a);
  const std::vector<OutputLock> locks = prepare_outputs(a, loaded);
  if (!a.start.empty()) options.start = read_valid_plan(a.start, loaded.instance);
  require_fit(a, loaded.instance, options);
  const CheckpointFolder checkpoints = prepare_checkpoints(a.checkpoints, loaded.instance, options);
  if (!checkpoints.resumed) ProofOutput::remove_old(a);
  ProofOutput proof(a);
  options.proof = proof.log();
  const auto log = open_log(a);
  log->head(head_of(app, a, loaded, std::to_string(a.threads)));
  if (checkpoints.resumed) log->resumed(checkpoints.resumed->header());

  Limits limits;
  set_limits(limits, a, start);
  RunLog rows = rows_of(*log, a, start);
  IncumbentFiles observer(a.incumbents, a.checkpoints.incumbent_file(), loaded.instance,
                          options.omega, rows);
  Solution solution =
      solve_by(method_of(a), a.anytime, loaded.instance, options, limits, &observer);

  proof.write(loaded.instance, solution, proof.close());
  add_run_facts(solution, app, a, start);
  report_failures({finish_run(a, loaded.instance, solution, *log), proof.failure()});
  if (a.require_plan && !solution.plan) throw CommandFailed(kExitNoPlan);
}

}  // namespace

void add_solve_command(CLI::App& root) {
  CLI::App* app =
      root.add_subcommand("solve", "Find a plan and prove a lower bound on the cost of every plan");
  app->footer(kSolveFooter);
  const auto arguments = std::make_shared<SolveArguments>();
  add_solve_options(*app, *arguments);
  app->callback([app, arguments] { run_solve(*app, *arguments); });
}

}  // namespace grove::detail
