// SPDX-License-Identifier: MIT
// Command-line options for writing checkpoints and resuming from them.
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
  double interval_s = 600;  // between two checkpoints, seconds
  std::string resume;       // "auto", "never", or "" if not given

  // Returns the file for the incumbent, which is written before the incumbent is announced; ""
  // without checkpoints.
  std::filesystem::path incumbent_file() const {
    return directory.empty() ? directory : directory / "incumbent.plan.json";
  }
};

// Adds --checkpoint, --checkpoint-interval and --resume. `arguments` must outlive the parsing of
// the command line.
void add_checkpoint_options(CLI::App& app, CheckpointArguments& arguments);

// Resources for checkpoints that a run must keep until its end.
struct CheckpointFolder {
  std::optional<FileLock> lock;               // nullopt without checkpoints
  std::unique_ptr<CheckpointReader> resumed;  // nullptr: the run starts a new search
};

// Creates and locks the folder and checks that a checkpoint can be written there. Sets `options` so
// that the run writes checkpoints (also on SIGUSR1) and, with --resume auto, resumes from an
// existing checkpoint and starts from the incumbent of the earlier run unless the start plan costs
// no more. With --resume never, removes that incumbent. Does nothing without --checkpoint. Throws
// InputError if the folder or a file in it cannot be used, for instance because another run uses
// it, and if a checkpoint or incumbent exists but --resume is not given.
CheckpointFolder prepare_checkpoints(const CheckpointArguments& arguments, const Instance& instance,
                                     SolveOptions& options);

}  // namespace grove::detail
