// SPDX-License-Identifier: MIT
// The table (held_karp.cpp) is all or nothing. The graph (sequence_dag.cpp) is built anew, wider,
// each time more is asked: far enough to let in about as many states as it had, so that all builds
// together cost little more than the last. Each build holds every sequence up to its reach, so a
// greater reach never has a smaller beyond().
#include "grove/detail/sequencing/completions.h"

#include <utility>

#include "grove/detail/model/assert.h"
#include "grove/detail/sequencing/cost_matrix.h"
#include "grove/detail/sequencing/rtsp.h"
#include "grove/detail/sequencing/sequence_dag.h"
#include "held_karp_table.h"
#include "path_relaxation.h"
#include "rtsp_backends.h"

namespace grove::detail {

// Immutable, so that any number of Completions may share one.
class Completions::Store {
 public:
  explicit Store(std::shared_ptr<const CostMatrix> matrix) : matrix_(std::move(matrix)) {}
  virtual ~Store() = default;

  const CostMatrix& matrix() const { return *matrix_; }
  virtual Time relaxed_bound() const = 0;
  virtual Time beyond() const = 0;
  virtual Time completion(StopSet left, int port) const = 0;
  // One with a beyond() > reach; null when a limit struck. Only if this has not.
  virtual std::shared_ptr<const Store> widened(Time reach, const Limits& limits) const = 0;

 protected:
  const std::shared_ptr<const CostMatrix>& shared_matrix() const { return matrix_; }

 private:
  std::shared_ptr<const CostMatrix> matrix_;
};

template <class Entry>
class Completions::Table : public Store {
 public:
  Table(std::shared_ptr<const CostMatrix> matrix, SharedArray shared)
      : Store(std::move(matrix)), shared_(shared) {}

  Time relaxed_bound() const override { return relaxation_bound(least_matrix(matrix())); }
  Time beyond() const override { return table_.built() ? kNever : 0; }
  Time completion(StopSet left, int port) const override {
    return table_.built() ? table_.completion(left, port) : kNever;
  }
  std::shared_ptr<const Store> widened(Time, const Limits& limits) const override {
    auto built = std::make_shared<Table>(this->shared_matrix(), shared_);
    return built->table_.build(matrix(), limits, shared_) ? built : nullptr;
  }

 private:
  SharedArray shared_;
  HeldKarpTable<Entry> table_;
};

class Completions::Graph : public Store {
 public:
  explicit Graph(std::shared_ptr<const CostMatrix> matrix)
      : Store(std::move(matrix)),
        relaxation_(std::make_shared<const PathRelaxation>(this->matrix())),
        dag_(relaxation_->root_bound()) {}
  Graph(const Graph& narrower, SequenceDag dag)
      : Store(narrower.shared_matrix()), relaxation_(narrower.relaxation_), dag_(std::move(dag)) {}

  Time relaxed_bound() const override { return relaxation_->root_bound(); }
  Time beyond() const override { return dag_.beyond(); }
  Time completion(StopSet left, int port) const override { return dag_.completion(left, port); }
  std::shared_ptr<const Store> widened(Time reach, const Limits& limits) const override {
    auto wider =
        SequenceDag::build(matrix(), *relaxation_, std::max(reach, dag_.next_reach()), limits);
    return wider ? std::make_shared<Graph>(*this, std::move(*wider)) : nullptr;
  }

 private:
  std::shared_ptr<const PathRelaxation> relaxation_;
  SequenceDag dag_;
};

Completions::Completions(CostMatrix matrix, SharedArray table) {
  auto shared = std::make_shared<const CostMatrix>(std::move(matrix));
  if (shared->stops() > kTableStops)
    store_ = std::make_shared<Graph>(std::move(shared));
  else if (fits_narrow_table(*shared))
    store_ = std::make_shared<Table<std::int16_t>>(std::move(shared), table);
  else
    store_ = std::make_shared<Table<std::int32_t>>(std::move(shared), table);
}

std::size_t Completions::table_bytes(int stops, int ports) {
  if (stops > kTableStops) return 0;
  return HeldKarpTable<std::int16_t>::entries(stops, ports) * sizeof(std::int16_t);
}

Completions::Completions(std::shared_ptr<const Store> store) : store_(std::move(store)) {}

Completions Completions::as_graph(CostMatrix matrix) {
  return Completions(
      std::make_shared<Graph>(std::make_shared<const CostMatrix>(std::move(matrix))));
}

const CostMatrix& Completions::matrix() const {
  return store_->matrix();
}

Time Completions::relaxed_bound() const {
  return store_->relaxed_bound();
}

Time Completions::beyond() const {
  return store_->beyond();
}

Time Completions::completion(StopSet left, int port) const {
  return store_->completion(left, port);
}

bool Completions::widen(Time reach, const Limits& limits) {
  GROVE_ASSERT(reach < kNever, "there is more to know");
  if (beyond() > reach) return true;
  auto wider = store_->widened(reach, limits);
  if (!wider) return false;
  store_ = std::move(wider);
  return true;
}

}  // namespace grove::detail
