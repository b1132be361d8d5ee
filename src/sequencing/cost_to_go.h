// SPDX-License-Identifier: MIT
// Exact costs to go of one agent: the least cost to complete a sequence from a state, which is a
// stop and the set of stops left.
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
// use a table of all states, larger ones a sequence graph that grows on demand. Initially the store
// is empty, so call extend(). Any number of threads may read an object while no thread changes it.
// Copies share the stores built so far but are extended separately, so different threads may use
// different copies.
class CostToGo {
 public:
  // Returns the direct legs of the agent (direct_legs.h) between the same stops.
  using MakeDirectLegs = std::function<CostMatrix()>;

  // `table`: memory for the table, if it has room; a table that is already complete there is only
  // read. `direct`: if given, a graph with more than kMaxStates states is replaced by a graph by
  // direct legs, i.e. of the routes of an agent that visits each plain stop that it passes.
  explicit CostToGo(CostMatrix matrix, SharedArray table = {}, MakeDirectLegs direct = {});
  // Returns separate costs to go for one sequence class; a graph by direct legs is valid for one
  // class only. Returns nullopt if *this can be used for `sequence_class`.
  std::optional<CostToGo> of_class(const SequenceClass& sequence_class) const;
  // Size in bytes of a table for `stops` stops with `ports` ports each, with 16-bit entries
  // (matrices with very large costs need 32-bit entries). 0: no table is used.
  static std::size_t table_bytes(int stops, int ports);
  // For tests: uses a graph even for small problems, and a graph by direct legs if `direct` is
  // given. The results must be the same.
  static CostToGo as_graph(CostMatrix matrix, MakeDirectLegs direct = {});
  // Returns the costs to go along one complete sequence, for searches that find a path but prove
  // nothing: outside_bound() is 0. A state is known if its stop precedes all its stops left in
  // `order`; its cost to go is the least cost through the stops left in this order.
  static CostToGo in_order(const CostMatrix& matrix, Sequence order);
  // Returns prices to go: costs of sequences that may leave out stops, plus the prices of these
  // stops. `skip`: by stop, the price of leaving it out; kNever: it must be visited.
  // `neighborhoods`: as for CompletionBounds::make(). Requires one port per stop. extend() fails if
  // there are too many states.
  static CostToGo with_prices(CostMatrix matrix, std::vector<Time> skip,
                              std::vector<StopSet> neighborhoods = {});
  const CostMatrix& matrix() const;

  // Proven lower bound on the cost of every sequence with a state outside the store; for a graph by
  // direct legs, on the cost of every path of its class with such a state. kNever: there is no such
  // sequence or path.
  Time outside_bound() const;
  // The least cost from `port` through all stops of `left`, which does not contain the stop of the
  // port, to the end, over the known routes. With one port per stop the port is the stop. Returns
  // kNever if no route is known, also if the state is outside the store.
  Time cost_to_go(StopSet left, int port) const;

  // A proven lower bound on the cost of every complete sequence (relaxation_bound() in rtsp.h),
  // independent of the known states. 0 for a store of in_order().
  Time relaxed_bound() const;

  // Extends the store such that outside_bound() > `cost_limit`; outside_bound() never decreases.
  // Returns false and changes nothing if a limit of the run was reached, if a graph by direct legs
  // would have more than kMaxDirectStates states, or for a store of in_order(). Requires
  // `cost_limit` < kNever.
  bool extend(Time cost_limit, const Limits& limits);

  // Undoes all calls of extend() since mark(), or since construction, because the results of a
  // search depend on the known states. Has no effect on a table. Repeated calls of extend() give
  // the same stores as before, and the latest of them are cached.
  void reset();
  // Makes the current store the one that reset() restores.
  void mark() { marked_ = store_; }

  static constexpr std::size_t kMaxStates = std::size_t{1} << 15;  // about 0.1 s to build
  static constexpr std::size_t kMaxDirectStates = std::size_t{1} << 16;

 private:
  class Store;
  explicit CostToGo(std::shared_ptr<const Store> store);
  class Graph;
  class Ordered;
  class Priced;
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
  std::vector<Extension> extended_;  // latest first; filled only after the first reset()
  bool resets_ = false;
  Time refused_ =
      kNever;  // least `cost_limit` for which extend() failed, except at a limit of the run
};

}  // namespace grove::detail
