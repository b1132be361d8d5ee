// SPDX-License-Identifier: MIT
// Network inside one process, with a simulated clock, for tests and the simulator.
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

// Delivers each message after the delay that the caller's DelayModel returns for it. Messages with
// the same sender and receiver never overtake each other; other messages may. One thread at a time.
class SimulatedNetwork {
 public:
  // Returns the time from sending to arrival, in seconds of the simulated clock.
  using DelayModel = std::function<double(int from, int to, std::size_t bytes)>;

  SimulatedNetwork(int ranks, DelayModel delay);
  ~SimulatedNetwork();

  // The transport of `rank`. It lives as long as the network.
  Transport& at(int rank);

  double now() const { return now_; }
  // Advances the clock to `time`. No effect if `time` is in the past.
  void advance_to(double time);
  // Arrival time of the next message for `rank`, possibly in the past. Infinity if no message is in
  // transit to it.
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
