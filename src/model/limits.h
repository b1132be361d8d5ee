// SPDX-License-Identifier: MIT
// When to stop working: the only clock, the only memory gauge and the only interrupt that the
// layers below the engine ever look at.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <utility>

namespace grove::detail {

enum class StopReason : std::uint8_t { kNone, kTime, kMemory, kInterrupt };

// The memory this process holds, in bytes (its resident set). 0 where the system does not tell.
std::size_t resident_bytes();
// The most it has held since it began. (Not getrusage's ru_maxrss, which a parent hands down.)
// What is shared counts in full.
std::size_t peak_resident_bytes();
// So many processes share so many bytes. From now on resident_bytes() counts its part of these,
// whoever has touched them, and of files, in place of what this process has touched of both. 1, 0:
// nothing is shared, as in the beginning.
void set_shared_memory_accounting(int processes, std::size_t bytes);

// Limits on a run. One object per run, shared by reference; every method may be called from any
// thread. Once stopped it stays stopped, with the first reason.
class Limits {
 public:
  using Clock = std::chrono::steady_clock;

  // No limit at all.
  Limits() = default;
  // Of a part of a run that may take so many seconds from now on: stops then, and when `whole`
  // does, which must outlive this. Not limited further.
  Limits(const Limits& whole, double seconds);

  // Takes the time from `clock` in place of the system. Called before any thread uses these limits;
  // `clock` must be thread-safe.
  void set_clock(std::function<Clock::time_point()> clock) { clock_ = std::move(clock); }
  // The clock of the run, for everything below that measures time.
  Clock::time_point now() const {
    return whole_ ? whole_->now() : clock_ ? clock_() : Clock::now();
  }

  void set_deadline(Clock::time_point deadline) { deadline_ = deadline; }
  void set_memory_limit(std::size_t bytes) { memory_limit_ = bytes; }
  // A flag that a signal handler may set; must outlive this object.
  void watch_interrupt(const std::atomic<bool>* flag) { interrupt_ = flag; }

  // True once a limit was hit. Costs one clock reading (about 30 ns), and a look at the memory
  // every few milliseconds: call it at least once a millisecond of work.
  bool stop_requested() const;
  StopReason reason() const { return reason_.load(std::memory_order_relaxed); }

  // Seconds until the deadline; negative once past, infinity without one.
  double seconds_left() const;
  // May `bytes` more be allocated? Ask before large tables. Does not stop the run.
  bool memory_allows(std::size_t bytes) const;
  // None: memory is not limited.
  std::optional<std::size_t> memory_limit() const {
    return whole_ ? whole_->memory_limit() : memory_limit_;
  }
  // The resident set when stop_requested() last looked at it; 0 before that, or without a limit.
  std::size_t last_resident() const {
    return whole_ ? whole_->last_resident() : last_resident_.load(std::memory_order_relaxed);
  }
  // Ends all work of the run, which has reached its end: stop_requested() is true from now on, and
  // reason() what it was.
  void cancel_workers() const { finished_.store(true, std::memory_order_relaxed); }
  // Takes cancel_workers() back, when all work has ended.
  void clear_cancel() const { finished_.store(false, std::memory_order_relaxed); }
  // Stops the run for a reason that was found elsewhere.
  void stop(StopReason reason) const;
  // For allocations refused elsewhere: stops the run for lack of memory.
  void memory_exhausted() const { stop(StopReason::kMemory); }

 private:
  const Limits* whole_ = nullptr;
  std::function<Clock::time_point()> clock_;  // empty: that of the system
  std::optional<Clock::time_point> deadline_;
  std::optional<std::size_t> memory_limit_;
  const std::atomic<bool>* interrupt_ = nullptr;
  mutable std::atomic<bool> finished_{false};
  mutable std::atomic<StopReason> reason_{StopReason::kNone};
  mutable std::atomic<Clock::rep> next_memory_look_{0};
  mutable std::atomic<std::size_t> last_resident_{0};
};

}  // namespace grove::detail
