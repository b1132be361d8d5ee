// SPDX-License-Identifier: MIT
#include "mpi/solve_distributed.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "engine/multicore.h"
#include "engine/worker.h"
#include "mpi/polling.h"
#include "mpi/rank_process.h"
#include "search/proof_log.h"

namespace grove::detail {
namespace {

constexpr double kAccountInterval_s = 2;  // between two statistics messages, mainly for observers
constexpr double kHeartbeatInterval_s =
    0.3;  // between statistics messages of a rank that waits for its workers to end

constexpr double kMinNap_s = 1e-5;  // minimum sleep; a shorter one can hit the same poll time

void sleep(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

// The searching threads of this rank and their outcome.
class SearchThread {
 public:
  // `threads`: number of workers. `rank` must outlive this object.
  SearchThread(Rank& rank, int number, int threads)
      : components_(rank.components()), limits_(components_.context().limits) {
    for (int i = 0; i < threads; ++i)
      workers_.push_back(std::make_unique<Worker>(components_, number * threads + i));
    thread_ = std::jthread([this] { run(); });
  }
  ~SearchThread() { limits_.cancel_workers(); }

  // True once all workers have ended. Throws what a worker threw.
  bool ended() const {
    if (!ended_) return false;
    if (failure_) std::rethrow_exception(failure_);
    return true;
  }
  Counters counters() const {
    Counters counters;
    for (const auto& worker : workers_) worker->add_counts(counters);
    return counters;
  }

 private:
  void run() {
    try {
      run_parallel(workers_, components_, limits_, [] {});
    } catch (...) {
      failure_ = std::current_exception();
    }
    ended_ = true;
  }

  Components& components_;
  const Limits& limits_;
  std::vector<std::unique_ptr<Worker>> workers_;
  std::exception_ptr failure_;
  std::atomic<bool> ended_{false};
  std::jthread thread_;  // declared last, so destroyed first
};

// Time since the last message. A period in which this process did not run counts at most
// kMaxInterval_s, because messages that arrived in it have not been received yet.
class SilenceTimer {
 public:
  void update(double now, bool heard) {
    seconds_ = heard ? 0 : seconds_ + std::min(now - last_, kMaxInterval_s);
    last_ = now;
  }
  double seconds() const { return seconds_; }

 private:
  static constexpr double kMaxInterval_s = 0.1;

  double seconds_ = 0;
  double last_ = 0;
};

}  // namespace

UnresponsiveRanks::UnresponsiveRanks(Solution found, std::int64_t count)
    : std::runtime_error(fmt::format("{} ranks did not respond after a limit was reached", count)),
      solution(std::move(found)),
      ranks(count) {}

std::optional<Solution> solve_distributed(const Problem& problem, const SolveOptions& options,
                                          const Limits& limits, Transport& transport,
                                          RunObserver& observer,
                                          const std::function<void()>& poll) {
  const Limits::Clock::time_point begin = limits.now();
  RankProcess member(problem, options, limits, observer, transport);
  SearchThread searching(member.rank(), transport.rank(), options.threads);
  const double patience = options.tuning.unresponsive_timeout;
  SilenceTimer silence;
  bool sent_finished = false;
  double accounted = 0;
  double heard_at = 0;
  const auto seconds = [&] { return std::chrono::duration<double>(limits.now() - begin).count(); };
  while (!member.left()) {
    const double now = seconds();
    const bool heard = member.exchange_messages(now);
    poll();
    if (auto* coordinator = member.coordinator()) {
      const std::int64_t silent = coordinator->check_unresponsive_ranks();
      if (silent > 0) throw UnresponsiveRanks(coordinator->conclude(), silent);
    }
    const double interval = member.rank().ended() ? kHeartbeatInterval_s : kAccountInterval_s;
    if (!sent_finished && now - accounted > interval) {
      member.rank().send_statistics(searching.counters());
      accounted = now;
    }
    if (!sent_finished && searching.ended() && member.rank().ended()) {
      member.rank().send_finished(searching.counters());
      sent_finished = true;
    }
    if (heard) heard_at = now;
    silence.update(now, heard);
    if (!member.coordinator() && std::min(silence.seconds(), -limits.seconds_left()) > patience)
      throw std::runtime_error(fmt::format(
          "rank 0 has not responded for {} s after the limit; the job ends without an answer",
          patience));
    const double rested = seconds();
    const double poll_interval = max_poll_interval(member.rank().ended());
    if (!heard) sleep(next_poll(heard_at, rested + kMinNap_s, poll_interval) - rested);
  }
  if (!member.coordinator()) return std::nullopt;
  if (options.proof != nullptr) member.rank().components().log_proof(*options.proof);
  return member.coordinator()->conclude();
}

}  // namespace grove::detail
