// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <set>
#include <thread>

namespace grove::detail {

// A background thread that flushes files to disk (fsync), so that they survive a crash of the
// machine. The caller does not wait for a flush, which can take seconds. The destructor waits for
// all flushes. The first failure is reported on standard error.
class DiskFlusher {
 public:
  DiskFlusher() : thread_([this] { run(); }) {}
  ~DiskFlusher();
  DiskFlusher(const DiskFlusher&) = delete;
  DiskFlusher& operator=(const DiskFlusher&) = delete;

  // Requests a flush of `file` and returns immediately. Thread-safe.
  void flush(const std::filesystem::path& file);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable wake_;
  std::set<std::filesystem::path> waiting_;
  bool stopping_ = false;
  std::thread thread_;  // last member, because the thread uses the other members
};

}  // namespace grove::detail
