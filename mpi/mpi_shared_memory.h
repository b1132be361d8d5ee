// SPDX-License-Identifier: MIT
// Shared memory in MPI windows.
#pragma once

#include <mpi.h>

#include <cstddef>

#include "mpi/shared_memory.h"

namespace grove::detail {

class MpiSharedMemory : public SharedMemory {
 public:
  // Collective over `communicator`, with the same arguments on all ranks. Allocates `bytes` bytes
  // for the ranks of each host; the first `zero_bytes` of them are zero. Allocates nothing if
  // `bytes` is 0, on a host with a single rank, or if the allocation is not possible (why_not()).
  // Only the thread that initialized MPI may construct and destroy it.
  MpiSharedMemory(MPI_Comm communicator, std::size_t bytes, std::size_t zero_bytes);
  // Collective over the ranks of the host. During stack unwinding it does not free the memory,
  // because the other ranks may not take part.
  ~MpiSharedMemory() override;

 private:
  void allocate(std::size_t bytes, std::size_t zero_bytes);
  // Collective over the ranks of the host. Returns true if `mine` is true on all of them.
  bool all_on_host(bool mine) const;

  MPI_Comm host_ = MPI_COMM_NULL;
  MPI_Win window_ = MPI_WIN_NULL;
};

}  // namespace grove::detail
