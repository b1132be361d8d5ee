// SPDX-License-Identifier: MIT
#include "mpi/child_links.h"

namespace grove::detail {

std::vector<std::vector<int>> ChildLinks::ranks() const {
  std::vector<std::vector<int>> all(static_cast<std::size_t>(count()));
  for (int rank = post_.rank; rank < hierarchy_.ranks() && include(rank); ++rank)
    all[static_cast<std::size_t>(with(rank))].push_back(rank);
  return all;
}

void ChildLinks::tell(int child, const message::Message& message) {
  const Endpoint post = hierarchy_.child(post_, child);
  transport_.send(post.rank, message::bytes_of(message, post.level));
}

void ChildLinks::broadcast(const message::Message& message) {
  const std::string bytes = message::bytes_of(message, post_.level - 1);
  for (int child = 0; child < count(); ++child)
    transport_.send(hierarchy_.child(post_, child).rank, bytes);
}

void ChildLinks::send_message_counts(const message::MessageCounts& goodbye) {
  std::vector<message::MessageCounts> parts(static_cast<std::size_t>(count()));
  for (const auto& [rank, messages] : goodbye.messages)
    parts.at(static_cast<std::size_t>(with(rank))).messages[rank] = messages;
  for (int child = 0; child < count(); ++child) tell(child, parts[static_cast<std::size_t>(child)]);
}

}  // namespace grove::detail
