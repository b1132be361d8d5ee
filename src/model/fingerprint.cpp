// SPDX-License-Identifier: MIT
// Fowler-Noll-Vo, variant 1a, over numbers of 8 bytes, low bytes first.
#include "grove/model/fingerprint.h"

namespace grove {
namespace {

class Fnv1a {
 public:
  void add(std::int64_t number) {
    for (int byte = 0; byte < 8; ++byte) {
      hash_ ^= static_cast<std::uint64_t>(number) >> (8 * byte) & 0xFF;
      hash_ *= 0x100000001B3;
    }
  }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325;
};

}  // namespace

std::uint64_t fingerprint(const Instance& instance) {
  const Grid& grid = instance.grid();
  Fnv1a hash;
  hash.add(grid.width());
  hash.add(grid.height());
  for (Cell cell = 0; cell < grid.cell_count(); ++cell) hash.add(grid.passable(cell) ? 1 : 0);
  hash.add(instance.task_count());
  for (const Task& task : instance.tasks()) hash.add(task.cell);
  hash.add(instance.agent_count());
  for (const Agent& agent : instance.agents()) {
    hash.add(agent.start);
    hash.add(agent.goal.value_or(kNoCell));
    hash.add(static_cast<std::int64_t>(agent.tasks.size()));
    for (const TaskIndex task : agent.tasks) hash.add(task);
  }
  return hash.hash();
}

}  // namespace grove
