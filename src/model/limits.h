// SPDX-License-Identifier: MIT
// Limits on a run: a deadline, a memory limit and an interrupt flag. The layers below the engine
// read the clock, the memory use and the interrupt flag only through this file.
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

// Returns the text for plan files, such as "time limit"; "" for kNone.
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

// The resident set size of this process in bytes, with shared memory counted as set by
// set_shared_memory_accounting(); 0 if the system does not report it. Thread-safe.
std::size_t resident_bytes();
// The maximum resident set size since this process started, in bytes, with shared memory counted in
// full; 0 if the system does not report it. (ru_maxrss of getrusage() is not used, because a child
// process inherits it from its parent.)
std::size_t peak_resident_bytes();
// From now on, resident_bytes() counts shared pages as max(shared pages that this process has
// touched, `bytes`) / `processes`, where `bytes` is the size of the memory that `processes`
// processes share. Shared pages include those of mapped files. The initial values are (1, 0), which
// means that nothing is shared.
void set_shared_memory_accounting(int processes, std::size_t bytes);

// Limits on a run. There is one object per run, which is passed by reference. The setters
// (set_clock(), set_deadline(), set_memory_limit(), watch_interrupt()) must be called before other
// threads use the object. All other methods are thread-safe. Once stop_requested() has found that a
// limit is reached, the object remains stopped, and reason() is the first reason.
class Limits {
 public:
  using Clock = std::chrono::steady_clock;

  // No limits.
  Limits() = default;
  // Limits on a part of a run. They are reached `seconds` seconds from now (never, if that is too
  // long for the clock), or when a limit of `whole` is reached; whole.cancel_workers() does not
  // affect them. `whole` must outlive this object. It provides the clock and the memory limit.
  Limits(const Limits& whole, double seconds);

  // Replaces the system clock by `clock`, which must be thread-safe.
  void set_clock(std::function<Clock::time_point()> clock) { clock_ = std::move(clock); }
  // The time by the run's clock. All code below the engine that measures time calls this function.
  Clock::time_point now() const {
    return whole_ ? whole_->now() : clock_ ? clock_() : Clock::now();
  }

  void set_deadline(Clock::time_point deadline) { deadline_ = deadline; }
  void set_memory_limit(std::size_t bytes) { memory_limit_ = bytes; }
  // The run stops once `*flag` is true; a signal handler may set it. `flag` must outlive this
  // object.
  void watch_interrupt(const std::atomic<bool>* flag) { interrupt_ = flag; }

  // True once a limit is reached, or after cancel_workers(). Each call reads the clock (about 30
  // ns); with a memory limit, one call every 5 ms also reads the memory use. Workers should call it
  // at least once per millisecond.
  bool stop_requested() const;
  StopReason reason() const { return reason_.load(std::memory_order_relaxed); }

  // Seconds until the deadline; negative after it, and infinity if there is none.
  double seconds_left() const;
  // True if allocating `bytes` more bytes would not exceed the memory limit. Call it before
  // allocating a large table. Does not stop the run.
  bool memory_allows(std::size_t bytes) const;
  // The memory limit in bytes. Returns nullopt if memory is not limited.
  std::optional<std::size_t> memory_limit() const {
    return whole_ ? whole_->memory_limit() : memory_limit_;
  }
  // The resident_bytes() that stop_requested() read last; 0 before the first reading, and without a
  // memory limit.
  std::size_t last_resident() const {
    return whole_ ? whole_->last_resident() : last_resident_.load(std::memory_order_relaxed);
  }
  // Makes stop_requested() true from now on, so that the workers of a run that is complete end.
  // Does not change reason().
  void cancel_workers() const { cancelled_.store(true, std::memory_order_relaxed); }
  // Reverts cancel_workers(). Call it only after all workers have ended.
  void clear_cancel() const { cancelled_.store(false, std::memory_order_relaxed); }
  // Stops the run with this reason, unless it has already stopped with another one.
  void stop(StopReason reason) const;
  // Stops the run with StopReason::kMemory. Call it after a failed allocation, or after
  // memory_allows() returned false.
  void memory_exhausted() const { stop(StopReason::kMemory); }

 private:
  const Limits* whole_ = nullptr;
  std::function<Clock::time_point()> clock_;  // empty: the system clock
  std::optional<Clock::time_point> deadline_;
  std::optional<std::size_t> memory_limit_;
  const std::atomic<bool>* interrupt_ = nullptr;
  mutable std::atomic<bool> cancelled_{false};
  mutable std::atomic<StopReason> reason_{StopReason::kNone};
  mutable std::atomic<Clock::rep> next_memory_check_{0};
  mutable std::atomic<std::size_t> last_resident_{0};
};

}  // namespace grove::detail
