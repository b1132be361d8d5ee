// SPDX-License-Identifier: MIT
#include "batch/entry.h"

#include <fmt/format.h>

#include <cstdint>
#include <string_view>

#include "model/fingerprint.h"

namespace grove::detail::batch {

LoadedInstance load(const Entry& entry) {
  return entry.agents > 0 ? read_scenario_instance(entry.path, entry.map, entry.agents, entry.rules)
                          : read_instance(entry.path, entry.rules);
}

namespace {

constexpr std::uint64_t kPrime = 0x100000001b3;

// Continues the hash with `text` and a zero byte.
std::uint64_t extended(std::uint64_t hash, std::string_view text) {
  for (const char byte : text) hash = (hash ^ static_cast<unsigned char>(byte)) * kPrime;
  return hash * kPrime;
}

}  // namespace

std::string instance_digest(const Instance& instance) {
  std::uint64_t hash = fingerprint(instance);
  for (const Agent& agent : instance.agents()) hash = extended(hash, agent.id);
  for (const Task& task : instance.tasks()) hash = extended(hash, task.id);
  return fmt::format("{:016x}", hash);
}

}  // namespace grove::detail::batch
