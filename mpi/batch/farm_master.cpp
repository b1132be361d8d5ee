// SPDX-License-Identifier: MIT
#include "mpi/batch/farm_master.h"

#include <algorithm>
#include <stdexcept>

namespace grove::detail::batch {
namespace {

constexpr double kCsvInterval_s = 10;  // between writes of the CSV file; each writes all rows

std::vector<Run> runs_of(const std::vector<Entry>& entries, const Settings& settings) {
  std::vector<Run> runs;
  for (const Entry& entry : entries) runs.push_back({entry.id, entry.digest, settings});
  return runs;
}

}  // namespace

FarmMaster::FarmMaster(Transport& world, Grouping grouping, std::vector<Entry> entries,
                       ResultTable& table, std::atomic<bool>& interrupted, BatchClock clock,
                       MasterOptions options)
    : world_(world),
      grouping_(grouping),
      table_(table),
      interrupted_(interrupted),
      clock_(std::move(clock)),
      options_(std::move(options)),
      start_(clock_.seconds()),
      entries_(std::move(entries)),
      runs_(runs_of(entries_, options_.settings)),
      todo_(table.begin(runs_)) {
  state_.total = static_cast<int>(entries_.size());
  state_.groups = grouping_.groups();
  for (const Run& run : runs_)
    if (const Row* row = table_.find(run)) state_.count(*row);
}

void FarmMaster::poll() {
  if (done()) return;
  while (std::optional<ReceivedMessage> received = world_.receive()) {
    FarmMessage message = decode(received->bytes);
    std::visit([&](auto& content) { on(received->from, content); }, message);
  }
  stop_if_interrupted();
  record();
  answer();
  if (done()) {
    table_.write_csv();
    table_.end();
  }
  if (options_.watch) options_.watch(state());
}

void FarmMaster::on(int from, RequestWork&) {
  asking_.push_back(from);
}

void FarmMaster::on(int from, Report& report) {
  end_assignment(from, &report.row.run.instance);
  finished_.push_back(std::move(report.row));
}

void FarmMaster::on(int from, Aborted&) {
  end_assignment(from, nullptr);
  interrupted_ = true;
}

template <typename Other>
void FarmMaster::on(int, Other&) {
  throw std::logic_error("farm master: unexpected message type");
}

void FarmMaster::end_assignment(int leader, const std::string* id) {
  const auto it = under_way_.find(leader);
  if (it == under_way_.end() || (id != nullptr && it->second.id != *id))
    throw std::logic_error("a group reports a run that was not assigned to it");
  under_way_.erase(it);
}

void FarmMaster::send(int leader, FarmMessage message) {
  if (leader == world_.rank()) {
    own_.push_back(std::move(message));
  } else {
    world_.send(leader, encode(message));
  }
}

// If interrupted, sends Stop to all groups in progress, because a signal possibly reached only some
// ranks.
void FarmMaster::stop_if_interrupted() {
  if (stopping_ || !interrupted_) return;
  stopping_ = true;
  for (const auto& [leader, what] : under_way_) send(leader, Stop{});
}

void FarmMaster::record() {
  if (finished_.empty()) return;
  table_.append(finished_);
  table_.flush();
  for (const Row& row : finished_) state_.count(row);
  finished_.clear();
  if (seconds() < next_csv_s_) return;
  table_.write_csv();
  next_csv_s_ = seconds() + kCsvInterval_s;
}

bool FarmMaster::has_work() const {
  return next_ < todo_.size() && !stopping_ && seconds() < options_.total_time_limit_s;
}

void FarmMaster::answer() {
  for (; !asking_.empty(); asking_.pop_front()) {
    if (has_work()) {
      assign_next(asking_.front());
    } else {
      send(asking_.front(), NoMoreWork{});
      ++dismissed_;
    }
  }
}

void FarmMaster::assign_next(int leader) {
  const std::size_t run = todo_[next_++];
  const Entry& entry = entries_[run];
  table_.mark_started(runs_[run]);
  under_way_[leader] = {entry.id, seconds()};
  send(leader, Assignment{entry});
}

BatchState FarmMaster::state() const {
  BatchState state = state_;
  state.elapsed_s = seconds();
  state.closes_in_s = std::max(0.0, options_.total_time_limit_s - state.elapsed_s);
  state.under_way = static_cast<int>(under_way_.size());
  for (const auto& [leader, what] : under_way_) state.under_way_s += state.elapsed_s - what.since;
  state.ending = next_ < todo_.size() && !has_work();
  return state;
}

std::optional<FarmMessage> FarmMaster::take_own_message() {
  if (own_.empty()) return std::nullopt;
  FarmMessage message = std::move(own_.front());
  own_.pop_front();
  return message;
}

}  // namespace grove::detail::batch
