// SPDX-License-Identifier: MIT
#include "mpi/custody.h"

#include "model/assert.h"

namespace grove::detail {

void Custody::keep(int to, const std::vector<NodePtr>& nodes) {
  Peer& peer = peers_[to];
  GROVE_CHECK(!peer.custody.contains(peer.sent + 1), "a batch is sent before the next one is kept");
  peer.custody[peer.sent + 1] = nodes;
  nodes_ += std::ssize(nodes);
}

void Custody::confirm_sent(int to) {
  Peer& peer = peers_[to];
  ++peer.sent;
  GROVE_CHECK(peer.custody.contains(peer.sent), "nodes are in custody before they are sent");
  nodes_sent_ += std::ssize(peer.custody.at(peer.sent));
}

void Custody::release(int to, std::int64_t batches, Frontier& frontier) {
  Peer& peer = peers_[to];
  GROVE_CHECK(batches <= peer.sent, "only batches that were sent are released");
  while (!peer.custody.empty() && peer.custody.begin()->first <= batches) {
    const auto batch = peer.custody.begin();
    for (const NodePtr& node : batch->second) frontier.complete(node);
    nodes_ -= std::ssize(batch->second);
    peer.custody.erase(batch);
  }
  GROVE_CHECK(nodes_ >= 0, "each node in custody is released once");
}

void Custody::received(int from) {
  Peer& peer = peers_[from];
  ++peer.received;
  peer.has_news = true;
}

std::vector<message::BatchReceived> Custody::new_receipts(int by) const {
  std::vector<message::BatchReceived> receipts;
  for (const auto& [rank, peer] : peers_)
    if (peer.has_news) receipts.push_back({by, rank, peer.received});
  return receipts;
}

void Custody::mark_reported() {
  for (auto& [rank, peer] : peers_) peer.has_news = false;
}

std::int64_t Custody::batches_sent() const {
  std::int64_t batches = 0;
  for (const auto& [rank, peer] : peers_) batches += peer.sent;
  return batches;
}

}  // namespace grove::detail
