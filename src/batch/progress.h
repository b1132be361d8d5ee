// SPDX-License-Identifier: MIT
// How far a long piece of work is, and how long it will take.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace grove::detail::batch {

// Work of many pieces that several workers do, at one moment.
struct Workload {
  int done = 0;            // pieces
  int left = 0;            // pieces not done, those under way too
  int workers = 1;         // at least 1
  double done_s = 0;       // what the pieces done took, summed
  double under_way_s = 0;  // for how long those under way have been, summed
};

// How long a piece takes on average; none before the first is done. As if the time a piece takes
// were exponentially distributed: the mean is all time spent, on what is under way too, over the
// number done. (Without what is under way the easy ones, which are done first, would promise too
// much.)
std::optional<double> seconds_each(const Workload& work);
// How long until all is done; none before the first is.
std::optional<double> seconds_left(const Workload& work);

// "1:02:03", "2:03"; whole seconds.
std::string duration_text(double seconds);

// What is shown: so many of so many pieces, in words.
struct ProgressText {
  int done = 0;
  int total = 0;
  std::string line;
};
// The line after a bar, in at most `columns` columns; without the bar, or cut off, where it is
// long.
std::string with_bar(const ProgressText& text, int columns);

// Where it is shown, and how.
struct ProgressStyle {
  bool terminal = false;  // a bar that is drawn again and again; else now and then a line
  int columns = 80;
  std::function<void(std::string_view)> write;
};

// Shows progress at a decent pace. Of one thread.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(ProgressStyle style) : style_(std::move(style)) {}

  // Is it time to show something, `elapsed_s` after the beginning?
  bool is_due(double elapsed_s) const { return elapsed_s >= next_s_; }
  void show(double elapsed_s, const ProgressText& text);
  // The last word.
  void finish(const ProgressText& text);

 private:
  void draw(const ProgressText& text);

  const ProgressStyle style_;
  double next_s_ = 0;
};

}  // namespace grove::detail::batch
