// SPDX-License-Identifier: MIT
// Batches of nodes between this rank and other ranks: custody of sent batches, receipts of received
// ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "mpi/messages.h"
#include "search/frontier.h"

namespace grove::detail {

// The proof that custody keeps the lower bound valid is at the head of coordinator.cpp. One thread
// at a time.
class Custody {
 public:
  // Keeps nodes that were taken from the frontier and are about to be sent to rank `to` as its next
  // batch; confirm_sent() must be called after the batch was sent.
  void keep(int to, const std::vector<NodePtr>& nodes);
  void confirm_sent(int to);
  // Completes the nodes of the first `batches` batches sent to rank `to`, because a processed
  // status covers them there.
  void release(int to, std::int64_t batches, Frontier& frontier);
  // Number of nodes in custody.
  std::int64_t nodes() const { return nodes_; }

  // Records a batch received from rank `from`.
  void received(int from);
  // The receipts, by this rank `by`, of ranks that have sent batches since mark_reported().
  std::vector<message::BatchReceived> new_receipts(int by) const;
  void mark_reported();

  // Numbers of batches and of nodes sent so far.
  std::int64_t batches_sent() const;
  std::int64_t nodes_sent() const { return nodes_sent_; }

 private:
  struct Peer {
    std::int64_t sent = 0;   // batches
    std::int64_t taken = 0;  // batches received from there
    bool has_news = false;   // `taken` has changed since the last status
    std::map<std::int64_t, std::vector<NodePtr>> custody;  // by batch number
  };
  std::map<int, Peer> peers_;  // by rank
  std::int64_t nodes_ = 0;
  std::int64_t nodes_sent_ = 0;
};

// Counts the messages directly from rank to rank, so that a rank knows when it has received all of
// them. One thread at a time.
class DirectMessages {
 public:
  void count_sent(int to) { ++sent_[to]; }
  void count_received() { ++received_; }
  // Sets the number of messages that this rank will have received in total.
  void expect(std::int64_t total) { expected_ = total; }
  bool all_received() const { return expected_ && received_ >= *expected_; }
  // By rank.
  const std::map<std::int32_t, std::int64_t>& sent() const { return sent_; }

 private:
  std::map<std::int32_t, std::int64_t> sent_;
  std::int64_t received_ = 0;
  std::optional<std::int64_t> expected_;
};

}  // namespace grove::detail
