// SPDX-License-Identifier: MIT
// The result of a run.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/plan.h"

namespace grove::detail::batch {

// A plan that a run found on the way, as reported by the run.
struct TracePoint {
  double seconds = 0;  // since the start of the run
  Cost cost = 0;
  std::optional<Cost> lower_bound = {};

  friend bool operator==(const TracePoint&, const TracePoint&) = default;
};

// Statuses in addition to those of a plan file. (A status of a plan file means that the result was
// re-checked.)
inline constexpr const char* kError = "error";          // the run failed; it will be repeated
inline constexpr const char* kInvalidPlan = "invalid";  // other solvers: the plan is invalid
inline constexpr const char* kClaimed = "claimed";      // other solvers: a cost without a plan
// The method does not support this instance.
inline constexpr const char* kUnsupported = "unsupported";

struct Outcome {
  std::string status = kError;  // as in a plan file, or one of the above
  bool solved = false;          // the run ended by itself with a plan that was re-checked
  std::optional<Cost> cost = {};
  std::optional<Cost> lower_bound = {};
  std::optional<double> first_plan_s = {};  // rounded to microseconds in files
  std::optional<std::int64_t> roots = {};
  std::optional<std::int64_t> rtsp_calls = {};
  std::optional<std::int64_t> nodes = {};
  std::optional<std::int64_t> low_level_calls = {};
  std::optional<double> peak_memory_mb = {};
  std::string counts = {};   // other counters of the search: "name=number name=number"
  std::string version = {};  // version of the program
  std::string error = {};    // why there is no better status, or the limit that was reached
  // Claims of another solver about its plan; not verified.
  std::optional<Cost> claimed_cost = {};
  std::optional<Cost> claimed_lower_bound = {};
  std::optional<double> claimed_s = {};  // rounded to microseconds in files
  std::vector<TracePoint> trace = {};    // in order of time, with falling costs
  // Whether a separate program accepted the certificate of the lower bound or infeasibility;
  // nullopt: it was not run.
  std::optional<bool> certified = {};
  std::optional<double> verify_s = {};  // duration of this verification
  std::optional<std::int64_t> proof_bytes = {};
  bool anytime = false;  // the run uses its whole time limit: solved if it found a plan

  bool failed() const { return status == kError; }
  // True if the run was stopped from outside, not by one of its own limits. The result of such a
  // run is not kept.
  bool interrupted() const { return failed() && error == "interrupt"; }

  friend bool operator==(const Outcome&, const Outcome&) = default;
};

// The outcome of a run that returned `solution` for `instance`. Verifies everything that the
// checker can verify. Does not set first_plan_s, trace, anytime, and the members about other
// solvers' claims and about certificates.
Outcome outcome_of(const Instance& instance, const Solution& solution);

// Reduces a trace to at most max(max_count, 2) points: repeatedly removes every second point, but
// never the first or the last one.
void thin_out(std::vector<TracePoint>& trace, std::size_t max_count);

// Text such as "0.25:120:100 1.5:118:-": seconds, cost, lower bound.
std::string trace_text(const std::vector<TracePoint>& trace);
// The inverse of trace_text(), which rounds times to microseconds. Throws std::invalid_argument if
// `text` has another form.
std::vector<TracePoint> parse_trace(const std::string& text);

}  // namespace grove::detail::batch
