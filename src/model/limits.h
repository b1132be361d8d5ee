// SPDX-License-Identifier: MIT
// Limits on a run: time, memory and interrupt. The layers below the engine read the clock, the
// memory in use and the interrupt only through this file.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace grove::detail {

enum class StopReason : std::uint8_t { kNone, kTime, kMemory, kInterrupt };

// Text for plan files.
inline std::string stop_text(StopReason reason) {
  switch (reason) {
    case StopReason::kTime:
      return "time limit";
    case StopReason::kMemory:
      return "memory limit";
    case StopReason::kInterrupt:
      return "interrupt";
    case StopReason::kNone:
      break;
  }
  return "";
}

// The memory that this process holds (its resident set), in bytes; 0 if the system does not report
// it.
std::size_t resident_bytes();
// The maximum of the resident set since the process began, in bytes. (getrusage's ru_maxrss would
// include the parent's value, which a child inherits.) Shared memory counts in full.
std::size_t peak_resident_bytes();
// `processes` processes share `bytes` bytes. From now on resident_bytes() counts this process's
// part of the shared bytes and of mapped files, whichever process has touched them, in place of the
// pages of both that this process has touched. (1, 0), the initial state: nothing is shared.
void set_shared_memory_accounting(int processes, std::size_t bytes);

// Limits on a run. One object per run, shared by reference. Thread-safe, unless a method says
// otherwise. Once a limit is reached, the object stays stopped, with the first reason.
class Limits {
 public:
  using Clock = std::chrono::steady_clock;

  // No limit at all.
  Limits() = default;
  // Limits on a part of a run: stops `seconds` seconds from now, or when `whole` stops. `whole`
  // must outlive this object. The part has no memory limit or interrupt of its own.
  Limits(const Limits& whole, double seconds);

  // Reads the time from `clock` in place of the system clock. Call it before any thread uses these
  // limits. `clock` must be thread-safe.
  void set_clock(std::function<Clock::time_point()> clock) { clock_ = std::move(clock); }
  // The time of the run's clock. All code below the engine that measures time uses it.
  Clock::time_point now() const {
    return whole_ ? whole_->now() : clock_ ? clock_() : Clock::now();
  }

  void set_deadline(Clock::time_point deadline) { deadline_ = deadline; }
  void set_memory_limit(std::size_t bytes) { memory_limit_ = bytes; }
  // `flag` may be set by a signal handler. It must outlive this object.
  void watch_interrupt(const std::atomic<bool>* flag) { interrupt_ = flag; }

  // True once a limit was reached. Costs one clock reading (about 30 ns), and reads the memory use
  // every few milliseconds. Call it at least once per millisecond of work.
  bool stop_requested() const;
  StopReason reason() const { return reason_.load(std::memory_order_relaxed); }

  // Seconds until the deadline; negative once past, infinity without one.
  double seconds_left() const;
  // True if `bytes` more bytes may be allocated within the memory limit. Call it before large
  // tables are allocated. Does not stop the run.
  bool memory_allows(std::size_t bytes) const;
  // Returns nullopt if memory is not limited.
  std::optional<std::size_t> memory_limit() const {
    return whole_ ? whole_->memory_limit() : memory_limit_;
  }
  // The resident set when stop_requested() last read it, in bytes; 0 before that, or without a
  // limit.
  std::size_t last_resident() const {
    return whole_ ? whole_->last_resident() : last_resident_.load(std::memory_order_relaxed);
  }
  // Ends all work of a run that is complete: from now on stop_requested() is true. reason() does
  // not change.
  void cancel_workers() const { finished_.store(true, std::memory_order_relaxed); }
  // Reverts cancel_workers(). Call it after all work has ended.
  void clear_cancel() const { finished_.store(false, std::memory_order_relaxed); }
  // Stops the run for a reason that the caller found.
  void stop(StopReason reason) const;
  // Stops the run for lack of memory. Call it when an allocation was refused elsewhere.
  void memory_exhausted() const { stop(StopReason::kMemory); }

 private:
  const Limits* whole_ = nullptr;
  std::function<Clock::time_point()> clock_;  // empty: the system clock
  std::optional<Clock::time_point> deadline_;
  std::optional<std::size_t> memory_limit_;
  const std::atomic<bool>* interrupt_ = nullptr;
  mutable std::atomic<bool> finished_{false};
  mutable std::atomic<StopReason> reason_{StopReason::kNone};
  mutable std::atomic<Clock::rep> next_memory_look_{0};
  mutable std::atomic<std::size_t> last_resident_{0};
};

}  // namespace grove::detail
