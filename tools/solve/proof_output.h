// SPDX-License-Identifier: MIT
// The certificate that a run leaves (docs/proof.md).
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "model/instance.h"
#include "model/plan.h"
#include "proof/proof_parts.h"
#include "tools/solve/solve_arguments.h"

namespace grove::detail {

// While the run goes on, what each rank writes down is in files beside the certificate,
// FILE.part-RANK-N; of a run that is to go on from its checkpoint they stay, and with those that
// follow make one certificate in the end.
class ProofOutput {
 public:
  // Nothing is done if none is asked for. Throws InputError, and CLI::ValidationError for runs that
  // cannot write one.
  explicit ProofOutput(const SolveArguments& arguments, int rank = 0);
  // What earlier runs left goes, unless this one is to go on from a checkpoint; of several ranks
  // one does it, before any makes its own. Throws InputError where no certificate can be written.
  static void remove_old(const SolveArguments& arguments);

  // For SolveOptions; null if none is asked for.
  ProofLog* log() { return recorder_.get(); }
  // This rank writes no more. Returns why not all that it has written down is in its file; empty:
  // all is.
  std::string close();
  // Once all ranks have closed theirs, with what close() returned on one that failed: makes the
  // certificate, and notes in the solution's statistics what it proves. What fails is told by
  // failure(), for the plan is to be written first.
  void write(const Instance& instance, Solution& solution, const std::string& failure);
  // Why there is no certificate; empty: there is one, or none was asked for.
  const std::string& failure() const { return failure_; }

 private:
  void make(const Instance& instance, Solution& solution) const;
  void remove_parts() const;

  const std::filesystem::path file_;
  const bool goes_on_;  // a later run may
  std::unique_ptr<ProofRecorder> recorder_;
  std::string failure_;
};

}  // namespace grove::detail
