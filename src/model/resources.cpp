// SPDX-License-Identifier: MIT
#include "model/resources.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>

#include "model/job_memory_limit.h"

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

}  // namespace grove::detail
