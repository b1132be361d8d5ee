// SPDX-License-Identifier: MIT
// A network inside one process, with a clock of its own: for tests and for the simulator.
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

// Delivers each message when its time has come, which depends on the delay that the caller gives
// it: messages of different pairs overtake each other, those of one pair never. Of one thread.
class SimulatedNetwork {
 public:
  // How long a message takes, in seconds of the simulated clock.
  using Delay = std::function<double(int from, int to, std::size_t bytes)>;

  SimulatedNetwork(int ranks, Delay delay);
  ~SimulatedNetwork();

  // One rank's end; lives as long as the network.
  Transport& at(int rank);

  double now() const { return now_; }
  // Sets the clock; it never goes back.
  void advance_to(double time);
  // When the next message for `rank` arrives, perhaps in the past; infinity: none is under way.
  double next_arrival(int rank) const;

 private:
  class End;
  struct UnderWay {
    double arrival;
    std::int64_t serial;  // the order in which messages were sent
    ReceivedMessage parcel;
  };
  struct Later {
    bool operator()(const UnderWay& a, const UnderWay& b) const {
      return a.arrival != b.arrival ? a.arrival > b.arrival : a.serial > b.serial;
    }
  };
  using Inbox = std::priority_queue<UnderWay, std::vector<UnderWay>, Later>;

  void send(int from, int to, std::string bytes);
  std::optional<ReceivedMessage> receive(int rank);

  const Delay delay_;
  std::vector<std::unique_ptr<End>> ends_;
  std::vector<Inbox> inboxes_;
  std::vector<std::unordered_map<int, double>> last_arrival_;  // by sender, then receiver
  double now_ = 0;
  std::int64_t serial_ = 0;
};

}  // namespace grove::detail
