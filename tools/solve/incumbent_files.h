// SPDX-License-Identifier: MIT
// Files with the incumbents of a run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/run_observer.h"
#include "model/instance.h"
#include "model/omega.h"
#include "tools/solve/disk_flusher.h"

namespace grove::detail {

// Writes the k-th plan of a run to PREFIX-<k>.plan.json and the best plan to a file of its own,
// each completely or not at all, and forwards all events to another observer. A plan is in its file
// before that observer receives it, so it survives the process. Another thread flushes it to disk
// soon after, because plans may come in quick succession and the search must not wait; then it
// survives a crash of the machine. The destructor waits for the flush. The first failure is
// reported on standard error; the run continues.
class IncumbentFiles : public ForwardingObserver {
 public:
  // If `prefix` or `best` is empty, these files are not written. `instance` and `next` must outlive
  // this.
  IncumbentFiles(std::string prefix, std::filesystem::path best, const Instance& instance,
                 Omega omega, RunObserver& next)
      : ForwardingObserver(next),
        prefix_(std::move(prefix)),
        best_(std::move(best)),
        instance_(instance),
        omega_(omega) {}

  // Returns the file of the k-th plan, k >= 1.
  static std::filesystem::path file(const std::string& prefix, int k);
  // Removes files that an earlier run with this prefix left.
  static void remove_old(const std::string& prefix);
  // Whether `path` could be one of the files; no other file of the run may have such a path.
  static bool may_be_file(const std::string& prefix, const std::filesystem::path& path);

  void on_incumbent(const Plan& plan, PlanSource source, const Progress& progress) override;

 private:
  void write(const Plan& plan, const Progress& progress);
  void write_file(const std::filesystem::path& file, const Solution& solution);

  const std::string prefix_;
  const std::filesystem::path best_;
  const Instance& instance_;
  const Omega omega_;
  int written_ = 0;
  bool failed_ = false;
  std::optional<DiskFlusher> flusher_;  // created with the first plan
};

}  // namespace grove::detail
