// SPDX-License-Identifier: MIT
// Example rows of a results table.
#pragma once

#include <string>

#include "batch/row.h"

namespace grove::detail::testing {

using batch::Row;

inline Row solved_row(const std::string& instance = "set/a_s3_n2_m4_mg",
                      const std::string& method = "auto") {
  return {.run = {.instance = instance,
                  .digest = "0123456789abcdef",
                  .settings = {.method = method,
                               .options = "--omega 0.01",
                               .omega = "0.01",
                               .seed = 7,
                               .time_limit_s = 60,
                               .memory_limit_gb = 1.5}},
          .facts = {.map = "a, \"b\"", .scenario = 3, .agents = 2, .tasks = 4, .problem = "mg"},
          .outcome = {.status = "bounded",
                      .solved = true,
                      .cost = 200,
                      .lower_bound = 160,
                      .first_plan_s = 0.25,
                      .roots = 3,
                      .rtsp_calls = 4,
                      .nodes = 5,
                      .low_level_calls = 6,
                      .peak_memory_mb = 7.25,
                      .counts = "bypasses=8 splits_vertex_edge=9",
                      .version = "grove 0.1.0 (git 0123)"},
          .root_cost = 150,
          .wall_s = 1.25,
          .machine = "a processor, 2 cores",
          .ended_at = "2026-11-30T23:59:59Z",
          .ranks = 4,
          .threads = 2};
}

inline Row failed_row(const std::string& instance = "i", const std::string& method = "auto") {
  Row row = solved_row(instance, method);
  row.run.settings.memory_limit_gb.reset();
  row.facts.scenario.reset();
  row.outcome = {.version = "grove", .error = "ended by signal 9 (Killed)"};
  return row;
}

}  // namespace grove::detail::testing
