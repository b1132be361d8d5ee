// SPDX-License-Identifier: MIT
// The memory and the cores that this process may use.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

namespace grove::detail {

// The physical memory of this machine, in bytes.
std::uint64_t physical_memory();
// The minimum of physical_memory() and job_memory_limit(), in bytes.
std::uint64_t usable_memory();
// The number of logical cores in the CPU affinity mask of this process; 1 if the system does not
// report it.
int usable_cores();

// Returns the value of an environment variable; nullptr if it is not set.
using Environment = std::function<const char*(const char* name)>;

// The memory limit in bytes of the batch job or container of this process, on this host: the
// minimum of the limits of its control group (version 1 or 2), of the parent groups, and of its
// Slurm job (SLURM_MEM_PER_NODE, or SLURM_MEM_PER_CPU times SLURM_CPUS_ON_NODE). All processes of
// the job or container together must not exceed it, or the system throttles or kills them. Returns
// nullopt if there is no limit. Reads /proc/self/cgroup and files below /sys/fs/cgroup, where
// `root` stands for "/".
std::optional<std::uint64_t> job_memory_limit(const std::filesystem::path& root,
                                              const Environment& environment);
// The limit of this process: root "/" and the real environment.
std::optional<std::uint64_t> job_memory_limit();

}  // namespace grove::detail
