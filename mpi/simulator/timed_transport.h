// SPDX-License-Identifier: MIT
// Transport of a simulated rank that accounts for the cost of communication.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mpi/simulated_network.h"
#include "mpi/simulator/machine.h"
#include "mpi/transport.h"

namespace grove::detail {

// Cost of one exchange of messages by a rank. The exchange starts at the current time of the
// network.
struct Communication {
  double takes_s = 0;          // duration of the exchange so far, in seconds
  std::vector<int> receivers;  // receivers of the messages sent
};

// A rank's transport on a simulated network on which each message costs time of its sender and of
// its receiver. One thread at a time.
class TimedTransport : public Transport {
 public:
  // All arguments must outlive this object. `communication` is the exchange in progress, which can
  // be of any rank. A message sent in it leaves when the exchange has taken
  // `communication.takes_s`.
  TimedTransport(SimulatedNetwork& network, int rank, const Machine& machine,
                 Communication& communication)
      : network_(network),
        end_(network.at(rank)),
        machine_(machine),
        communication_(communication) {}

  int rank() const override { return end_.rank(); }
  int ranks() const override { return end_.ranks(); }
  std::optional<ReceivedMessage> receive() override {
    const double arrival = network_.next_arrival(rank());
    auto received = end_.receive();
    if (!received) return std::nullopt;
    waited_s_ += network_.now() + communication_.takes_s - arrival;
    ++received_;
    take_time_for(received->bytes.size());
    return received;
  }

  // Messages received so far.
  std::int64_t received() const { return received_; }
  // Seconds from arrival to handling, summed over the messages received.
  double waited_s() const { return waited_s_; }

 private:
  void do_send(int to, std::string bytes) override {
    take_time_for(bytes.size());
    communication_.receivers.push_back(to);
    end_.send(to, std::move(bytes));
  }
  void take_time_for(std::size_t bytes) {
    communication_.takes_s +=
        machine_.message_cost + static_cast<double>(bytes) / machine_.bandwidth;
  }

  SimulatedNetwork& network_;
  Transport& end_;
  const Machine& machine_;
  Communication& communication_;
  std::int64_t received_ = 0;
  double waited_s_ = 0;
};

}  // namespace grove::detail
