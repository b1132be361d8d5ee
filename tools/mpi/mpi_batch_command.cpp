// SPDX-License-Identifier: MIT
// grove-mpi batch: solves many instances in parallel on all ranks.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "batch/folder.h"
#include "batch/manifest.h"
#include "engine/method.h"
#include "engine/run_observer.h"
#include "engine/solve.h"
#include "io/plan_file.h"
#include "model/choices.h"
#include "model/fingerprint.h"
#include "mpi/batch/farm_client.h"
#include "mpi/batch/farm_master.h"
#include "mpi/batch/gather.h"
#include "mpi/solve_distributed.h"
#include "tools/common/commands.h"
#include "tools/common/instance_arguments.h"
#include "tools/common/machine.h"
#include "tools/common/options.h"
#include "tools/common/program.h"
#include "tools/common/progress_style.h"
#include "tools/common/signals.h"
#include "tools/common/standard_error.h"
#include "tools/common/version.h"
#include "tools/mpi/collective.h"
#include "tools/mpi/mpi_commands.h"
#include "tools/mpi/rank_layout.h"
#include "tools/solve/solve_arguments.h"
#include "tools/solve/solve_run.h"

namespace grove::detail {
namespace {

using Clock = std::chrono::steady_clock;
using Poll = std::function<void()>;

constexpr double kNoLimit_s = 1e9;

constexpr const char* kBatchFooter =
    R"(INSTANCES is a folder (all *.cts.json below it) or a list: on each line a path relative to the list,
or FILE.scen --map M --agents K; # begins a comment. The limits are for each instance.
DIR/results.csv and DIR/results.jsonl have a row per instance, and DIR/plans has the plans. The same
command resumes a batch that was stopped; instances that ended in an error are repeated.

Examples:
  mpirun -np 8 grove-mpi batch instances/ --output results --time-limit 60
  mpirun -np 8 grove-mpi batch hard.txt --output results --ranks-per-instance 4)";

struct BatchArguments {
  SolveArguments solve;  // for each instance
  std::string instances;
  std::string output;
  std::int64_t ranks_per_instance = 1;
  double total_time_limit_s = kNoLimit_s;
  bool confined = false;
  bool quiet = false;
};

// Returns the settings on which results depend. They include the memory limit only if the user set
// it; otherwise it depends on the machine.
batch::Settings settings_of(const CLI::App& app, const BatchArguments& a) {
  std::string options;
  const auto add = [&](const char* option, const std::string& value, const std::string& defaults) {
    if (value != defaults)
      options += fmt::format("{}{} {}", options.empty() ? "" : " ", option, value);
  };
  const SolveArguments defaults;
  const std::string omega = solve_options(a.solve).omega.to_string();
  add("--omega", omega, solve_options(defaults).omega.to_string());
  add("--policy", a.solve.policy, defaults.policy);
  add("--rtsp", a.solve.rtsp, defaults.rtsp);
  add("--without", fmt::format("{}", fmt::join(a.solve.without, ",")), "");
  add("--ranks-per-instance", std::to_string(a.ranks_per_instance), "1");
  return {.method = a.solve.method,
          .options = options,
          .omega = omega,
          .seed = a.solve.seed,
          .time_limit_s = a.solve.time_limit_s,
          .memory_limit_gb = app.count("--memory-limit") > 0
                                 ? std::optional(a.solve.memory_limit_gb)
                                 : std::nullopt};
}

class FirstPlanClock : public RunObserver {
 public:
  explicit FirstPlanClock(Clock::time_point start) : start_(start) {}
  void on_incumbent(const Plan&, PlanSource, const Progress&) override {
    if (!first_s_) first_s_ = std::chrono::duration<double>(Clock::now() - start_).count();
  }
  std::optional<double> first_s() const { return first_s_; }

 private:
  const Clock::time_point start_;
  std::optional<double> first_s_;
};

class BatchRun {
 public:
  BatchRun(const CLI::App& app, BatchArguments& arguments, MpiSession& session)
      : app_(app), a_(arguments), session_(session) {}

  void run() {
    divide_machine(app_, a_.solve, session_);
    options_ = options_of_one_search(a_.solve);
    if (a_.ranks_per_instance > session_.ranks())
      throw CLI::ValidationError("--ranks-per-instance",
                                 fmt::format("found {}; expected at most {}, the number of ranks",
                                             a_.ranks_per_instance, session_.ranks()));
    require_same(session_, "version", version_text());
    require_same(session_, "options", options_text(app_));
    const batch::Grouping grouping{session_.ranks(), static_cast<int>(a_.ranks_per_instance)};
    const int group = grouping.group_of(session_.rank());
    world_ = session_.connect();
    farm_ = session_.connect(group);
    agreement_ = session_.connect(group);
    search_ = session_.connect(group);
    collective(session_, [&] {
      if (session_.rank() == 0) open(grouping);
    });
    try {
      batch::FarmClient client(
          *world_, *farm_, interrupted,
          {.solve = [this](const auto& entry, auto& row,
                           const Poll& poll) { solve(entry, row, poll); },
           .settings = settings_of(app_, a_),
           .threads = options_.threads,
           .version = version_text(),
           .machine = processor_text(),
           .clock = batch::machine_clock(),
           .idle = [] { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }},
          master_ ? &*master_ : nullptr);
      client.run();
    } catch (const InputError& error) {  // abort, because the other ranks would wait forever
      print_error(*app_.get_parent(), error.what());
      session_.abort(kExitBadInput);
    }
    if (!master_) return;
    if (!a_.quiet) progress_.finish(progress_text(master_->state()));
    fmt::print("table: {}\n", batch::csv_file(a_.output).string());
  }

 private:
  InputRules rules() const { return input_rules(a_.confined, a_.solve.memory_limit_gb); }

  void open(batch::Grouping grouping) {
    auto entries = batch::read_manifest(a_.instances, rules());
    table_.emplace(a_.output, batch::TableOf::kPlans);
    warn_of_other_versions();
    for (const batch::Entry& entry : entries) batch::make_folder(plan_path(entry).parent_path());
    master_.emplace(*world_, grouping, std::move(entries), *table_, interrupted,
                    batch::machine_clock(),
                    batch::MasterOptions{.settings = settings_of(app_, a_),
                                         .total_time_limit_s = a_.total_time_limit_s,
                                         .watch = [this](const batch::BatchState& state) {
                                           if (!a_.quiet && progress_.is_due(state.elapsed_s))
                                             progress_.show(state.elapsed_s, progress_text(state));
                                         }});
  }

  void warn_of_other_versions() const {
    const auto other = std::ranges::find_if(
        table_->rows(), [](const auto& row) { return row.outcome.version != version_text(); });
    if (other != table_->rows().end())
      print_to_stderr(fmt::format("grove-mpi: warning: {} has rows of {}; they are kept", a_.output,
                                  other->outcome.version));
  }

  // Collective over the group. If `error` is not "" on some rank, throws std::runtime_error on all
  // ranks, with the text of the first such rank.
  void agree(const std::string& error, const Poll& poll) {
    for (const std::string& text : batch::gather(*agreement_, error, poll))
      if (!text.empty()) throw std::runtime_error(text);
  }

  LoadedInstance load(const batch::Entry& entry, const Poll& poll) {
    std::optional<LoadedInstance> loaded;
    std::string error;
    try {
      batch::Entry mine = entry;
      mine.rules = rules();
      loaded = batch::load(mine);
    } catch (const std::exception& failure) {
      error = failure.what();
    }
    agree(error, poll);
    const auto prints =
        batch::gather(*agreement_, fmt::format("{:016x}", fingerprint(loaded->instance)), poll);
    if (std::ranges::count(prints, prints[0]) != farm_->ranks())
      throw std::runtime_error(entry.path + " is not the same on all ranks");
    return std::move(*loaded);
  }

  // Returns why the method does not support this instance; "" if it does.
  std::string unsupported_reason(const Instance& instance) const {
    try {
      require_fit(method_of(a_.solve), instance, options_);
      require_no_choices(instance, "grove-mpi does not support", "'grove solve'");
      return "";
    } catch (const std::invalid_argument& error) {
      return one_line(error.what());
    }
  }

  std::filesystem::path plan_path(const batch::Entry& entry) const {
    return std::filesystem::path(a_.output) / batch::plan_file(entry.id);
  }

  void solve(const batch::Entry& entry, batch::Row& row, const Poll& poll) {
    const Clock::time_point start = Clock::now();
    const LoadedInstance loaded = load(entry, poll);
    row.facts = metadata_of(entry, loaded);
    if (const std::string why = unsupported_reason(loaded.instance); !why.empty()) {
      row.outcome = {.status = batch::kUnsupported, .error = why};
      return;
    }
    Limits limits;
    set_limits(limits, a_.solve, start);
    FirstPlanClock observer(start);
    auto solution = solve_with(loaded.instance, limits, observer, poll);
    if (farm_->rank() != 0) return;
    add_run_facts(*solution, app_, a_.solve, start);
    solution->stats.texts["instance"] = entry.path;
    solution->stats.counts["ranks"] = farm_->ranks();
    write_solution(plan_path(entry), loaded.instance, *solution);
    row.plan_file = batch::plan_file(entry.id);
    row.outcome = batch::outcome_of(loaded.instance, *solution);
    row.outcome.first_plan_s = observer.first_s();
  }

  std::optional<Solution> solve_with(const Instance& instance, const Limits& limits,
                                     RunObserver& observer, const Poll& poll) {
    const Problem problem(instance, limits, options_.threads);
    auto answer = presolve(problem, options_, limits, observer);
    const auto found = batch::gather(*agreement_, answer ? "an answer" : "", poll);
    if (std::ranges::count(found, "") < farm_->ranks()) {
      if (farm_->rank() != 0) return std::nullopt;
      return answer ? std::move(answer)
                    : grove::detail::solve(instance, options_, limits, &observer);
    }
    try {
      return solve_distributed(problem, options_, limits, *search_, observer, poll);
    } catch (const std::exception& error) {
      if (farm_->ranks() == 1) throw;  // the caller writes a row with the error
      print_error(*app_.get_parent(),
                  fmt::format("internal failure of rank {}: {}", session_.rank(), error.what()));
      session_.abort(kExitInternalFailure);  // the other ranks would wait forever
    }
  }

  const CLI::App& app_;
  BatchArguments& a_;
  MpiSession& session_;
  SolveOptions options_;
  std::unique_ptr<Transport> world_, farm_, agreement_, search_;
  batch::ProgressDisplay progress_{stderr_style()};
  std::optional<batch::ResultTable> table_;
  std::optional<batch::FarmMaster> master_;
};

}  // namespace

void add_mpi_batch_command(CLI::App& root, MpiSession& session, CommandLines& lines) {
  CLI::App* app = root.add_subcommand("batch", "Solve many instances and tabulate the results");
  app->footer(kBatchFooter);
  const auto a = std::make_shared<BatchArguments>();
  app->add_option("INSTANCES", a->instances, "folder or list of instances")
      ->required()
      ->type_name("");
  add_search_options(*app, a->solve);
  add_confine_option(*app, a->confined);
  add_integer(*app, "--ranks-per-instance", a->ranks_per_instance, {1, 1'000'000},
              "number of ranks that solve an instance together; 1 for many small instances")
      ->type_name("G");
  add_number(*app, "--total-time-limit", a->total_time_limit_s, 0, kNoLimit_s,
             "start no instance after this time, seconds")
      ->type_name("S");
  app->add_option("-o,--output", a->output,
                  "folder for the plans and the table; created if missing")
      ->required()
      ->type_name("DIR");
  app->add_flag("--quiet", a->quiet, "do not show progress");
  app->callback([app, a, &session, &lines] {
    lines.accept();
    BatchRun(*app, *a, session).run();
  });
}

}  // namespace grove::detail
