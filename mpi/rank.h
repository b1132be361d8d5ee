// SPDX-License-Identifier: MIT
// One rank's part of a search, and of the talk about it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "engine/local_nodes.h"
#include "engine/shared_search.h"
#include "engine/solve.h"
#include "mpi/bound_broadcast.h"
#include "mpi/hierarchy.h"
#include "mpi/messages.h"
#include "mpi/parent_link.h"
#include "mpi/remote_bounds.h"
#include "mpi/transport.h"
#include "planning/agent_stops_cache.h"
#include "search/problem.h"
#include "search/tree_record.h"

namespace grove::detail {

// The nodes that a rank holds, for its workers, and all that is said about them to the coordinator
// and to other ranks. The protocol is told at the head of coordinator.cpp. search() and what it
// leads to may be used from any thread, the rest by one: the one that speaks.
class Rank {
 public:
  // All must outlive this, but for `stops`, of which it makes a copy: what is known already of the
  // agents' stops.
  Rank(const Problem& problem, const SolveOptions& options, const Limits& limits,
       Transport& transport, const AgentStopsCache& stops);

  SharedSearch& search() { return search_; }
  const LocalNodes& nodes() const { return nodes_; }
  // For workers to begin with.
  const AgentStopsCache& stops() const { return stops_; }

  // Something that a rank may be told. Throws std::invalid_argument for what cannot be.
  void handle(int from, message::Message&& message);
  // On rank 0: no plan of the whole search costs less.
  void know(Cost bound) { ledger_.know(bound); }
  // Says what is new: plans always; where it stands at once if that may matter at once, else not
  // more often than ranks can bear. `now` in seconds since the beginning.
  void send_updates(double now);
  // When it may have something to say though nothing has happened since; infinity: never.
  double next_send_time() const {
    return ended_ ? parent_.reports_at()
                  : std::min(parent_.reports_at(), knowledge_.next_send_time());
  }

  // Until the farewell: tells what has been done so far, workers' counts among it.
  void send_statistics(Stats counts);
  // Is it time for workers to end? Then, when they have, say farewell: what they counted.
  bool ended() const { return ended_; }
  void send_finished(Stats counts);
  // Is nothing more to come?
  bool left() const;

 private:
  struct DeferredBatch {  // that arrived before what it needs
    int from;
    message::NodeBatch batch;
  };

  void take_over(int from, message::NodeBatch& batch);
  void take_over_held();
  bool must_defer(const message::NodeBatch& batch) const;
  void give(const message::SendNodes& order);
  bool keeps_next() const;
  void others_wait();
  void release(const message::ReleaseCustody& release);
  void accept(const message::AssignNodes& entrusted);
  void gather();
  void send_part();
  void send_found();
  void speak_of_prices();
  void speak_of_facts(double now);
  void receive(message::LearnedBounds& facts);
  void push(const std::vector<NodeRecord>& records, const std::vector<GroupBound>& findings);
  void begin_anew(Cost proven);
  message::Status status() const;
  RunStatistics survey(Stats counts) const;
  bool is_wanted(Cost bound) const;
  void tell(int rank, const message::Message& message);

  const Problem& problem_;
  const Omega omega_;
  const Limits& limits_;
  Transport& transport_;
  const Hierarchy hierarchy_;
  ParentLink parent_;
  LocalNodes nodes_;
  AgentStopsCache stops_;
  Trees trees_;  // outlives all that holds nodes of them
  RemoteBounds ledger_;
  TreeSource elsewhere_;    // the coordinator brings trees,
  WorkObserver unwatched_;  // and counts what is done
  SharedSearch search_;

  std::map<std::uint32_t, NodePtr> roots_;  // by the number of the tree
  TreeIndex trees_of_facts_;
  BoundBroadcast knowledge_;
  std::int32_t epoch_ = 0;
  std::int64_t assigned_ = 0;
  std::vector<DeferredBatch> held_;

  struct Peer {
    std::int64_t sent = 0;                                 // batches
    std::int64_t taken = 0;                                // batches from there
    bool news = false;                                     // of `taken`, since the last status
    std::map<std::int64_t, std::vector<NodePtr>> custody;  // by the number of the batch
  };
  std::map<int, Peer> peers_;
  std::int64_t in_custody_ = 0;         // nodes
  std::int64_t cached_only_until_ = 0;  // that so many nodes have been expanded here
  std::int64_t nodes_sent_ = 0;
  std::int64_t facts_sent_ = 0;

  std::vector<NodePtr> gathered_;  // for a checkpoint; not sent yet

  bool ended_ = false;
  // Directly from rank to rank: how many messages went to whom, came here, and are to come
  // altogether, which is known at the very end.
  std::map<std::int32_t, std::int64_t> told_;
  std::int64_t heard_ = 0;
  std::optional<std::int64_t> to_hear_;
};

}  // namespace grove::detail
