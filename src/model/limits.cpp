// SPDX-License-Identifier: MIT
#include "model/limits.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <limits>
#include <memory>
#include <string>

namespace grove::detail {
namespace {

constexpr Limits::Clock::duration kMemoryCheckInterval = std::chrono::milliseconds(5);
constexpr double kForEver = 4e9;  // seconds; longer times could overflow the clock

// Set by set_shared_memory_accounting(): the number of processes that share memory, and the size of
// that memory.
std::atomic<std::size_t> sharers{1};
std::atomic<std::size_t> shared_bytes{0};

}  // namespace

std::size_t resident_bytes() {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen("/proc/self/statm", "r"),
                                                             &std::fclose);
  long total_pages = 0;
  long resident_pages = 0;
  long shared_pages = 0;
  if (!file ||
      std::fscanf(file.get(), "%ld %ld %ld", &total_pages, &resident_pages, &shared_pages) != 3)
    return 0;
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::size_t own = static_cast<std::size_t>(resident_pages - shared_pages) * page;
  const std::size_t shared = static_cast<std::size_t>(shared_pages) * page;
  return own + std::max(shared, shared_bytes.load(std::memory_order_relaxed)) /
                   sharers.load(std::memory_order_relaxed);
}

void set_shared_memory_accounting(int processes, std::size_t bytes) {
  sharers = static_cast<std::size_t>(processes);
  shared_bytes = bytes;
}

std::size_t peak_resident_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::stoull(line.substr(6)) * 1024;
  return 0;
}

Limits::Limits(const Limits& whole, double seconds) : whole_(&whole) {
  if (seconds < kForEver)
    deadline_ =
        now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool Limits::stop_requested() const {
  if (reason() != StopReason::kNone || cancelled_.load(std::memory_order_relaxed)) return true;
  if (whole_ && whole_->stop_requested()) stop(whole_->reason());
  if (interrupt_ && interrupt_->load(std::memory_order_relaxed)) stop(StopReason::kInterrupt);
  const Clock::time_point time = now();
  if (deadline_ && time >= *deadline_) stop(StopReason::kTime);
  if (memory_limit_ && time.time_since_epoch().count() >= next_memory_check_.load()) {
    next_memory_check_ = (time + kMemoryCheckInterval).time_since_epoch().count();
    last_resident_ = resident_bytes();
    if (last_resident_ > *memory_limit_) stop(StopReason::kMemory);
  }
  return reason() != StopReason::kNone;
}

double Limits::seconds_left() const {
  const double left = deadline_ ? std::chrono::duration<double>(*deadline_ - now()).count()
                                : std::numeric_limits<double>::infinity();
  return whole_ ? std::min(left, whole_->seconds_left()) : left;
}

bool Limits::memory_allows(std::size_t bytes) const {
  const auto limit = memory_limit();
  return !limit || resident_bytes() + bytes <= *limit;
}

void Limits::stop(StopReason reason) const {
  StopReason expected = StopReason::kNone;
  reason_.compare_exchange_strong(expected, reason);
}

}  // namespace grove::detail
