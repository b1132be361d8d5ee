// SPDX-License-Identifier: MIT
// Transport over MPI.
#pragma once

#include <mpi.h>

#include <list>
#include <string>

#include "mpi/transport.h"

namespace grove::detail {

// Uses a duplicate of the given communicator, so that it receives no other messages. Construction
// and destruction are collective; all messages must have been received before the destruction. Only
// the thread that initialized MPI may use it.
class MpiTransport : public Transport {
 public:
  explicit MpiTransport(MPI_Comm communicator);
  // During stack unwinding it neither waits for unfinished sends nor frees the communicator.
  ~MpiTransport() override;

  int rank() const override { return rank_; }
  int ranks() const override { return ranks_; }
  std::optional<ReceivedMessage> receive() override;

 private:
  struct Sending {
    MPI_Request request;
    std::string bytes;
  };
  void do_send(int to, std::string bytes) override;
  void forget_sent();

  MPI_Comm communicator_ = MPI_COMM_NULL;
  int rank_ = 0;
  int ranks_ = 0;
  std::list<Sending> sending_;
};

}  // namespace grove::detail
