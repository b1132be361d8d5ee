// SPDX-License-Identifier: MIT
// What one asks about checkpoints on the command line, and going on from one.
#pragma once

#include <CLI/App.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "grove/engine/checkpoint.h"
#include "grove/engine/solve.h"

namespace grove {

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

// Makes the folder, sees that a checkpoint can be written there, and sets `options` up to write
// checkpoints, in which case SIGUSR1 asks for one, and to go on from the one that is there; which
// is returned, for it must outlive the run (null: none). Throws InputError for a folder or a file
// that cannot be used, and when there is a checkpoint and nothing was said of it;
// CLI::ValidationError when the arguments do not fit together.
std::unique_ptr<CheckpointReader> prepare_checkpoints(const CheckpointArguments& arguments,
                                                      const Instance& instance,
                                                      SolveOptions& options);

}  // namespace grove
