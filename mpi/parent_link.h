// SPDX-License-Identifier: MIT
// Throttled status reports from a rank or sub-coordinator to its parent.
#pragma once

#include <limits>

#include "mpi/hierarchy.h"
#include "mpi/messages.h"
#include "mpi/transport.h"

namespace grove::detail {

// One thread at a time.
class ParentLink {
 public:
  // Link of the rank or sub-coordinator at `post`, which is not the top. The parent takes `first`
  // as the status already reported. `transport` must outlive this.
  ParentLink(Transport& transport, const Hierarchy& hierarchy, Endpoint post,
             message::Status first);

  // Sends `message` at once.
  void tell(const message::Message& message);
  // Sends `status` if it differs from the last one. An urgent status is sent at once, any other at
  // a rate that the parent can handle from all its children. `now` in seconds since the beginning.
  // Returns true if it was sent.
  bool report(message::Status status, double now);
  // Makes the next status urgent, even if it is unchanged.
  void urge() { urgent_ = true; }
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
