// SPDX-License-Identifier: MIT
// A row of the result table: the stored data of one run of a method on an instance.
//
// Columns, in the order of the file. A missing value is null or empty. Times are in seconds, costs
// in steps, memory in MB (1e6 bytes).
//
//     instance, method, options      Entry::id; name of the method; its options as typed
//     map, scenario, agents, tasks, problem     InstanceMetadata; missing: the instance is
//                                    unreadable
//     omega, seed, time_limit_s      settings of the run
//     solved                         the run ended by itself, before any limit, with a re-checked
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
//     error                          why there is no better status, or the limit that was reached
//     ranks, threads                 number of ranks; threads of each rank
//     memory_limit_gb                missing: limited by the machine
//     plan_file                      relative to the table's folder; missing: no plan was kept
//     instance_digest                detects whether an instance has changed
//     counts                         other counters, without zeros, named as in the plan file:
//                                    "bypasses=2 joint_mdd_nodes=77"
//     solver                         adapter of another solver; missing: Grove
//     claimed_cost, claimed_lower_bound, claimed_s     claims of another solver
//     anytime                        the run uses its whole time limit, which is not a failure
//     trace                          the plans found on the way, as reported by the run, up to the
//                                    one that was re-checked: "0.25:120:100 1.5:118:-" (seconds,
//                                    cost, bound)
//     certified, verify_s, proof_bytes     whether a separate program accepted the certificate;
//                                    time of this check; size of the certificate
//
// Tables from older versions lack the columns from counts on, or the last ones of these.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "batch/instance_facts.h"
#include "batch/outcome.h"

namespace grove::detail::batch {

// All inputs of a run except for the instance. Two runs of an instance with equal settings should
// have equal results.
struct Settings {
  std::string method;
  std::string options;  // as typed, without those that have a member below
  std::string omega;    // effective value, such as 0, 0.01 or inf
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
  double wall_s = 0;  // rounded to microseconds in files
  std::string machine = {};
  std::string ended_at = {};  // UTC, such as 2026-11-30T23:59:59Z
  std::int64_t ranks = 1;
  std::int64_t threads = 1;
  std::string plan_file = {};
  std::string solver = {};  // empty: Grove

  // The column runtime_s. As in the paper, the runtime of an unsolved run is its time
  // limit.
  double runtime_s() const {
    const double limit = run.settings.time_limit_s;
    if (!outcome.solved) return limit;
    return outcome.anytime ? std::min(outcome.first_plan_s.value_or(wall_s), limit) : wall_s;
  }

  friend bool operator==(const Row&, const Row&) = default;
};

// The row as one line of JSON, without a line end. Invalid UTF-8 is replaced.
std::string json_line(const Row& row);
// The inverse of json_line(). Also accepts rows of older versions. Throws std::invalid_argument
// with a description of the error.
Row parse_json_line(std::string_view line);

// The header and a row of a CSV file (RFC 4180), with line ends. A missing value is empty.
std::string csv_header();
std::string csv_line(const Row& row);

}  // namespace grove::detail::batch
