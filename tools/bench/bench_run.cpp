// SPDX-License-Identifier: MIT
// Each worker thread repeatedly runs a child process, evaluates its outcome and writes a row. At
// most one child per worker exists, and a worker evaluates only while its child is not running, so
// evaluation takes no core from the runs. A mutex guards the table and the counts. No thread holds
// it while children run or plans are checked.
//
// A worker writes a row only after the run has ended, its outcome is evaluated and its plan, if
// kept, is in place. Therefore no run in progress has a row if this process ends for any reason.
// Its children are killed with it.
#include "tools/bench/bench_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>

#include "batch/batch_clock.h"
#include "batch/result_table.h"
#include "batch/table_writer.h"
#include "io/format_support.h"
#include "io/input_error.h"
#include "io/instance_file.h"
#include "io/plan_file.h"
#include "model/assert.h"
#include "tools/bench/child_process.h"
#include "tools/bench/root_costs.h"
#include "tools/bench/run_outcome.h"

namespace grove::detail::bench {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr batch::WriteIntervals kWriteIntervals{.flush_s = 1, .csv_s = 30};
constexpr auto kWatchInterval = std::chrono::milliseconds(100);
constexpr double kMaxCheckTime_s = 3600;

// All runs of a benchmark: each method on each instance, instance by instance.
class AllRuns {
 public:
  // Both arguments must outlive this object.
  AllRuns(const std::vector<BenchInstance>& instances, const std::vector<Method>& methods)
      : instances_(instances), methods_(methods) {
    for (const BenchInstance& instance : instances)
      for (const Method& method : methods)
        runs_.push_back({instance.entry.id, instance.entry.digest, method.settings});
  }

  const std::vector<batch::Run>& all() const { return runs_; }
  const batch::Run& operator[](std::size_t run) const { return runs_[run]; }
  const std::vector<Method>& methods() const { return methods_; }
  const Method& method(std::size_t run) const { return methods_[run % methods_.size()]; }
  // Position of the run's instance among all instances.
  std::size_t instance_index(std::size_t run) const { return run / methods_.size(); }
  const BenchInstance& instance(std::size_t run) const { return instances_[instance_index(run)]; }

 private:
  const std::vector<BenchInstance>& instances_;
  const std::vector<Method>& methods_;
  std::vector<batch::Run> runs_;
};

class Bench {
 public:
  Bench(const std::vector<BenchInstance>& instances, const std::vector<Method>& methods,
        const BenchOptions& options)
      : options_(options),
        runs_(instances, methods),
        table_(options.folder, batch::TableOf::kMethods),
        writer_(table_, kWriteIntervals, [this] { return seconds(); }),
        todo_(table_.begin(runs_.all())),
        root_costs_(instances.size(), options.root_cost_s,
                    static_cast<std::size_t>(options.root_cost_gb * 1e9)) {
    count_existing_rows();
    under_way_.resize(workers());
  }

  BenchState run() {
    fs::remove_all(scratch());  // left by a benchmark that was killed
    batch::make_folder(scratch());
    std::vector<std::jthread> threads;
    for (std::size_t worker = 0; worker < workers(); ++worker)
      threads.emplace_back([this, worker] { work(worker); });
    while (working_ > 0) {
      if (options_.watch) options_.watch(state());
      std::this_thread::sleep_for(kWatchInterval);
    }
    threads.clear();
    fs::remove_all(scratch());
    if (failure_) std::rethrow_exception(failure_);
    table_.flush();
    table_.write_csv();
    state_.false_claims = batch::false_claims(table_.rows());
    return state();
  }

 private:
  struct UnderWay {
    bool busy = false;
    Clock::time_point since;
  };

  // --- runs ---

  void count_existing_rows() {
    state_.work.left = static_cast<int>(runs_.all().size());
    state_.work.workers = static_cast<int>(std::max<std::size_t>(1, workers()));
    for (const Method& method : runs_.methods()) {
      if (!state_.counts.contains(method.settings.method))
        state_.methods.push_back(method.settings.method);
      state_.counts[method.settings.method];
    }
    for (const batch::Run& run : runs_.all())
      if (const batch::Row* row = table_.find(run)) {
        state_.count(*row);
        if (row->outcome.version != options_.version)
          state_.other_versions.insert(row->outcome.version);
      }
  }

  std::size_t workers() const {
    return std::min(todo_.size(), static_cast<std::size_t>(options_.jobs));
  }

  // --- a worker ---

  void work(std::size_t worker) {
    try {
      while (const auto run = take(worker)) do_run(*run, worker);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      failed_ = true;  // stops the other workers
    }
    --working_;
  }

  std::optional<std::size_t> take(std::size_t worker) {
    const std::lock_guard lock(mutex_);
    under_way_[worker].busy = false;
    if (must_stop() || next_ == todo_.size()) return std::nullopt;
    GROVE_CHECK(!table_.find(runs_[todo_[next_]]), "a run that starts has no row");
    under_way_[worker] = {true, Clock::now()};
    return todo_[next_++];
  }

  bool must_stop() const { return failed_ || options_.stopped(); }

  // Scratch files of a run. Each worker has its own set.
  struct Files {
    fs::path plan;
    fs::path output_file;
    fs::path log;
    fs::path folder;  // for the files of an external solver
    fs::path proof;
    fs::path instance;  // for the certificate checker if the entry is a scenario
  };
  Files files_of(std::size_t worker) const {
    const auto named = [&](const char* end) {
      return scratch() / fmt::format("{}{}", worker, end);
    };
    return {named(".plan.json"), named(".txt"),   named(".jsonl"),
            named(".folder"),    named(".proof"), named(".cts.json")};
  }

  void do_run(std::size_t run, std::size_t worker) {
    const Method& method = runs_.method(run);
    batch::Row row{.run = runs_[run],
                   .facts = runs_.instance(run).facts,
                   .machine = options_.machine,
                   .threads = method.threads,
                   .solver = method.solver ? method.solver->adapter.name : ""};
    try {
      if (const std::string& why = runs_.instance(run).error; !why.empty())
        row.outcome = {.error = why};
      else if (!(method.solver ? solve_externally(row, run, files_of(worker))
                               : solve(row, run, files_of(worker))))
        return;
    } catch (const InputError& error) {
      row.outcome = {.error = error.what()};
    }
    if (row.outcome.interrupted() && must_stop()) return;  // the signal also reached the child
    row.ended_at = batch::machine_clock().utc();
    if (row.outcome.version.empty()) row.outcome.version = options_.version;
    record(row);
  }

  ChildEnd run_one(const std::vector<std::string>& command, batch::Row& row, const Files& files,
                   bool receives_time_limit, std::optional<double> memory_gb) const {
    const double limit = row.run.settings.time_limit_s;
    const double for_certificate = options_.verify.empty() ? 0 : limit;
    const double grace = limit * (options_.grace_factor - 1) + options_.grace_s + for_certificate;
    const ChildEnd end = run_child(command, files.output_file,
                                   {.seconds = receives_time_limit ? limit + grace : limit,
                                    .cancelled = [this] { return must_stop(); },
                                    .memory_gb = memory_gb});
    row.wall_s = end.wall_s;
    return end;
  }

  // Runs Grove and sets the outcome. Returns false if the run or the check of its certificate was
  // cancelled. Reads the instance again after the run, so that the check depends only on the files.
  bool solve(batch::Row& row, std::size_t run, const Files& files) {
    const BenchInstance& instance = runs_.instance(run);
    const double limit = row.run.settings.time_limit_s;
    fs::remove(files.plan);
    fs::remove(files.log);
    fs::remove(files.proof);
    auto command =
        solve_command(options_.program, instance.entry, runs_.method(run), limit, files.plan);
    command.insert(command.end(), {"--log", files.log.string(), "--log-format", "jsonl"});
    if (!options_.verify.empty()) command.insert(command.end(), {"--proof", files.proof.string()});
    const ChildEnd end = run_one(command, row, files, true, std::nullopt);
    if (end.kind == ChildEnd::Kind::kCancelled) return false;
    const LoadedInstance loaded = load(instance.entry);
    row.outcome = is_refusal(end)
                      ? batch::Outcome{.status = batch::kUnsupported,
                                       .error = refusal(files.output_file, instance.entry.path)}
                      : outcome_of_run(end, limit, loaded.instance, files.plan, files.output_file);
    if (!row.outcome.failed()) row.outcome.trace = trace_of_log(files.log);
    if (!row.outcome.trace.empty()) row.outcome.first_plan_s = row.outcome.trace.front().seconds;
    if (fs::exists(files.proof) && !certify(row.outcome, instance.entry, loaded, files))
      return false;
    row.root_cost = root_costs_.of(runs_.instance_index(run), loaded.instance);
    if (options_.keep_plans) keep(files.plan, plan_name(row), row);
    return true;
  }

  // Runs grove-verify on the certificate of the run. Returns false if the check was cancelled.
  bool certify(batch::Outcome& outcome, const batch::Entry& entry, const LoadedInstance& loaded,
               const Files& files) const {
    fs::path instance = entry.path;
    if (entry.agents > 0) {
      instance = files.instance;
      write_instance(instance, loaded.instance, fs::absolute(loaded.map_path),
                     Durability::kProcess);
    }
    std::vector<std::string> command{options_.verify, instance.string(), files.proof.string()};
    if (entry.rules.confined && entry.agents == 0) command.push_back("--confine");
    const ChildEnd end = run_child(command, files.output_file,
                                   {.seconds = kMaxCheckTime_s,
                                    .cancelled = [this] { return must_stop(); },
                                    .memory_gb = std::nullopt});
    if (end.kind == ChildEnd::Kind::kCancelled) return false;
    outcome.verify_s = end.wall_s;
    outcome.proof_bytes = static_cast<std::int64_t>(fs::file_size(files.proof));
    outcome.certified = check_claims(outcome, end, files.output_file);
    return true;
  }

  bool solve_externally(batch::Row& row, std::size_t run, const Files& files) {
    const batch::Entry& entry = runs_.instance(run).entry;
    const LoadedInstance loaded = load(entry);
    try {
      const Method& method = runs_.method(run);
      ExternalRun external(*method.solver, entry, loaded, row.run.settings, files.folder);
      const ChildEnd end =
          run_one(external.command(), row, files, external.receives_time_limit(), method.memory_gb);
      if (end.kind == ChildEnd::Kind::kCancelled) return false;
      row.outcome = external.outcome_of_run(end, files.output_file);
      if (options_.keep_plans) keep(external, loaded.instance, files, row);
    } catch (const NotRepresentable& error) {
      row.outcome = {.status = batch::kUnsupported,
                     .error = fmt::format("{}: {}", error.field(), error.what())};
    }
    row.root_cost = root_costs_.of(runs_.instance_index(run), loaded.instance);
    return true;
  }

  static std::string plan_name(const batch::Row& row) {
    const batch::Settings& settings = row.run.settings;
    const std::string seed = settings.seed == 0 ? "" : fmt::format("+seed{}", settings.seed);
    return batch::plan_file(settings.method + seed + "/" + row.run.instance);
  }

  void keep(const fs::path& file, const std::string& name, batch::Row& row) const {
    if (!fs::exists(file)) return;
    row.plan_file = name;
    const fs::path kept = options_.folder / name;
    batch::make_folder(kept.parent_path());
    fs::rename(file, kept);
  }

  // Keeps a valid plan of an external solver as a Grove plan file, and an invalid plan unchanged.
  void keep(const ExternalRun& external, const Instance& instance, const Files& files,
            batch::Row& row) const {
    if (external.valid_plan()) {
      write_solution(files.plan, instance, *external.valid_plan());
      keep(files.plan, plan_name(row), row);
    } else if (row.outcome.status == batch::kInvalidPlan) {
      keep(external.plan(), plan_name(row) + ".wrong", row);
    }
  }

  void record(const batch::Row& row) {
    const std::lock_guard lock(mutex_);
    GROVE_CHECK(!row.root_cost || !row.outcome.cost || *row.root_cost <= *row.outcome.cost,
                "no plan costs less than the sum of the agents' best sequences");
    writer_.write({&row, 1});
    state_.count(row);
    GROVE_CHECK(state_.work.left >= 0, "no run is counted twice");
  }

  // --- progress ---

  BenchState state() {
    const std::lock_guard lock(mutex_);
    BenchState state = state_;
    state.elapsed_s = seconds();
    const Clock::time_point now = Clock::now();
    for (const UnderWay& run : under_way_)
      if (run.busy)
        state.work.under_way_s += std::chrono::duration<double>(now - run.since).count();
    return state;
  }

  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  fs::path scratch() const { return options_.folder / ".running"; }

  const BenchOptions& options_;
  const Clock::time_point start_ = Clock::now();
  const AllRuns runs_;
  batch::ResultTable table_;
  batch::TableWriter writer_;
  const std::vector<std::size_t> todo_;  // positions in runs_
  RootCosts root_costs_;

  std::mutex mutex_;  // guards table_, writer_ and all members below, except for the atomics
  std::size_t next_ = 0;
  BenchState state_;
  std::vector<UnderWay> under_way_;  // by worker
  std::exception_ptr failure_;
  std::atomic<bool> failed_ = false;
  std::atomic<std::size_t> working_ = workers();
};

}  // namespace

std::vector<std::string> solve_command(const std::string& program, const batch::Entry& entry,
                                       const Method& method, double time_limit_s,
                                       const fs::path& plan) {
  std::vector<std::string> words{program, "solve", entry.path};
  if (entry.agents > 0)
    words.insert(words.end(), {"--map", entry.map, "--agents", std::to_string(entry.agents)});
  if (entry.rules.confined) words.push_back("--confine");
  words.insert(words.end(), method.arguments.begin(), method.arguments.end());
  words.insert(words.end(), {"--time-limit", fmt::format("{}", time_limit_s), "--output",
                             plan.string(), "--quiet"});
  return words;
}

BenchState run_bench(const std::vector<BenchInstance>& instances,
                     const std::vector<Method>& methods, const BenchOptions& options) {
  return Bench(instances, methods, options).run();
}

}  // namespace grove::detail::bench
