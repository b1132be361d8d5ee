// SPDX-License-Identifier: MIT
// A problem whose large arrays are shared by the ranks on one host.
#pragma once

#include <cstddef>
#include <optional>

#include "model/shared_arrays.h"
#include "mpi/shared_memory.h"
#include "planning/problem.h"

namespace grove::detail {

class SharedProblem {
 public:
  // Size of the shared memory in bytes, and the number of its first bytes that must be zero. Equal
  // on all ranks; 0 for small problems.
  struct Need {
    std::size_t bytes = 0;
    std::size_t zero_bytes = 0;
  };
  static Need need(const Instance& instance);

  // Builds the problem of `instance`. Each of the ranks that share `memory` builds a part of the
  // arrays, with `threads` threads. If `memory` is empty, each rank builds all arrays itself.
  // `instance` and `memory` must outlive this object. A process must not have two objects of this
  // class at the same time.
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
