// SPDX-License-Identifier: MIT
// A node counts the true inputs below it. Output i + j + ... of a node follows from output i of its
// left child and output j of its right child. Only these implications are needed, because the
// outputs are used as upper limits.
#include "cores/totalizer.h"

#include <algorithm>

#include "model/assert.h"

namespace grove::detail {

Totalizer::Totalizer(SatSolver& solver, std::span<const Literal> inputs)
    : solver_(solver), number_(solver.log_sum(inputs)) {
  GROVE_CHECK(inputs.size() >= 2, "a totalizer counts two literals or more");
  make(inputs, 0);
}

std::size_t Totalizer::make(std::span<const Literal> inputs, std::size_t first) {
  Node node;
  node.first = first;
  node.inputs = inputs.size();
  if (inputs.size() == 1) {
    node.outputs = {inputs.front()};
  } else {
    const std::size_t half = inputs.size() / 2;
    node.left = make(inputs.first(half), first);
    node.right = make(inputs.subspan(half), first + half);
  }
  nodes_.push_back(std::move(node));
  return nodes_.size() - 1;
}

Literal Totalizer::output(std::size_t node, std::size_t count) {
  GROVE_CHECK(count >= 1 && count <= nodes_[node].inputs, "a totalizer counts its inputs");
  while (nodes_[node].outputs.size() < count) extend(node);
  return nodes_[node].outputs[count - 1];
}

// Adds the next output of a node.
void Totalizer::extend(std::size_t node) {
  const std::size_t count = nodes_[node].outputs.size() + 1;
  const auto [left, right, first, inputs, outputs] = nodes_[node];
  const Literal next =
      solver_.new_variable(FormulaKind::kCount, {number_, static_cast<std::int64_t>(first),
                                                 static_cast<std::int64_t>(first + inputs),
                                                 static_cast<std::int64_t>(count)});
  for (std::size_t i = 0; i <= std::min(count, nodes_[left].inputs); ++i) {
    const std::size_t j = count - i;
    if (j > nodes_[right].inputs) continue;
    std::vector<Literal> clause{next};
    if (i > 0) clause.push_back(-output(left, i));
    if (j > 0) clause.push_back(-output(right, j));
    solver_.add(clause);
  }
  if (!outputs.empty()) solver_.add({-next, outputs.back()});
  nodes_[node].outputs.push_back(next);
}

}  // namespace grove::detail
