// SPDX-License-Identifier: MIT
#include "batch/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "model/assert.h"

namespace grove::detail::batch {
namespace {

constexpr double kBarInterval_s = 0.2;
constexpr double kLineInterval_s = 30;
constexpr int kShortestBar = 10;
constexpr int kMaxBarLength = 40;

}  // namespace

std::optional<double> seconds_each(const Workload& work) {
  if (work.done == 0) return std::nullopt;
  return (work.done_s + work.under_way_s) / work.done;
}

std::optional<double> seconds_left(const Workload& work) {
  if (work.left == 0) return 0;
  const auto each = seconds_each(work);
  if (!each) return std::nullopt;
  GROVE_CHECK(work.workers > 0, "at least one worker solves the pieces that are left");
  return *each * std::max(1.0, static_cast<double>(work.left) / work.workers);
}

std::string duration_text(double seconds) {
  const auto s = static_cast<std::int64_t>(std::llround(std::max(0.0, seconds)));
  if (s < 3600) return fmt::format("{}:{:02}", s / 60, s % 60);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::string with_bar(const ProgressText& text, int columns) {
  const int room = std::min(columns - static_cast<int>(text.line.size()) - 3, kMaxBarLength);
  if (room < kShortestBar)
    return text.line.substr(0, static_cast<std::size_t>(std::max(0, columns)));
  const int filled =
      text.total == 0 ? room : static_cast<int>(std::int64_t{room} * text.done / text.total);
  return fmt::format("[{:#>{}}{:->{}}] {}", "", filled, "", room - filled, text.line);
}

void ProgressDisplay::show(double elapsed_s, const ProgressText& text) {
  next_s_ = elapsed_s + (style_.terminal ? kBarInterval_s : kLineInterval_s);
  draw(text);
}

void ProgressDisplay::finish(const ProgressText& text) {
  draw(text);
  if (style_.terminal) style_.write("\n");
}

// Leaves the last column free, because some terminals break the line after it.
void ProgressDisplay::draw(const ProgressText& text) {
  style_.write(style_.terminal ? fmt::format("\r{}\033[K", with_bar(text, style_.columns - 1))
                               : text.line + "\n");
}

}  // namespace grove::detail::batch
