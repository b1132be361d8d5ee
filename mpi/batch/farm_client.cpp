// SPDX-License-Identifier: MIT
#include "mpi/batch/farm_client.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>
#include <variant>

#include "io/input_error.h"

namespace grove::detail::batch {
namespace {

constexpr int kMaster = 0;  // rank in the world
constexpr int kLeader = 0;  // rank in the group

// Returns the text of the error, never empty.
std::string error_text(const std::exception& error) {
  const std::string text = one_line(error.what());
  return text.empty() ? "unknown error" : text;
}

}  // namespace

FarmClient::FarmClient(Transport& world, Transport& group, std::atomic<bool>& interrupted,
                       ClientOptions options, FarmMaster* master)
    : world_(world),
      group_(group),
      interrupted_(interrupted),
      options_(std::move(options)),
      master_(master) {}

void FarmClient::run() {
  if (group_.rank() == kLeader) {
    run_as_leader();
  } else {
    follow();
  }
}

void FarmClient::run_as_leader() {
  while (const std::optional<Entry> entry = next_entry()) {
    tell_members(Assignment{*entry});
    Row row = solve(*entry);
    wait_for_members(row);
    if (row.outcome.interrupted()) {
      tell_master(Aborted{});
    } else {
      tell_master(Report{std::move(row)});
    }
  }
  tell_members(NoMoreWork{});
  while (master_ != nullptr && !master_->done()) {
    master_->poll();
    options_.idle();
  }
}

// Requests and returns the next instance. Returns nullopt if the master assigns no more instances.
std::optional<Entry> FarmClient::next_entry() {
  tell_master(RequestWork{});
  for (;;) {
    std::optional<FarmMessage> message = receive_from_master();
    if (!message) {
      options_.idle();
    } else if (auto* assignment = std::get_if<Assignment>(&*message)) {
      return std::move(assignment->entry);
    } else if (std::holds_alternative<NoMoreWork>(*message)) {
      return std::nullopt;
    } else {
      interrupted_ = true;  // a Stop that arrived after the instance was done
    }
  }
}

Row FarmClient::solve(const Entry& entry) {
  Row row{.run = {entry.id, entry.digest, options_.settings}};
  row.machine = options_.machine;
  row.ranks = group_.ranks();
  row.threads = options_.threads;
  const double start = options_.clock.seconds();
  try {
    options_.solve(entry, row, [this] { poll(); });
  } catch (const std::exception& error) {
    row.outcome = {.error = error_text(error)};
  }
  if (broken_) std::rethrow_exception(broken_);  // an error of poll(), not of the instance
  row.outcome.version = options_.version;
  row.wall_s = options_.clock.seconds() - start;
  row.ended_at = options_.clock.utc();
  return row;
}

void FarmClient::poll() {
  try {
    while (const std::optional<FarmMessage> message = receive_from_master()) {
      if (!std::holds_alternative<Stop>(*message))
        throw std::logic_error("a busy group leader accepts only a message to stop");
      interrupted_ = true;
    }
  } catch (...) {
    broken_ = std::current_exception();
    throw;
  }
}

void FarmClient::wait_for_members(Row& row) {
  for (int left = group_.ranks() - 1; left > 0;) {
    const std::optional<FarmMessage> message = receive_from_group();
    if (!message) {
      poll();
      options_.idle();
      continue;
    }
    --left;
    const std::string& error = std::get<Ended>(*message).error;
    if (!error.empty() && !row.outcome.failed())
      row.outcome = {.version = options_.version, .error = error};
  }
}

void FarmClient::follow() {
  for (;;) {
    const std::optional<FarmMessage> message = receive_from_group();
    if (!message) {
      options_.idle();
      continue;
    }
    if (std::holds_alternative<NoMoreWork>(*message)) return;
    Ended ended;
    try {
      Row unused;
      options_.solve(std::get<Assignment>(*message).entry, unused, [] {});
    } catch (const std::exception& error) {
      ended.error = fmt::format("rank {} of the world: {}", world_.rank(), error_text(error));
    }
    group_.send(kLeader, encode(ended));
  }
}

void FarmClient::tell_master(const FarmMessage& message) {
  world_.send(kMaster, encode(message));
}

void FarmClient::tell_members(const FarmMessage& message) {
  const std::string bytes = encode(message);
  for (int rank = 1; rank < group_.ranks(); ++rank) group_.send(rank, bytes);
}

std::optional<FarmMessage> FarmClient::receive_from_master() {
  if (master_ != nullptr) {
    master_->poll();
    return master_->take_own_message();
  }
  const std::optional<ReceivedMessage> received = world_.receive();
  return received ? std::optional(decode(received->bytes)) : std::nullopt;
}

std::optional<FarmMessage> FarmClient::receive_from_group() {
  const std::optional<ReceivedMessage> received = group_.receive();
  return received ? std::optional(decode(received->bytes)) : std::nullopt;
}

}  // namespace grove::detail::batch
