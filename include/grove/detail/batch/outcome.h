// SPDX-License-Identifier: MIT
// How a run ended.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "grove/detail/model/plan.h"

namespace grove::detail::batch {

struct Outcome {
  std::string status = "error";  // or a plan file's
  bool solved = false;           // ended by itself with a plan that was re-checked
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
  std::string error = {};    // why the status is error, or the limit that struck

  bool failed() const { return status == "error"; }
  // Stopped from outside, and not by a limit of its own: no result to keep.
  bool interrupted() const { return failed() && error == "interrupt"; }

  friend bool operator==(const Outcome&, const Outcome&) = default;
};

// What `solution`, which some run claims of `instance`, is worth: nothing is believed that the
// checker can work out itself. first_plan_s is not known.
Outcome outcome_of(const Instance& instance, const Solution& solution);

}  // namespace grove::detail::batch
