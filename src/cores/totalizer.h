// SPDX-License-Identifier: MIT
// Totalizer: clauses that count true literals (Bailleux and Boufkhad 2003), made on demand (Martins
// et al. 2014).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cores/sat_solver.h"

namespace grove::detail {

class Totalizer {
 public:
  // `inputs`: two or more. `solver` must outlive this object.
  Totalizer(SatSolver& solver, std::span<const Literal> inputs);

  // Its number in the proof.
  std::int64_t number() const { return number_; }
  std::size_t input_count() const { return nodes_.back().inputs; }
  // A literal that every assignment with at least `count` true inputs makes true. Adds its clauses
  // when called for the first time. 1 <= `count` <= input_count().
  Literal at_least(std::size_t count) { return output(nodes_.size() - 1, count); }

 private:
  struct Node {
    std::size_t left = 0;  // children; unused at inputs
    std::size_t right = 0;
    std::size_t first = 0;  // index of its first input
    std::size_t inputs = 1;
    std::vector<Literal> outputs;  // [i]: at least i + 1
  };

  Literal output(std::size_t node, std::size_t count);
  void extend(std::size_t node);
  std::size_t make(std::span<const Literal> inputs, std::size_t first);

  SatSolver& solver_;
  const std::int64_t number_;
  std::vector<Node> nodes_;  // children before parents
};

}  // namespace grove::detail
