// SPDX-License-Identifier: MIT
// The MPI of a process, from beginning to end.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mpi/shared_memory.h"
#include "mpi/transport.h"

namespace grove::detail {

// One per process, made by the thread that is to speak, which is the only one that may use this and
// the transports. What all ranks must call together is marked so.
class MpiSession {
 public:
  // Without MPI: rank 0 of 1, which may gather() and nothing else. It serves programs that only
  // print their help, which must work where MPI cannot start.
  MpiSession() = default;
  // Throws std::runtime_error if MPI cannot be started.
  MpiSession(int& argc, char**& argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }
  // All ranks: what each of them says, by rank.
  std::vector<std::string> gather(const std::string& mine) const;
  // All ranks: a network among those that name the same group, numbered as they are here.
  std::unique_ptr<Transport> connect(int group = 0) const;
  // All ranks, with the same numbers: memory that those on one host share, see MpiSharedMemory.
  std::unique_ptr<SharedMemory> share(std::size_t bytes, std::size_t zero_bytes) const;
  // Ends the processes of all ranks.
  [[noreturn]] void abort(int exit_code) const;

 private:
  bool has_mpi_ = false;
  int rank_ = 0;
  int ranks_ = 1;
};

}  // namespace grove::detail
