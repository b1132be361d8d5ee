// SPDX-License-Identifier: MIT
#include "tools/solve/proof_output.h"

#include <fmt/format.h>

#include <CLI/Error.hpp>
#include <algorithm>
#include <new>
#include <string>
#include <vector>

#include "engine/method.h"
#include "io/atomic_file.h"
#include "io/input_error.h"
#include "proof/certificate.h"
#include "tools/common/standard_error.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

// Returns the part files of all ranks and runs for the certificate `file`.
std::vector<fs::path> parts_of(const fs::path& file) {
  const std::string prefix = file.filename().string() + ".part-";
  std::vector<fs::path> parts;
  for (const auto& entry : fs::directory_iterator(fs::absolute(file).parent_path()))
    if (entry.path().filename().string().starts_with(prefix)) parts.push_back(entry.path());
  std::ranges::sort(parts);
  return parts;
}

fs::path unused_part(const fs::path& file, int rank) {
  for (int number = 0;; ++number) {
    fs::path part = fs::path(file).concat(fmt::format(".part-{}-{}", rank, number));
    if (!fs::exists(fs::symlink_status(part))) return part;
  }
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

// The checker repeats a joint search over all states and times, and takes about 10 times as long as
// Grove. Up to this number of joint states it takes at most seconds.
constexpr std::int64_t kFewJointStates = 1000;

// Returns whether the instance has at most kFewJointStates joint states.
bool has_few_joint_states(const Instance& instance) {
  std::int64_t states = 1;
  for (AgentIndex agent = 0; agent < instance.agent_count() && states <= kFewJointStates; ++agent)
    states *= instance.world().state_count();
  return states <= kFewJointStates;
}

void warn_of_joint_search(const fs::path& file, const Instance& instance, const Stats& stats) {
  const auto searched = stats.counts.find("joint_states");
  if (searched != stats.counts.end()) {
    if (searched->second > kFewJointStates)
      print_to_stderr(fmt::format(
          "grove: warning: {}: the proof is a joint search of all agents, which the checker must "
          "repeat; the search had {} joint states, and grove-verify may take 10 times as long",
          file.string(), searched->second));
  } else if (!has_few_joint_states(instance)) {
    print_to_stderr(fmt::format(
        "grove: warning: {}: the proof is a joint search of all agents that Grove did not need; it "
        "may take too much time or memory of grove-verify",
        file.string()));
  }
}

}  // namespace

ProofOutput::ProofOutput(const SolveArguments& a, int rank)
    : file_(a.proof), may_resume_(!a.checkpoints.directory.empty()) {
  if (file_.empty()) return;
  if (method_of(a) == Method::kCtsCbsB || method_of(a) == Method::kCtsCbsC)
    throw CLI::ValidationError(
        "--proof", fmt::format("not possible with --method {}; expected another method", a.method));
  recorder_ = std::make_unique<ProofRecorder>(unused_part(file_, rank));
}

void ProofOutput::remove_old(const SolveArguments& a) {
  if (a.proof.empty()) return;
  require_writable(a.proof);
  for (const fs::path& part : parts_of(a.proof)) fs::remove(part);
}

std::string ProofOutput::close() {
  return recorder_ ? recorder_->flush() : "";
}

void ProofOutput::write(const Instance& instance, Solution& solution, const std::string& failure) {
  if (!recorder_) return;
  failure_ = failure;
  try {
    if (failure.empty())
      make(instance, solution);
    else
      remove_parts();
  } catch (const InputError& error) {
    failure_ = error.what();
  } catch (const std::bad_alloc&) {
    failure_ = InputError(file_.string(), "",
                          "there is not enough memory to make the certificate; its parts remain")
                   .what();
  }
  if (!failure_.empty()) solution.stats.texts["proof"] = "none was written";
}

void ProofOutput::make(const Instance& instance, Solution& solution) const {
  const std::vector<fs::path> parts = parts_of(file_);
  const Cost claimed =
      solution.status == Status::kInfeasible ? kInfiniteCost : solution.lower_bound;
  const Certificate made = write_certificate(instance, parts, claimed, file_);
  solution.stats.texts["proof"] = text_of(made, claimed);
  if (made.by_joint_search) warn_of_joint_search(file_, instance, solution.stats);
  remove_parts();
}

void ProofOutput::remove_parts() const {
  if (may_resume_) return;
  for (const fs::path& part : parts_of(file_)) fs::remove(part);
}

}  // namespace grove::detail
