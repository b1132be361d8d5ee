// SPDX-License-Identifier: MIT
// Batches of nodes between this rank and other ranks: custody of sent batches, and receipts for
// received batches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "mpi/messages.h"
#include "search/frontier.h"

namespace grove::detail {

// Keeps the nodes of sent batches until other ranks cover them, and counts received batches. The
// proof that this keeps the lower bound valid is at the head of coordinator.cpp. One thread at a
// time.
class Custody {
 public:
  // Takes custody of nodes that were taken from the frontier and are about to be sent to rank `to`
  // as the next batch. confirm_sent() must be called after the batch was sent.
  void keep(int to, const std::vector<NodePtr>& nodes);
  void confirm_sent(int to);
  // Completes the nodes of the first `batches` batches sent to rank `to`, because a processed
  // status from its side covers them.
  void release(int to, std::int64_t batches, Frontier& frontier);
  // Number of nodes in custody.
  std::int64_t nodes() const { return nodes_; }

  // Records a batch received from rank `from`.
  void received(int from);
  // Receipts for the ranks that have sent batches since mark_reported(). `by`: number of this rank.
  std::vector<message::BatchReceived> new_receipts(int by) const;
  void mark_reported();

  // Numbers of batches and of nodes sent so far.
  std::int64_t batches_sent() const;
  std::int64_t nodes_sent() const { return nodes_sent_; }

 private:
  struct Peer {
    std::int64_t sent = 0;      // batches
    std::int64_t received = 0;  // batches received from that rank
    bool has_news = false;      // `received` has changed since the last status
    std::map<std::int64_t, std::vector<NodePtr>> custody;  // by batch number
  };
  std::map<int, Peer> peers_;  // by rank
  std::int64_t nodes_ = 0;
  std::int64_t nodes_sent_ = 0;
};

// Counts the messages that ranks send to each other directly, so that a rank can detect that it has
// received all of them. One thread at a time.
class DirectMessages {
 public:
  void count_sent(int to) { ++sent_[to]; }
  void count_received() { ++received_; }
  // Sets the number of messages that this rank will have received in total.
  void expect(std::int64_t total) { expected_ = total; }
  bool all_received() const { return expected_ && received_ >= *expected_; }
  // Number of messages sent, by receiving rank.
  const std::map<std::int32_t, std::int64_t>& sent() const { return sent_; }

 private:
  std::map<std::int32_t, std::int64_t> sent_;
  std::int64_t received_ = 0;
  std::optional<std::int64_t> expected_;
};

}  // namespace grove::detail
