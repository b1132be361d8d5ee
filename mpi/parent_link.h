// SPDX-License-Identifier: MIT
// What a rank or a coordinator says to the one above it, and when it is worth saying.
#pragma once

#include <limits>

#include "mpi/hierarchy.h"
#include "mpi/messages.h"
#include "mpi/transport.h"

namespace grove::detail {

// Of one thread.
class ParentLink {
 public:
  // Of the one at this post, which is not the top. The superior takes it that `first` was said.
  // `transport` must outlive this.
  ParentLink(Transport& transport, const Hierarchy& hierarchy, Endpoint post,
             message::Status first);

  // Says this at once.
  void tell(const message::Message& message);
  // Says where things stand, if that is news: at once if it may matter at once, else not more often
  // than the superior can bear who hears all its children. `now` in seconds since the beginning.
  // True if it was said.
  bool report(message::Status status, double now);
  // The next status matters at once, whatever it says.
  void urge() { urgent_ = true; }
  // When what was kept back may be said; infinity if nothing was, or is to be any more.
  double reports_at() const { return reports_at_; }
  // No more reports.
  void end_reports() { reports_at_ = std::numeric_limits<double>::infinity(); }

 private:
  bool is_urgent(const message::Status& status) const;

  Transport& transport_;
  const Endpoint to_;
  const double pause_;    // seconds
  message::Status said_;  // last
  double said_at_ = -1;
  double reports_at_ = std::numeric_limits<double>::infinity();
  bool urgent_ = false;
};

}  // namespace grove::detail
