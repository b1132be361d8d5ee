// SPDX-License-Identifier: MIT
#include "mpi/batch/batch_progress.h"

#include <gtest/gtest.h>

namespace grove::detail::batch {
namespace batch_progress_test {

BatchState some_state() {
  BatchState state;
  state.total = 135;
  state.solved = 36;
  state.limited = 4;
  state.failed = 1;
  state.under_way = 2;
  state.groups = 2;
  state.solving_s = 235;
  state.under_way_s = 11;
  state.elapsed_s = 125;
  return state;
}

TEST(BatchState, CountsRows) {
  BatchState state;
  Row row;
  row.wall_s = 2;
  for (const Status status : {Status::kOptimal, Status::kBounded, Status::kInfeasible,
                              Status::kFeasible, Status::kUnknown}) {
    row.outcome.status = to_string(status);
    row.outcome.solved = status == Status::kOptimal || status == Status::kBounded;
    state.count(row);
  }
  row.outcome = {.error = "broken"};
  state.count(row);
  EXPECT_EQ(state.solved, 3);
  EXPECT_EQ(state.limited, 2);
  EXPECT_EQ(state.failed, 1);
  EXPECT_EQ(state.done(), 6);
  EXPECT_EQ(state.solving_s, 12);
}

TEST(SecondsLeft, ExtrapolateTheCurrentPace) {
  const BatchState state = some_state();  // 6 s per instance, 94 left for 2 groups
  EXPECT_DOUBLE_EQ(*seconds_left(state), 282);
  BatchState last = state;  // more groups than instances left: one round
  last.groups = 1000;
  EXPECT_DOUBLE_EQ(*seconds_left(last), 6);
  BatchState closing = state;
  closing.closes_in_s = 10;
  EXPECT_DOUBLE_EQ(*seconds_left(closing), 16);
  BatchState ending = state;
  ending.ending = true;
  EXPECT_DOUBLE_EQ(*seconds_left(ending), 6);
}

TEST(SecondsLeft, AreUnknownBeforeTheFirstInstanceIsDone) {
  BatchState state;
  state.total = 3;
  state.under_way = 1;
  state.under_way_s = 9;
  EXPECT_EQ(seconds_left(state), std::nullopt);
  state.solved = 3;
  EXPECT_EQ(seconds_left(state), 0);
  EXPECT_EQ(seconds_left(BatchState{}), 0);
}

TEST(ProgressTexts, ShowOnlyWhatIsPresent) {
  BatchState state = some_state();
  EXPECT_EQ(progress_text(state).line,
            "41/135 done: 36 solved, 4 at a limit, 1 failed; 2:05 elapsed, about 4:42 left");
  state.ending = true;
  EXPECT_EQ(
      progress_text(state).line,
      "41/135 done: 36 solved, 4 at a limit, 1 failed; 2:05 elapsed, ending: 2 under way, about "
      "0:06 left");
  state.under_way = 0;
  EXPECT_EQ(
      progress_text(state).line,
      "41/135 done: 36 solved, 4 at a limit, 1 failed; 2:05 elapsed, 94 left for another run");
  BatchState first;
  first.total = 2;
  first.under_way = 1;
  EXPECT_EQ(progress_text(first).line, "0/2 done: 0 solved; 0:00 elapsed");
}

std::string shown(bool terminal, const std::vector<double>& times) {
  std::string text;
  ProgressDisplay progress(
      {.terminal = terminal, .columns = 40, .write = [&](std::string_view t) { text += t; }});
  BatchState state;
  state.total = 1;
  for (const double time : times) {
    state.elapsed_s = time;
    if (progress.is_due(time)) progress.show(time, progress_text(state));
  }
  state.solved = 1;
  progress.finish(progress_text(state));
  return text;
}

TEST(Progress, RedrawsItsLineOnATerminal) {
  EXPECT_EQ(shown(true, {0, 0.1, 0.15, 5}),
            "\r0/1 done: 0 solved; 0:00 elapsed\033[K\r0/1 done: 0 solved; 0:05 elapsed\033[K"
            "\r1/1 done: 1 solved; 0:05 elapsed\033[K\n");
}

TEST(Progress, PrintsOccasionalLinesElsewhere) {
  EXPECT_EQ(shown(false, {0, 1, 10, 29, 31, 32, 60, 61.5}),
            "0/1 done: 0 solved; 0:00 elapsed\n0/1 done: 0 solved; 0:31 elapsed\n"
            "0/1 done: 0 solved; 1:02 elapsed\n1/1 done: 1 solved; 1:02 elapsed\n");
}

}  // namespace batch_progress_test
}  // namespace grove::detail::batch
