// SPDX-License-Identifier: MIT
#include "mpi/simulated_network.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "model/assert.h"

namespace grove::detail {

class SimulatedNetwork::End : public Transport {
 public:
  End(SimulatedNetwork& network, int rank) : network_(network), rank_(rank) {}

  int rank() const override { return rank_; }
  int ranks() const override { return static_cast<int>(network_.ends_.size()); }
  std::optional<ReceivedMessage> receive() override { return network_.receive(rank_); }

 private:
  void do_send(int to, std::string bytes) override { network_.send(rank_, to, std::move(bytes)); }

  SimulatedNetwork& network_;
  const int rank_;
};

SimulatedNetwork::SimulatedNetwork(int ranks, DelayModel delay)
    : delay_(std::move(delay)),
      inboxes_(static_cast<std::size_t>(ranks)),
      last_arrival_(static_cast<std::size_t>(ranks)) {
  for (int rank = 0; rank < ranks; ++rank) ends_.push_back(std::make_unique<End>(*this, rank));
}

SimulatedNetwork::~SimulatedNetwork() = default;

Transport& SimulatedNetwork::at(int rank) {
  return *ends_[static_cast<std::size_t>(rank)];
}

void SimulatedNetwork::advance_to(double time) {
  now_ = std::max(now_, time);
}

double SimulatedNetwork::next_arrival(int rank) const {
  const Inbox& inbox = inboxes_[static_cast<std::size_t>(rank)];
  return inbox.empty() ? std::numeric_limits<double>::infinity() : inbox.top().arrival;
}

void SimulatedNetwork::send(int from, int to, std::string bytes) {
  double& last = last_arrival_[static_cast<std::size_t>(from)][to];
  last = std::max(last, now_ + delay_(from, to, bytes.size()));
  GROVE_CHECK(last >= now_, "a message arrives no earlier than it was sent");
  inboxes_[static_cast<std::size_t>(to)].push({last, serial_++, {from, std::move(bytes)}});
}

std::optional<ReceivedMessage> SimulatedNetwork::receive(int rank) {
  Inbox& inbox = inboxes_[static_cast<std::size_t>(rank)];
  if (inbox.empty() || inbox.top().arrival > now_) return std::nullopt;
  // The order in the queue depends only on `arrival` and `serial`, so the bytes can be moved out.
  ReceivedMessage received = std::move(const_cast<UnderWay&>(inbox.top()).received);
  inbox.pop();
  return received;
}

}  // namespace grove::detail
