// SPDX-License-Identifier: MIT
// How processes talk.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace grove::detail {

// A message and where it comes from.
struct ReceivedMessage {
  int from = 0;
  std::string bytes;
};

// Carries messages among a fixed set of ranks, 0 to ranks() - 1. Each arrives once, whole, and
// after what the same sender sent to the same receiver before it; nothing is said of other orders.
// A rank may send to itself. Of one thread.
class Transport {
 public:
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  virtual ~Transport() = default;

  virtual int rank() const = 0;
  virtual int ranks() const = 0;
  // Returns at once; the message is under way.
  void send(int to, std::string bytes) {
    ++messages_;
    bytes_ += static_cast<std::int64_t>(bytes.size());
    do_send(to, std::move(bytes));
  }
  // The next message that has arrived, if any has; returns at once.
  virtual std::optional<ReceivedMessage> receive() = 0;

  // Sent so far.
  std::int64_t messages() const { return messages_; }
  std::int64_t bytes() const { return bytes_; }

 private:
  virtual void do_send(int to, std::string bytes) = 0;

  std::int64_t messages_ = 0;
  std::int64_t bytes_ = 0;
};

}  // namespace grove::detail
