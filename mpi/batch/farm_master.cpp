// SPDX-License-Identifier: MIT
#include "mpi/batch/farm_master.h"

#include <algorithm>
#include <stdexcept>

#include "model/assert.h"

namespace grove::detail::batch {
namespace {

constexpr double kCsvInterval_s = 10;  // between writes of the CSV file; each writes all rows

}  // namespace

FarmMaster::FarmMaster(Transport& world, Grouping grouping, std::vector<Entry> entries,
                       ResultTable& table, std::atomic<bool>& interrupted, BatchClock clock,
                       MasterOptions options)
    : world_(world),
      table_(table),
      interrupted_(interrupted),
      clock_(std::move(clock)),
      options_(std::move(options)),
      start_(clock_.seconds()),
      assignments_(std::move(entries), options_.settings),
      writer_(table, {.flush_s = 0, .csv_s = kCsvInterval_s}, [this] { return seconds(); }) {
  const std::vector<Run>& runs = assignments_.runs();
  assignments_.set_todo(table.begin(runs));
  state_.total = static_cast<int>(runs.size());
  state_.groups = grouping.groups();
  for (const Run& run : runs)
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
  check_runs();
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
  assignments_.end(from, &report.row.run.instance);
  finished_.push_back(std::move(report.row));
}

void FarmMaster::on(int from, Aborted&) {
  assignments_.end(from, nullptr);
  interrupted_ = true;
}

template <typename Other>
void FarmMaster::on(int, Other&) {
  throw std::logic_error("farm master: unexpected message type");
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
  for (const auto& [leader, what] : assignments_.in_progress()) send(leader, Stop{});
}

void FarmMaster::record() {
  if (finished_.empty()) return;
  writer_.write(finished_);
  for (const Row& row : finished_) state_.count(row);
  finished_.clear();
}

// Each run waits, is in progress or has a row, unless its group aborted it after an interrupt.
void FarmMaster::check_runs() const {
  const auto in_progress = std::ssize(assignments_.in_progress());
  const std::int64_t known =
      state_.done() + in_progress + static_cast<std::int64_t>(assignments_.waiting());
  GROVE_CHECK(known == state_.total || (stopping_ && known < state_.total),
              "each run waits, is in progress or is done");
  GROVE_CHECK(dismissed_ + in_progress <= state_.groups, "no dismissed group solves an instance");
}

bool FarmMaster::has_work() const {
  return assignments_.any_waiting() && !stopping_ && seconds() < options_.total_time_limit_s;
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
  const std::size_t run = assignments_.start(leader, seconds());
  table_.mark_started(assignments_.runs()[run]);
  send(leader, Assignment{assignments_.entry(run)});
}

BatchState FarmMaster::state() const {
  const auto& in_progress = assignments_.in_progress();
  BatchState state = state_;
  state.elapsed_s = seconds();
  state.closes_in_s = std::max(0.0, options_.total_time_limit_s - state.elapsed_s);
  state.under_way = static_cast<int>(in_progress.size());
  for (const auto& [leader, what] : in_progress) state.under_way_s += state.elapsed_s - what.since;
  state.ending = assignments_.any_waiting() && !has_work();
  return state;
}

std::optional<FarmMessage> FarmMaster::take_own_message() {
  if (own_.empty()) return std::nullopt;
  FarmMessage message = std::move(own_.front());
  own_.pop_front();
  return message;
}

}  // namespace grove::detail::batch
