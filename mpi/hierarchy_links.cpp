// SPDX-License-Identifier: MIT
#include "mpi/hierarchy_links.h"

#include <utility>

#include "model/assert.h"
#include "mpi/polling.h"

namespace grove::detail {

std::vector<std::vector<int>> ChildLinks::ranks() const {
  std::vector<std::vector<int>> all(static_cast<std::size_t>(count()));
  for (int rank = post_.rank; rank < hierarchy_.ranks() && include(rank); ++rank)
    all[static_cast<std::size_t>(with(rank))].push_back(rank);
  for (int child = 0; child < count(); ++child) {
    const std::vector<int>& below = all[static_cast<std::size_t>(child)];
    GROVE_CHECK(!below.empty() && below.front() == hierarchy_.child(post_, child).rank,
                "a child is on the first of the ranks below it");
  }
  return all;
}

void ChildLinks::send(int child, const message::Message& message) {
  const Endpoint post = hierarchy_.child(post_, child);
  transport_.send(post.rank, message::bytes_of(message, post.level));
}

void ChildLinks::broadcast(const message::Message& message) {
  const std::string bytes = message::bytes_of(message, post_.level - 1);
  for (int child = 0; child < count(); ++child)
    transport_.send(hierarchy_.child(post_, child).rank, bytes);
}

void ChildLinks::send_message_counts(const message::MessageCounts& message_counts) {
  std::vector<message::MessageCounts> parts(static_cast<std::size_t>(count()));
  for (const auto& [rank, messages] : message_counts.messages)
    parts.at(static_cast<std::size_t>(with(rank))).messages[rank] = messages;
  for (int child = 0; child < count(); ++child) send(child, parts[static_cast<std::size_t>(child)]);
}

namespace {

// Minimum time between two statuses that are not urgent, in seconds, at the start; see pause_at().
// Grows with the number of siblings, because the parent handles the statuses of all its children.
constexpr double kPause = 2e-3;
constexpr double kPausePerSibling = 50e-6;

constexpr double kNoReport = std::numeric_limits<double>::infinity();

bool has_idle(const message::Status& status) {
  return !status.work_requests.empty() && status.work_requests.front().idle;
}

}  // namespace

ParentLink::ParentLink(Transport& transport, const Hierarchy& hierarchy, Endpoint post,
                       message::Status first)
    : transport_(transport),
      to_(hierarchy.parent(post)),
      top_(hierarchy.top()),
      pause_(kPause + kPausePerSibling * hierarchy.children(to_)),
      last_sent_(std::move(first)) {}

void ParentLink::send(const message::Message& message) {
  transport_.send(to_.rank, message::bytes_of(message, to_.level));
}

void ParentLink::send_to_top(const message::Message& message) {
  transport_.send(top_.rank, message::bytes_of(message, top_.level));
}

// A status is urgent if any field changed on which other ranks or the global bounds depend. A
// larger surplus is urgent only if half of the open nodes, about what the rank can give away, has
// more than doubled since the last report, because other ranks wait for nodes while few ranks have
// any.
bool ParentLink::is_urgent(const message::Status& status) const {
  const bool has_more = !status.surplus.empty() && status.open / 2 > 2 * (last_sent_.open / 2);
  return has_more || !status.taken.empty() || status.assigned != last_sent_.assigned ||
         status.epoch != last_sent_.epoch || status.bound != last_sent_.bound ||
         status.proven != last_sent_.proven || status.stopped != last_sent_.stopped ||
         status.live != last_sent_.live || has_idle(status) != has_idle(last_sent_);
}

bool ParentLink::report(message::Status status, double now) {
  GROVE_CHECK(status.expanded >= last_sent_.expanded && status.assigned >= last_sent_.assigned &&
                  status.epoch >= last_sent_.epoch && status.proven >= last_sent_.proven,
              "the counts of a status never fall");
  GROVE_CHECK(now >= last_sent_at_, "statuses are reported in order of time");
  reports_at_ = kNoReport;
  if (!urgent_ && status == last_sent_) return false;
  const double next = last_sent_at_ + pause_at(last_sent_at_, pause_);
  if (!urgent_ && !is_urgent(status) && now < next) {
    reports_at_ = next;
    return false;
  }
  send(status);
  last_sent_ = std::move(status);
  last_sent_.taken.clear();
  last_sent_at_ = now;
  urgent_ = false;
  return true;
}

}  // namespace grove::detail
