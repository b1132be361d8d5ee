// SPDX-License-Identifier: MIT
#include "mpi/sub_coordinator.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>
#include <variant>

#include "model/assert.h"
#include "mpi/messages.h"

namespace grove::detail {
namespace {

// Status at the start, when all ranks below are idle.
message::Status first_status(const LoadBalancer& load_balancer) {
  message::Status status;
  status.work_requests = load_balancer.work_requests();
  return status;
}

}  // namespace

SubCoordinator::SubCoordinator(Transport& transport, const Hierarchy& hierarchy, int level,
                               const Tuning& tuning)
    : children_(transport, hierarchy, level),
      nodes_(children_),
      load_balancer_(children_.ranks(), tuning),
      parent_(transport, hierarchy, {transport.rank(), level}, first_status(load_balancer_)) {}

void SubCoordinator::handle(int from, message::Message&& message) {
  const auto child = [&] { return children_.with(from); };
  const auto unexpected = [](const auto&) {
    throw std::invalid_argument("sub-coordinator: unexpected message type");
  };
  std::visit(Overloaded{[&](message::Status& status) { update(child(), std::move(status)); },
                        [&](message::NewPlan& found) {
                          if (found.plan.cost < cutoff_) parent_.send(found);
                        },
                        [&](message::ProcessStatistics& report) { parent_.send(report); },
                        [&](message::SnapshotTaken& parts) { gathered(parts); },
                        [&](message::RankFinished& finished) { send_finished(finished); },
                        [&](message::SendNodes& ordered) { order(ordered); },
                        [&](message::ReleaseCustody& release) {
                          children_.send(children_.with(release.from), release);
                        },
                        [&](message::AssignNodes& nodes) {
                          ++assigned_;
                          nodes_.assign(std::move(nodes));
                          parent_.mark_urgent();
                        },
                        [&](message::Restart& order) { restart(order); },
                        [&](message::Incumbent& incumbent) {
                          cutoff_ = std::min(cutoff_, incumbent.plan.cost);
                          children_.broadcast(incumbent);
                        },
                        [&](message::NewTree& tree) { children_.broadcast(tree); },
                        [&](message::SnapshotRequest& gather) {
                          snapshots_taken_ = 0;
                          gathered_ = {};
                          children_.broadcast(gather);
                        },
                        [&](message::Heartbeat& alive) { children_.broadcast(alive); },
                        [&](message::Terminate& end) {
                          ending_ = true;
                          parent_.end_reports();
                          children_.broadcast(end);
                        },
                        [&](message::MessageCounts& message_counts) {
                          children_.send_message_counts(message_counts);
                        },
                        unexpected},
             message);
  changed_ = true;
}

// Releases batches between two children here; the merged status covers such a batch before and
// after the release. Reports of other batches go to the parent.
void SubCoordinator::update(int child, message::Status&& status) {
  load_balancer_.update(child, status);
  for (const message::BatchReceived& taken : status.taken) {
    GROVE_CHECK(children_.include(taken.by), "a child reports batches received by its ranks");
    GROVE_CHECK(std::ranges::none_of(taken_,
                                     [&](const message::BatchReceived& earlier) {
                                       return earlier.by == taken.by &&
                                              earlier.from == taken.from &&
                                              earlier.batches >= taken.batches;
                                     }),
                "the number of batches received rises with every report");
    load_balancer_.arrived(taken.by);
    if (children_.include(taken.from))
      children_.send(children_.with(taken.from),
                     message::ReleaseCustody{taken.from, taken.by, taken.batches});
    else
      taken_.push_back(taken);
  }
  nodes_.update(child, std::move(status));
  if (ending_) return;  // a batch ordered now could be left in transit at the end
  while (const auto transfer = load_balancer_.next())
    children_.send(transfer->from,
                   message::SendNodes{transfer->to, transfer->nodes, transfer->to_idle});
}

// When all children have taken their snapshots, all plans found before the snapshots have been
// forwarded.
void SubCoordinator::gathered(const message::SnapshotTaken& parts) {
  gathered_.evicted_bound = std::min(gathered_.evicted_bound, parts.evicted_bound);
  GROVE_CHECK(snapshots_taken_ < children_.count(), "each child takes one snapshot");
  if (++snapshots_taken_ == children_.count()) parent_.send(gathered_);
}

void SubCoordinator::send_finished(const message::RankFinished& message) {
  GROVE_CHECK(ending_ && finished_children_ < children_.count(),
              "each child finishes once, after Terminate");
  add(message, finished_);
  if (++finished_children_ == children_.count()) parent_.send(finished_);
}

// One child must send a batch, even an empty one, because the receiver waits for it.
void SubCoordinator::order(const message::SendNodes& order) {
  children_.send(load_balancer_.donor(order.count), order);
}

void SubCoordinator::restart(const message::Restart& order) {
  nodes_.broadcast_restart(order.proven);
  parent_.mark_urgent();
}

message::Status SubCoordinator::status() const {
  message::Status status = nodes_.merged();
  status.assigned = assigned_;
  status.surplus = load_balancer_.surplus();
  status.work_requests = load_balancer_.work_requests();
  status.taken = taken_;
  return status;
}

void SubCoordinator::send_updates(double now) {
  if (!changed_ || ending_) return;
  if (parent_.report(status(), now)) taken_.clear();
  changed_ = parent_.reports_at() < std::numeric_limits<double>::infinity();
}

}  // namespace grove::detail
