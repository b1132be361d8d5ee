// SPDX-License-Identifier: MIT
// The certificate that a run leaves (docs/proof.md).
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "grove/detail/model/instance.h"
#include "grove/detail/model/plan.h"
#include "grove/detail/proof/proof_parts.h"
#include "tools/solve/solve_arguments.h"

namespace grove::detail {

// While the run goes on, what it writes down is in files beside the certificate, FILE.part-N; of a
// run that is to go on from its checkpoint they stay, and with those that follow make one
// certificate in the end.
class ProofOutput {
 public:
  // Nothing is done if none is asked for. Throws InputError, and CLI::ValidationError for runs that
  // cannot write one. `resumed`: the run goes on from a checkpoint.
  ProofOutput(const SolveArguments& arguments, bool resumed);

  // For SolveOptions; null if none is asked for.
  ProofLog* log() { return recorder_.get(); }
  // Makes the certificate, and notes in the solution's statistics what it proves.
  void write(const Instance& instance, Solution& solution);

 private:
  const std::filesystem::path file_;
  const bool goes_on_;  // a later run may
  std::vector<std::filesystem::path> parts_;
  std::unique_ptr<ProofRecorder> recorder_;
};

}  // namespace grove::detail
