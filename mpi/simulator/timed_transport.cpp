// SPDX-License-Identifier: MIT
#include "mpi/simulator/timed_transport.h"

#include <utility>

namespace grove::detail {

std::optional<ReceivedMessage> TimedTransport::receive() {
  const double arrival = network_.next_arrival(rank());
  auto parcel = end_.receive();
  if (!parcel) return std::nullopt;
  waited_s_ += network_.now() + talk_.takes_s - arrival;
  ++received_;
  take_time_for(parcel->bytes.size());
  return parcel;
}

void TimedTransport::do_send(int to, std::string bytes) {
  take_time_for(bytes.size());
  talk_.receivers.push_back(to);
  end_.send(to, std::move(bytes));
}

}  // namespace grove::detail
