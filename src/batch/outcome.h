// SPDX-License-Identifier: MIT
// How a run ended.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/plan.h"

namespace grove::detail::batch {

// A plan that a run had on the way, as it says itself.
struct TracePoint {
  double seconds = 0;  // since the run began
  Cost cost = 0;
  std::optional<Cost> lower_bound = {};

  friend bool operator==(const TracePoint&, const TracePoint&) = default;
};

// Beside the statuses of a plan file, which are what was proven and re-checked.
inline constexpr const char* kError = "error";            // the run is broken: to be tried again
inline constexpr const char* kWrongPlan = "wrong";        // of another solver: its plan is none
inline constexpr const char* kClaimed = "claimed";        // of another solver: a cost, but no plan
inline constexpr const char* kUnsuitable = "unsuitable";  // the method is not for this instance

struct Outcome {
  std::string status = kError;  // or a plan file's, or one of those above
  bool solved = false;          // ended by itself with a plan that was re-checked
  std::optional<Cost> cost = {};
  std::optional<Cost> lower_bound = {};
  std::optional<double> first_plan_s = {};  // files keep microseconds
  std::optional<std::int64_t> roots = {};
  std::optional<std::int64_t> rtsp_calls = {};
  std::optional<std::int64_t> nodes = {};
  std::optional<std::int64_t> low_level_calls = {};
  std::optional<double> peak_memory_mb = {};
  std::string counts = {};   // what else the search counted: "name=number name=number"
  std::string version = {};  // of the program
  std::string error = {};    // why there is no better status, or the limit that struck
  // What another solver says of its plan, believed in nothing.
  std::optional<Cost> claimed_cost = {};
  std::optional<Cost> claimed_lower_bound = {};
  std::optional<double> claimed_s = {};  // files keep microseconds
  std::vector<TracePoint> trace = {};    // by time; costs fall
  // Of its lower bound (of "infeasible" too), by another program; none: it was not asked.
  std::optional<bool> certified = {};
  std::optional<double> verify_s = {};  // that this took
  std::optional<std::int64_t> proof_bytes = {};
  bool anytime = false;  // it goes on until its time limit: solved as soon as it has a plan

  bool failed() const { return status == kError; }
  // Stopped from outside, and not by a limit of its own: no result to keep.
  bool interrupted() const { return failed() && error == "interrupt"; }

  friend bool operator==(const Outcome&, const Outcome&) = default;
};

// What `solution`, which some run claims of `instance`, is worth: nothing is believed that the
// checker can work out itself. first_plan_s is not known.
Outcome outcome_of(const Instance& instance, const Solution& solution);

// At most `most` points of a trace: the first, the last, and of the others each second as often as
// need be.
void thin_out(std::vector<TracePoint>& trace, std::size_t most);

// "0.25:120:100 1.5:118:-": seconds, cost, lower bound.
std::string trace_text(const std::vector<TracePoint>& trace);
// And back. Throws std::invalid_argument.
std::vector<TracePoint> parse_trace(const std::string& text);

}  // namespace grove::detail::batch
