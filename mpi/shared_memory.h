// SPDX-License-Identifier: MIT
// Memory that the ranks on a host have in common.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace grove::detail {

// All its members made it together, and destroy it together, when none uses it any more.
class SharedMemory {
 public:
  SharedMemory() = default;  // none
  virtual ~SharedMemory() = default;
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  // The same bytes for all members, if at other addresses, all of them multiples of
  // SharedArrays::kAlignment. Empty: there is none.
  std::span<std::byte> bytes() const { return bytes_; }
  int member() const { return member_; }
  int members() const { return members_; }
  // Why there is none that was asked for, in a few words; empty: nothing is missing.
  const std::string& why_not() const { return why_not_; }

 protected:
  std::span<std::byte> bytes_;
  int member_ = 0;
  int members_ = 1;
  std::string why_not_;
};

}  // namespace grove::detail
