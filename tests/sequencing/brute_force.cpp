// SPDX-License-Identifier: MIT
#include "brute_force.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "sequencing/cost_matrix.h"

namespace grove::detail::testing {
namespace {

std::int64_t plain_cost(const CostMatrix& matrix, const Sequence& sequence) {
  const int n = matrix.stops();
  std::int64_t cost = 0;
  int at = n;
  for (int stop : sequence) {
    cost += matrix.cost(at, stop);
    at = stop;
  }
  return cost + matrix.cost(at, n);
}

}  // namespace

bool belongs(const Sequence& sequence, const SequenceClass& work) {
  const std::size_t length = work.prefix.size();
  if (!std::equal(work.prefix.begin(), work.prefix.end(), sequence.begin())) return false;
  return length == sequence.size() || (work.forbidden_next >> sequence[length] & 1) == 0;
}

std::vector<Time> all_costs(const CostMatrix& matrix, const SequenceClass& work) {
  Sequence sequence(matrix.stops());
  std::iota(sequence.begin(), sequence.end(), Stop{0});
  std::vector<Time> costs;
  do {
    const std::int64_t cost = plain_cost(matrix, sequence);
    if (cost < kNever && belongs(sequence, work)) costs.push_back(static_cast<Time>(cost));
  } while (std::next_permutation(sequence.begin(), sequence.end()));
  std::sort(costs.begin(), costs.end());
  return costs;
}

bool is_complete(const CostMatrix& matrix, const Sequence& sequence) {
  StopSet seen = 0;
  for (Stop stop : sequence) seen |= StopSet{1} << stop;
  return std::ssize(sequence) == matrix.stops() && seen == matrix.all();
}

}  // namespace grove::detail::testing
