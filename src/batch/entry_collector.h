// SPDX-License-Identifier: MIT
// The instances of a batch, as they are found.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "batch/entry.h"

namespace grove::detail::batch {

inline constexpr std::string_view kInstanceSuffix = ".cts.json";

// What an instance is called that is found in, or by a manifest of, `folder`. No upward steps: what
// names files below the output folder must stay there. Of an instance that lies elsewhere the file
// and the folder it is in, and not the whole way there, which says more of the machine than of the
// instance. `agents`: of a scenario; else 0.
std::string id_of(const std::filesystem::path& path, const std::filesystem::path& folder,
                  int agents);

// Collects entries and refuses what must not be.
class EntryCollector {
 public:
  // `source`: the manifest or the folder, for messages.
  EntryCollector(std::filesystem::path source, const InputRules& rules)
      : source_(std::move(source)), rules_(rules) {}

  // `place` is where the entry comes from: a line of a manifest, or a file of a folder. Works out
  // its digest. Throws InputError.
  void add(Entry entry, const std::string& place);
  std::vector<Entry> take() { return std::move(entries_); }

 private:
  using Places = std::map<std::string, std::string>;

  void require_new(Places& places, const std::string& key, const std::string& place,
                   const std::string& what) const;

  const std::filesystem::path source_;
  const InputRules rules_;  // of all entries
  std::vector<Entry> entries_;
  Places files_;
  Places ids_;
};

}  // namespace grove::detail::batch
