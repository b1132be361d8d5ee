// SPDX-License-Identifier: MIT
#include "tools/generate/components.h"

#include <algorithm>

namespace grove {
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

}  // namespace grove
