// SPDX-License-Identifier: MIT
// Shared memory by windows of MPI.
#pragma once

#include <mpi.h>

#include <cstddef>

#include "mpi/shared_memory.h"

namespace grove::detail {

class MpiSharedMemory : public SharedMemory {
 public:
  // All ranks of `communicator`, with the same numbers: so many bytes for those on each host, of
  // which the first `zero_bytes` are zero. None for a rank that is alone on its host, nor for 0
  // bytes. Of the thread that initialised MPI, as its destruction.
  MpiSharedMemory(MPI_Comm communicator, std::size_t bytes, std::size_t zero_bytes);
  // While an exception passes it leaves the memory to the end of the process: others may not come.
  ~MpiSharedMemory() override;

 private:
  void allocate(std::size_t bytes, std::size_t zero_bytes);
  // Whether all ranks of the host say so.
  bool all_on_host(bool mine) const;

  MPI_Comm host_ = MPI_COMM_NULL;
  MPI_Win window_ = MPI_WIN_NULL;
};

}  // namespace grove::detail
