// SPDX-License-Identifier: MIT
// What one asks about checkpoints on the command line, and going on from one.
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
  std::string resume;  // empty: not said

  // The best plan so far, written before it is announced; empty without checkpoints.
  std::filesystem::path incumbent_file() const {
    return directory.empty() ? directory : directory / "incumbent.plan.json";
  }
};

// `arguments` must outlive the parsing.
void add_checkpoint_options(CLI::App& app, CheckpointArguments& arguments);

// What a run holds until its end.
struct CheckpointFolder {
  std::optional<FileLock> lock;               // none without checkpoints
  std::unique_ptr<CheckpointReader> resumed;  // null: the run begins anew
};

// Makes the folder and locks it, sees that a checkpoint can be written there, and sets `options` up
// to write checkpoints, in which case SIGUSR1 asks for one, and to go on from the one that is
// there. Throws InputError for a folder or a file that cannot be used, also because another run
// does, and when there is a checkpoint and nothing was said of it; CLI::ValidationError when the
// arguments do not fit together.
CheckpointFolder prepare_checkpoints(const CheckpointArguments& arguments, const Instance& instance,
                                     SolveOptions& options);

}  // namespace grove::detail
