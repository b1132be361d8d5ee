// SPDX-License-Identifier: MIT
// Writes the log of a run as JSON Lines: one object per line, whose key "event" states its kind.
// docs/command-line.md lists the events and their keys.
#pragma once

#include "tools/solve/log_format.h"
#include "tools/solve/log_sink.h"

namespace grove::detail {

class JsonLog : public LogFormat {
 public:
  explicit JsonLog(LogSink sink) : sink_(std::move(sink)) {}

  void head(const LogHead& head) override;
  void warning(std::string_view text) override;
  void resumed(const CheckpointHeader& checkpoint) override;
  void row(const LogRow& row) override;
  void statistics(const RunStatistics& statistics, double seconds) override;
  void root(const RootRow& row, double seconds) override;
  void node(const NodeRow& row, double seconds) override;
  void infeasible(std::string_view reason) override;
  void note(std::string_view text, double seconds) override;
  void checkpoint(const CheckpointReport& report, double seconds) override;
  void end(const LogEnd& end) override;

 private:
  LogSink sink_;
  const Instance* instance_ = nullptr;  // set by head(); outlives the log
};

}  // namespace grove::detail
