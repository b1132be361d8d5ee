// SPDX-License-Identifier: MIT
#include "mpi/batch/assignments.h"

#include <stdexcept>
#include <utility>

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

std::size_t Assignments::start(int leader, double now) {
  const std::size_t run = todo_[next_++];
  in_progress_[leader] = {entries_[run].id, now};
  return run;
}

void Assignments::end(int leader, const std::string* id) {
  const auto it = in_progress_.find(leader);
  if (it == in_progress_.end() || (id != nullptr && it->second.id != *id))
    throw std::logic_error("a group reports a run that was not assigned to it");
  in_progress_.erase(it);
}

}  // namespace grove::detail::batch
