// SPDX-License-Identifier: MIT
// Writes the incumbents of a run to files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "engine/run_observer.h"
#include "model/instance.h"
#include "model/omega.h"
#include "tools/solve/disk_flusher.h"

namespace grove::detail {

// Writes the k-th incumbent of a run to PREFIX-<k>.plan.json and each incumbent to the file `best`,
// which it replaces atomically. Forwards all events to the observer `next`. An incumbent is in its
// files before `next` receives it, so it survives the end of the process. A background thread then
// flushes the files to disk, so that they survive a crash of the machine; the search does not wait
// for it, because incumbents can come in quick succession. The destructor waits for all flushes.
// After the first file that cannot be written, which it reports on standard error, it writes no
// more files.
class IncumbentFiles : public ForwardingObserver {
 public:
  // If `prefix` is "", it writes no numbered files; if `best` is "", no file with the best plan.
  // `instance` and `next` must outlive this object.
  IncumbentFiles(std::string prefix, std::filesystem::path best, const Instance& instance,
                 Omega omega, RunObserver& next)
      : ForwardingObserver(next),
        prefix_(std::move(prefix)),
        best_(std::move(best)),
        instance_(instance),
        omega_(omega) {}

  // Returns the file for the k-th incumbent, k >= 1.
  static std::filesystem::path file(const std::string& prefix, int k);
  // Removes the files of an earlier run with this prefix: those numbered from 1 without a gap.
  static void remove_old(const std::string& prefix);
  // Returns whether `path` is PREFIX-<k>.plan.json for some k. A different file of the run must not
  // have such a path.
  static bool matches_name(const std::string& prefix, const std::filesystem::path& path);

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
  std::optional<DiskFlusher> flusher_;  // created when the first incumbent is written
};

}  // namespace grove::detail
