// SPDX-License-Identifier: MIT
// What is kept of one run of a method on an instance: a row of the table.
//
// Column by column, in the order of the file; what is absent is null or empty. Times in seconds,
// costs in steps, memory in MB (1e6 bytes).
//
//     instance, method, options      Entry::id; the method's name; its options, as one types them
//     map, scenario, agents, tasks, problem     InstanceFacts; absent: the instance cannot be read
//     omega, seed, time_limit_s      of the run
//     solved                         it ended by itself, before any limit, with a plan that was
//                                    re-checked; of what is anytime: it had one in time
//     status                         as in the plan file; or "error": it crashed, or Grove's plan
//                                    is wrong; "unsuitable": the method is not for the instance;
//                                    of other solvers "feasible", or "wrong": the plan is none, or
//                                    "claimed": a plan that is not shown
//     cost                           of the plan that was re-checked
//     lower_bound, gap               what Grove has proven; (cost - lower bound) / lower bound
//     root_cost, sqr                 the sum of the agents' best sequences, conflicts ignored; its
//                                    ratio to the cost, of what is solved
//     runtime_s                      the wall time; the time limit when not solved; of what is
//                                    anytime when it found its first plan
//     wall_s                         from the start of the process to its end
//     first_plan_s                   when the first plan was found, as the run says
//     roots, rtsp_calls, nodes, low_level_calls     as the plan file has them
//     peak_memory_mb                 likewise; of other solvers as the system counted it
//     version, machine, ended_at     of grove; processor and cores; UTC
//     error                          why the status is error, or the limit that struck
//     ranks, threads                 that worked together; threads of each
//     memory_limit_gb                absent: the machine decides
//     plan_file                      relative to the table's folder; absent: it was not kept
//     instance_digest                tells when an instance has changed
//     counts                         what else the search counted: "bypasses=2 joint_pairs=77", by
//                                    the names of the plan file, without zeros
//     solver                         what other solver it is: its adapter; absent: Grove itself
//     claimed_cost, claimed_lower_bound, claimed_s     what that says of its plan, and of its time
//     anytime                        it goes on until its time limit, which is no failure
//     trace                          the plans on the way, as the run says, up to the one that was
//                                    re-checked: "0.25:120:100 1.5:118:-", seconds, cost, bound
// From counts on they are absent in older tables.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "batch/instance_facts.h"
#include "batch/outcome.h"

namespace grove::detail::batch {

// What an answer depends on, beside the instance: the same twice should end the same.
struct Settings {
  std::string method;
  std::string options;  // but for the following, if they have a member of their own
  std::string omega;    // what the options amount to: 0, 0.01, inf
  std::int64_t seed = 0;
  double time_limit_s = 0;
  std::optional<double> memory_limit_gb = {};  // none: what the machine allows

  friend bool operator==(const Settings&, const Settings&) = default;
};

// What makes a run the run it is.
struct Run {
  std::string instance;  // Entry::id
  std::string digest;    // Entry::digest
  Settings settings;

  friend bool operator==(const Run&, const Run&) = default;
};

struct Row {
  Run run;
  InstanceFacts facts = {};
  Outcome outcome = {};
  std::optional<Cost> root_cost = {};
  double wall_s = 0;  // files keep microseconds
  std::string machine = {};
  std::string ended_at = {};  // UTC, as 2026-11-30T23:59:59Z
  std::int64_t ranks = 1;
  std::int64_t threads = 1;
  std::string plan_file = {};
  std::string solver = {};  // empty: Grove itself

  // The paper counts a run that solved nothing with its limit.
  double runtime_s() const {
    const double limit = run.settings.time_limit_s;
    if (!outcome.solved) return limit;
    return outcome.anytime ? std::min(outcome.first_plan_s.value_or(wall_s), limit) : wall_s;
  }

  friend bool operator==(const Row&, const Row&) = default;
};

// One line of JSON without its end. Text that is no UTF-8 is mended.
std::string json_line(const Row& row);
// Reads such a line. Throws std::invalid_argument saying what is wrong with it.
Row parse_json_line(std::string_view line);

// The same as CSV (RFC 4180); what is absent is empty.
std::string csv_header();
std::string csv_line(const Row& row);

}  // namespace grove::detail::batch
