// SPDX-License-Identifier: MIT
// What talking costs a simulated rank.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mpi/simulated_network.h"
#include "mpi/simulator/machine.h"
#include "mpi/transport.h"

namespace grove::detail {

// What a rank says and hears at one go, which begins at the network's present time. A value.
struct Talk {
  double takes_s = 0;          // so far
  std::vector<int> receivers;  // of what was sent
};

// A rank's end of a simulated network, where each message takes the time of whoever talks. Of one
// thread.
class TimedTransport : public Transport {
 public:
  // All must outlive this. `talk` is the one under way, whoever talks; messages that it sends leave
  // when it has taken so long.
  TimedTransport(SimulatedNetwork& network, int rank, const Machine& machine, Talk& talk)
      : network_(network), end_(network.at(rank)), machine_(machine), talk_(talk) {}

  int rank() const override { return end_.rank(); }
  int ranks() const override { return end_.ranks(); }
  std::optional<ReceivedMessage> receive() override;

  // Messages, so far.
  std::int64_t received() const { return received_; }
  // Seconds between the arrival of each and its being dealt with, summed.
  double waited_s() const { return waited_s_; }

 private:
  void do_send(int to, std::string bytes) override;
  void take_time_for(std::size_t bytes) {
    talk_.takes_s += machine_.message_cost + static_cast<double>(bytes) / machine_.bandwidth;
  }

  SimulatedNetwork& network_;
  Transport& end_;
  const Machine& machine_;
  Talk& talk_;
  std::int64_t received_ = 0;
  double waited_s_ = 0;
};

}  // namespace grove::detail
