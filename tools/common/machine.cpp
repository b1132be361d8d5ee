// SPDX-License-Identifier: MIT
#include "tools/common/machine.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/utsname.h>

#include <fstream>
#include <thread>

#include "grove/solve.hpp"
#include "model/resources.h"

namespace grove::detail {

double usable_memory_gb() {
  return static_cast<double>(usable_memory()) / 1e9;
}

double default_memory_gb() {
  return static_cast<double>(default_memory_limit()) / 1e9;
}

std::string usable_cores_text() {
  cpu_set_t cores;
  if (::sched_getaffinity(0, sizeof cores, &cores) != 0) return "unknown";
  std::string text;
  for (int core = 0; core < CPU_SETSIZE; ++core)
    if (CPU_ISSET(core, &cores)) text += fmt::format(" {}", core);
  return text;
}

std::string machine_text() {
  utsname name{};
  ::uname(&name);
  const double usable = usable_memory_gb();
  const double physical = static_cast<double>(physical_memory()) / 1e9;
  return fmt::format("{} {} {}, {} cores, {:.1f} GB{}", name.nodename, name.sysname, name.machine,
                     std::thread::hardware_concurrency(), physical,
                     usable < physical ? fmt::format(", {:.1f} GB of them granted", usable) : "");
}

std::string processor_text() {
  utsname name{};
  ::uname(&name);
  std::string model = name.machine;
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (!line.starts_with("model name") || colon == std::string::npos) continue;
    model = line.substr(colon + 2);
    break;
  }
  return fmt::format("{}, {} cores", model, std::thread::hardware_concurrency());
}

}  // namespace grove::detail
