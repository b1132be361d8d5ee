// SPDX-License-Identifier: MIT
// Exact costs to go of one agent: the least cost of completing a sequence from a state.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "model/grid.h"
#include "model/limits.h"
#include "model/shared_arrays.h"
#include "sequencing/rtsp.h"

namespace grove::detail {

// Exact costs to go of one agent, for every sequence cheaper than outside_bound(). Small problems
// use a table of all states, larger ones a sequence graph that grows on demand. Initially it is
// empty: call extend(). Any number of threads may read an object while no thread extends it. Copies
// share the stores built so far, and each copy is extended separately: a copy may be passed to
// another thread.
class CostToGo {
 public:
  // Returns the direct legs of the agent over the same stops (direct_legs.h). Called at most once.
  using MakeDirectLegs = std::function<CostMatrix()>;

  // A table, if one is used, is built in `table` if it has room, or read from there. With `direct`,
  // a graph that grows beyond kMaxStates is replaced by a graph of the routes of an agent that
  // visits each stop that it passes.
  explicit CostToGo(CostMatrix matrix, SharedArray table = {}, MakeDirectLegs direct = {});
  // Returns the costs to go of one class of sequences, because a graph by direct legs is valid for
  // one class only. Returns nullopt if *this serves every class.
  std::optional<CostToGo> of_class(const SequenceClass& sequence_class) const;
  // Size in bytes of a table for `stops` stops with `ports` ports each, with 16-bit entries (the
  // largest costs need wider ones). 0: no table is used.
  static std::size_t table_bytes(int stops, int ports);
  // For tests: uses a graph also if a table would do, and one by direct legs if `direct` is given.
  // The results must be the same.
  static CostToGo as_graph(CostMatrix matrix, MakeDirectLegs direct = {});
  // Costs to go of one complete sequence, to find a path without a proof: outside_bound() is 0. A
  // state is known if its stop precedes all stops left in `order`; its cost to go is the cost of
  // visiting the stops left in this order.
  static CostToGo in_order(const CostMatrix& matrix, Sequence order);
  const CostMatrix& matrix() const;

  // Proven lower bound on every sequence of the class with a state outside the store; for a graph
  // by direct legs, on every such path. kNever: there is no such sequence or path.
  Time outside_bound() const;
  // The least cost from `port` (equal to the stop if the matrix has one port per stop) through all
  // stops of `left` (without the stop itself) to the end, over the known routes. Returns kNever if
  // there is none, or if the state is outside.
  Time cost_to_go(StopSet left, int port) const;

  // A lower bound on every complete sequence (relaxation_bound() in rtsp.h), independent of the
  // states known.
  Time relaxed_bound() const;

  // Extends the store. Afterwards outside_bound() > `cost_limit`, and never less than before.
  // Returns false and changes nothing if a limit of the run was reached, or if the graph had more
  // than kMaxDirectStates states. Requires `cost_limit` < kNever.
  bool extend(Time cost_limit, const Limits& limits);

  // Undoes extend() since mark(), or since the beginning, because the results of a search depend on
  // how much is known. A later extend() does the same as before, mostly from memory.
  void reset();
  // Makes the present state the one that reset() restores.
  void mark() { marked_ = store_; }

  static constexpr std::size_t kMaxStates = std::size_t{1} << 15;  // about 0.1 s
  static constexpr std::size_t kMaxDirectStates = std::size_t{1} << 16;

 private:
  class Store;
  explicit CostToGo(std::shared_ptr<const Store> store);
  class Graph;
  class Ordered;
  template <class Entry>
  class Table;
  // Result of an extend(): `from`, extended to `cost_limit`, became `to`.
  struct Extension {
    std::shared_ptr<const Store> from;
    Time cost_limit;
    std::shared_ptr<const Store> to;
  };
  static constexpr std::size_t kMaxExtensions = 4;

  std::shared_ptr<const Store> store_;
  std::shared_ptr<const Store> marked_;
  std::vector<Extension> extended_;  // latest first; filled only once reset() was called
  bool resets_ = false;
  Time refused_ = kNever;  // extend() to this or more failed without a limit of the run
};

}  // namespace grove::detail
