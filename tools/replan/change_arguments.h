// SPDX-License-Identifier: MIT
// Changes of an instance during the execution of its plan, from the command line.
#pragma once

#include <string>
#include <vector>

#include "execution/change.h"
#include "execution/delay.h"
#include "io/change_file.h"

namespace grove::detail {

// Values of the options.
struct ChangeArguments {
  std::vector<std::string> late;       // ROBOT=STEPS
  std::vector<std::string> new_tasks;  // files
  std::vector<std::string> dropped;    // tasks
  std::vector<std::string> blocked;    // X,Y; or A and A,B on a roadmap
};

// Throw CLI::ValidationError, which names the option and its value, and InputError for files.
std::vector<Delay> late_robots(const ChangeArguments& arguments, const Instance& instance);

// The change, with the source of each part.
class RequestedChange {
 public:
  // `instance` is the instance to change.
  RequestedChange(const ChangeArguments& arguments, const Instance& instance);

  const InstanceChange& change() const { return change_; }
  // Rethrows an error of apply() as an error of the command line or of a file.
  [[noreturn]] void refuse(const InstanceError& error) const;

 private:
  void read_new_tasks(const std::string& file, const Instance& instance);
  void block(const std::string& text, const Instance& instance);
  void block_on_roadmap(const std::string& text, const Roadmap& roadmap);

  InstanceChange change_;
  struct Source {
    std::string where;  // file or option
    std::string what;   // place in the file, or the option's value
  };
  std::vector<Source> new_tasks_, dropped_, blocked_, closed_roads_;  // same order as in the change
};

}  // namespace grove::detail
