// SPDX-License-Identifier: MIT
// The table (held_karp.cpp) is all or nothing. The graph (sequence_dag.cpp) is built anew, wider,
// each time more is asked: far enough to let in about as many states as it had, so that all builds
// together cost little more than the last. Each build holds every sequence up to its reach, so a
// greater reach never has a smaller beyond().
#include "grove/sequencing/completions.h"

#include <utility>

#include "grove/sequencing/sequence_dag.h"
#include "held_karp_table.h"
#include "path_relaxation.h"
#include "rtsp_backends.h"

namespace grove {

class Completions::Store {
 public:
  explicit Store(CostMatrix matrix) : matrix_(std::move(matrix)) {}
  virtual ~Store() = default;

  const CostMatrix& matrix() const { return matrix_; }
  virtual Time beyond() const = 0;
  virtual Time completion(StopSet left, int stop) const = 0;
  virtual bool widen(Time reach, const Limits& limits) = 0;

 private:
  CostMatrix matrix_;
};

template <class Entry>
class Completions::Table : public Store {
 public:
  using Store::Store;

  Time beyond() const override { return table_.built() ? kNever : 0; }
  Time completion(StopSet left, int stop) const override {
    return table_.built() ? table_.completion(left, stop) : kNever;
  }
  bool widen(Time, const Limits& limits) override {
    return table_.built() || table_.build(matrix(), limits);
  }

 private:
  HeldKarpTable<Entry> table_;
};

class Completions::Graph : public Store {
 public:
  explicit Graph(CostMatrix matrix)
      : Store(std::move(matrix)), relaxation_(this->matrix()), dag_(relaxation_.root_bound()) {}

  Time beyond() const override { return dag_.beyond(); }
  Time completion(StopSet left, int stop) const override { return dag_.completion(left, stop); }
  bool widen(Time reach, const Limits& limits) override {
    if (dag_.beyond() > reach) return true;
    auto wider =
        SequenceDag::build(matrix(), relaxation_, std::max(reach, dag_.next_reach()), limits);
    if (!wider) return false;
    dag_ = std::move(*wider);
    return true;
  }

 private:
  PathRelaxation relaxation_;
  SequenceDag dag_;
};

Completions::Completions(CostMatrix matrix) {
  if (matrix.stops() > kTableStops)
    store_ = std::make_unique<Graph>(std::move(matrix));
  else if (fits_narrow_table(matrix))
    store_ = std::make_unique<Table<std::int16_t>>(std::move(matrix));
  else
    store_ = std::make_unique<Table<std::int32_t>>(std::move(matrix));
}

Completions::~Completions() = default;
Completions::Completions(Completions&&) noexcept = default;
Completions& Completions::operator=(Completions&&) noexcept = default;

const CostMatrix& Completions::matrix() const {
  return store_->matrix();
}

Time Completions::beyond() const {
  return store_->beyond();
}

Time Completions::completion(StopSet left, int stop) const {
  return store_->completion(left, stop);
}

bool Completions::widen(Time reach, const Limits& limits) {
  return store_->widen(reach, limits);
}

}  // namespace grove
