// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <set>
#include <thread>

namespace grove::detail {

// A thread that brings files to the disk, so that they outlive the machine, while others go on:
// that may take seconds. Its end waits until all are there. What fails is told on stderr, once.
class DiskFlusher {
 public:
  DiskFlusher() : thread_([this] { run(); }) {}
  ~DiskFlusher();
  DiskFlusher(const DiskFlusher&) = delete;
  DiskFlusher& operator=(const DiskFlusher&) = delete;

  // Returns at once. Of any thread.
  void flush(const std::filesystem::path& file);

 private:
  void run();

  std::mutex mutex_;
  std::condition_variable news_;
  std::set<std::filesystem::path> waiting_;
  bool over_ = false;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace grove::detail
