// SPDX-License-Identifier: MIT
// What a log says, whatever it looks like.
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

// Before the search: who solves what, and how. The instance outlives the log.
struct LogHead {
  const LoadedInstance& loaded;
  std::string instance;  // as the user named it
  std::string options;   // that are not the default, as one types them
  std::string method;    // empty: Grove's own
  std::string workers;   // "2" threads or "4 ranks of 2"
  bool deterministic = false;
};

// Where the run stands, and what happened since the row before.
struct LogRow {
  RunEvent event = RunEvent::kProgress;   // the most telling one
  PlanSource source = PlanSource::kTree;  // of a kIncumbent
  Progress progress;
  double seconds = 0;                               // since the program began
  std::size_t memory_bytes = 0;                     // held now
  std::map<std::string_view, Cost> raised_by = {};  // the bound, since the row before: by what, and
                                                    // how far; docs/command-line.md
};

struct LogEnd {
  const Solution& solution;
  std::string plan_file;
  std::string proof_file;    // empty: none was asked for
  std::optional<Cost> kept;  // the plan file was left alone, with a plan of that cost
  bool is_lost = false;      // the plan file could not be written
};

// Turns each into lines. Called from one thread at a time.
class LogFormat {
 public:
  virtual ~LogFormat() = default;

  virtual void head(const LogHead& head) = 0;
  virtual void warning(std::string_view text) = 0;
  // The run goes on from there.
  virtual void resumed(const CheckpointHeader& checkpoint) = 0;
  virtual void row(const LogRow& row) = 0;
  // The same between rows; overwritten by what comes next, if it is shown at all.
  virtual void progress(const LogRow& /*row*/) {}
  // What was done so far; the trees: for programs alone.
  virtual void survey(const RunStatistics& /*survey*/, double /*seconds*/) {}
  virtual void root(const RootRow& /*row*/, double /*seconds*/) {}
  virtual void node(const NodeRow& /*row*/, double /*seconds*/) {}
  // As RunObserver has them.
  virtual void infeasible(std::string_view reason) = 0;
  virtual void note(std::string_view text, double seconds) = 0;
  virtual void checkpoint(const CheckpointReport& report, double seconds) = 0;
  virtual void end(const LogEnd& end) = 0;
};

}  // namespace grove::detail
