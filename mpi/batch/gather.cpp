// SPDX-License-Identifier: MIT
// Rank 0 receives all texts and sends them to all ranks. Therefore a rank cannot receive a message
// of a later call than its own.
#include "mpi/batch/gather.h"

#include <utility>

#include "engine/serialize.h"

namespace grove::detail::batch {
namespace {

using Texts = std::vector<std::string>;

ReceivedMessage next(Transport& transport, const std::function<void()>& wait) {
  for (;;) {
    if (std::optional<ReceivedMessage> received = transport.receive()) return std::move(*received);
    wait();
  }
}

}  // namespace

std::vector<std::string> gather(Transport& transport, const std::string& mine,
                                const std::function<void()>& wait) {
  if (transport.rank() != 0) {
    transport.send(0, mine);
    return from_bytes<Texts>(next(transport, wait).bytes);
  }
  Texts texts(static_cast<std::size_t>(transport.ranks()));
  texts[0] = mine;
  for (int left = transport.ranks() - 1; left > 0; --left) {
    ReceivedMessage received = next(transport, wait);
    texts[static_cast<std::size_t>(received.from)] = std::move(received.bytes);
  }
  const std::string all = to_bytes(texts);
  for (int rank = 1; rank < transport.ranks(); ++rank) transport.send(rank, all);
  return texts;
}

}  // namespace grove::detail::batch
