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

// During the run each rank records its part in files beside the certificate, FILE.part-RANK-N. If
// the run can be resumed from its checkpoint, these files remain; together with those of later runs
// they make one certificate.
class ProofOutput {
 public:
  // Does nothing without --proof. Throws InputError, and CLI::ValidationError for runs that cannot
  // write a certificate.
  explicit ProofOutput(const SolveArguments& arguments, int rank = 0);
  // Removes files of earlier runs unless this run resumes from a checkpoint. With several ranks,
  // one calls it, before any rank creates its own files. Throws InputError if no certificate can be
  // written.
  static void remove_old(const SolveArguments& arguments);

  // For SolveOptions; nullptr without --proof.
  ProofLog* log() { return recorder_.get(); }
  // Ends this rank's part. Returns "", or the reason why a part of it is not in its file.
  std::string close();
  // Call it after all ranks have closed their parts, with the return value of close() of a rank
  // that failed. Makes the certificate and records in the solution's statistics what it proves. It
  // does not throw, because the plan must be written first; see failure().
  void write(const Instance& instance, Solution& solution, const std::string& failure);
  // Why there is no certificate; "" if there is one, or without --proof.
  const std::string& failure() const { return failure_; }

 private:
  void make(const Instance& instance, Solution& solution) const;
  void remove_parts() const;

  const std::filesystem::path file_;
  const bool may_resume_;  // a later run may resume
  std::unique_ptr<ProofRecorder> recorder_;
  std::string failure_;
};

}  // namespace grove::detail
