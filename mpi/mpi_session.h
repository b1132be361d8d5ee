// SPDX-License-Identifier: MIT
// Initialization and finalization of MPI in a process.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mpi/shared_memory.h"
#include "mpi/transport.h"

namespace grove::detail {

// The MPI session of a process, which has at most one. Only the thread that constructs it may use
// it and its transports. "Collective" marks functions that all ranks must call.
class MpiSession {
 public:
  // Session without MPI: rank 0 of 1, on which only rank(), ranks() and gather() may be called. For
  // programs that only print their help, because that must work where MPI cannot start.
  MpiSession() = default;
  // Initializes MPI. Throws std::runtime_error if MPI does not provide MPI_THREAD_FUNNELED.
  MpiSession(int& argc, char**& argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }
  // Collective. Returns the argument `mine` of each rank, by rank.
  std::vector<std::string> gather(const std::string& mine) const;
  // Collective. Returns a transport among the ranks that pass the same `group`, numbered in the
  // order of their ranks here.
  std::unique_ptr<Transport> connect(int group = 0) const;
  // Collective, with the same arguments on all ranks. Returns memory shared by the ranks of one
  // host; see MpiSharedMemory.
  std::unique_ptr<SharedMemory> share(std::size_t bytes, std::size_t zero_bytes) const;
  // Ends the processes of all ranks.
  [[noreturn]] void abort(int exit_code) const;

 private:
  bool has_mpi_ = false;
  int rank_ = 0;
  int ranks_ = 1;
};

}  // namespace grove::detail
