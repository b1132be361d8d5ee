// SPDX-License-Identifier: MIT
// Events of a log, independent of its format.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "engine/checkpoint.h"
#include "engine/run_observer.h"
#include "io/instance_file.h"
#include "model/plan.h"
#include "tools/solve/tree_log.h"

namespace grove::detail {

// Written before the search: instance and options. The instance outlives the log.
struct LogHead {
  const LoadedInstance& loaded;
  std::string instance;  // as given by the user
  std::string options;   // options that were given, as on the command line
  std::string method;    // "" for Grove's own search
  std::string workers;   // "2" threads or "4 ranks of 2"
  bool deterministic = false;
};

// Progress of the run, and what happened since the previous row.
struct LogRow {
  RunEvent event = RunEvent::kProgress;   // the most important one since then
  PlanSource source = PlanSource::kTree;  // of a kIncumbent
  Progress progress;
  double seconds = 0;            // since the start of the program
  std::size_t memory_bytes = 0;  // current
  // Rise of the lower bound since the previous row, by its cause; docs/command-line.md.
  std::map<std::string_view, Cost> raised_by = {};
};

struct LogEnd {
  const Solution& solution;
  std::string plan_file;
  std::string proof_file;    // "" if no certificate was requested
  std::optional<Cost> kept;  // cost of the plan in the plan file, if the file was not changed
  bool is_lost = false;      // whether the plan file could not be written
};

// Writes each event as lines. One thread at a time.
class LogFormat {
 public:
  virtual ~LogFormat() = default;

  virtual void head(const LogHead& head) = 0;
  virtual void warning(std::string_view text) = 0;
  // The run resumes from this checkpoint.
  virtual void resumed(const CheckpointHeader& checkpoint) = 0;
  virtual void row(const LogRow& row) = 0;
  // The same between rows; if it is shown, the next output overwrites it.
  virtual void progress(const LogRow& /*row*/) {}
  // Counts of the search, and nodes of the trees: only in formats for programs.
  virtual void statistics(const RunStatistics& /*statistics*/, double /*seconds*/) {}
  virtual void root(const RootRow& /*row*/, double /*seconds*/) {}
  virtual void node(const NodeRow& /*row*/, double /*seconds*/) {}
  // As in RunObserver.
  virtual void infeasible(std::string_view reason) = 0;
  virtual void note(std::string_view text, double seconds) = 0;
  virtual void checkpoint(const CheckpointReport& report, double seconds) = 0;
  virtual void end(const LogEnd& end) = 0;
};

}  // namespace grove::detail
