// SPDX-License-Identifier: MIT
// *Space.* Open MPI keeps shared-memory windows in files in /dev/shm. If there is too little space,
// the rank that creates the file fails, and the other ranks wait for it forever. Therefore the
// ranks check the free space first.
//
// *Alignment.* A window starts behind Open MPI's own data, at any offset (in Open MPI 4.1 at 8
// bytes after a multiple of 64). The offset within a page is the same in all processes. Therefore
// kAlignment - 1 more bytes are allocated, and the shared memory starts at the next aligned
// address.
#include "mpi/mpi_shared_memory.h"

#include <sys/statvfs.h>

#include <algorithm>
#include <exception>
#include <memory>

#include "model/shared_arrays.h"

namespace grove::detail {
namespace {

constexpr const char* kFolder = "/dev/shm";

// True if /dev/shm has space for `bytes` bytes and a tenth more, because MPI has other files there,
// too.
bool has_room(std::size_t bytes) {
  struct statvfs folder = {};
  if (::statvfs(kFolder, &folder) != 0) return true;  // MPI then uses another directory
  return static_cast<double>(folder.f_bavail) * static_cast<double>(folder.f_frsize) >
         1.1 * static_cast<double>(bytes);
}

}  // namespace

MpiSharedMemory::MpiSharedMemory(MPI_Comm communicator, std::size_t bytes, std::size_t zero_bytes) {
  if (bytes == 0) return;
  MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &host_);
  MPI_Comm_rank(host_, &member_);
  MPI_Comm_size(host_, &members_);
  if (members_ > 1) allocate(bytes, zero_bytes);
}

MpiSharedMemory::~MpiSharedMemory() {
  if (std::uncaught_exceptions() > 0) return;
  if (window_ != MPI_WIN_NULL) {
    MPI_Win_unlock_all(window_);
    MPI_Win_free(&window_);
  }
  if (host_ != MPI_COMM_NULL) MPI_Comm_free(&host_);
}

bool MpiSharedMemory::all_on_host(bool mine) const {
  int all = mine ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &all, 1, MPI_INT, MPI_MIN, host_);
  return all == 1;
}

// Allocates a few bytes too many, which costs nothing: pages of the file that are never touched
// take no memory.
void MpiSharedMemory::allocate(std::size_t bytes, std::size_t zero_bytes) {
  if (!all_on_host(has_room(bytes))) {
    why_not_ = std::string("there is too little memory in ") + kFolder;
    return;
  }
  MPI_Comm_set_errhandler(host_, MPI_ERRORS_RETURN);
  void* begin = nullptr;
  std::size_t room = bytes + SharedArrays::kAlignment - 1;
  const auto size = static_cast<MPI_Aint>(member_ == 0 ? room : 0);
  const int error = MPI_Win_allocate_shared(size, 1, MPI_INFO_NULL, host_, &begin, &window_);
  if (error != MPI_SUCCESS) window_ = MPI_WIN_NULL;
  if (!all_on_host(error == MPI_SUCCESS)) {
    why_not_ = "MPI cannot allocate shared memory";
    if (window_ != MPI_WIN_NULL) MPI_Win_free(&window_);
    return;
  }
  MPI_Aint whole = 0;
  int unit = 0;
  MPI_Win_shared_query(window_, 0, &whole, &unit, &begin);
  MPI_Win_lock_all(MPI_MODE_NOCHECK, window_);
  bytes_ = {static_cast<std::byte*>(std::align(SharedArrays::kAlignment, bytes, begin, room)),
            bytes};
  if (member_ == 0) std::ranges::fill(bytes_.first(zero_bytes), std::byte{0});
  MPI_Win_sync(window_);
  MPI_Barrier(host_);
  MPI_Win_sync(window_);
}

}  // namespace grove::detail
