// SPDX-License-Identifier: MIT
// Messages between the ranks of a batch about the assignment of instances.
//
//     leader of a group        master (rank 0)
//       RequestWork   ->
//                    <-   Assignment   or NoMoreWork, the last message to this leader
//                    <-   Stop         perhaps, while the leader has an assignment
//       Report, or Aborted ->
//       RequestWork   -> ...
//
//     leader                   each other rank of its group
//       Assignment   ->        or NoMoreWork, the last message
//                    <-   Ended
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "batch/entry.h"
#include "batch/row.h"

namespace grove::detail::batch {

// The group is idle and requests an instance.
struct RequestWork {
  friend bool operator==(const RequestWork&, const RequestWork&) = default;
};
// The group has solved its assignment or failed to solve it.
struct Report {
  Row row;
  friend bool operator==(const Report&, const Report&) = default;
};
// The group was interrupted; a later run must solve its assignment.
struct Aborted {
  friend bool operator==(const Aborted&, const Aborted&) = default;
};
// Solve this instance.
struct Assignment {
  Entry entry;
  friend bool operator==(const Assignment&, const Assignment&) = default;
};
// The batch was interrupted: abort the assignment.
struct Stop {
  friend bool operator==(const Stop&, const Stop&) = default;
};
// The master assigns no more instances; the receiver ends.
struct NoMoreWork {
  friend bool operator==(const NoMoreWork&, const NoMoreWork&) = default;
};
// The rank has ended its part of the assignment. `error` is empty if it succeeded.
struct Ended {
  std::string error;
  friend bool operator==(const Ended&, const Ended&) = default;
};

using FarmMessage = std::variant<RequestWork, Report, Aborted, Assignment, Stop, NoMoreWork, Ended>;

std::string encode(const FarmMessage& message);
// Inverse of encode(). Throws std::invalid_argument if `bytes` is not an encoded message.
FarmMessage decode(std::string_view bytes);

}  // namespace grove::detail::batch
