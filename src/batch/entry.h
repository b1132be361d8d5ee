// SPDX-License-Identifier: MIT
// An instance of a batch: its id, the paths of its files, and its digest.
#pragma once

#include <string>

#include "io/instance_file.h"
#include "model/instance.h"

namespace grove::detail::batch {

// An instance of a batch. Relative paths are relative to the working directory.
struct Entry {
  // Unique in its batch; part of the names of the instance's files. A printable relative path
  // without a suffix.
  std::string id;
  std::string path;         // FILE.cts.json; or FILE.scen, with `map` and `agents`
  std::string map = {};     // of a .scen file; else empty
  int agents = 0;           // number of rows of a .scen file to use; else 0
  InputRules rules = {};    // rules for reading the instance
  std::string digest = {};  // instance_digest(); empty: the instance cannot be read

  friend bool operator==(const Entry&, const Entry&) = default;
};

// Reads the instance of `entry`. Throws InputError.
LoadedInstance load(const Entry& entry);

// Digest that shows whether an instance has changed since it was solved: a 64-bit hash, as
// hexadecimal digits, of fingerprint() and of the ids of agents and tasks, which plans refer to. It
// does not depend on the location and layout of the files. It detects changes but not deliberate
// collisions (FNV-1a).
std::string instance_digest(const Instance& instance);

}  // namespace grove::detail::batch
