// SPDX-License-Identifier: MIT
// Writes the log of a run as text in the style of MIP solvers: head, table, summary.
#pragma once

#include "tools/solve/log_format.h"
#include "tools/solve/log_sink.h"

namespace grove::detail {

class TextLog : public LogFormat {
 public:
  // `verbose`: add statistics of the search to the summary.
  TextLog(LogSink sink, double time_limit_s, bool verbose)
      : sink_(std::move(sink)), time_limit_s_(time_limit_s), verbose_(verbose) {}

  void head(const LogHead& head) override;
  void warning(std::string_view text) override;
  void resumed(const CheckpointHeader& checkpoint) override;
  void row(const LogRow& row) override;
  void progress(const LogRow& row) override;
  void infeasible(std::string_view reason) override;
  void note(std::string_view text, double seconds) override;
  void checkpoint(const CheckpointReport& report, double seconds) override;
  void end(const LogEnd& end) override;

 private:
  LogSink sink_;
  const double time_limit_s_;
  const bool verbose_;
  int rows_ = 0;
  const Instance* instance_ = nullptr;  // since head()
};

}  // namespace grove::detail
