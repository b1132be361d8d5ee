// SPDX-License-Identifier: MIT
#include "tools/common/machine.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>

#include "tools/common/memory_granted.h"

namespace grove::detail {

namespace {

double physical_memory_gb() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e9;
}

}  // namespace

double usable_memory_gb() {
  const auto granted = memory_granted();
  return std::min(physical_memory_gb(), granted ? static_cast<double>(*granted) / 1e9 : HUGE_VAL);
}

double default_memory_gb() {
  return std::floor(80 * usable_memory_gb()) / 100;
}

int usable_cores() {
  cpu_set_t cores;
  if (::sched_getaffinity(0, sizeof cores, &cores) != 0) return 1;
  return std::max(1, CPU_COUNT(&cores));
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
  return fmt::format(
      "{} {} {}, {} cores, {:.1f} GB{}", name.nodename, name.sysname, name.machine,
      std::thread::hardware_concurrency(), physical_memory_gb(),
      usable < physical_memory_gb() ? fmt::format(", {:.1f} GB of them granted", usable) : "");
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
