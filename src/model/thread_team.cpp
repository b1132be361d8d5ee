// SPDX-License-Identifier: MIT
#include "model/thread_team.h"

#include <system_error>
#include <utility>

#include "model/assert.h"

namespace grove::detail {

ThreadTeam::ThreadTeam(int threads) {
  try {
    for (int i = 1; i < threads; ++i) others_.emplace_back([this, i] { serve(i); });
  } catch (const std::system_error&) {  // the team consists of the threads that were created
  }
}

ThreadTeam::~ThreadTeam() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  begun_.notify_all();
  for (std::thread& thread : others_) thread.join();
}

void ThreadTeam::run(const std::function<void(int thread)>& work) {
  {
    const std::lock_guard lock(mutex_);
    GROVE_CHECK(busy_ == 0 && !closed_, "a team performs one piece of work at a time");
    work_ = &work;
    busy_ = static_cast<int>(others_.size());
    ++round_;
  }
  begun_.notify_all();
  perform(work, 0);
  std::unique_lock lock(mutex_);
  ended_.wait(lock, [this] { return busy_ == 0; });
  if (auto thrown = std::exchange(thrown_, nullptr)) std::rethrow_exception(thrown);
}

void ThreadTeam::serve(int thread) {
  std::unique_lock lock(mutex_);
  for (int done = 0;; ++done) {
    begun_.wait(lock, [&] { return closed_ || round_ > done; });
    if (closed_) return;
    const auto& work = *work_;
    lock.unlock();
    perform(work, thread);
    lock.lock();
    if (--busy_ == 0) ended_.notify_one();
  }
}

void ThreadTeam::perform(const std::function<void(int thread)>& work, int thread) {
  try {
    work(thread);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    thrown_ = std::current_exception();
  }
}

}  // namespace grove::detail
