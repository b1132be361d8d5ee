// SPDX-License-Identifier: MIT
// Message links along the hierarchy: from a coordinator to its children (ranks or
// sub-coordinators), and from a rank or sub-coordinator to its parent.
#pragma once

#include <limits>
#include <vector>

#include "mpi/hierarchy.h"
#include "mpi/messages.h"
#include "mpi/transport.h"

namespace grove::detail {

// From a coordinator to its children. These are numbered from 0: ranks, or coordinators of the
// level below. One thread at a time.
class ChildLinks {
 public:
  // Links of the coordinator of `level` on the transport's rank. `transport` must outlive this.
  ChildLinks(Transport& transport, const Hierarchy& hierarchy, int level)
      : transport_(transport), hierarchy_(hierarchy), post_{transport.rank(), level} {}

  int count() const { return hierarchy_.children(post_); }
  // The child that is `rank` or is above it. `rank` must be below this coordinator.
  int with(int rank) const { return hierarchy_.child_with(post_, rank); }
  // For each child, the ranks that it is or that are below it.
  std::vector<std::vector<int>> ranks() const;
  bool include(int rank) const { return hierarchy_.is_below(post_, rank); }

  void send(int child, const message::Message& message);
  void broadcast(const message::Message& message);
  // Sends each child the counts of the ranks that it is or that are below it.
  void send_message_counts(const message::MessageCounts& message_counts);

 private:
  Transport& transport_;
  const Hierarchy hierarchy_;
  const Endpoint post_;
};

// From a rank or sub-coordinator to its parent: throttled status reports. One thread at a time.
class ParentLink {
 public:
  // Link of the rank or sub-coordinator at `post`, which is not the top. The parent takes `first`
  // as the status already reported. `transport` must outlive this.
  ParentLink(Transport& transport, const Hierarchy& hierarchy, Endpoint post,
             message::Status first);

  // Sends `message` at once.
  void send(const message::Message& message);
  // Sends `status` if it differs from the last one. An urgent status is sent at once, any other at
  // a rate that the parent can handle from all its children. `now` in seconds since the beginning.
  // Returns true if it was sent.
  bool report(message::Status status, double now);
  // Makes the next status urgent, even if it is unchanged.
  void mark_urgent() { urgent_ = true; }
  // When a withheld status may be sent. Infinity if none is withheld, or after end_reports().
  double reports_at() const { return reports_at_; }
  // Cancels a withheld status.
  void end_reports() { reports_at_ = std::numeric_limits<double>::infinity(); }

 private:
  bool is_urgent(const message::Status& status) const;

  Transport& transport_;
  const Endpoint to_;
  const double pause_;    // seconds
  message::Status said_;  // last status sent
  double said_at_ = -1;
  double reports_at_ = std::numeric_limits<double>::infinity();
  bool urgent_ = false;
};

}  // namespace grove::detail
