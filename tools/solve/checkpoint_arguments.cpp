// SPDX-License-Identifier: MIT
#include "tools/solve/checkpoint_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <system_error>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/text_file.h"
#include "model/fingerprint.h"
#include "tools/common/options.h"
#include "tools/common/signals.h"
#include "tools/common/standard_error.h"
#include "tools/solve/start_plan.h"

namespace grove::detail {
namespace {

constexpr double kShortestInterval_s = 0.1;  // so that the search makes progress
constexpr double kMaxInterval_s = 1e9;

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw InputError(
        folder.string(), "",
        fmt::format("cannot be created{}{}; expected a folder for checkpoints", error ? ": " : "",
                    error ? error.message() : ": a file has that name"));
  require_writable(checkpoint_file(folder));
}

// Locks the folder, so that two runs do not overwrite each other's checkpoints. Warns if the file
// system supports no locks.
FileLock lock_folder(const std::filesystem::path& folder) {
  FileLock lock(folder / "checkpoint.lock");
  if (!lock.is_held())
    print_to_stderr(
        fmt::format("grove: warning: {}: cannot be locked on this file system; make sure "
                    "that no other run uses it",
                    folder.string()));
  return lock;
}

// Returns whether the plan file is complete. A crash of the machine can truncate an incumbent file,
// because it is flushed to disk only after it has been renamed.
bool is_whole(const std::filesystem::path& plan) {
  return read_text(plan).ends_with("}\n");
}

// Replaces the start plan in `options` by the incumbent of an earlier run if that is cheaper.
void start_from_incumbent(const std::filesystem::path& file, const Instance& instance,
                          SolveOptions& options) {
  if (!std::filesystem::exists(file)) return;
  if (!is_whole(file))
    return print_to_stderr(fmt::format(
        "grove: warning: {}: is incomplete; continuing without that plan", file.string()));
  Plan plan = read_valid_plan(file, instance);
  if (!options.start || plan.cost < options.start->cost) options.start = std::move(plan);
}

}  // namespace

void add_checkpoint_options(CLI::App& app, CheckpointArguments& a) {
  CLI::Option* checkpoint =
      app.add_option("--checkpoint", a.directory,
                     "write the state of the search to this folder at intervals, on SIGUSR1 and at "
                     "the end (even after the time limit), so that a later run can resume; also "
                     "write the best plan there, before it is announced")
          ->type_name("DIR");
  add_number(app, "--checkpoint-interval", a.interval_s, kShortestInterval_s, kMaxInterval_s,
             "interval between two checkpoints, seconds")
      ->type_name("S")
      ->needs(checkpoint);
  app.add_option(
         "--resume", a.resume,
         "what to do with an existing checkpoint. auto: resume from it, or start a new search "
         "if there is none; never: start a new search. Default: an existing checkpoint is an error")
      ->type_name("auto|never")
      ->check(one_of({"auto", "never"}))
      ->needs(checkpoint);
}

CheckpointFolder prepare_checkpoints(const CheckpointArguments& a, const Instance& instance,
                                     SolveOptions& options) {
  if (a.directory.empty()) return {};
  make_folder(a.directory);
  CheckpointFolder folder{lock_folder(a.directory), nullptr};
  options.checkpoints = {a.directory, a.interval_s, &checkpoint_requested};
  const std::filesystem::path file = checkpoint_file(a.directory);
  const bool found = std::filesystem::exists(file);
  if (a.resume.empty() && (found || std::filesystem::exists(a.incumbent_file())))
    throw InputError(found ? file.string() : a.incumbent_file().string(), "",
                     "is of an earlier run; expected --resume auto to resume it or --resume "
                     "never to start a new search");
  if (a.resume == "never") {
    std::filesystem::remove(a.incumbent_file());
    return folder;
  }
  if (found) {  // before the incumbent, because this checks that the checkpoint fits the instance
    const Policy policy = options.policy == Policy::kFixed ? Policy::kFixed : Policy::kFree;
    folder.resumed = std::make_unique<CheckpointReader>(a.directory, fingerprint(instance), policy);
    options.resume = folder.resumed.get();
  }
  start_from_incumbent(a.incumbent_file(), instance, options);
  return folder;
}

}  // namespace grove::detail
