// SPDX-License-Identifier: MIT
// A fixed team of threads, which runs a function on all of its threads at once.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace grove::detail {

// Only the thread that constructed the team may use it.
class ThreadTeam {
 public:
  // `threads` >= 1 includes the caller's thread. If the system grants fewer threads, the team is
  // smaller.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int size() const { return static_cast<int>(others_.size()) + 1; }

  // Calls work(i) on each thread i of the team, where the caller's thread has number 0. Returns
  // when all calls have returned. If calls threw exceptions, rethrows one of these exceptions.
  void run(const std::function<void(int thread)>& work);

 private:
  void serve(int thread);
  void perform(const std::function<void(int thread)>& work, int thread);

  std::mutex mutex_;  // guards all members below except others_
  std::condition_variable begun_;
  std::condition_variable ended_;
  const std::function<void(int thread)>* work_ = nullptr;
  int round_ = 0;  // number of calls of run()
  int busy_ = 0;   // number of other threads that have not finished this round
  bool closed_ = false;
  std::exception_ptr thrown_;
  std::vector<std::thread> others_;
};

}  // namespace grove::detail
