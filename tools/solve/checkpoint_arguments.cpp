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

constexpr double kShortestInterval_s = 0.1;  // there should be time for the search
constexpr double kLongestInterval_s = 1e9;

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw InputError(
        folder.string(), "",
        fmt::format("cannot be made{}{}; expected a folder for checkpoints", error ? ": " : "",
                    error ? error.message() : ": there is a file of that name"));
  require_writable(checkpoint_file(folder));
}

// Two runs in one folder would take each other's checkpoints away.
FileLock lock_folder(const std::filesystem::path& folder) {
  FileLock lock(folder / "checkpoint.lock");
  if (!lock.is_held())
    say_on_stderr(
        fmt::format("grove: warning: {}: cannot be locked on this file system; see to it "
                    "that no other run uses it",
                    folder.string()));
  return lock;
}

// Not torn by a crash of the machine: the disk gets a plan while the search goes on.
bool is_whole(const std::filesystem::path& plan) {
  return read_text(plan).ends_with("}\n");
}

// The better one of the plan to start from and the one that an earlier run left.
void start_from_incumbent(const std::filesystem::path& file, const Instance& instance,
                          SolveOptions& options) {
  if (!std::filesystem::exists(file)) return;
  if (!is_whole(file))
    return say_on_stderr(fmt::format(
        "grove: warning: {}: ends in the middle; goes on without that plan", file.string()));
  Plan plan = read_valid_plan(file, instance);
  if (!options.start || plan.cost < options.start->cost) options.start = std::move(plan);
}

}  // namespace

void add_checkpoint_options(CLI::App& app, CheckpointArguments& a) {
  CLI::Option* checkpoint =
      app.add_option("--checkpoint", a.directory,
                     "write the state of the search to this folder now and then, on SIGUSR1 and at "
                     "the end, past the time limit if need be, so that a later run can go on from "
                     "it; and the best plan, before it is announced")
          ->type_name("DIR");
  add_number(app, "--checkpoint-interval", a.interval_s, kShortestInterval_s, kLongestInterval_s,
             "the time between two checkpoints")
      ->type_name("S")
      ->needs(checkpoint);
  app.add_option("--resume", a.resume,
                 "what to do about a checkpoint in that folder: go on from it (auto; without one, "
                 "begin), or begin anew (never). With neither, finding one is an error")
      ->type_name("auto|never")
      ->check(one_of({"auto", "never"}))
      ->needs(checkpoint);
}

CheckpointFolder prepare_checkpoints(const CheckpointArguments& a, const Instance& instance,
                                     SolveOptions& options) {
  if (a.directory.empty()) return {};
  make_folder(a.directory);
  CheckpointFolder folder{lock_folder(a.directory), nullptr};
  options.checkpoints = {a.directory, a.interval_s, &checkpoint_asked};
  const std::filesystem::path file = checkpoint_file(a.directory);
  const bool found = std::filesystem::exists(file);
  if (a.resume.empty() && (found || std::filesystem::exists(a.incumbent_file())))
    throw InputError(found ? file.string() : a.incumbent_file().string(), "",
                     "is of an earlier run; expected --resume auto to go on from it or --resume "
                     "never to begin anew");
  if (a.resume == "never") {
    std::filesystem::remove(a.incumbent_file());
    return folder;
  }
  if (found) {  // first, since it knows whose it is
    const Policy policy = options.policy == Policy::kFixed ? Policy::kFixed : Policy::kFree;
    folder.resumed = std::make_unique<CheckpointReader>(a.directory, fingerprint(instance), policy);
    options.resume = folder.resumed.get();
  }
  start_from_incumbent(a.incumbent_file(), instance, options);
  return folder;
}

}  // namespace grove::detail
