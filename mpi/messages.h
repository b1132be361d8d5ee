// SPDX-License-Identifier: MIT
// All that ranks say to each other about one search. Values; see coordinator.cpp for the protocol,
// and hierarchy.h for who answers to whom.
#pragma once

#include <cereal/types/utility.hpp>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "engine/bound_source.h"
#include "engine/run_statistics.h"
#include "engine/serialize.h"
#include "lagrangian/pricing_messages.h"
#include "model/limits.h"
#include "primal/plan_source.h"
#include "search/group_bounds.h"
#include "search/learned_bounds.h"
#include "search/node_record.h"
#include "search/tree_record.h"

namespace grove::detail::message {

// Nodes of one bound.
struct Surplus {
  Cost bound = kInfiniteCost;
  std::int64_t nodes = 0;
  // Beside these, for idle ranks only: the next nodes of ranks that are at another one. (Busy ranks
  // would hand each other their best nodes for ever.)
  std::int64_t next = 0;

  friend bool operator==(const Surplus&, const Surplus&) = default;
};

// A rank that would expand better nodes if it had some.
struct WorkRequest {
  std::int32_t rank = 0;
  bool idle = true;           // it has no node that the end waits for
  Cost best = kInfiniteCost;  // of its open nodes that the end waits for

  friend bool operator==(const WorkRequest&, const WorkRequest&) = default;
};

// That many batches of rank `from` have been taken over by rank `by`.
struct BatchReceived {
  std::int32_t by = 0;
  std::int32_t from = 0;
  std::int64_t batches = 0;

  friend bool operator==(const BatchReceived&, const BatchReceived&) = default;
};

// To the superior: where a rank stands, or all that are below a coordinator. Covers the nodes it
// holds, those it has given away that nobody was said to have taken over, and the least bound of
// those it has given up.
struct Status {
  Cost bound = kInfiniteCost;
  Cost evicted_bound = kInfiniteCost;
  Cost proven = 0;  // beside the nodes; see Ledger::prove
  BoundSource proven_by = BoundSource::kJointSearch;
  bool live = false;  // is any node?
  std::int64_t open = 0;
  std::int64_t expanded = 0;
  std::int32_t epoch = 0;                  // how many Restart all have obeyed
  std::int64_t entrusted = 0;              // how many Entrust it has obeyed
  StopReason stopped = StopReason::kNone;  // a limit that struck there
  std::vector<Surplus> surplus;            // of the least bounds of which any can be spared
  std::vector<WorkRequest> work_requests;  // the neediest first; not of all ranks below
  std::vector<BatchReceived> taken;        // since the last status; from ranks not below

  friend bool operator==(const Status&, const Status&) = default;
};

// Rank 0 to a rank that has answered all that it was asked before: find these prices, at once.
struct RequestPricing {
  PricingRequest share;
};

// A rank to rank 0: it has.
struct PricingDone {
  PricingReply answer;
};

// To the superior: a plan, to be checked.
struct NewPlan {
  Plan plan;
  PlanSource source{};
};

// To the superior, now and then: what has been done so far, for who looks on.
struct ProcessStatistics {
  RunStatistics survey;
};

// To the superior, after End: what was done, and how many messages were sent to whom that went
// directly from rank to rank. The sender sends nothing more.
struct RankFinished {
  RunStatistics survey;
  std::map<std::int32_t, std::int64_t> messages;
};

// What two say together.
void add(const RankFinished& part, RankFinished& sum);

// Rank to rank: nodes and what is known about them. Perhaps none.
struct NodeBatch {
  std::int32_t epoch = 0;
  std::vector<NodeRecord> nodes;
  std::vector<GroupBound> findings;
};

// Rank to rank: what was found out. The receiver tells it to the next `reach` - 1 ranks, in the
// order of ranks, the first being after the last; see knowledge.h.
struct LearnedBounds {
  std::int32_t reach = 1;
  std::vector<std::string> facts;  // packed, see below: many pass by who only hands them on
};

// To all below: a tree, before any of its nodes.
struct NewTree {
  std::uint32_t number = 0;
  TreeRecord tree;
};

// Coordinator to a child: these nodes are yours; and others, of this bound at least, were given up.
struct AssignNodes {
  std::vector<NodeRecord> nodes;
  Cost evicted_bound = kInfiniteCost;
};

// Coordinator to a child: a rank there is to send up to `count` nodes to rank `to`, in one batch;
// see Spare::next.
struct SendNodes {
  std::int32_t to = 0;
  std::int64_t count = 0;
  bool to_idle = false;
};

// On its way to rank `from`: what it sent to rank `to`, up to this number of batches, is covered by
// that rank's status.
struct ReleaseCustody {
  std::int32_t from = 0;
  std::int32_t to = 0;
  std::int64_t batches = 0;
};

// To all below: a plan that has been checked.
struct Incumbent {
  Plan plan;
};

// To all below: no node is live anywhere; forget what was given up, the roots come again.
// Every plan that was not pruned costs `proven` at least.
struct Restart {
  Cost proven = 0;
};

// To all below: look at your nodes, for a checkpoint.
struct SnapshotRequest {};

// To the superior: all here have. The plans of nodes that were gone by then have been sent before.
struct SnapshotTaken {
  Cost evicted_bound = kInfiniteCost;
};

// The top to a rank: send some of what you saw then.
struct SnapshotNext {};

// A rank to the top: some of it.
struct SnapshotPart {
  std::vector<NodeRecord> nodes;
  bool last = false;
};

// To all below, while a checkpoint is written: rank 0 does not stand still.
struct Heartbeat {};

// To all below: it is over; say farewell.
struct Terminate {};

// To all below, after their farewells: how many messages were sent to each directly, by rank.
struct MessageCounts {
  std::map<std::int32_t, std::int64_t> messages;
};

using Message =
    std::variant<Status, NewPlan, SnapshotTaken, SnapshotPart, ProcessStatistics,
                 RankFinished,                                           // up
                 NodeBatch, RequestPricing, PricingDone, LearnedBounds,  // from rank to rank
                 NewTree, AssignNodes, SendNodes, ReleaseCustody, Incumbent, Restart,
                 SnapshotRequest, SnapshotNext, Heartbeat, Terminate, MessageCounts>;  // down

struct Addressed {
  int level = 0;  // whom it is for, on the rank that it has come to; see Post
  Message message;
};

// A fact as it travels.
std::string packed(const LearnedBound& fact);
// Throws std::invalid_argument for bytes that are no fact.
LearnedBound unpacked(std::string_view bytes);

std::string bytes_of(const Message& message, int level);
// Throws std::invalid_argument for bytes that are no message.
Addressed message_of(std::string_view bytes);

}  // namespace grove::detail::message
