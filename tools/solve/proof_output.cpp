// SPDX-License-Identifier: MIT
#include "tools/solve/proof_output.h"

#include <fmt/format.h>

#include <CLI/Error.hpp>
#include <string>

#include "grove/detail/engine/method.h"
#include "grove/detail/io/atomic_file.h"
#include "grove/detail/io/input_error.h"
#include "grove/detail/proof/certificate.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

fs::path part_of(const fs::path& file, std::size_t number) {
  return fs::path(file).concat(fmt::format(".part-{}", number));
}

std::string text_of(const Certificate& made, Cost claimed) {
  const auto cost_text = [](Cost cost) {
    return cost >= kInfiniteCost ? std::string("there is no plan")
                                 : fmt::format("no plan costs less than {}", cost);
  };
  std::string text =
      fmt::format("{}; {} splits, {} leaves, {} lemmas, {} bytes", cost_text(made.bound),
                  made.splits, made.leaves, made.lemmas, made.bytes);
  if (made.bound < claimed)
    text += fmt::format(" (that {} is left uncertified)", cost_text(claimed));
  return text;
}

}  // namespace

ProofOutput::ProofOutput(const SolveArguments& a, bool resumed)
    : file_(a.proof), goes_on_(!a.checkpoints.directory.empty()) {
  if (file_.empty()) return;
  if (solve_options(a).policy == Policy::kFixed || is_adaptation(method_of(a)))
    throw CLI::ValidationError("--proof",
                               "expected --policy free and a method of one tree with it");
  require_writable(file_);
  for (std::size_t number = 0; fs::exists(part_of(file_, number)); ++number) {
    if (resumed)
      parts_.push_back(part_of(file_, number));
    else
      fs::remove(part_of(file_, number));
  }
  parts_.push_back(part_of(file_, parts_.size()));
  recorder_ = std::make_unique<ProofRecorder>(parts_.back());
}

void ProofOutput::write(const Instance& instance, Solution& solution) {
  if (!recorder_) return;
  recorder_->flush();
  const Cost claimed =
      solution.status == Status::kInfeasible ? kInfiniteCost : solution.lower_bound;
  const Certificate made = write_certificate(instance, parts_, claimed, file_);
  solution.stats.texts["proof"] = text_of(made, claimed);
  recorder_.reset();
  if (goes_on_) return;
  for (const fs::path& part : parts_) fs::remove(part);
}

}  // namespace grove::detail
