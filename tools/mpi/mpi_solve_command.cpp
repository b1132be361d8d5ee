// SPDX-License-Identifier: MIT
// grove-mpi solve: solves one instance with all ranks.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/run_observer.h"
#include "io/input_error.h"
#include "model/fingerprint.h"
#include "mpi/shared_problem.h"
#include "mpi/solve_distributed.h"
#include "tools/common/commands.h"
#include "tools/common/program.h"
#include "tools/common/version.h"
#include "tools/mpi/collective.h"
#include "tools/mpi/mpi_commands.h"
#include "tools/mpi/rank_layout.h"
#include "tools/solve/incumbent_files.h"
#include "tools/solve/proof_output.h"
#include "tools/solve/solve_arguments.h"
#include "tools/solve/solve_run.h"
#include "tools/solve/start_plan.h"

namespace grove::detail {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kSolveFooter =
    R"(All ranks solve the instance together. Each has --threads search threads, and one thread that
communicates with other ranks. Every rank must be able to read the instance; only rank 0 writes
files and the log. The limits are per rank: --memory-limit is for each process.

Examples:
  mpirun -np 2 grove-mpi solve benchmarks/data/first.cts.json
  mpirun -np 4 --map-by node --bind-to none grove-mpi solve INSTANCE.cts.json --threads 16)";

// This rank's part of the run.
class Run {
 public:
  Run(const CLI::App& app, SolveArguments& arguments, MpiSession& session)
      : app_(app), a_(arguments), session_(session) {}

  void run() {
    divide_machine(app_, a_, session_);
    options_ = options_of_one_search(a_);
    require_same(session_, "version", version_text());
    require_same(session_, "options", options_text(app_));
    if (a_.instance.is_standard_input()) share_standard_input();
    collective(session_, [&] {
      loaded_.emplace(load(a_, is_first()));
      require_fit_of_one_search(a_, loaded_->instance, options_, "grove-mpi");
    });
    require_same(session_, "an instance of fingerprint",
                 fmt::format("{:016x}", fingerprint(loaded_->instance)));
    set_limits(limits_, a_, start_);
    collective(session_, [&] {
      if (is_first()) prepare();
    });
    collective(session_, [&] { proof_.emplace(a_, session_.rank()); });
    options_.proof = proof_->log();
    share_memory();
    if (is_first())
      solve_and_write();
    else
      solve_with(silent_);
  }

 private:
  struct Answer {
    std::optional<Solution> solution;  // nullopt on all ranks except 0
    std::string missing_part_reason;   // why a part of the certificate is missing; "" if none is
    std::int64_t unresponsive = 0;     // number of ranks that did not respond at the end
  };

  bool is_first() const { return session_.rank() == 0; }

  // mpirun passes standard input only to rank 0.
  void share_standard_input() {
    std::string text;
    collective(session_, [&] {
      if (is_first()) text = read_standard_input();
    });
    a_.instance.set_standard_input(session_.gather(text).front());
  }

  void prepare() {
    locks_ = prepare_outputs(a_, *loaded_);
    if (!a_.start.empty()) options_.start = read_valid_plan(a_.start, loaded_->instance);
    checkpoints_ = prepare_checkpoints(a_.checkpoints, loaded_->instance, options_);
    log_ = open_log(a_, false);
    if (!checkpoints_.resumed) ProofOutput::remove_old(a_);
  }

  // Collective. Call it when no rank can refuse its input any more, because only ranks that end
  // normally release the shared memory.
  void share_memory() {
    const auto [bytes, zero_bytes] = SharedProblem::need(loaded_->instance);
    memory_ = session_.share(bytes, zero_bytes);
    const RankLayout layout = gather_rank_layout(session_, a_.threads, *memory_);
    if (!is_first()) return;
    log_->head(head_of(app_, a_, *loaded_, workers_text(layout)));
    for (const std::string& warning : warnings(layout)) log_->warning(warning);
    if (checkpoints_.resumed) log_->resumed(checkpoints_.resumed->header());
  }

  void solve_and_write() {
    RunLog rows = rows_of(*log_, a_, start_);
    IncumbentFiles observer(a_.incumbents, a_.checkpoints.incumbent_file(), loaded_->instance,
                            options_.omega, rows);
    Answer answer = solve_with(observer);
    Solution& solution = *answer.solution;
    const bool all_respond = answer.unresponsive == 0;
    if (all_respond) proof_->write(loaded_->instance, solution, answer.missing_part_reason);
    add_run_facts(solution, app_, a_, start_);
    solution.stats.counts["ranks"] = session_.ranks();
    if (!all_respond) {
      solution.stats.counts["unresponsive_ranks"] = answer.unresponsive;
      log_->warning(without_text(answer.unresponsive));
    }
    const std::string failure = finish_run(a_, loaded_->instance, solution, *log_);
    if (!all_respond && failure.empty())
      session_.abort(kExitSuccess);  // else unresponsive ranks would prevent the end of this rank
    try {
      report_failures({failure, proof_->failure()});
    } catch (const CommandFailed& failed) {
      if (!all_respond) session_.abort(failed.exit_code());
      throw;
    }
  }

  std::string without_text(std::int64_t unresponsive) {
    return fmt::format("{} of {} ranks did not respond at shutdown; the job ends without them{}",
                       unresponsive, session_.ranks(),
                       proof_->log() == nullptr ? "" : ", and without a certificate");
  }

  // Collective. If presolve on some rank already gives the answer, no rank searches and rank 0
  // returns the answer; otherwise all ranks search.
  Answer solve_with(RunObserver& observer) {
    const SharedProblem shared(loaded_->instance, limits_, options_.threads, *memory_);
    const Problem& problem = shared.problem();
    const auto answer = presolve(problem, options_, limits_, observer);
    const auto found = session_.gather(answer ? "an answer" : "");
    if (std::ranges::count(found, "") == session_.ranks()) {
      Answer by_all = solve_by_all(problem, observer);
      if (by_all.unresponsive > 0) return by_all;
      for (const std::string& failure : session_.gather(proof_->close()))
        if (by_all.missing_part_reason.empty()) by_all.missing_part_reason = failure;
      return by_all;
    }
    if (!is_first()) return {};
    auto solution = answer ? answer : solve(loaded_->instance, options_, limits_, &observer);
    return {std::move(solution), proof_->close()};
  }

  // Searches with all ranks. Aborts the job on an error, because it may occur on this rank only,
  // and the other ranks would wait forever. For example, rank 0 may find that the nodes in a
  // checkpoint are damaged.
  Answer solve_by_all(const Problem& problem, RunObserver& observer) {
    try {
      const auto network = session_.connect();
      return {solve_distributed(problem, options_, limits_, *network, observer, [] {}), ""};
    } catch (UnresponsiveRanks& silence) {
      return {std::move(silence.solution), "", silence.ranks};
    } catch (const InputError& error) {
      print_error(*app_.get_parent(), error.what());
      session_.abort(kExitBadInput);
    } catch (const std::exception& error) {
      print_error(*app_.get_parent(),
                  fmt::format("internal failure of rank {}: {}", session_.rank(), error.what()));
      session_.abort(kExitInternalFailure);
    }
  }

  const Clock::time_point start_ = Clock::now();
  const CLI::App& app_;
  SolveArguments& a_;
  MpiSession& session_;
  SolveOptions options_;
  std::optional<LoadedInstance> loaded_;
  Limits limits_;
  RunObserver silent_;
  std::vector<OutputLock> locks_;
  CheckpointFolder checkpoints_;
  std::unique_ptr<LogFormat> log_;
  std::optional<ProofOutput> proof_;
  std::unique_ptr<SharedMemory> memory_;
};

}  // namespace

void add_mpi_solve_command(CLI::App& root, MpiSession& session, CommandLines& lines) {
  CLI::App* app =
      root.add_subcommand("solve", "Find a plan and prove a lower bound on the cost of every plan");
  app->footer(kSolveFooter);
  const auto arguments = std::make_shared<SolveArguments>();
  arguments->instance.add_to(*app);
  add_search_options(*app, *arguments);
  arguments->instance.add_rules_to(*app);
  add_checkpoint_options(*app, arguments->checkpoints);
  add_file_options(*app, *arguments);
  app->callback([app, arguments, &session, &lines] {
    lines.accept();
    Run(*app, *arguments, session).run();
  });
}

}  // namespace grove::detail
