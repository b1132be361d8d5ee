// SPDX-License-Identifier: MIT
// Writes the certificate of a run (docs/proof.md).
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "model/instance.h"
#include "model/plan.h"
#include "proof/proof_parts.h"
#include "tools/solve/solve_arguments.h"

namespace grove::detail {

// During the run each rank logs its part of the proof to FILE.part-RANK-N beside the certificate
// FILE. At the end one rank combines the parts of all ranks. With --checkpoint the parts remain,
// because a later run that resumes needs them for its certificate too.
class ProofOutput {
 public:
  // Without --proof the object does nothing. Throws InputError if the part cannot be written, and
  // CLI::ValidationError for methods that cannot log a proof.
  explicit ProofOutput(const SolveArguments& arguments, int rank = 0);
  // Removes the parts of earlier runs. Call it on one rank, before any rank constructs its
  // ProofOutput, and only if the run does not resume from a checkpoint. Throws InputError if the
  // certificate cannot be written.
  static void remove_old(const SolveArguments& arguments);

  // The log for SolveOptions; nullptr without --proof.
  ProofLog* log() { return recorder_.get(); }
  // Flushes this rank's part. Returns "", or why the part is incomplete.
  std::string close();
  // Makes the certificate from the parts and records in the solution's statistics what it proves.
  // Call it on one rank after all ranks have called close(). `failure`: the result of close() on a
  // rank that failed, otherwise "". If the certificate cannot be written or memory runs out, sets
  // failure() instead of throwing, because the plan must still be written.
  void write(const Instance& instance, Solution& solution, const std::string& failure);
  // Why no certificate was written; "" if one was, or without --proof.
  const std::string& failure() const { return failure_; }

 private:
  void make(const Instance& instance, Solution& solution) const;
  void remove_parts() const;

  const std::filesystem::path file_;
  const bool may_resume_;  // a later run can resume from the checkpoint of this run
  std::unique_ptr<ProofRecorder> recorder_;
  std::string failure_;
};

}  // namespace grove::detail
