// SPDX-License-Identifier: MIT
// Checkpoint options of the command line, and resuming from a checkpoint.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "engine/checkpoint.h"
#include "engine/solve.h"
#include "io/file_lock.h"

namespace grove::detail {

struct CheckpointArguments {
  std::filesystem::path directory;
  double interval_s = 600;
  std::string resume;  // "" if not given

  // File of the best plan so far, written before the plan is announced; "" without checkpoints.
  std::filesystem::path incumbent_file() const {
    return directory.empty() ? directory : directory / "incumbent.plan.json";
  }
};

// `arguments` must outlive the parsing of the command line.
void add_checkpoint_options(CLI::App& app, CheckpointArguments& arguments);

// Resources that a run holds until its end.
struct CheckpointFolder {
  std::optional<FileLock> lock;               // nullopt without checkpoints
  std::unique_ptr<CheckpointReader> resumed;  // nullptr: a new search
};

// Creates and locks the folder, checks that a checkpoint can be written there, and sets `options`
// so that the run writes checkpoints (also on SIGUSR1) and resumes from an existing one. Throws
// InputError if a folder or file cannot be used, for instance because another run uses it, or if
// there is a checkpoint and --resume is not given; CLI::ValidationError if the arguments contradict
// each other.
CheckpointFolder prepare_checkpoints(const CheckpointArguments& arguments, const Instance& instance,
                                     SolveOptions& options);

}  // namespace grove::detail
