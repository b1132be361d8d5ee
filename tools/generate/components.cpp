// SPDX-License-Identifier: MIT
#include "tools/generate/components.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace grove::detail {
namespace {

void flood(const Grid& grid, Cell first, int label, std::vector<int>& labels) {
  std::vector<Cell> stack{first};
  labels[first] = label;
  while (!stack.empty()) {
    const Cell cell = stack.back();
    stack.pop_back();
    for (Cell next : grid.neighbors(cell)) {
      if (labels[next] >= 0) continue;
      labels[next] = label;
      stack.push_back(next);
    }
  }
}

using Neighbors = std::vector<std::vector<int>>;  // by vertex

// Appends to `visited` the unseen vertices that are reachable from `from`, in depth-first
// postorder, and marks them as seen.
void visit_after_next(const Neighbors& next, int from, std::vector<bool>& seen,
                      std::vector<int>& visited) {
  std::vector<std::pair<int, std::size_t>> stack{
      {from, 0}};  // vertex and number of its neighbours already visited
  seen[from] = true;
  while (!stack.empty()) {
    auto& [here, done] = stack.back();
    if (done == next[here].size()) {
      visited.push_back(here);
      stack.pop_back();
      continue;
    }
    const int to = next[here][done++];
    if (seen[to]) continue;
    seen[to] = true;
    stack.emplace_back(to, 0);
  }
}

}  // namespace

std::vector<int> components(const Grid& grid) {
  std::vector<int> labels(grid.cell_count(), -1);
  int count = 0;
  for (Cell cell = 0; cell < grid.cell_count(); ++cell)
    if (grid.passable(cell) && labels[cell] < 0) flood(grid, cell, count++, labels);
  return labels;
}

std::vector<Cell> largest_component(const Grid& grid) {
  const std::vector<int> labels = components(grid);
  std::vector<int> sizes(labels.empty() ? 1 : *std::ranges::max_element(labels) + 2);
  for (int label : labels)
    if (label >= 0) ++sizes[label];
  const auto largest = static_cast<int>(std::ranges::max_element(sizes) - sizes.begin());
  std::vector<Cell> cells;
  for (Cell cell = 0; cell < grid.cell_count(); ++cell)
    if (labels[cell] == largest) cells.push_back(cell);
  return cells;
}

// Kosaraju's algorithm: a depth-first search along the roads, then depth-first searches against the
// roads that start from the vertices in reverse postorder of the first search.
std::vector<int> largest_strong_component(const Roadmap& roadmap) {
  const std::size_t count = roadmap.vertices().size();
  Neighbors next(count);
  Neighbors before(count);
  const auto add = [&](int from, int to) {
    next[from].push_back(to);
    before[to].push_back(from);
  };
  for (const Road& road : roadmap.roads()) {
    add(road.from, road.to);
    if (!road.one_way) add(road.to, road.from);
  }
  std::vector<int> order;
  std::vector<bool> seen(count);
  for (std::size_t v = 0; v < count; ++v)
    if (!seen[v]) visit_after_next(next, static_cast<int>(v), seen, order);
  seen.assign(count, false);
  std::vector<int> largest;
  for (auto v = order.rbegin(); v != order.rend(); ++v) {
    if (seen[*v]) continue;
    std::vector<int> part;
    visit_after_next(before, *v, seen, part);
    std::ranges::sort(part);
    if (part.size() > largest.size() || (part.size() == largest.size() && part < largest))
      largest = std::move(part);
  }
  return largest;
}

}  // namespace grove::detail
