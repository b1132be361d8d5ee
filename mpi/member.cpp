// SPDX-License-Identifier: MIT
#include "mpi/member.h"

#include <utility>

namespace grove::detail {

Member::Member(const Problem& problem, const SolveOptions& options, const Limits& limits,
               RunObserver& observer, Transport& transport, const AgentStopsStore& stops)
    : transport_(transport), rank_(problem, options, limits, transport, stops) {
  if (transport.rank() != 0) return;
  coordinator_ = std::make_unique<Coordinator>(problem, options, limits, observer, transport);
  coordinator_->begin();
}

bool Member::converse(double now) {
  bool heard = false;
  while (auto parcel = transport_.receive()) {
    heard = true;
    message::Message message = message::message_of(parcel->bytes);
    if (Coordinator::is_for_coordinator(message))
      coordinator_->handle(parcel->from, std::move(message));
    else
      rank_.handle(parcel->from, std::move(message));
  }
  if (coordinator_) {
    coordinator_->step();
    rank_.know(coordinator_->lower_bound());
  }
  rank_.speak(now);
  return heard;
}

}  // namespace grove::detail
