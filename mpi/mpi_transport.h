// SPDX-License-Identifier: MIT
// Messages by MPI.
#pragma once

#include <mpi.h>

#include <list>
#include <string>

#include "mpi/transport.h"

namespace grove::detail {

// Over a communicator of its own, a duplicate of the one given, so that nobody else's messages are
// taken for its own. Of the thread that initialised MPI. All ranks make it, and destroy it, at the
// same point of the program; what was sent must have been received by then.
class MpiTransport : public Transport {
 public:
  explicit MpiTransport(MPI_Comm communicator);
  // While an exception passes it leaves the network to the end of the process.
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
