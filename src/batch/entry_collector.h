// SPDX-License-Identifier: MIT
// Collects the instances of a batch. Rejects duplicates and ids that cannot be file names.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "batch/entry.h"

namespace grove::detail::batch {

inline constexpr std::string_view kInstanceSuffix = ".cts.json";

// The id of an instance that was found in `folder`, or by a manifest in `folder`. Files below the
// output folder are named after the id, so it contains no "..". For an instance outside `folder` it
// consists only of the file's name and the name of the file's folder, because the full path would
// describe the machine rather than the instance. `agents`: number of agents of a scenario; else 0.
std::string id_of(const std::filesystem::path& path, const std::filesystem::path& folder,
                  int agents);

// Collects entries. Rejects duplicates and unsuitable ids. Does not validate instances.
class EntryCollector {
 public:
  // `source`: the manifest or the folder, for error messages.
  EntryCollector(std::filesystem::path source, const InputRules& rules)
      : source_(std::move(source)), rules_(rules) {}

  // Adds an entry and computes its digest. `place`: the origin of the entry for error messages: a
  // line of a manifest, or a file in a folder. Throws InputError if the id is unsuitable as a file
  // name, or if the instance or its id is already present.
  void add(Entry entry, const std::string& place);
  std::vector<Entry> take();

 private:
  using Places = std::map<std::string, std::string>;

  void require_new(Places& places, const std::string& key, const std::string& place,
                   const std::string& what) const;

  const std::filesystem::path source_;
  const InputRules rules_;  // for all entries
  std::vector<Entry> entries_;
  Places files_;
  Places ids_;
};

}  // namespace grove::detail::batch
