// SPDX-License-Identifier: MIT
// Messages between the ranks of one distributed search; all types are values. The protocol is at
// the head of coordinator.cpp; the tree of coordinators is in hierarchy.h.
#pragma once

#include <cereal/types/utility.hpp>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/component.h"
#include "engine/run_statistics.h"
#include "engine/serialize.h"
#include "engine/shared_bounds.h"
#include "model/limits.h"
#include "primal/plan_source.h"
#include "search/group_bounds.h"
#include "search/learned_bounds.h"
#include "search/node_record.h"
#include "search/tree_record.h"

namespace grove::detail::message {

// Nodes of one bound that a rank can give away.
struct Surplus {
  Cost bound = kInfiniteCost;
  std::int64_t nodes = 0;
  // Additional nodes that only an idle rank can get: at most one, the best open node, of each rank
  // whose worker is expanding a node. (Busy ranks would otherwise transfer their best nodes to each
  // other for ever.)
  std::int64_t next = 0;

  friend bool operator==(const Surplus&, const Surplus&) = default;
};

// Request from a rank for nodes, or for better nodes than it has. A node is wanted if it must be
// expanded before the run can end.
struct WorkRequest {
  std::int32_t rank = 0;
  bool idle = true;           // the rank has no wanted node
  Cost best = kInfiniteCost;  // least bound of the rank's wanted open nodes

  friend bool operator==(const WorkRequest&, const WorkRequest&) = default;
};

// Rank `by` has received `batches` batches from rank `from` so far.
struct BatchReceived {
  std::int32_t by = 0;
  std::int32_t from = 0;
  std::int64_t batches = 0;

  friend bool operator==(const BatchReceived&, const BatchReceived&) = default;
};

// Status report to the parent, for one rank or for all ranks below a sub-coordinator. Covers the
// nodes that these ranks hold, the nodes that they have in custody (transferred, but not yet
// released), and the nodes that they have evicted.
struct Status {
  Cost bound = kInfiniteCost;
  Cost evicted_bound = kInfiniteCost;
  Cost proven = 0;  // proven outside the tree search; see SharedBounds::prove
  ComponentId proven_by{};
  bool live = false;  // true: some node is live
  std::int64_t open = 0;
  std::int64_t expanded = 0;
  std::int32_t epoch = 0;     // number of Restart messages that all these ranks have handled
  std::int64_t assigned = 0;  // number of AssignNodes messages that the sender has handled
  StopReason stopped = StopReason::kNone;  // a limit reached on one of these ranks
  std::vector<Surplus> surplus;            // by bound, ascending
  std::vector<WorkRequest> work_requests;  // the most urgent ones, in descending urgency
  std::vector<BatchReceived> taken;  // new since the last status; no `from` is below the sender

  friend bool operator==(const Status&, const Status&) = default;
};

// From rank to rank: a message of a component of the engine to the same component there.
struct ForComponent {
  ComponentMessage message;
};

// To the parent: a plan to be checked.
struct NewPlan {
  Plan plan;
  PlanSource source{};
};

// To the parent, periodically: the current statistics, for observers and as a sign of life. They
// also replace the final statistics of a rank that does not finish.
struct ProcessStatistics {
  RunStatistics statistics;
};

// To the parent, after Terminate: the final statistics, and the number of messages sent directly to
// each other rank. It is the sender's last message to its parent.
struct RankFinished {
  RunStatistics statistics;
  std::map<std::int32_t, std::int64_t> messages;
};

// Adds `part` to `sum`.
void add(const RankFinished& part, RankFinished& sum);

// From rank to rank: nodes, and the known bounds on groups of agents in them. `nodes` can be empty.
struct NodeBatch {
  std::int32_t epoch = 0;
  std::vector<NodeRecord> nodes;
  std::vector<GroupBound> findings;
};

// From rank to rank: learned bounds. The receiver is responsible for forwarding them to the next
// `reach` - 1 ranks, in cyclic order of ranks; see bound_broadcast.h.
struct LearnedBounds {
  std::int32_t reach = 1;
  std::vector<std::string> facts;  // packed by packed(), because many ranks only forward them
};

// To all ranks below: a tree, sent before any of its nodes is assigned.
struct NewTree {
  std::uint32_t number = 0;
  TreeRecord tree;
};

// From a coordinator to a child: nodes to search. `evicted_bound`: lower bound on the nodes of a
// restored checkpoint that were evicted earlier.
struct AssignNodes {
  std::vector<NodeRecord> nodes;
  Cost evicted_bound = kInfiniteCost;
};

// From a coordinator to a child: the child's rank, or one rank below it, must send up to `count`
// nodes to rank `to`, in one batch. `to_idle`: the nodes counted by Surplus::next may be sent.
struct SendNodes {
  std::int32_t to = 0;
  std::int64_t count = 0;
  bool to_idle = false;
};

// To rank `from`, through the coordinators: a processed status covers the first `batches` batches
// that rank `from` sent to rank `to`, so their custody ends.
struct ReleaseCustody {
  std::int32_t from = 0;
  std::int32_t to = 0;
  std::int64_t batches = 0;
};

// To all ranks below: a plan that has been checked.
struct Incumbent {
  Plan plan;
};

// To all ranks below: no node is live on any rank, and the roots will be assigned again. Each rank
// forgets its evicted bound. Every plan that was not pruned costs at least `proven`.
struct Restart {
  Cost proven = 0;
};

// To all ranks below: take a snapshot of the nodes, for a checkpoint.
struct SnapshotRequest {};

// To the parent: the sending rank, or every rank below the sender, has taken its snapshot. The
// plans of nodes completed before the snapshots were sent earlier.
struct SnapshotTaken {
  Cost evicted_bound = kInfiniteCost;
};

// From the top coordinator to a rank: send the next part of the snapshot.
struct SnapshotNext {};

// From a rank to the top coordinator: a part of the snapshot.
struct SnapshotPart {
  std::vector<NodeRecord> nodes;
  bool last = false;
};

// To all ranks below, while a checkpoint is written: sign that rank 0 is responsive.
struct Heartbeat {};

// To all ranks below: the run is over; reply with RankFinished.
struct Terminate {};

// To all ranks below, after all ranks have finished: the number of messages that other ranks sent
// directly to each rank.
struct MessageCounts {
  std::map<std::int32_t, std::int64_t> messages;
};

using Message =
    std::variant<Status, NewPlan, SnapshotTaken, SnapshotPart, ProcessStatistics,
                 RankFinished,                            // up
                 NodeBatch, ForComponent, LearnedBounds,  // from rank to rank
                 NewTree, AssignNodes, SendNodes, ReleaseCustody, Incumbent, Restart,
                 SnapshotRequest, SnapshotNext, Heartbeat, Terminate, MessageCounts>;  // down

struct Addressed {
  int level = 0;  // level of the receiver on its rank; see Endpoint
  Message message;
};

// Serialized form of a learned bound.
std::string packed(const LearnedBound& fact);
// Inverse of packed(). Throws std::invalid_argument if `bytes` is not a packed learned bound.
LearnedBound unpacked(std::string_view bytes);

std::string bytes_of(const Message& message, int level);
// Inverse of bytes_of(). Throws std::invalid_argument if `bytes` is not a serialized message.
Addressed message_of(std::string_view bytes);

}  // namespace grove::detail::message

namespace grove::detail {

// Visitor composed of lambdas, for std::visit of a message.
template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;  // needed by clang 16

}  // namespace grove::detail
