// SPDX-License-Identifier: MIT
#include "mpi/rank_process.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace grove::detail {

RankProcess::RankProcess(const Problem& problem, const SolveOptions& options, const Limits& limits,
                         RunObserver& observer, Transport& transport, const AgentStopsCache& stops)
    : transport_(transport), rank_(problem, options, limits, transport, stops) {
  const Hierarchy hierarchy(transport.ranks(), options.tuning.coordinator_children);
  const int highest = hierarchy.highest_at(transport.rank());
  for (int level = 1; level <= highest && level < hierarchy.levels(); ++level)
    subs_.emplace_back(transport, hierarchy, level, options.tuning);
  if (transport.rank() != 0) return;
  coordinator_ = std::make_unique<Coordinator>(problem, options, limits, observer, transport);
  coordinator_->begin();
}

bool RankProcess::exchange_messages(double now) {
  bool heard = false;
  while (auto received = transport_.receive()) {
    heard = true;
    handle(received->from, message::message_of(received->bytes));
  }
  if (coordinator_) {
    coordinator_->step();
    rank_.set_lower_bound(coordinator_->lower_bound());
  }
  rank_.send_updates(now);
  for (SubCoordinator& sub : subs_) sub.send_updates(now);
  return heard;
}

void RankProcess::handle(int from, message::Addressed&& addressed) {
  auto& [level, message] = addressed;
  if (level == 0)
    rank_.handle(from, std::move(message));
  else if (level <= std::ssize(subs_))
    subs_[static_cast<std::size_t>(level) - 1].handle(from, std::move(message));
  else if (coordinator_ && level == std::ssize(subs_) + 1)
    coordinator_->handle(from, std::move(message));
  else
    throw std::invalid_argument("rank process: message for a coordinator of another process");
}

double RankProcess::next_send_time() const {
  double first = rank_.next_send_time();
  for (const SubCoordinator& sub : subs_) first = std::min(first, sub.next_send_time());
  return first;
}

}  // namespace grove::detail
