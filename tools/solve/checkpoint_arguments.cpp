// SPDX-License-Identifier: MIT
#include "tools/solve/checkpoint_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <system_error>

#include "grove/io/atomic_file.h"
#include "grove/io/input_error.h"
#include "grove/model/fingerprint.h"
#include "tools/common/options.h"
#include "tools/common/signals.h"
#include "tools/solve/start_plan.h"

namespace grove {
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

// The better one of the plan to start from and the one that an earlier run left.
void start_from_incumbent(const std::filesystem::path& file, const Instance& instance,
                          SolveOptions& options) {
  if (!std::filesystem::exists(file)) return;
  Plan plan = read_start_plan(file, instance);
  if (!options.start || plan.cost < options.start->cost) options.start = std::move(plan);
}

}  // namespace

void add_checkpoint_options(CLI::App& app, CheckpointArguments& a) {
  app.add_option("--checkpoint", a.directory,
                 "write the state of the search to this folder now and then, on SIGUSR1 and at the "
                 "end, so that a later run can go on from it; and the best plan, before it is "
                 "announced")
      ->type_name("DIR");
  add_number(app, "--checkpoint-interval", a.interval_s, kShortestInterval_s, kLongestInterval_s,
             "the time between two checkpoints")
      ->type_name("S");
  app.add_option("--resume", a.resume,
                 "what to do about a checkpoint in that folder: go on from it (auto; without one, "
                 "begin), or begin anew (never). With neither, finding one is an error")
      ->type_name("auto|never")
      ->check(CLI::Validator(
          [](const std::string& text) {
            return text == "auto" || text == "never"
                       ? std::string()
                       : fmt::format("found '{}'; expected auto or never", text);
          },
          ""));
}

std::unique_ptr<CheckpointReader> prepare_checkpoints(const CheckpointArguments& a,
                                                      const Instance& instance,
                                                      SolveOptions& options) {
  if (a.directory.empty()) {
    if (!a.resume.empty())
      throw CLI::ValidationError("--resume", "expected --checkpoint DIR to go with it");
    return nullptr;
  }
  make_folder(a.directory);
  options.checkpoints = {a.directory, a.interval_s, &checkpoint_asked};
  const std::filesystem::path file = checkpoint_file(a.directory);
  const bool found = std::filesystem::exists(file);
  if (a.resume.empty() && (found || std::filesystem::exists(a.incumbent_file())))
    throw InputError(found ? file.string() : a.incumbent_file().string(), "",
                     "is of an earlier run; expected --resume auto to go on from it or --resume "
                     "never to begin anew");
  if (a.resume == "never") {
    std::filesystem::remove(a.incumbent_file());
    return nullptr;
  }
  start_from_incumbent(a.incumbent_file(), instance, options);
  if (!found) return nullptr;
  const Policy policy = options.policy == Policy::kFixed ? Policy::kFixed : Policy::kFree;
  auto reader = std::make_unique<CheckpointReader>(a.directory, fingerprint(instance), policy);
  options.resume = reader.get();
  return reader;
}

}  // namespace grove
