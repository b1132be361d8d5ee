// SPDX-License-Identifier: MIT
// A problem of which the ranks on a host hold the large parts together.
#pragma once

#include <cstddef>
#include <optional>

#include "model/shared_arrays.h"
#include "mpi/shared_memory.h"
#include "search/problem.h"

namespace grove::detail {

class SharedProblem {
 public:
  // The memory to share, in bytes, and how many of them must be zero: the same on all ranks.
  // Nothing for small problems.
  struct Need {
    std::size_t bytes = 0;
    std::size_t zero_bytes = 0;
  };
  static Need need(const Instance& instance);

  // What all ranks that have a part in `memory` make of the same instance, each a share of it. If
  // that is none, each makes all for itself. `instance` and `memory` must outlive this. Of these
  // there is one at a time in a process.
  SharedProblem(const Instance& instance, const Limits& limits, int threads,
                const SharedMemory& memory);
  ~SharedProblem();
  SharedProblem(const SharedProblem&) = delete;
  SharedProblem& operator=(const SharedProblem&) = delete;

  const Problem& problem() const { return *problem_; }

 private:
  std::optional<SharedArrays> arrays_;
  std::optional<Problem> problem_;
};

}  // namespace grove::detail
