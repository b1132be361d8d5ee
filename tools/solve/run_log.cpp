// SPDX-License-Identifier: MIT
#include "tools/solve/run_log.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "grove/io/input_error.h"
#include "grove/model/limits.h"
#include "tools/common/gap_text.h"
#include "tools/common/standard_error.h"

namespace grove {
namespace {

constexpr int kRowsPerHeader = 20;
constexpr double kRowInterval_s = 0.5;  // at first; then a tenth of the time gone by
constexpr double kProgressInterval_s = 0.1;
constexpr std::int64_t kRowInterval_nodes = 1000;

std::string cost_text(std::optional<Cost> cost) {
  return cost ? fmt::format("{}", *cost) : "-";
}

std::string memory_text() {
  return fmt::format("{} MB", resident_bytes() / 1'000'000);
}

char letter_of(PlanSource source) {
  switch (source) {
    case PlanSource::kStart:
      return 'S';
    case PlanSource::kPriorities:
      return 'H';
    case PlanSource::kConfigurations:
      return 'C';
    case PlanSource::kNeighborhood:
      return 'L';
    case PlanSource::kTree:
      break;
  }
  return '*';
}

// Of the events that are no plans. The rarer the event, the more telling.
char letter_of(RunEvent event) {
  switch (event) {
    case RunEvent::kBound:
      return 'B';
    case RunEvent::kTree:
      return 'T';
    case RunEvent::kIncumbent:
    case RunEvent::kProgress:
    case RunEvent::kEnd:
      break;
  }
  return ' ';
}

// What the search gave up for want of memory.
std::string evicted_text(const Solution& solution) {
  const auto evicted = solution.stats.counts.find("nodes_evicted");
  if (evicted == solution.stats.counts.end() || evicted->second == 0) return "";
  const std::int64_t restarts = solution.stats.counts.at("restarts");
  return fmt::format(", {} nodes given up{}", evicted->second,
                     restarts == 0 ? "" : fmt::format(", {} times begun anew", restarts));
}

int telling(char letter) {
  return static_cast<int>(std::string_view(" TBLCHS*").find(letter));
}

}  // namespace

LogSink::LogSink(bool to_stdout, const std::filesystem::path& file, bool may_show_progress)
    : to_stdout_(to_stdout),
      shows_progress_(to_stdout && may_show_progress && ::isatty(STDOUT_FILENO) == 1) {
  if (file.empty()) return;
  file_.reset(std::fopen(file.c_str(), "w"));
  if (!file_)
    throw InputError(file.string(), "",
                     fmt::format("cannot write the log: {}", std::strerror(errno)));
}

void LogSink::line(std::string_view text) {
  if (to_stdout_) {
    erase_progress();
    to_stdout_ = write(stdout, text, "standard output");
  }
  if (file_ && !write(file_.get(), text, "the log file")) file_.reset();
}

void LogSink::warn(std::string_view text) {
  line(fmt::format("  {}", text));
  if (!to_stdout_) say_on_stderr(fmt::format("grove: warning: {}", text));
}

// A log that cannot be written is given up with a word on stderr; the run goes on.
bool LogSink::write(std::FILE* file, std::string_view text, const char* name) {
  std::fprintf(file, "%.*s\n", static_cast<int>(text.size()), text.data());
  if (std::fflush(file) == 0 && std::ferror(file) == 0) return true;
  say_on_stderr(fmt::format("grove: warning: {} cannot be written ({}); the log ends here", name,
                            std::strerror(errno)));
  std::clearerr(file);
  return false;
}

void LogSink::progress(std::string_view text) {
  if (!shows_progress_) return;
  erase_progress();
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
  progress_shown_ = true;
}

void LogSink::erase_progress() {
  if (progress_shown_) std::fputs("\r\033[K", stdout);
  progress_shown_ = false;
}

RunLog::RunLog(LogSink& sink, Clock::time_point start, double time_limit_s, bool by_work)
    : sink_(sink), start_(start), time_limit_s_(time_limit_s), by_work_(by_work) {}

double RunLog::seconds() const {
  return std::chrono::duration<double>(Clock::now() - start_).count();
}

void RunLog::on_incumbent(const Plan&, PlanSource source, const Progress&) {
  letter_ = letter_of(source);
}

void RunLog::on_event(RunEvent event, const Progress& progress) {
  if (telling(letter_of(event)) > telling(letter_)) letter_ = letter_of(event);
  const bool news = letter_ != ' ' || progress.nodes_expanded != last_row_nodes_;
  if (event == RunEvent::kIncumbent || (event == RunEvent::kEnd && news) || row_is_due(progress))
    return row(progress);
  if (sink_.shows_progress() && event == RunEvent::kProgress) show_progress(progress);
}

bool RunLog::row_is_due(const Progress& progress) const {
  if (rows_ == 0) return true;
  if (by_work_)
    return progress.nodes_expanded - last_row_nodes_ >=
           std::max(kRowInterval_nodes, last_row_nodes_ / 10);
  return seconds() - last_row_s_ >= std::max(kRowInterval_s, last_row_s_ / 10);
}

void RunLog::row(const Progress& p) {
  if (rows_++ % kRowsPerHeader == 0)
    sink_.line(
        "     expanded       open    trees   lower bound     incumbent       gap    memory      "
        "time");
  sink_.line(fmt::format("{:1} {:>11} {:>10} {:>8} {:>13} {:>13} {:>9} {:>9} {:>8.2f}s", letter_,
                         p.nodes_expanded, p.nodes_open, p.trees, p.lower_bound,
                         cost_text(p.incumbent), gap_text(p.incumbent, p.lower_bound),
                         memory_text(), seconds()));
  letter_ = ' ';
  last_row_s_ = seconds();
  last_row_nodes_ = p.nodes_expanded;
}

void RunLog::show_progress(const Progress& p) {
  const double now = seconds();
  if (now - last_progress_s_ < kProgressInterval_s) return;
  last_progress_s_ = now;
  sink_.progress(
      fmt::format("  {:.1f} of {:g} s: {} nodes, {} trees, lower bound {}, incumbent {}, gap {}",
                  now, time_limit_s_, p.nodes_expanded, p.trees, p.lower_bound,
                  cost_text(p.incumbent), gap_text(p.incumbent, p.lower_bound)));
}

void RunLog::on_infeasible(std::string_view reason) {
  sink_.line(fmt::format("There is no plan: {}.", reason));
}

void RunLog::on_note(std::string_view note) {
  sink_.line(fmt::format("  {} ({:.2f}s)", note, seconds()));
}

void RunLog::on_checkpoint(const CheckpointReport& report) {
  if (report.failure.empty())
    sink_.line(fmt::format("  Checkpoint of {} nodes written in {:.2f} s ({:.2f}s)", report.nodes,
                           report.seconds, seconds()));
  else
    sink_.warn(fmt::format("NO checkpoint was written: {}", report.failure));
}

void RunLog::finish(const Solution& solution, const std::filesystem::path& plan_path) {
  const auto text = [&](const char* key) {
    const auto it = solution.stats.texts.find(key);
    return it == solution.stats.texts.end() ? std::string() : it->second;
  };
  const auto cost = solution.plan ? std::optional(solution.plan->cost) : std::nullopt;
  const std::string stopped = text("stopped_by");

  sink_.line();
  sink_.line(fmt::format("Status        {}{}", to_string(solution.status),
                         stopped.empty() ? "" : fmt::format(" (stopped by: {})", stopped)));
  if (cost) sink_.line(fmt::format("Cost          {}", *cost));
  if (solution.status != Status::kInfeasible)
    sink_.line(fmt::format("Lower bound   {}", solution.lower_bound));
  if (cost)
    sink_.line(fmt::format("Gap           {} (omega asks for {})",
                           gap_text(cost, solution.lower_bound),
                           solution.omega.is_infinite()
                               ? "any plan"
                               : fmt::format("at most {:g} %", 100 * solution.omega.value())));
  if (const std::string remark = text("remark"); !remark.empty())
    sink_.line("Remark        " + remark);
  sink_.line(fmt::format("Time          {:.2f} s", solution.stats.measures.at("wall_s")));
  const auto node_bytes = solution.stats.measures.find("node_bytes");
  if (node_bytes != solution.stats.measures.end())
    sink_.line(fmt::format("Memory        {:.0f} MB at most, {:.0f} bytes per node{}",
                           solution.stats.measures.at("peak_memory_mb"), node_bytes->second,
                           evicted_text(solution)));
  sink_.line(fmt::format("Plan file     {}", plan_path.string()));
}

}  // namespace grove
