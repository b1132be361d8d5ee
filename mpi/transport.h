// SPDX-License-Identifier: MIT
// Message passing between processes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace grove::detail {

// A message and the rank of its sender.
struct ReceivedMessage {
  int from = 0;
  std::string bytes;
};

// Carries messages among a fixed set of ranks, 0 to ranks() - 1. Each message arrives once,
// complete, and after every earlier message from the same sender to the same receiver. No other
// order is guaranteed. A rank can send to itself. One thread at a time.
class Transport {
 public:
  Transport() = default;
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;
  virtual ~Transport() = default;

  virtual int rank() const = 0;
  virtual int ranks() const = 0;
  // Starts sending and returns at once.
  void send(int to, std::string bytes) {
    ++messages_;
    bytes_ += static_cast<std::int64_t>(bytes.size());
    do_send(to, std::move(bytes));
  }
  // Returns the next message that has arrived. Returns nullopt at once if no message has arrived.
  virtual std::optional<ReceivedMessage> receive() = 0;

  // Messages and bytes sent so far.
  std::int64_t messages() const { return messages_; }
  std::int64_t bytes() const { return bytes_; }

 private:
  virtual void do_send(int to, std::string bytes) = 0;

  std::int64_t messages_ = 0;
  std::int64_t bytes_ = 0;
};

}  // namespace grove::detail
