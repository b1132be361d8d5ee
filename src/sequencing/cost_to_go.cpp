// SPDX-License-Identifier: MIT
// Stores of costs to go: table, graph, graph by direct legs.
//
// The table (held_karp.cpp) holds all states or none. The graph (sequence_dag.cpp) is rebuilt with
// a greater cost limit whenever outside_bound() must rise. The new limit is chosen to admit about
// as many new states as the graph already has, so that all builds together cost little more than
// the last one. Each build holds every sequence up to its limit, so a greater limit never gives a
// smaller outside_bound().
//
// If the graph of all sequences becomes too large, a graph by direct legs replaces it. It holds all
// states that a path of the class can reach within the limit. So its outside_bound() is a lower
// bound on paths instead of sequences, and its cost to go of a state is a lower bound on the paths
// that continue from this state. If the graph by direct legs becomes too large as well, extend()
// fails, and fails immediately when it is called again with the same or a greater cost limit, so
// that no time or memory is spent.
#include "sequencing/cost_to_go.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "model/assert.h"
#include "sequencing/cost_matrix.h"
#include "sequencing/direct_legs.h"
#include "sequencing/held_karp_table.h"
#include "sequencing/one_tree_relaxation.h"
#include "sequencing/optional_stops_dag.h"
#include "sequencing/rtsp.h"
#include "sequencing/sequence.h"
#include "sequencing/sequence_dag.h"

namespace grove::detail {

// One version of the known costs to go. Immutable: any number of CostToGo objects may share it.
class CostToGo::Store {
 public:
  explicit Store(std::shared_ptr<const CostMatrix> matrix) : matrix_(std::move(matrix)) {}
  virtual ~Store() = default;

  const CostMatrix& matrix() const { return *matrix_; }
  virtual Time relaxed_bound() const = 0;
  virtual Time outside_bound() const = 0;
  virtual Time cost_to_go(StopSet left, int port) const = 0;
  // Returns a store with outside_bound() > `cost_limit`, or nullptr if none could be built. Call
  // only if outside_bound() <= `cost_limit`.
  virtual std::shared_ptr<const Store> extended(Time cost_limit, const Limits& limits) const = 0;
  virtual bool is_all_or_nothing() const { return false; }
  // Returns a store for a sequence class, or nullptr if this store can be used for it.
  virtual std::shared_ptr<const Store> of_class(const SequenceClass&) const { return nullptr; }

 protected:
  const std::shared_ptr<const CostMatrix>& shared_matrix() const { return matrix_; }

 private:
  std::shared_ptr<const CostMatrix> matrix_;
};

template <class Entry>
class CostToGo::Table : public Store {
 public:
  Table(std::shared_ptr<const CostMatrix> matrix, SharedArray shared)
      : Store(std::move(matrix)), shared_(shared) {}

  Time relaxed_bound() const override { return relaxation_bound(min_matrix(matrix())); }
  Time outside_bound() const override { return table_.built() ? kNever : 0; }
  bool is_all_or_nothing() const override { return true; }
  Time cost_to_go(StopSet left, int port) const override {
    return table_.built() ? table_.cost_to_go(left, port) : kNever;
  }
  std::shared_ptr<const Store> extended(Time, const Limits& limits) const override {
    auto built = std::make_shared<Table>(this->shared_matrix(), shared_);
    return built->table_.build(matrix(), limits, shared_) ? built : nullptr;
  }

 private:
  SharedArray shared_;
  HeldKarpTable<Entry> table_;
};

class CostToGo::Graph : public Store {
 public:
  Graph(std::shared_ptr<const CostMatrix> matrix, MakeDirectLegs make_direct)
      : Store(std::move(matrix)),
        relaxation_(std::make_shared<const OneTreeRelaxation>(this->matrix())),
        make_direct_(std::move(make_direct)),
        dag_(nothing_known()) {}

  Time relaxed_bound() const override { return relaxation_->root_bound(); }
  Time outside_bound() const override { return dag_->outside_bound(); }
  Time cost_to_go(StopSet left, int port) const override { return dag_->cost_to_go(left, port); }
  std::shared_ptr<const Store> extended(Time cost_limit, const Limits& limits) const override {
    auto extended = std::make_shared<Graph>(*this);
    return extended->extend(cost_limit, limits) ? extended : nullptr;
  }
  std::shared_ptr<const Store> of_class(const SequenceClass& sequence_class) const override {
    if (!make_direct_ || sequence_class == sequence_class_) return nullptr;
    auto other = std::make_shared<Graph>(*this);
    other->sequence_class_ = sequence_class;
    if (direct_) other->dag_ = nothing_known();
    return other;
  }
  // Does nothing if no direct legs are available.
  void use_direct_legs() {
    if (make_direct_) direct_ = std::make_shared<const DirectLegs>(make_direct_(), matrix());
  }

 private:
  using End = SequenceDag::End;

  bool extend(Time cost_limit, const Limits& limits) {
    const Time far = std::max(cost_limit, dag_->next_cost_limit());
    if (!direct_) {
      const End end = build(far, limits);
      if (end != End::kTooLarge) return end == End::kBuilt;
      use_direct_legs();
      return build(cost_limit, limits) == End::kBuilt;
    }
    End end = build(far, limits);
    if (end == End::kTooLarge && cost_limit < far) end = build(cost_limit, limits);
    return end == End::kBuilt;
  }

  End build(Time cost_limit, const Limits& limits) {
    SequenceDag::Scope scope{matrix(), *relaxation_};
    if (direct_) {
      scope.direct = direct_.get();
      scope.sequence_class = sequence_class_;
      scope.max_states = kMaxDirectStates;
    } else if (make_direct_) {
      scope.max_states = kMaxStates;
    }
    SequenceDag built(0);
    const End end = SequenceDag::build(scope, cost_limit, limits, built);
    if (end == End::kBuilt) dag_ = std::make_shared<const SequenceDag>(std::move(built));
    return end;
  }

  std::shared_ptr<const SequenceDag> nothing_known() const {
    return std::make_shared<const SequenceDag>(relaxation_->root_bound());
  }

  std::shared_ptr<const OneTreeRelaxation> relaxation_;
  MakeDirectLegs make_direct_;                // may be empty
  std::shared_ptr<const DirectLegs> direct_;  // set after the graph of all sequences was too large
  SequenceClass sequence_class_;
  std::shared_ptr<const SequenceDag> dag_;
};

// Costs to go along one given order, restricted to the stops left.
class CostToGo::Ordered : public Store {
 public:
  Ordered(std::shared_ptr<const CostMatrix> matrix, Sequence order)
      : Store(std::move(matrix)), order_(std::move(order)), later_(order_.size()) {
    StopSet later = 0;
    for (auto stop = order_.rbegin(); stop != order_.rend(); ++stop) {
      later_[*stop] = later;
      later |= bit(*stop);
    }
    GROVE_CHECK(later == this->matrix().all() && std::ssize(order_) == this->matrix().stops(),
                "an order holds each stop once");
  }

  Time relaxed_bound() const override { return 0; }
  Time outside_bound() const override { return 0; }
  Time cost_to_go(StopSet left, int port) const override {
    const int ports = matrix().ports;
    const int stop = port / ports;
    if ((left & ~later_[stop]) != 0) return kNever;
    PortCosts onward;
    int next = kNone;
    const auto go_back_to = [&](int from) {
      onward = next == kNone ? to_end(from) : through(from, next, onward);
      next = from;
    };
    for (auto at = order_.rbegin(); at != order_.rend(); ++at)
      if ((left & bit(*at)) != 0) go_back_to(*at);
    go_back_to(stop);
    return onward[port % ports];
  }
  std::shared_ptr<const Store> extended(Time, const Limits&) const override { return nullptr; }

 private:
  static constexpr int kMaxPorts = 4;
  static constexpr int kNone = -1;
  using PortCosts = std::array<Time, kMaxPorts>;

  PortCosts to_end(int stop) const {
    PortCosts costs;
    costs.fill(kNever);
    for (int port = 0; port < matrix().ports; ++port)
      costs[port] = matrix().to_end(stop * matrix().ports + port);
    return costs;
  }
  PortCosts through(int stop, int next, const PortCosts& onward) const {
    const int ports = matrix().ports;
    PortCosts costs;
    costs.fill(kNever);
    for (int from = 0; from < ports; ++from)
      for (int to = 0; to < ports; ++to)
        costs[from] = std::min(
            costs[from],
            add_costs(matrix().between(stop * ports + from, next * ports + to), onward[to]));
    return costs;
  }

  Sequence order_;
  std::vector<StopSet> later_;  // by stop: the stops after it in the order
};

// Prices to go of sequences that may leave out stops.
class CostToGo::Priced : public Store {
 public:
  Priced(std::shared_ptr<const CostMatrix> matrix, std::vector<Time> skip,
         std::vector<StopSet> neighborhoods)
      : Store(std::move(matrix)),
        skip_(std::make_shared<const std::vector<Time>>(std::move(skip))),
        neighborhoods_(std::make_shared<const std::vector<StopSet>>(std::move(neighborhoods))),
        dag_(std::make_shared<const OptionalStopsDag>(0)) {}

  Time relaxed_bound() const override { return 0; }
  Time outside_bound() const override { return dag_->outside_bound(); }
  Time cost_to_go(StopSet left, int port) const override { return dag_->price_to_go(left, port); }
  std::shared_ptr<const Store> extended(Time cost_limit, const Limits& limits) const override {
    auto extended = std::make_shared<Priced>(*this);
    if (!extended->bounds_) {
      auto bounds = CompletionBounds::make(matrix(), *skip_, *neighborhoods_, limits);
      if (!bounds) return nullptr;
      extended->bounds_ = std::make_shared<const CompletionBounds>(*std::move(bounds));
    }
    auto dag = OptionalStopsDag::build(matrix(), *skip_, *extended->bounds_, cost_limit, limits);
    if (!dag) return nullptr;
    extended->dag_ = std::make_shared<const OptionalStopsDag>(*std::move(dag));
    return extended;
  }

 private:
  std::shared_ptr<const std::vector<Time>> skip_;
  std::shared_ptr<const std::vector<StopSet>> neighborhoods_;
  std::shared_ptr<const CompletionBounds> bounds_;  // made when first needed
  std::shared_ptr<const OptionalStopsDag> dag_;
};

CostToGo::CostToGo(CostMatrix matrix, SharedArray table, MakeDirectLegs direct) {
  auto shared = std::make_shared<const CostMatrix>(std::move(matrix));
  if (shared->stops() > kTableStops)
    store_ = std::make_shared<Graph>(std::move(shared), std::move(direct));
  else if (fits_narrow_table(*shared))
    store_ = std::make_shared<Table<std::int16_t>>(std::move(shared), table);
  else
    store_ = std::make_shared<Table<std::int32_t>>(std::move(shared), table);
  mark();
}

std::size_t CostToGo::table_bytes(int stops, int ports) {
  if (stops > kTableStops) return 0;
  return HeldKarpTable<std::int16_t>::entries(stops, ports) * sizeof(std::int16_t);
}

CostToGo::CostToGo(std::shared_ptr<const Store> store)
    : store_(std::move(store)), marked_(store_) {}

CostToGo CostToGo::in_order(const CostMatrix& matrix, Sequence order) {
  return CostToGo(
      std::make_shared<Ordered>(std::make_shared<const CostMatrix>(matrix), std::move(order)));
}

CostToGo CostToGo::as_graph(CostMatrix matrix, MakeDirectLegs direct) {
  auto graph = std::make_shared<Graph>(std::make_shared<const CostMatrix>(std::move(matrix)),
                                       std::move(direct));
  graph->use_direct_legs();
  return CostToGo(std::move(graph));
}

std::optional<CostToGo> CostToGo::of_class(const SequenceClass& sequence_class) const {
  auto other = store_->of_class(sequence_class);
  if (!other) return std::nullopt;
  CostToGo cost_to_go(std::move(other));
  if (marked_ != store_) cost_to_go.marked_ = marked_->of_class(sequence_class);
  return cost_to_go;
}

CostToGo CostToGo::with_prices(CostMatrix matrix, std::vector<Time> skip,
                               std::vector<StopSet> neighborhoods) {
  return CostToGo(std::make_shared<Priced>(std::make_shared<const CostMatrix>(std::move(matrix)),
                                           std::move(skip), std::move(neighborhoods)));
}

const CostMatrix& CostToGo::matrix() const {
  return store_->matrix();
}

Time CostToGo::relaxed_bound() const {
  return store_->relaxed_bound();
}

Time CostToGo::outside_bound() const {
  return store_->outside_bound();
}

Time CostToGo::cost_to_go(StopSet left, int port) const {
  GROVE_ASSERT((left & bit(port / matrix().ports)) == 0,
               "the stop of a port is not among the stops left");
  return store_->cost_to_go(left, port);
}

bool CostToGo::extend(Time cost_limit, const Limits& limits) {
  GROVE_ASSERT(cost_limit < kNever, "the cost limit is finite");
  if (outside_bound() > cost_limit) return true;
  if (cost_limit >= refused_) return false;
  const auto known = std::ranges::find_if(extended_, [&](const Extension& extended) {
    return extended.from == store_ && extended.cost_limit == cost_limit;
  });
  if (known != extended_.end()) {
    std::rotate(extended_.begin(), known, known + 1);
    store_ = extended_.front().to;
    GROVE_CHECK(outside_bound() > cost_limit, "a known extension covers the cost limit");
    return true;
  }
  auto extended = store_->extended(cost_limit, limits);
  if (!extended) {
    if (!limits.stop_requested()) refused_ = cost_limit;
    return false;
  }
  GROVE_CHECK(extended->outside_bound() > cost_limit, "an extension covers the cost limit");
  GROVE_CHECK(&extended->matrix() == &store_->matrix(), "an extension is over the same costs");
  if (resets_) {
    if (extended_.size() == kMaxExtensions) extended_.pop_back();
    extended_.insert(extended_.begin(), {store_, cost_limit, extended});
  }
  store_ = std::move(extended);
  return true;
}

// A table is kept: it is complete or empty, and no search uses an empty table, so the results of a
// search do not depend on earlier calls of extend().
void CostToGo::reset() {
  if (store_->is_all_or_nothing()) return;
  resets_ = true;
  store_ = marked_;
}

}  // namespace grove::detail
