// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "mpi/messages.h"
#include "mpi/transport.h"

namespace grove::detail::testing {

// A transport of one rank that records sent messages and delivers none. One thread at a time.
class Outbox : public Transport {
 public:
  Outbox(int rank, int ranks) : rank_(rank), ranks_(ranks) {}
  int rank() const override { return rank_; }
  int ranks() const override { return ranks_; }
  std::optional<ReceivedMessage> receive() override { return std::nullopt; }

  // Removes and returns all messages sent since the last call, in order.
  std::vector<message::Message> take() {
    std::vector<message::Message> all;
    for (const auto& [receiver, bytes] : std::exchange(sent_, {}))
      all.push_back(message::message_of(bytes).message);
    return all;
  }

  // Returns the messages of type `Kind` sent to rank `to` that take() has not removed yet.
  template <class Kind>
  std::vector<Kind> sent(int to) const {
    std::vector<Kind> all;
    for (const auto& [receiver, bytes] : sent_) {
      message::Message message = message::message_of(bytes).message;
      auto* wanted = std::get_if<Kind>(&message);
      if (receiver == to && wanted) all.push_back(std::move(*wanted));
    }
    return all;
  }

 private:
  void do_send(int to, std::string bytes) override { sent_.emplace_back(to, std::move(bytes)); }

  int rank_;
  int ranks_;
  std::vector<std::pair<int, std::string>> sent_;
};

}  // namespace grove::detail::testing
