// SPDX-License-Identifier: MIT
#include "mpi/batch/batch_progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace grove::batch {
namespace {

constexpr double kBarInterval_s = 0.2;
constexpr double kLineInterval_s = 30;
constexpr int kShortestBar = 10;
constexpr int kLongestBar = 40;

}  // namespace

void BatchState::count(const Row& row) {
  solving_s += row.wall_s;
  if (row.failed()) {
    ++failed;
  } else if (row.result.status == Status::kFeasible || row.result.status == Status::kUnknown) {
    ++limited;
  } else {
    ++solved;
  }
}

std::optional<double> seconds_left(const BatchState& state) {
  const int left = state.ending ? state.under_way : state.total - state.done();
  if (left == 0) return 0;
  if (state.done() == 0) return std::nullopt;
  const double mean = (state.solving_s + state.under_way_s) / state.done();
  const double rounds = std::max(1.0, static_cast<double>(left) / state.groups);
  return std::min(mean * rounds, state.closes_in_s + mean);
}

std::string duration_text(double seconds) {
  const auto s = static_cast<std::int64_t>(std::llround(std::max(0.0, seconds)));
  if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::string progress_line(const BatchState& state) {
  std::string text = fmt::format("{}/{} done: {} solved", state.done(), state.total, state.solved);
  if (state.limited > 0) text += fmt::format(", {} at a limit", state.limited);
  if (state.failed > 0) text += fmt::format(", {} failed", state.failed);
  text += fmt::format("; {} gone", duration_text(state.elapsed_s));
  if (state.ending && state.under_way > 0)
    text += fmt::format(", ending: {} under way", state.under_way);
  if (state.ending && state.under_way == 0)
    text += fmt::format(", {} left for another run", state.total - state.done());
  if (const auto left = seconds_left(state); left && *left > 0)
    text += fmt::format(", about {} left", duration_text(*left));
  return text;
}

std::string progress_bar(const BatchState& state, int columns) {
  const std::string line = progress_line(state);
  const int room = std::min(columns - static_cast<int>(line.size()) - 3, kLongestBar);
  if (room < kShortestBar) return line.substr(0, static_cast<std::size_t>(std::max(0, columns)));
  const int filled = state.total == 0 ? room : room * state.done() / state.total;
  return fmt::format("[{:#>{}}{:->{}}] {}", "", filled, "", room - filled, line);
}

ProgressStyle stderr_style() {
  ProgressStyle style;
  style.terminal = ::isatty(STDERR_FILENO) == 1;
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    style.columns = size.ws_col;
  style.write = [](std::string_view text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
  };
  return style;
}

void BatchProgress::show(const BatchState& state) {
  if (state.elapsed_s < next_s_) return;
  next_s_ = state.elapsed_s + (style_.terminal ? kBarInterval_s : kLineInterval_s);
  draw(state);
}

void BatchProgress::finish(const BatchState& state) {
  draw(state);
  if (style_.terminal) style_.write("\n");
}

// One column stays free: some terminals break the line after the last one.
void BatchProgress::draw(const BatchState& state) {
  style_.write(style_.terminal ? fmt::format("\r{}\033[K", progress_bar(state, style_.columns - 1))
                               : progress_line(state) + "\n");
}

}  // namespace grove::batch
