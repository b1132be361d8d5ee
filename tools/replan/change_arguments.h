// SPDX-License-Identifier: MIT
// Command-line options for changes to an instance during the execution of its plan.
#pragma once

#include <string>
#include <vector>

#include "execution/change.h"
#include "execution/delay.h"
#include "io/change_file.h"

namespace grove::detail {

// Values of the command-line options.
struct ChangeArguments {
  std::vector<std::string> late;       // ROBOT=STEPS
  std::vector<std::string> new_tasks;  // files of new tasks
  std::vector<std::string> dropped;    // ids of tasks
  std::vector<std::string> blocked;    // cell X,Y; on a roadmap vertex A or road A,B
};

// Returns the delays of the late robots. Throws CLI::ValidationError, which names the option and
// its value.
std::vector<Delay> late_robots(const ChangeArguments& arguments, const Instance& instance);

// The requested change, with the option or file from which each part comes.
class RequestedChange {
 public:
  // `instance` is the instance to change. Throws CLI::ValidationError for bad values, and
  // InputError for bad files.
  RequestedChange(const ChangeArguments& arguments, const Instance& instance);

  const InstanceChange& change() const { return change_; }
  // Hints on the files with new tasks, one line each.
  const std::vector<std::string>& hints() const { return hints_; }
  // Rethrows `error`, which apply() threw, as an error in the option or file that requested the
  // refused part.
  [[noreturn]] void refuse(const InstanceError& error) const;

 private:
  void read_new_tasks(const std::string& file, const Instance& instance);
  void block(const std::string& text, const Instance& instance);
  void block_on_roadmap(const std::string& text, const Roadmap& roadmap);

  InstanceChange change_;
  std::vector<std::string> hints_;
  struct Source {
    std::string where;  // name of the file or option
    std::string what;   // place in the file, or value of the option
  };
  std::vector<Source> new_tasks_, dropped_, blocked_, closed_roads_;  // same order as in the change
};

}  // namespace grove::detail
