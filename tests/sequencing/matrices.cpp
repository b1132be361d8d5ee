// SPDX-License-Identifier: MIT
#include "matrices.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <numeric>

#include "tests/support/movingai.h"

namespace grove::detail::testing {
namespace {

int below(int bound, Random& random) {
  return static_cast<int>(random() % bound);
}

Grid random_grid(int width, int height, Random& random) {
  std::vector<bool> passable(width * height);
  for (std::size_t i = 0; i < passable.size(); ++i) passable[i] = below(5, random) != 0;
  return {width, height, passable};
}

// Returns an instance in which the agent's start, its destination and its n tasks are on distinct
// passable cells.
Instance instance_on(const Grid& grid, int n, Variant variant, Random& random, Motion motion = {},
                     Time longest_work = 0) {
  std::vector<Cell> cells;
  for (Cell cell = 0; cell < grid.cell_count(); ++cell)
    if (grid.passable(cell)) cells.push_back(cell);
  std::shuffle(cells.begin(), cells.end(), random);
  InstanceBuilder builder(grid);
  const std::string agent = "a";
  AgentSpec spec;
  spec.id = agent;
  spec.start.place = cells.at(0);
  spec.motion = motion;
  if (variant == Variant::kCts) spec.goal = cells.at(1);
  builder.add_agent(spec);
  for (int i = 0; i < n; ++i) {
    const Time duration = longest_work > 0 ? below(longest_work + 1, random) : 0;
    builder.add_task(fmt::format("t{}", i), grid.position(cells.at(i + 2)), {&agent, 1}, duration);
  }
  return std::move(builder).build();
}

CostMatrix matrix_of(const Instance& instance) {
  return cost_matrix(instance, 0, DistanceFields(instance));
}

std::optional<Grid> read_map(const std::string& name) {
  std::ifstream file(movingai_directory() / (name + ".map"));
  std::string word;
  int width = 0;
  int height = 0;
  file >> word >> word >> word >> height >> word >> width >> word;
  std::vector<bool> passable;
  for (std::string row; file >> row;)
    for (char c : row) passable.push_back(c == '.');
  if (width == 0 || height == 0) return std::nullopt;
  return Grid(width, height, passable);
}

}  // namespace

Instance random_instance(int n, Variant variant, Random& random) {
  while (true) {
    const Grid grid = random_grid(5 + below(8, random), 4 + below(6, random), random);
    if (grid.passable_count() >= n + 2) return instance_on(grid, n, variant, random);
  }
}

CostMatrix grid_matrix(int n, Variant variant, Random& random) {
  return matrix_of(random_instance(n, variant, random));
}

CostMatrix metric_matrix(int n, Variant variant, Random& random) {
  const int places = n + 2;
  CostMatrix::Matrix d(places);
  for (int i = 0; i < places; ++i)
    for (int j = 0; j <= i; ++j) d(i, j) = d(j, i) = i == j ? 0 : 1 + below(40, random);
  for (int k = 0; k < places; ++k)
    for (int i = 0; i < places; ++i)
      for (int j = 0; j < places; ++j) d(i, j) = std::min(d(i, j), d(i, k) + d(k, j));
  // In `d`, index n is the start and index n + 1 the end.
  CostMatrix matrix{CostMatrix::Matrix(n + 1)};
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j < n; ++j) matrix.cost(i, j) = d(i, j);
    matrix.cost(i, n) = variant == Variant::kMg ? 0 : d(i, n + 1);
  }
  return matrix;
}

CostMatrix wild_matrix(int n, Variant variant, Random& random) {
  CostMatrix matrix{CostMatrix::Matrix(n + 1)};
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      matrix.cost(i, j) = below(4, random) == 0 ? kNever : below(9, random);
  if (variant == Variant::kMg) fill_column(matrix, n, 0);
  return matrix;
}

CostMatrix wild_port_matrix(int n, Variant variant, Random& random) {
  constexpr int kPorts = DistanceFields::kPorts;
  CostMatrix matrix = wild_matrix(n * kPorts, variant, random);
  matrix.ports = kPorts;
  return matrix;
}

CostMatrix turning_matrix(int n, Variant variant, Random& random) {
  while (true) {
    const Grid grid = random_grid(4 + below(4, random), 4 + below(4, random), random);
    if (grid.passable_count() < n + 2) continue;
    const Motion motion{.turn_steps = 1 + below(3, random)};
    const Instance instance = instance_on(grid, n, variant, random, motion, 4);
    const CostMatrix matrix = port_matrix(instance, 0, DistanceFields(instance));
    if (matrix.ports > 1) return matrix;
  }
}

void fill_column(CostMatrix& matrix, int column, Time cost) {
  for (int row = 0; row < matrix.cost.size(); ++row) matrix.cost(row, column) = cost;
}

void scale(CostMatrix& matrix, Time factor) {
  for (int row = 0; row < matrix.cost.size(); ++row)
    for (int column = 0; column < matrix.cost.size(); ++column) matrix.cost(row, column) *= factor;
}

std::optional<CostMatrix> map_matrix(const std::string& map, int n, Variant variant,
                                     Random& random) {
  const std::optional<Grid> grid = read_map(map);
  if (!grid) return std::nullopt;
  return matrix_of(instance_on(*grid, n, variant, random));
}

SequenceClass random_class(int n, Random& random) {
  Sequence order(n);
  std::iota(order.begin(), order.end(), Stop{0});
  std::shuffle(order.begin(), order.end(), random);
  SequenceClass work;
  work.prefix.assign(order.begin(), order.begin() + below(n + 1, random));
  for (int stop = 0; stop < n; ++stop)
    if (below(3, random) == 0) work.forbidden_next |= StopSet{1} << stop;
  return work;
}

}  // namespace grove::detail::testing
