// SPDX-License-Identifier: MIT
#include "mpi/batch/batch_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "model/assert.h"

namespace grove::detail::batch {

void BatchState::count(const Row& row) {
  solving_s += row.wall_s;
  if (row.outcome.failed()) {
    ++failed;
  } else if (row.outcome.solved || row.outcome.status == to_string(Status::kInfeasible)) {
    ++solved;
  } else {
    ++limited;
  }
  GROVE_CHECK(total == 0 || done() <= total, "no instance is counted twice");
}

std::optional<double> seconds_left(const BatchState& state) {
  const Workload work{.done = state.done(),
                      .left = state.ending ? state.under_way : state.total - state.done(),
                      .workers = state.groups,
                      .done_s = state.solving_s,
                      .under_way_s = state.under_way_s};
  const auto left = seconds_left(work);
  if (!left || *left == 0) return left;
  return std::min(*left, state.closes_in_s + *seconds_each(work));
}

ProgressText progress_text(const BatchState& state) {
  std::string text = fmt::format("{}/{} done: {} solved", state.done(), state.total, state.solved);
  if (state.limited > 0) text += fmt::format(", {} at a limit", state.limited);
  if (state.failed > 0) text += fmt::format(", {} failed", state.failed);
  text += fmt::format("; {} elapsed", duration_text(state.elapsed_s));
  if (state.ending && state.under_way > 0)
    text += fmt::format(", ending: {} under way", state.under_way);
  if (state.ending && state.under_way == 0)
    text += fmt::format(", {} left for another run", state.total - state.done());
  if (const auto left = seconds_left(state); left && *left > 0)
    text += fmt::format(", about {} left", duration_text(*left));
  return {state.done(), state.total, std::move(text)};
}

}  // namespace grove::detail::batch
