// SPDX-License-Identifier: MIT
// One rank of a distributed search: its nodes and its messages.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/components.h"
#include "engine/live_nodes.h"
#include "engine/run_observer.h"
#include "engine/solve.h"
#include "model/counters.h"
#include "mpi/custody.h"
#include "mpi/hierarchy_links.h"
#include "mpi/learned_bound_exchange.h"
#include "mpi/messages.h"
#include "mpi/remote_bounds.h"
#include "mpi/transport.h"
#include "planning/agent_stops_cache.h"
#include "planning/problem.h"
#include "search/tree_record.h"

namespace grove::detail {

// Holds the nodes of a rank for its workers, and exchanges messages about them with the coordinator
// and with other ranks. The protocol is at the head of coordinator.cpp. components() and the
// objects reachable from it are thread-safe, except where they say otherwise. Only the
// communicating thread may use everything else.
class Rank {
 public:
  // All arguments must outlive this object, except `stops`, which is copied. `stops`: cached stops
  // of the agents, to start from.
  Rank(const Problem& problem, const SolveOptions& options, const Limits& limits,
       Transport& transport, const AgentStopsCache& stops);

  Components& components() { return components_; }
  const LocalNodes& nodes() const { return nodes_; }
  // Cached stops of the agents; the workers' caches start with them.
  const AgentStopsCache& stops() const { return trees_.stops; }

  // Handles a message to this rank. Throws std::invalid_argument for a type of message that no rank
  // receives, and for invalid content.
  void handle(int from, message::Message&& message);
  // On rank 0: sets the lower bound of the whole search.
  void set_lower_bound(Cost bound) { shared_bounds_.set_lower_bound(bound); }
  // Sends plans found here, learned bounds, messages of components, and the status. Plans are
  // sent at once. A status is sent at once if it is urgent, otherwise at a limited rate; see
  // ParentLink::report(). Sends nothing once ended() is true. `now`: seconds since the start of the
  // run.
  void send_updates(double now);
  // The time at which send_updates() can have something to send even if nothing happens until then,
  // in seconds since the start of the run. Infinity: never.
  double next_send_time() const {
    return ended_ ? parent_.reports_at()
                  : std::min(parent_.reports_at(), learned_bounds_.next_send_time());
  }

  // Sends the current statistics, including `counters`, the counters of the workers. Must not be
  // called after send_finished().
  void send_statistics(const Counters& counters);
  // True if the workers must end. The caller calls send_finished() with their counts after they
  // have ended.
  bool ended() const { return ended_; }
  void send_finished(const Counters& counters);
  // True if no further message will arrive.
  bool left() const;

 private:
  // A batch that arrived before its tree or its Restart, or behind such a batch from the same rank.
  struct DeferredBatch {
    int from;
    message::NodeBatch batch;
  };
  // The trees of the run as received from the coordinator.
  struct ReceivedTrees {
    AgentStopsCache stops;
    Trees trees;                             // must outlive everything that holds their nodes
    std::map<std::uint32_t, NodePtr> roots;  // by tree number
  };
  // Placeholders, because the coordinator supplies the trees and observes the run.
  struct AtCoordinator {
    TreeSupply trees;       // supplies none
    WorkObserver observer;  // does nothing
  };
  // Numbers of the coordinator's orders that the rank has handled.
  struct Handled {
    std::int32_t epoch = 0;     // Restart messages
    std::int64_t assigned = 0;  // AssignNodes messages
  };

  void receive_batch(int from, message::NodeBatch& batch);
  void receive_deferred();
  bool must_defer(const message::NodeBatch& batch) const;
  void send_nodes(const message::SendNodes& order);
  bool keeps_next() const;
  void favor_splitting();
  void accept(const message::AssignNodes& assigned);
  void accept(const message::NewTree& tree);
  void gather();
  void send_part();
  void send_found();
  void send_component_messages();
  void send_learned_bounds(double now);
  void push(const std::vector<NodeRecord>& records, const std::vector<GroupBound>& findings);
  void restart(Cost proven);
  message::Status status() const;
  RunStatistics statistics(Counters counters) const;
  bool is_wanted(Cost bound) const;
  void send(int rank, const message::Message& message);

  Transport& transport_;
  ParentLink parent_;
  LocalNodes nodes_;
  ReceivedTrees trees_;
  RemoteBounds shared_bounds_;
  AtCoordinator at_coordinator_;
  Components components_;
  LearnedBoundExchange learned_bounds_;
  Custody custody_;
  DirectMessages direct_messages_;
  Handled handled_;
  std::vector<DeferredBatch> deferred_;
  std::int64_t cached_only_until_ = 0;  // value of `expanded` at which kCachedOnly ends
  std::vector<NodePtr> gathered_;       // nodes of the snapshot not yet sent to rank 0
  bool ended_ = false;
};

}  // namespace grove::detail
