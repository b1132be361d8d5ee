// SPDX-License-Identifier: MIT
#include "batch/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <system_error>

#include "batch/entry_collector.h"
#include "io/input_error.h"
#include "io/text_file.h"
#include "model/parse_number.h"

namespace grove::detail::batch {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxAgents = 1'000'000;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

Entry plain_entry(const fs::path& path, const fs::path& folder) {
  Entry entry;
  entry.id = id_of(path, folder, 0);
  entry.path = path.string();
  return entry;
}

// --- folders ---

std::vector<Entry> read_folder(const fs::path& folder, const InputRules& rules) {
  std::vector<fs::path> paths;
  try {
    for (const auto& item : fs::recursive_directory_iterator(folder))
      if (item.path().string().ends_with(kInstanceSuffix) && item.is_regular_file())
        paths.push_back(item.path());
  } catch (const fs::filesystem_error& error) {
    throw InputError(error.path1().empty() ? folder.string() : error.path1().string(), "",
                     "cannot be read: " + error.code().message());
  }
  if (paths.empty())
    throw InputError(folder.string(), "",
                     "has no instance; expected *.cts.json files in it or below");
  std::ranges::sort(paths);
  EntryCollector collector(folder, rules);
  for (const fs::path& path : paths)
    collector.add(plain_entry(path, folder), path.lexically_relative(folder).string());
  return collector.take();
}

// --- manifests ---

class ManifestReader {
 public:
  ManifestReader(const fs::path& path, const InputRules& rules)
      : path_(path), folder_(path.parent_path()), collector_(path, rules) {}

  std::vector<Entry> read() {
    const std::string text = read_text(path_);
    for (const std::string_view line : split_lines(text)) {
      place_ = fmt::format("line {}", ++line_);
      if (const std::string_view item = trimmed(line); !item.empty() && item.front() != '#')
        collector_.add(entry_of(item), place_);
    }
    std::vector<Entry> entries = collector_.take();
    if (entries.empty())
      throw InputError(path_.string(), "", "has no instance; expected one path per line");
    return entries;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(path_.string(), place_, message);
  }

  Entry entry_of(std::string_view item) const {
    if (item.ends_with(".scen") || item.find(".scen ") != std::string_view::npos)
      return scenario_entry(item);
    if (item.ends_with(".map"))
      fail(fmt::format("{} is a map; expected an instance, FILE.cts.json", item));
    return plain_entry(existing(item), folder_);
  }

  // FILE.scen --map FILE.map --agents K. File names may contain blanks.
  Entry scenario_entry(std::string_view item) const {
    constexpr std::string_view kMap = " --map ";
    constexpr std::string_view kAgents = " --agents ";
    const std::size_t map = item.find(kMap);
    const std::size_t map_name = map + kMap.size();
    const std::size_t agents = item.find(kAgents, map);
    if (map == std::string_view::npos || agents == std::string_view::npos || agents < map_name)
      fail(fmt::format("found '{}'; expected FILE.scen --map FILE.map --agents K", one_line(item)));
    Entry entry;
    entry.path = existing(trimmed(item.substr(0, map)));
    entry.map = existing(trimmed(item.substr(map_name, agents - map_name)));
    entry.agents = agent_count(trimmed(item.substr(agents + kAgents.size())));
    entry.id = id_of(entry.path, folder_, entry.agents);
    return entry;
  }

  int agent_count(std::string_view text) const {
    const auto count = parse_number(text, 1, kMaxAgents);
    if (!count)
      fail(fmt::format("found '{}'; expected a number of agents from 1 to {}", one_line(text),
                       kMaxAgents));
    return *count;
  }

  std::string existing(std::string_view name) const {
    const fs::path path = folder_ / fs::path(name);
    std::error_code error;
    if (name.empty() || !fs::exists(path, error) || fs::is_directory(path, error))
      fail(fmt::format("there is no file {}; expected a path relative to the manifest",
                       path.string()));
    return path.string();
  }

  const fs::path path_;
  const fs::path folder_;
  EntryCollector collector_;
  int line_ = 0;
  std::string place_;
};

}  // namespace

std::vector<Entry> read_manifest(const fs::path& manifest_or_folder, const InputRules& rules) {
  std::error_code error;
  if (fs::is_directory(manifest_or_folder, error)) return read_folder(manifest_or_folder, rules);
  if (manifest_or_folder.string().ends_with(kInstanceSuffix) && fs::exists(manifest_or_folder)) {
    EntryCollector collector(manifest_or_folder, rules);
    collector.add(plain_entry(manifest_or_folder, manifest_or_folder.parent_path()), "");
    return collector.take();
  }
  for (const std::string_view suffix : {".json", ".scen", ".map"})
    if (manifest_or_folder.string().ends_with(suffix))
      throw InputError(manifest_or_folder.string(), "",
                       "is not a manifest; expected a folder, or a text file with the path of an "
                       "instance on each line");
  return ManifestReader(manifest_or_folder, rules).read();
}

}  // namespace grove::detail::batch
