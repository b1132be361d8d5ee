// SPDX-License-Identifier: MIT
// Search over all assignments at once, for instances in which agents choose tasks or destinations.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "assignment/route_bound.h"
#include "engine/solve.h"
#include "model/counters.h"

namespace grove::detail {

// Searches by unsatisfiable cores (cores/core_search.h), in which agents pay for the tasks that
// they leave out and for their goals (assignment/priced_instance.h). One thread at a time.
class AllAssignmentsSearch {
 public:
  // False if cores are disabled in the build or in `options`.
  static bool is_available(const SolveOptions& options);
  // Prepares a search for plans that cost less than `cutoff`. Returns nullptr if price_choices() is
  // not possible, or if is_available() is false. With a proof log, the
  // search logs a formula, and reduced cost fixing is off. All arguments except
  // `bound` must outlive the object.
  static std::unique_ptr<AllAssignmentsSearch> make(const Instance& instance, RouteBound& bound,
                                                    Cost cutoff, const SolveOptions& options,
                                                    const Limits& limits);
  virtual ~AllAssignmentsSearch() = default;

  // Searches with an effort of about `effort` (model/effort.h). `cutoff`: as in make(), and not
  // greater. Calls `after_step` about every millisecond, if it is not empty. Returns false if the
  // search is over.
  virtual bool run(Cost cutoff, std::int64_t effort,
                   const std::function<void()>& after_step = {}) = 0;
  // Proven: every plan that costs less than the cutoff of the last run() costs at least this.
  virtual Cost lower_bound() const = 0;
  // An optimal plan, if the search has found one. It is checked.
  virtual const std::optional<Plan>& plan() const = 0;
  virtual void add_counts(Counters& counters) const = 0;
};

}  // namespace grove::detail
