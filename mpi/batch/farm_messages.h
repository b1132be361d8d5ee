// SPDX-License-Identifier: MIT
// All that the ranks of a batch tell each other about who solves what.
//
//     leader of a group        master (rank 0)
//       RequestWork   ->
//                    <-   Assignment   or Dismissal, the last word to this leader
//                    <-   Stop         perhaps, while the leader has an assignment
//       Report, or Aborted ->
//       RequestWork   -> ...
//
//     leader                   each other rank of its group
//       Assignment   ->        or Dismissal, the last word
//                    <-   Ended
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "batch/entry.h"
#include "batch/row.h"

namespace grove::detail::batch {

// The group has nothing to do.
struct RequestWork {
  friend bool operator==(const RequestWork&, const RequestWork&) = default;
};
// The group has solved its assignment, or failed to.
struct Report {
  Row row;
  friend bool operator==(const Report&, const Report&) = default;
};
// The group was interrupted; its assignment is to be solved another time.
struct Aborted {
  friend bool operator==(const Aborted&, const Aborted&) = default;
};
// Solve this.
struct Assignment {
  Entry entry;
  friend bool operator==(const Assignment&, const Assignment&) = default;
};
// The run is to end: give up.
struct Stop {
  friend bool operator==(const Stop&, const Stop&) = default;
};
// There is nothing more to do.
struct NoMoreWork {
  friend bool operator==(const NoMoreWork&, const NoMoreWork&) = default;
};
// The rank has ended its part of the assignment, with an error or without.
struct Ended {
  std::string error;
  friend bool operator==(const Ended&, const Ended&) = default;
};

using FarmMessage = std::variant<RequestWork, Report, Aborted, Assignment, Stop, NoMoreWork, Ended>;

std::string encode(const FarmMessage& message);
// Throws std::invalid_argument when `bytes` are no message.
FarmMessage decode(std::string_view bytes);

}  // namespace grove::detail::batch
