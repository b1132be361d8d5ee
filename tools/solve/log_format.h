// SPDX-License-Identifier: MIT
// Interface of log formats, and the events that they write.
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

// Instance and options, logged before the search. The instance must outlive the log.
struct LogHead {
  const LoadedInstance& loaded;
  std::string instance;  // name, as the user gave it
  std::string options;   // options that were given, as on the command line
  std::string method;    // "" for Grove's own search
  std::string workers;   // number of threads ("2"), or ranks and threads ("2 each on 4 ranks, ...")
  bool deterministic = false;
};

// Progress of the run and events since the previous row.
struct LogRow {
  RunEvent event = RunEvent::kProgress;   // most important event since the previous row
  PlanSource source = PlanSource::kTree;  // source of the incumbent if event is kIncumbent
  Progress progress;
  double seconds = 0;            // since the start of the program
  std::size_t memory_bytes = 0;  // current resident memory of this process
  // Rise of the lower bound since the previous row, by cause; docs/command-line.md lists the
  // causes.
  std::map<std::string_view, Cost> raised_by = {};
};

// Result of the run, logged at its end.
struct LogEnd {
  const Solution& solution;
  std::string plan_file;
  std::string proof_file;     // "" if no certificate was requested
  std::optional<Cost> kept;   // cost of the existing plan if the plan file was left unchanged
  bool is_unwritten = false;  // true if the plan file could not be written
};

// Writes the events of a run. One thread at a time.
class LogFormat {
 public:
  virtual ~LogFormat() = default;

  virtual void head(const LogHead& head) = 0;
  virtual void warning(std::string_view text) = 0;
  // Reports that the run resumes from this checkpoint.
  virtual void resumed(const CheckpointHeader& checkpoint) = 0;
  virtual void row(const LogRow& row) = 0;
  // Shows the progress between rows on a terminal. The next output overwrites it.
  virtual void progress(const LogRow& /*row*/) {}
  // Statistics of the search and nodes of the trees. Only machine-readable formats write them.
  virtual void statistics(const RunStatistics& /*statistics*/, double /*seconds*/) {}
  virtual void root(const RootRow& /*row*/, double /*seconds*/) {}
  virtual void node(const NodeRow& /*row*/, double /*seconds*/) {}
  // See RunObserver::on_infeasible() and on_note().
  virtual void infeasible(std::string_view reason) = 0;
  virtual void note(std::string_view text, double seconds) = 0;
  virtual void checkpoint(const CheckpointReport& report, double seconds) = 0;
  virtual void end(const LogEnd& end) = 0;
};

}  // namespace grove::detail
