// SPDX-License-Identifier: MIT
// One instance of a batch.
#pragma once

#include <string>

#include "io/instance_file.h"

namespace grove::detail::batch {

// Where to find an instance, and what to call it. Paths lead there from the working directory.
struct Entry {
  // Unique in its batch; names the instance's files. A relative path without a suffix, printable.
  std::string id;
  std::string path;         // FILE.cts.json, or FILE.scen with the two below
  std::string map = {};     // of a .scen file; else empty
  int agents = 0;           // the first so many rows of a .scen file; else 0
  InputRules rules = {};    // by which it is to be read
  std::string digest = {};  // instance_digest(); empty: the instance cannot be read

  friend bool operator==(const Entry&, const Entry&) = default;
};

// The instance that `entry` names. Throws InputError.
LoadedInstance load(const Entry& entry);

}  // namespace grove::detail::batch
