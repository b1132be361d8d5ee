// SPDX-License-Identifier: MIT
// The log of a run, as a MIP solver's users know it: head, table, summary.
#pragma once

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "grove/engine/run_observer.h"
#include "grove/model/plan.h"

namespace grove {

// Writes lines to standard output, to a file, to both or to neither; and on a terminal a progress
// line that the next line overwrites.
class LogSink {
 public:
  // `file` empty: no file. Throws InputError when it cannot be opened. `may_show_progress`: mpirun
  // gives its programs a terminal even where there is none.
  LogSink(bool to_stdout, const std::filesystem::path& file, bool may_show_progress = true);

  void line(std::string_view text = "");
  // Also told on stderr where standard output tells nothing.
  void warn(std::string_view text);
  bool shows_progress() const { return shows_progress_; }
  void progress(std::string_view text);

 private:
  static bool write(std::FILE* file, std::string_view text, const char* name);
  void erase_progress();

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  bool to_stdout_;
  bool shows_progress_;
  bool progress_shown_ = false;
  std::unique_ptr<std::FILE, Close> file_;
};

// Turns the events of a run into the table. Rows are throttled by the clock, or, with `by_work`, by
// the number of nodes expanded, so that two runs of the same search log the same rows.
class RunLog : public RunObserver {
 public:
  using Clock = std::chrono::steady_clock;
  RunLog(LogSink& sink, Clock::time_point start, double time_limit_s, bool by_work);

  void on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) override;
  void on_event(RunEvent event, const Progress& progress) override;
  void on_infeasible(std::string_view reason) override;
  void on_note(std::string_view note) override;
  void on_checkpoint(const CheckpointReport& report) override;

  // The result, below the table. `plan_path` is where the plan file is.
  void finish(const Solution& solution, const std::filesystem::path& plan_path);

 private:
  bool row_is_due(const Progress& progress) const;
  void row(const Progress& progress);
  void show_progress(const Progress& progress);
  double seconds() const;

  LogSink& sink_;
  const Clock::time_point start_;
  const double time_limit_s_;
  const bool by_work_;
  int rows_ = 0;
  char letter_ = ' ';  // of the most telling event since the last row
  double last_row_s_ = 0;
  std::int64_t last_row_nodes_ = 0;
  double last_progress_s_ = 0;
};

}  // namespace grove
