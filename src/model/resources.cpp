// SPDX-License-Identifier: MIT
#include "model/resources.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>
#include <string_view>

#include "model/parse_number.h"

namespace grove::detail {

std::uint64_t physical_memory() {
  return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

std::uint64_t usable_memory() {
  return std::min(physical_memory(), job_memory_limit().value_or(UINT64_MAX));
}

int usable_cores() {
  cpu_set_t cores;
  if (::sched_getaffinity(0, sizeof cores, &cores) != 0) return 1;
  return std::max(1, CPU_COUNT(&cores));
}

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kUnlimited = std::uint64_t{1} << 62;  // and more: no limit (cgroup v1)

// The minimum of the limits in the files of a control group. A file may be missing or contain
// "max".
std::uint64_t limit_of(const fs::path& group) {
  std::uint64_t least = kUnlimited;
  for (const char* name : {"memory.max", "memory.high", "memory.limit_in_bytes"}) {
    std::ifstream file(group / name);
    if (std::uint64_t limit = 0; file >> limit) least = std::min(least, limit);
  }
  return least;
}

// The minimum of the limits of `folder` and of the groups on the path `group` below it. In a
// container `group` can be a path of the host, which does not exist below `folder`; then only the
// limits of `folder` count.
std::uint64_t limit_within(const fs::path& folder, std::string_view group) {
  std::uint64_t least = limit_of(folder);
  fs::path inner = folder;
  for (const fs::path& step : fs::path(group).relative_path()) {
    inner /= step;
    if (step == ".." || !fs::is_directory(inner)) break;
    least = std::min(least, limit_of(inner));
  }
  return least;
}

// True if the list `controllers`, such as "a,b,c", contains `name`.
bool lists(std::string_view controllers, std::string_view name) {
  while (!controllers.empty()) {
    const std::string_view first = controllers.substr(0, controllers.find(','));
    if (first == name) return true;
    controllers.remove_prefix(std::min(controllers.size(), first.size() + 1));
  }
  return false;
}

// The number in an environment variable. Returns nullopt if the variable is not set or is not an
// integer from 1 to 2^31 - 1.
std::optional<std::int64_t> count(const Environment& environment, const char* name) {
  const char* value = environment(name);
  if (value == nullptr) return std::nullopt;
  return parse_number<std::int64_t>(value, 1, std::numeric_limits<std::int32_t>::max());
}

// Slurm's unit is MB of 2^20 bytes. With `--mem=0` (all memory of the node) Slurm sets neither
// variable.
std::uint64_t limit_of_slurm(const Environment& environment) {
  constexpr std::uint64_t kMegabyte = std::uint64_t{1} << 20;
  std::uint64_t least = kUnlimited;
  if (const auto node = count(environment, "SLURM_MEM_PER_NODE"))
    least = static_cast<std::uint64_t>(*node) * kMegabyte;
  const auto core = count(environment, "SLURM_MEM_PER_CPU");
  const auto cores = count(environment, "SLURM_CPUS_ON_NODE");
  if (core && cores)
    least = std::min(least, static_cast<std::uint64_t>(*core * *cores) * kMegabyte);
  return least;
}

}  // namespace

std::optional<std::uint64_t> job_memory_limit() {
  return job_memory_limit("/", [](const char* name) -> const char* { return std::getenv(name); });
}

std::optional<std::uint64_t> job_memory_limit(const fs::path& root,
                                              const Environment& environment) {
  const fs::path groups = root / "sys/fs/cgroup";
  std::uint64_t least = limit_of_slurm(environment);
  std::ifstream file(root / "proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {  // "number:controllers:group"
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string_view controllers =
        std::string_view(line).substr(first + 1, second - first - 1);
    const std::string_view group = std::string_view(line).substr(second + 1);
    if (controllers.empty())
      least = std::min(least, limit_within(groups, group));
    else if (lists(controllers, "memory"))
      least = std::min(least, limit_within(groups / "memory", group));
  }
  return least < kUnlimited ? std::optional(least) : std::nullopt;
}

}  // namespace grove::detail
