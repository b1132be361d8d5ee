// SPDX-License-Identifier: MIT
// A row of the table of results: what is stored of one run of a method on an instance.
//
// Columns, in the order of the file. A missing value is null or empty. Times are in seconds, costs
// in steps, memory in MB (1e6 bytes).
//
//     instance, method, options      Entry::id; name of the method; its options as typed
//     map, scenario, agents, tasks, problem     InstanceMetadata; missing: the instance is
//     unreadable omega, seed, time_limit_s      settings of the run solved the run ended by itself,
//     before any limit, with a re-checked
//                                    plan; anytime: it had a plan in time
//     status                         as in the plan file; or "error": it crashed, or Grove's plan
//                                    is invalid; or "unsupported": the method does not support the
//                                    instance; other solvers: "feasible", "invalid" (the plan is
//                                    invalid) or "claimed" (a cost without a plan)
//     cost                           of the plan that was re-checked
//     lower_bound, gap               proven by Grove; (cost - lower bound) / lower bound
//     root_cost, sqr                 sum of the costs of the agents' best sequences, conflicts
//                                    ignored; its ratio to the cost, if solved
//     runtime_s                      wall time; the time limit if not solved; anytime: time of the
//                                    first plan
//     wall_s                         from the start of the process to its end
//     first_plan_s                   time of the first plan, as reported by the run
//     roots, rtsp_calls, nodes, low_level_calls     as in the plan file
//     peak_memory_mb                 as in the plan file; other solvers: measured by the system
//     version, machine, ended_at     of Grove; processor and cores; UTC
//     error                          why the status is error, or the limit that was reached
//     ranks, threads                 number of ranks; threads of each rank
//     memory_limit_gb                missing: limited by the machine
//     plan_file                      relative to the table's folder; missing: no plan was kept
//     instance_digest                detects whether an instance has changed
//     counts                         other counters: "bypasses=2 joint_mdd_nodes=77", named as in
//     the
//                                    plan file, without zeros
//     solver                         adapter of another solver; missing: Grove
//     claimed_cost, claimed_lower_bound, claimed_s     claims of another solver: plan and time
//     anytime                        it runs until its time limit, which is not a failure
//     trace                          the plans found on the way, as reported by the run, up to the
//                                    one that was re-checked: "0.25:120:100 1.5:118:-" (seconds,
//                                    cost, bound)
//
// Older tables lack the columns from counts on.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "batch/instance_facts.h"
#include "batch/outcome.h"

namespace grove::detail::batch {

// All inputs of a run except for the instance. Two runs with equal inputs should have equal
// results.
struct Settings {
  std::string method;
  std::string options;  // without those that have a member below
  std::string omega;    // value that results from the options: 0, 0.01, inf
  std::int64_t seed = 0;
  double time_limit_s = 0;
  std::optional<double> memory_limit_gb = {};  // nullopt: limited by the machine

  friend bool operator==(const Settings&, const Settings&) = default;
};

// The identity of a run.
struct Run {
  std::string instance;  // Entry::id
  std::string digest;    // Entry::digest
  Settings settings;

  friend bool operator==(const Run&, const Run&) = default;
};

struct Row {
  Run run;
  InstanceMetadata facts = {};
  Outcome outcome = {};
  std::optional<Cost> root_cost = {};
  double wall_s = 0;  // microseconds in files
  std::string machine = {};
  std::string ended_at = {};  // UTC, as 2026-11-30T23:59:59Z
  std::int64_t ranks = 1;
  std::int64_t threads = 1;
  std::string plan_file = {};
  std::string solver = {};  // empty: Grove

  // As in the paper, an unsolved run counts with its time limit.
  double runtime_s() const {
    const double limit = run.settings.time_limit_s;
    if (!outcome.solved) return limit;
    return outcome.anytime ? std::min(outcome.first_plan_s.value_or(wall_s), limit) : wall_s;
  }

  friend bool operator==(const Row&, const Row&) = default;
};

// The row as one line of JSON, without a line end. Invalid UTF-8 is replaced.
std::string json_line(const Row& row);
// The inverse of json_line(). Throws std::invalid_argument with a description of the error.
Row parse_json_line(std::string_view line);

// The same as CSV (RFC 4180). A missing value is empty.
std::string csv_header();
std::string csv_line(const Row& row);

}  // namespace grove::detail::batch
