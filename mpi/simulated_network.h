// SPDX-License-Identifier: MIT
// Network inside one process with a simulated clock, for tests and for the simulator.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <queue>
#include <string>
#include <unordered_map>
#include <vector>

#include "mpi/transport.h"

namespace grove::detail {

// Delivers each message after the delay that the caller's function gives for it. Messages of
// different pairs of ranks may overtake each other, messages from one rank to another never. One
// thread at a time.
class SimulatedNetwork {
 public:
  // The time from sending to arrival, in seconds of the simulated clock.
  using DelayModel = std::function<double(int from, int to, std::size_t bytes)>;

  SimulatedNetwork(int ranks, DelayModel delay);
  ~SimulatedNetwork();

  // The transport of `rank`. It lives as long as the network.
  Transport& at(int rank);

  double now() const { return now_; }
  // Advances the clock to `time`. No effect if `time` is in the past.
  void advance_to(double time);
  // Arrival time of the next message for `rank`, possibly in the past. Infinity if none is in
  // transit.
  double next_arrival(int rank) const;

 private:
  class End;
  struct UnderWay {
    double arrival;
    std::int64_t serial;  // number of the message in order of sending
    ReceivedMessage received;
  };
  struct Later {
    bool operator()(const UnderWay& a, const UnderWay& b) const {
      return a.arrival != b.arrival ? a.arrival > b.arrival : a.serial > b.serial;
    }
  };
  using Inbox = std::priority_queue<UnderWay, std::vector<UnderWay>, Later>;

  void send(int from, int to, std::string bytes);
  std::optional<ReceivedMessage> receive(int rank);

  const DelayModel delay_;
  std::vector<std::unique_ptr<End>> ends_;
  std::vector<Inbox> inboxes_;
  std::vector<std::unordered_map<int, double>> last_arrival_;  // by sender, then receiver
  double now_ = 0;
  std::int64_t serial_ = 0;
};

}  // namespace grove::detail
