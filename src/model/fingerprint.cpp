// SPDX-License-Identifier: MIT
// The hash is FNV-1a (Fowler, Noll, Vo) over a sequence of 64-bit numbers, least significant byte
// first.
//
// For a given type of map, the sequence of numbers determines everything that the fingerprint
// covers: each list follows its length, and kOptional or kChoice, which differ from all places and
// lengths, precede data that only some tasks and agents have.
#include "model/fingerprint.h"

namespace grove::detail {
namespace {

constexpr std::int64_t kOptional = -2;
constexpr std::int64_t kChoice = -3;

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

void add(const Grid& grid, Fnv1a& hash) {
  hash.add(grid.width());
  hash.add(grid.height());
  for (Cell cell = 0; cell < grid.cell_count(); ++cell) hash.add(grid.passable(cell) ? 1 : 0);
}

void add(const Roadmap& roadmap, Fnv1a& hash) {
  hash.add(static_cast<std::int64_t>(roadmap.vertices().size()));
  hash.add(static_cast<std::int64_t>(roadmap.roads().size()));
  for (const Road& road : roadmap.roads()) {
    hash.add(road.from);
    hash.add(road.to);
    hash.add(road.steps);
    hash.add(road.one_way ? 1 : 0);
  }
}

template <typename List>
void add_list(const List& list, Fnv1a& hash) {
  hash.add(static_cast<std::int64_t>(list.size()));
  for (const auto item : list) hash.add(item);
}

}  // namespace

std::uint64_t fingerprint(const Instance& instance) {
  Fnv1a hash;
  std::visit([&](const auto& map) { add(map, hash); }, instance.map());
  hash.add(instance.task_count());
  for (const Task& task : instance.tasks()) {
    hash.add(task.cell);
    if (task.duration > 0) {
      hash.add(kOptional);
      hash.add(task.duration);
    }
    if (!task.needs_all()) {
      hash.add(kChoice);
      hash.add(task.need);
    }
  }
  hash.add(instance.agent_count());
  for (const Agent& agent : instance.agents()) {
    hash.add(agent.start);
    hash.add(agent.goal.value_or(kNoPlace));
    if (agent.motion.turn_steps > 0) {
      hash.add(kOptional);
      hash.add(agent.motion.turn_steps);
      hash.add(agent.goal_heading ? static_cast<std::int64_t>(*agent.goal_heading) : -1);
    }
    add_list(agent.tasks, hash);
    if (agent.has_choice()) {
      hash.add(kChoice);
      add_list(agent.goals, hash);
      add_list(agent.options, hash);
    }
  }
  if (!instance.may_follow()) hash.add(1);
  return hash.hash();
}

}  // namespace grove::detail
