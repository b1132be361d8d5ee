// SPDX-License-Identifier: MIT
#include "mpi/batch/assignments.h"

#include <stdexcept>
#include <utility>

#include "model/assert.h"

namespace grove::detail::batch {
namespace {

std::vector<Run> runs_of(const std::vector<Entry>& entries, const Settings& settings) {
  std::vector<Run> runs;
  for (const Entry& entry : entries) runs.push_back({entry.id, entry.digest, settings});
  return runs;
}

}  // namespace

Assignments::Assignments(std::vector<Entry> entries, const Settings& settings)
    : entries_(std::move(entries)), runs_(runs_of(entries_, settings)) {}

void Assignments::set_todo(std::vector<std::size_t> todo) {
  todo_ = std::move(todo);
  std::vector<bool> seen(runs_.size());
  for (const std::size_t run : todo_) {
    GROVE_CHECK(run < seen.size() && !seen[run], "each run is listed at most once");
    seen[run] = true;
  }
}

std::size_t Assignments::start(int leader, double now) {
  GROVE_CHECK(any_waiting(), "only a waiting run is assigned");
  const std::size_t run = todo_[next_++];
  const bool is_idle = in_progress_.try_emplace(leader, entries_[run].id, now).second;
  GROVE_CHECK(is_idle, "a group solves one instance at a time");
  return run;
}

void Assignments::end(int leader, const std::string* id) {
  const auto it = in_progress_.find(leader);
  if (it == in_progress_.end() || (id != nullptr && it->second.id != *id))
    throw std::logic_error("a group reports a run that was not assigned to it");
  in_progress_.erase(it);
}

}  // namespace grove::detail::batch
