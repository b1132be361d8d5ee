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

// Links from a coordinator to its children, which are ranks or coordinators of the level below,
// numbered from 0. One thread at a time.
class ChildLinks {
 public:
  // Links of the level-`level` coordinator on the transport's rank. `transport` must outlive this
  // object.
  ChildLinks(Transport& transport, const Hierarchy& hierarchy, int level)
      : transport_(transport), hierarchy_(hierarchy), post_{transport.rank(), level} {}

  int count() const { return hierarchy_.children(post_); }
  // The number of the child that is `rank` or has `rank` below it. `rank` must be below this
  // coordinator.
  int with(int rank) const { return hierarchy_.child_with(post_, rank); }
  // By child: the child's own rank, or the ranks below it.
  std::vector<std::vector<int>> ranks() const;
  bool include(int rank) const { return hierarchy_.is_below(post_, rank); }

  void send(int child, const message::Message& message);
  void broadcast(const message::Message& message);
  // Sends each child the counts for its own rank or the ranks below it.
  void send_message_counts(const message::MessageCounts& message_counts);

 private:
  Transport& transport_;
  const Hierarchy hierarchy_;
  const Endpoint post_;
};

// Link from a rank or sub-coordinator to its parent, with throttled status reports. One thread at a
// time.
class ParentLink {
 public:
  // Link of the rank or sub-coordinator at `post`, which must not be the top. `first` is the status
  // that the parent assumes before the first report. `transport` must outlive this object.
  ParentLink(Transport& transport, const Hierarchy& hierarchy, Endpoint post,
             message::Status first);

  // Sends `message` at once, to the parent or directly to the top coordinator.
  void send(const message::Message& message);
  void send_to_top(const message::Message& message);
  // Sends `status` if it differs from the last status sent. An urgent status is sent at once, any
  // other at a rate that the parent can handle for all its children. `now`: seconds since the start
  // of the run. Returns true if `status` was sent.
  bool report(message::Status status, double now);
  // Makes the next status urgent, even if it is unchanged.
  void mark_urgent() { urgent_ = true; }
  // The time at which a withheld status can be sent, in seconds since the start of the run.
  // Infinity if no status is withheld, and after end_reports().
  double reports_at() const { return reports_at_; }
  // Cancels a withheld status.
  void end_reports() { reports_at_ = std::numeric_limits<double>::infinity(); }

 private:
  bool is_urgent(const message::Status& status) const;

  Transport& transport_;
  const Endpoint to_;
  const Endpoint top_;
  const double pause_;         // seconds
  message::Status last_sent_;  // last status sent
  double last_sent_at_ = -1;
  double reports_at_ = std::numeric_limits<double>::infinity();
  bool urgent_ = false;
};

}  // namespace grove::detail
