// SPDX-License-Identifier: MIT
// All messages have the same tag on one communicator, so MPI keeps the order between any two ranks
// (MPI 4.0, section 3.5). On errors MPI's own error handler names the rank and ends the job.
#include "mpi/mpi_transport.h"

#include <exception>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

namespace grove::detail {
namespace {

constexpr int kTag = 0;

}  // namespace

MpiTransport::MpiTransport(MPI_Comm communicator) {
  MPI_Comm_dup(communicator, &communicator_);
  MPI_Comm_rank(communicator_, &rank_);
  MPI_Comm_size(communicator_, &ranks_);
}

// During stack unwinding other ranks are possibly unresponsive or do not get here. The destructor
// then waits for nothing, and leaks the buffers of unfinished sends, because MPI still uses them.
MpiTransport::~MpiTransport() {
  if (std::uncaught_exceptions() > 0) {
    static_cast<void>(std::make_unique<std::list<Sending>>(std::move(sending_)).release());
    return;
  }
  for (Sending& sending : sending_) MPI_Wait(&sending.request, MPI_STATUS_IGNORE);
  MPI_Comm_free(&communicator_);
}

void MpiTransport::do_send(int to, std::string bytes) {
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::length_error("MPI transport: message too long");
  forget_sent();
  Sending& sending = sending_.emplace_back(Sending{MPI_REQUEST_NULL, std::move(bytes)});
  MPI_Isend(sending.bytes.data(), static_cast<int>(sending.bytes.size()), MPI_BYTE, to, kTag,
            communicator_, &sending.request);
}

std::optional<ReceivedMessage> MpiTransport::receive() {
  forget_sent();
  int arrived = 0;
  MPI_Message message;
  MPI_Status status;
  MPI_Improbe(MPI_ANY_SOURCE, kTag, communicator_, &arrived, &message, &status);
  if (arrived == 0) return std::nullopt;
  int size = 0;
  MPI_Get_count(&status, MPI_BYTE, &size);
  ReceivedMessage received{status.MPI_SOURCE, std::string(static_cast<std::size_t>(size), '\0')};
  MPI_Mrecv(received.bytes.data(), size, MPI_BYTE, &message, MPI_STATUS_IGNORE);
  return received;
}

// Frees the buffers of completed sends, oldest first, up to the first send in progress.
void MpiTransport::forget_sent() {
  while (!sending_.empty()) {
    int done = 0;
    MPI_Test(&sending_.front().request, &done, MPI_STATUS_IGNORE);
    if (done == 0) return;
    sending_.pop_front();
  }
}

}  // namespace grove::detail
