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
#include "mpi/bound_broadcast.h"
#include "mpi/hierarchy.h"
#include "mpi/hierarchy_links.h"
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
  const AgentStopsCache& stops() const { return stops_; }

  // Handles a message to this rank. Throws std::invalid_argument for a type of message that no rank
  // receives, and for invalid content.
  void handle(int from, message::Message&& message);
  // On rank 0: sets the lower bound of the whole search.
  void set_lower_bound(Cost bound) { shared_bounds_.set_lower_bound(bound); }
  // Sends plans found here, learned bounds, pricing requests or replies, and the status. Plans are
  // sent at once. A status is sent at once if it is urgent, otherwise at a limited rate; see
  // ParentLink::report(). Sends nothing once ended() is true. `now`: seconds since the start of the
  // run.
  void send_updates(double now);
  // The time at which send_updates() can have something to send even if nothing happens until then,
  // in seconds since the start of the run. Infinity: never.
  double next_send_time() const {
    return ended_ ? parent_.reports_at()
                  : std::min(parent_.reports_at(), bound_broadcast_.next_send_time());
  }

  // Sends the current statistics, including `counters`, those of the workers. Must not be called
  // after send_finished().
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

  void receive_batch(int from, message::NodeBatch& batch);
  void receive_deferred();
  bool must_defer(const message::NodeBatch& batch) const;
  void send_nodes(const message::SendNodes& order);
  bool keeps_next() const;
  void favor_splitting();
  void release(const message::ReleaseCustody& release);
  void accept(const message::AssignNodes& assigned);
  void gather();
  void send_part();
  void send_found();
  void send_component_messages();
  void send_learned_bounds(double now);
  void receive(message::LearnedBounds& facts);
  void push(const std::vector<NodeRecord>& records, const std::vector<GroupBound>& findings);
  void restart(Cost proven);
  message::Status status() const;
  RunStatistics statistics(Counters counters) const;
  bool is_wanted(Cost bound) const;
  void send(int rank, const message::Message& message);

  const Problem& problem_;
  const Omega omega_;
  const Limits& limits_;
  Transport& transport_;
  const Hierarchy hierarchy_;
  ParentLink parent_;
  LocalNodes nodes_;
  AgentStopsCache stops_;
  Trees trees_;  // must outlive everything that holds nodes of the trees
  RemoteBounds shared_bounds_;
  TreeSupply remote_trees_;  // supplies no tree: the coordinator instantiates them
  WorkObserver unwatched_;   // does nothing: the coordinator observes the run
  Components components_;

  std::map<std::uint32_t, NodePtr> roots_;  // by tree number
  TreeIndex trees_of_bounds_;
  BoundBroadcast bound_broadcast_;
  std::int32_t epoch_ = 0;
  std::int64_t assigned_ = 0;
  std::vector<DeferredBatch> held_;

  struct Peer {
    std::int64_t sent = 0;   // batches
    std::int64_t taken = 0;  // batches received from there
    bool news = false;       // true: `taken` changed since the last status
    std::map<std::int64_t, std::vector<NodePtr>> custody;  // by batch number
  };
  std::map<int, Peer> peers_;
  std::int64_t in_custody_ = 0;         // number of nodes in custody
  std::int64_t cached_only_until_ = 0;  // value of `expanded` at which kCachedOnly ends
  std::int64_t nodes_sent_ = 0;
  std::int64_t learned_bounds_sent_ = 0;

  std::vector<NodePtr> gathered_;  // nodes of the snapshot not yet sent to rank 0

  bool ended_ = false;
  // Numbers of messages directly from rank to rank: sent to each rank, received here, and to be
  // received here in total (set at shutdown).
  std::map<std::int32_t, std::int64_t> messages_sent_;
  std::int64_t received_messages_ = 0;
  std::optional<std::int64_t> expected_messages_;
};

}  // namespace grove::detail
