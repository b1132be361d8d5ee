// SPDX-License-Identifier: MIT
// How processes talk.
#pragma once

#include <optional>
#include <string>

namespace grove {

// A message and where it comes from.
struct Parcel {
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
  virtual void send(int to, std::string bytes) = 0;
  // The next message that has arrived, if any has; returns at once.
  virtual std::optional<Parcel> receive() = 0;
};

}  // namespace grove
