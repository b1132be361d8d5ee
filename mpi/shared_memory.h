// SPDX-License-Identifier: MIT
// Memory shared by the ranks on one host.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace grove::detail {

// Memory that the ranks on one host, its members, share. They construct it together, and destroy it
// together when none of them uses it any more.
class SharedMemory {
 public:
  SharedMemory() = default;  // provides no shared memory
  virtual ~SharedMemory() = default;
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  // The shared bytes, possibly at different addresses on different members. The start address is a
  // multiple of SharedArrays::kAlignment. Empty: there is no shared memory.
  std::span<std::byte> bytes() const { return bytes_; }
  int member() const { return member_; }
  int members() const { return members_; }
  // A few words that say why requested memory could not be provided; empty if it was provided or
  // none was requested.
  const std::string& why_not() const { return why_not_; }

 protected:
  std::span<std::byte> bytes_;
  int member_ = 0;
  int members_ = 1;
  std::string why_not_;
};

}  // namespace grove::detail
