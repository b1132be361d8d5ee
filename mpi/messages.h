// SPDX-License-Identifier: MIT
// All that ranks say to each other about one search. The coordinator is on rank 0, beside that
// rank's own nodes. Values; see coordinator.cpp for the protocol.
#pragma once

#include <cereal/types/utility.hpp>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "grove/detail/engine/proven_by.h"
#include "grove/detail/engine/serialise.h"
#include "grove/detail/engine/survey.h"
#include "grove/detail/lagrangian/price_share.h"
#include "grove/detail/model/limits.h"
#include "grove/detail/primal/plan_source.h"
#include "grove/detail/search/findings.h"
#include "grove/detail/search/frontier.h"
#include "grove/detail/search/node_record.h"
#include "grove/detail/search/tree_record.h"
#include "mpi/transport.h"

namespace grove::detail::message {

// Rank to coordinator: where it stands. Covers the nodes it holds, those it has given away that
// nobody was said to have taken over, and the least bound of those it has given up.
struct Status {
  Cost bound = kInfiniteCost;
  Cost evicted_bound = kInfiniteCost;
  Cost proven = 0;  // beside the nodes; see Ledger::prove
  ProvenBy proven_by = ProvenBy::kJointSearch;
  std::int64_t live = 0;
  bool idle = true;  // no node that the end waits for: the incumbent is within w of those it has
  std::int64_t open = 0;
  std::int64_t expanded = 0;
  std::int32_t era = 0;                    // how many BeginAnew it has obeyed
  std::int64_t entrusted = 0;              // how many Entrust it has obeyed
  StopReason stopped = StopReason::kNone;  // a limit that struck there
  std::vector<Frontier::Level> levels;     // the least ones, of open nodes that the end waits for
  // Of each rank that it has nodes from: how many batches it has taken over.
  std::vector<std::pair<std::int32_t, std::int64_t>> batches;
};

// Rank 0 to a rank that has answered all that it was asked before: find these prices, at once.
struct AskPrices {
  PriceShare share;
};

// A rank to rank 0: it has.
struct Prices {
  PriceAnswer answer;
};

// Rank to coordinator: a plan, to be checked.
struct Found {
  Plan plan;
  PlanSource source{};
};

// Rank to coordinator, now and then: what it has done so far, for who looks on.
struct Account {
  grove::detail::Account account;
};

// Rank to coordinator, after End: what it did, and how many batches it has sent to whom. It sends
// nothing more.
struct Farewell {
  grove::detail::Account account;
  std::vector<std::pair<std::int32_t, std::int64_t>> batches;
};

// Rank to rank: nodes and what is known about them. Perhaps none.
struct Batch {
  std::int32_t era = 0;
  std::vector<NodeRecord> nodes;
  std::vector<Finding> findings;
};

// Coordinator to all: a tree, before any of its nodes.
struct NewTree {
  std::uint32_t number = 0;
  TreeRecord tree;
};

// Coordinator to a rank: these nodes are yours; and others, of this bound at least, were given up.
struct Entrust {
  std::vector<NodeRecord> nodes;
  Cost evicted_bound = kInfiniteCost;
};

// Coordinator to a rank: send up to `count` nodes to rank `to`, in one batch.
struct Order {
  std::int32_t to = 0;
  std::int64_t count = 0;
};

// Coordinator to a rank: what it sent to rank `to`, up to this number of batches, is covered by
// that rank's status.
struct Release {
  std::int32_t to = 0;
  std::int64_t batches = 0;
};

// Coordinator to all: a plan that has been checked.
struct Incumbent {
  Plan plan;
};

// Coordinator to all: no node is live anywhere; forget what was given up, the roots come again.
// Every plan that was not pruned costs `proven` at least.
struct BeginAnew {
  Cost proven = 0;
};

// Coordinator to all: look at your nodes, for a checkpoint.
struct Gather {};

// Rank to coordinator: it has. The plans of nodes that were gone by then have been sent before.
struct Gathered {
  Cost evicted_bound = kInfiniteCost;
};

// Coordinator to a rank: send some of what you saw then.
struct More {};

// Rank to coordinator: some of it.
struct Part {
  std::vector<NodeRecord> nodes;
  bool last = false;
};

// Coordinator to all: it is over; say farewell.
struct End {};

// Coordinator to all, after their farewells: how many batches were sent to this rank altogether.
struct Goodbye {
  std::int64_t batches = 0;
};

using Message =
    std::variant<Status, Found, Gathered, Part, Account, Farewell,  // to the coordinator
                 Batch, AskPrices, Prices,                          // to another rank
                 NewTree, Entrust, Order, Release, Incumbent, BeginAnew, Gather, More, End,
                 Goodbye>;

// Throws std::invalid_argument for bytes that are no message.
std::string bytes_of(const Message& message);
Message message_of(std::string_view bytes);

}  // namespace grove::detail::message

namespace grove::detail {

// Sends a message to every rank, this one included.
void tell_all(Transport& transport, const message::Message& message);

}  // namespace grove::detail
