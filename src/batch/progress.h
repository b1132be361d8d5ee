// SPDX-License-Identifier: MIT
// Progress of a long computation, and an estimate of the remaining time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace grove::detail::batch {

// The state of a computation that consists of pieces computed by several workers.
struct Workload {
  int done = 0;            // pieces completed
  int left = 0;            // pieces not completed, including those in progress
  int workers = 1;         // at least 1
  double done_s = 0;       // total time of the completed pieces
  double under_way_s = 0;  // total time so far of the pieces in progress
};

// The expected time per piece, in seconds. Returns nullopt before the first piece is completed. It
// assumes that the times are exponentially distributed: the mean is the total time, including the
// time of pieces in progress, divided by the number of completed pieces. (Without the time of
// pieces in progress the estimate would be too low, because easy pieces are completed first.)
std::optional<double> seconds_each(const Workload& work);
// The expected remaining time, in seconds; 0 if no pieces are left. Otherwise returns nullopt
// before the first piece is completed.
std::optional<double> seconds_left(const Workload& work);

// Text such as "1:02:03" or "2:03", in whole seconds.
std::string duration_text(double seconds);

// The displayed progress: the numbers of completed pieces and of all pieces, and a text.
struct ProgressText {
  int done = 0;
  int total = 0;
  std::string line;
};
// The text behind a progress bar, in at most `columns` columns. If the text is long, the bar is
// omitted or the text is truncated.
std::string with_bar(const ProgressText& text, int columns);

// Form of the display.
struct ProgressStyle {
  bool terminal = false;  // redraw a bar; false: write a line now and then
  int columns = 80;
  std::function<void(std::string_view)> write;
};

// Displays progress. To limit the frequency, the caller calls show() only if is_due(). One thread
// at a time.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(ProgressStyle style) : style_(std::move(style)) {}

  // True if the display is due `elapsed_s` seconds after the start.
  bool is_due(double elapsed_s) const { return elapsed_s >= next_s_; }
  void show(double elapsed_s, const ProgressText& text);
  // Displays the final state.
  void finish(const ProgressText& text);

 private:
  void draw(const ProgressText& text);

  const ProgressStyle style_;
  double next_s_ = 0;
};

}  // namespace grove::detail::batch
