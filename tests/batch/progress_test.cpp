// SPDX-License-Identifier: MIT
#include "batch/progress.h"

#include <gtest/gtest.h>

#include <vector>

namespace grove::detail::batch {
namespace progress_test {

TEST(Estimates, ExtrapolateTheCurrentPace) {
  const Workload work{.done = 41, .left = 94, .workers = 2, .done_s = 235, .under_way_s = 11};
  EXPECT_DOUBLE_EQ(*seconds_each(work), 6);
  EXPECT_DOUBLE_EQ(*seconds_left(work), 282);
  Workload last = work;  // more workers than runs left: one round
  last.workers = 1000;
  EXPECT_DOUBLE_EQ(*seconds_left(last), 6);
}

TEST(Estimates, AreNulloptBeforeTheFirstRunIsDone) {
  EXPECT_EQ(seconds_left({.done = 0, .left = 3, .under_way_s = 9}), std::nullopt);
  EXPECT_EQ(seconds_each({}), std::nullopt);
  EXPECT_EQ(seconds_left({}), 0);
}

TEST(Durations, AreFormattedAsClockTimes) {
  EXPECT_EQ(duration_text(0), "0:00");
  EXPECT_EQ(duration_text(-1), "0:00");
  EXPECT_EQ(duration_text(59.6), "1:00");
  EXPECT_EQ(duration_text(3599), "59:59");
  EXPECT_EQ(duration_text(3600), "1:00:00");
  EXPECT_EQ(duration_text(100 * 3600 + 62), "100:01:02");
}

TEST(Bars, AreShownIfTheyFit) {
  ProgressText text{1, 4, "a quarter is done"};
  EXPECT_EQ(with_bar(text, 200), "[##########" + std::string(30, '-') + "] " + text.line);
  EXPECT_EQ(with_bar(text, 34), "[###-----------] " + text.line);
  EXPECT_EQ(with_bar(text, 29), text.line);
  EXPECT_EQ(with_bar(text, 4), "a qu");
  EXPECT_EQ(with_bar(text, 0), "");
  EXPECT_EQ(with_bar(text, -1), "");
  for (int columns = 0; columns < 150; ++columns)
    EXPECT_LE(with_bar(text, columns).size(), static_cast<std::size_t>(columns));
  text.done = 4;
  EXPECT_TRUE(with_bar(text, 200).starts_with("[" + std::string(40, '#') + "] "));
  text.done = 0;
  EXPECT_TRUE(with_bar(text, 200).starts_with("[" + std::string(40, '-') + "] "));
  text.total = 0;
  EXPECT_TRUE(with_bar(text, 200).starts_with("[" + std::string(40, '#') + "] "));
}

std::string shown(bool terminal, const std::vector<double>& times) {
  std::string text;
  ProgressDisplay display(
      {.terminal = terminal, .columns = 20, .write = [&](std::string_view t) { text += t; }});
  for (const double time : times)
    if (display.is_due(time)) display.show(time, {0, 1, duration_text(time)});
  display.finish({1, 1, "end"});
  return text;
}

TEST(Displays, RedrawTheLineOnATerminal) {
  EXPECT_EQ(shown(true, {0, 0.1, 0.15, 5}),
            "\r[------------] 0:00\033[K\r[------------] 0:05\033[K\r[#############] end\033[K\n");
}

TEST(Displays, PrintLinesPeriodicallyWithoutATerminal) {
  EXPECT_EQ(shown(false, {0, 1, 10, 29, 31, 32, 60, 61.5}), "0:00\n0:31\n1:02\nend\n");
}

}  // namespace progress_test
}  // namespace grove::detail::batch
