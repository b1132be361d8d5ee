// SPDX-License-Identifier: MIT
// The resources of the machine that this process may use: memory and cores.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

namespace grove::detail {

// The memory of the machine, in bytes.
std::uint64_t physical_memory();
// The memory of the machine in bytes, or less if a container or a batch system grants less.
std::uint64_t usable_memory();
// The number of cores that this process may use, >= 1.
int usable_cores();

// The value of an environment variable; nullptr if it is not set.
using Environment = std::function<const char*(const char* name)>;

// The bytes of memory that this host grants to this process and those it shares a job or a
// container with: the least limit of its control group (version 1 or 2), of the groups around it,
// and of its Slurm job (SLURM_MEM_PER_NODE, or SLURM_MEM_PER_CPU times SLURM_CPUS_ON_NODE). Slurm
// and containers kill a process that needs more. Returns nullopt without a limit. Reads
// /proc/self/cgroup and below /sys/fs/cgroup, both under `root`.
std::optional<std::uint64_t> job_memory_limit(const std::filesystem::path& root,
                                              const Environment& environment);
// Those of this process.
std::optional<std::uint64_t> job_memory_limit();

}  // namespace grove::detail
