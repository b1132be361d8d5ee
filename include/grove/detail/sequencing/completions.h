// SPDX-License-Identifier: MIT
// What it costs one agent to complete a sequence, for all the states that may matter.
#pragma once

#include <cstddef>
#include <memory>

#include "grove/detail/model/grid.h"
#include "grove/detail/model/limits.h"
#include "grove/detail/model/shared_arrays.h"
#include "grove/detail/sequencing/sequence.h"

namespace grove::detail {

// Exact costs to go of one agent, for every sequence cheaper than beyond(). A table of all states
// where that is small, else a sequence graph that grows on demand. At first there is nothing:
// widen(). Any number of threads may read one that nobody widens. Copies share what is known, and
// each is widened for itself: a copy may go to another thread.
class Completions {
 public:
  // The table, if there is one, is made in `table`, if there is room, or read from there.
  explicit Completions(CostMatrix matrix, SharedArray table = {});
  // The room that a table of so many stops with so many ports takes, in bytes, but of the largest
  // costs; 0: there is none.
  static std::size_t table_bytes(int stops, int ports);
  // A graph however small a table were: they must tell the same.
  static Completions as_graph(CostMatrix matrix);
  const CostMatrix& matrix() const;

  // Proven: a sequence with a state outside costs at least this. kNever: there is none such.
  Time beyond() const;
  // The least cost from a port (of a stop, which is the same where the matrix has none) through all
  // of `left` (without the stop) to the end, over the ways known; kNever when there is none, or the
  // state is outside.
  Time completion(StopSet left, int port) const;

  // A lower bound on every complete sequence (relaxation_bound() in rtsp.h), whatever is known.
  Time relaxed_bound() const;

  // Afterwards beyond() > reach, and never less than before. False, and nothing changed, when a
  // limit struck. `reach` < kNever.
  bool widen(Time reach, const Limits& limits);

 private:
  class Store;
  explicit Completions(std::shared_ptr<const Store> store);
  class Graph;
  template <class Entry>
  class Table;
  std::shared_ptr<const Store> store_;
};

}  // namespace grove::detail
