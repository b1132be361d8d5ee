// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace grove::detail {

// The bytes of memory that control groups grant to this process: the least limit of its group and
// of those around it, be they of version 1 or 2; a container or a batch system kills who needs
// more. None without a limit. Reads /proc/self/cgroup and below /sys/fs/cgroup, both under `root`.
std::optional<std::uint64_t> memory_granted(const std::filesystem::path& root = "/");

}  // namespace grove::detail
