// SPDX-License-Identifier: MIT
// Every better plan of a run as a file of its own.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/run_observer.h"
#include "model/instance.h"
#include "model/omega.h"
#include "tools/solve/disk_flusher.h"

namespace grove::detail {

// Writes the k-th plan of a run to PREFIX-<k>.plan.json, and the best one to a file of its own,
// whole or not at all, and passes everything on to another observer; a plan is in its file before
// that one hears of it, and so outlives the process. The disk gets it soon after, from a thread of
// its own, since plans come many at a time and the search must not wait: then it outlives the
// machine. The end of this waits for the disk. A file that cannot be written is told on stderr,
// once; the run goes on.
class IncumbentFiles : public ForwardingObserver {
 public:
  // `prefix` or `best` empty: these are not written. `instance` and `next` must outlive this.
  IncumbentFiles(std::string prefix, std::filesystem::path best, const Instance& instance,
                 Omega omega, RunObserver& next)
      : ForwardingObserver(next),
        prefix_(std::move(prefix)),
        best_(std::move(best)),
        instance_(instance),
        omega_(omega) {}

  // The file of the k-th plan, from 1.
  static std::filesystem::path file(const std::string& prefix, int k);
  // Removes the files that an earlier run with this prefix left.
  static void remove_old(const std::string& prefix);
  // Could that be one of the files? Such a path must not be anything else in the run.
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
  std::optional<DiskFlusher> flusher_;  // from the first plan on
};

}  // namespace grove::detail
