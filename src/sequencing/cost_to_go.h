// SPDX-License-Identifier: MIT
// What it costs one agent to complete a sequence, for all the states that may matter.
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

// Exact costs to go of one agent, for every sequence cheaper than beyond(). A table of all states
// where that is small, else a sequence graph that grows on demand. At first there is nothing:
// widen(). Any number of threads may read one that nobody widens. Copies share what is known, and
// each is widened for itself: a copy may go to another thread.
class CostToGo {
 public:
  // Direct legs of the agent over the same stops (direct_legs.h), asked for once at most.
  using MakeDirectLegs = std::function<CostMatrix()>;

  // The table, if there is one, is made in `table`, if there is room, or read from there.
  // With `direct`, a graph that grows beyond kMostStates is replaced by one of what an agent can do
  // that visits each stop it passes.
  explicit CostToGo(CostMatrix matrix, SharedArray table = {}, MakeDirectLegs direct = {});
  // Completions of a class of sequences, for a graph by direct legs is of one class alone. Returns
  // nullopt if these serve every class.
  std::optional<CostToGo> of_class(const SequenceClass& work) const;
  // The room that a table of so many stops with so many ports takes, in bytes, but of the largest
  // costs; 0: there is none.
  static std::size_t table_bytes(int stops, int ports);
  // A graph however small a table were, and by direct legs if there are any: they must tell the
  // same.
  static CostToGo as_graph(CostMatrix matrix, MakeDirectLegs direct = {});
  // Of one complete sequence, to find a path and to prove nothing: beyond() is 0, and a state is
  // known if its stop comes before all that is left, its completion being the cost of what is left
  // in this order.
  static CostToGo in_order(const CostMatrix& matrix, Sequence order);
  const CostMatrix& matrix() const;

  // Proven: a sequence of the class with a state outside costs at least this, and by direct legs a
  // path. kNever: there is none such.
  Time beyond() const;
  // The least cost from a port (of a stop, which is the same where the matrix has none) through all
  // of `left` (without the stop) to the end, over the ways known; kNever when there is none, or the
  // state is outside.
  Time cost_to_go(StopSet left, int port) const;

  // A lower bound on every complete sequence (relaxation_bound() in rtsp.h), whatever is known.
  Time relaxed_bound() const;

  // Afterwards beyond() > reach, and never less than before. Returns false, and no more is known,
  // if a limit of the run was reached, or the graph had more than kMostDirectStates states.
  // `reach` < kNever.
  bool widen(Time reach, const Limits& limits);

  // Takes back what widen() has made known since mark(), or since the beginning: what a search
  // finds on its way depends on how much is known. Afterwards widen() does the same as before, and
  // mostly from memory.
  void reset();
  // From now on reset() leads back to what is known now.
  void mark() { marked_ = store_; }

  static constexpr std::size_t kMostStates = std::size_t{1} << 15;  // some 0.1 s
  static constexpr std::size_t kMostDirectStates = std::size_t{1} << 16;

 private:
  class Store;
  explicit CostToGo(std::shared_ptr<const Store> store);
  class Graph;
  class Ordered;
  template <class Entry>
  class Table;
  // What widen() made of a store.
  struct Widened {
    std::shared_ptr<const Store> from;
    Time reach;
    std::shared_ptr<const Store> to;
  };
  static constexpr std::size_t kMostWidenedKept = 4;

  std::shared_ptr<const Store> store_;
  std::shared_ptr<const Store> marked_;
  std::vector<Widened> widened_;  // the last ones in front; kept once reset() was called
  bool resets_ = false;
  Time refused_ = kNever;  // to widen to this or more was refused, by no limit of the run
};

}  // namespace grove::detail
