// SPDX-License-Identifier: MIT
#include "grove/detail/batch/manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <system_error>

#include "grove/detail/io/input_error.h"
#include "grove/detail/io/text_file.h"
#include "grove/detail/model/parse_number.h"
#include "instance_digest.h"

namespace grove::detail::batch {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSuffix = ".cts.json";
constexpr int kMostAgents = 1'000'000;

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string without_suffix(std::string name) {
  for (const std::string_view suffix :
       {kSuffix, std::string_view(".json"), std::string_view(".scen")})
    if (name.ends_with(suffix)) return name.substr(0, name.size() - suffix.size());
  return name;
}

// No upward steps: what names files below the output folder must stay there. Of an instance that
// lies elsewhere the file and the folder it is in, and not the whole way there, which says more of
// the machine than of the instance.
std::string id_of(const fs::path& path, const fs::path& folder, int agents) {
  const fs::path base = folder.empty() ? fs::current_path() : fs::absolute(folder);
  const fs::path seen =
      fs::absolute(path).lexically_normal().lexically_relative(base.lexically_normal());
  fs::path inside = seen;
  if (*seen.begin() == "..") {
    const fs::path in = seen.parent_path().filename();
    inside = (in == ".." ? fs::path() : in) / seen.filename();
  }
  return without_suffix(inside.generic_string()) + (agents > 0 ? fmt::format("-{}", agents) : "");
}

Entry plain_entry(const fs::path& path, const fs::path& folder) {
  Entry entry;
  entry.id = id_of(path, folder, 0);
  entry.path = path.string();
  return entry;
}

// What is wrong with an instance is for its own row to tell.
std::string digest_of(const Entry& entry) {
  try {
    return instance_digest(load(entry).instance);
  } catch (const InputError&) {
    return "";
  }
}

// Collects entries and refuses what must not be.
class Collector {
 public:
  // `source`: the manifest or the folder, for messages.
  explicit Collector(const fs::path& source) : source_(source) {}

  // `place` is where the entry comes from: a line of a manifest, or a file of a folder.
  void add(Entry entry, const std::string& place) {
    if (one_line(entry.id) != entry.id || entry.id.empty())
      throw InputError(source_.string(), place,
                       "the path cannot name files; expected printable UTF-8, at most 400 bytes");
    std::error_code error;
    const fs::path file = fs::weakly_canonical(entry.path, error);
    require_new(files_, fmt::format("{} {}", file.string(), entry.agents), place,
                "is the same instance as");
    require_new(ids_, entry.id, place, fmt::format("names its files '{}', as does", entry.id));
    entry.digest = digest_of(entry);
    entries_.push_back(std::move(entry));
  }

  std::vector<Entry> take() { return std::move(entries_); }

 private:
  using Places = std::map<std::string, std::string>;

  void require_new(Places& places, const std::string& key, const std::string& place,
                   const std::string& what) const {
    const auto [first, is_new] = places.try_emplace(key, place);
    if (is_new) return;
    throw InputError(source_.string(), place,
                     fmt::format("{} {}; expected each instance once, under a name of its own",
                                 what, first->second));
  }

  const fs::path source_;
  std::vector<Entry> entries_;
  Places files_;
  Places ids_;
};

// --- folders ---

std::vector<Entry> read_folder(const fs::path& folder) {
  std::vector<fs::path> paths;
  try {
    for (const auto& item : fs::recursive_directory_iterator(folder))
      if (item.path().string().ends_with(kSuffix) && item.is_regular_file())
        paths.push_back(item.path());
  } catch (const fs::filesystem_error& error) {
    throw InputError(error.path1().empty() ? folder.string() : error.path1().string(), "",
                     "cannot be read: " + error.code().message());
  }
  if (paths.empty())
    throw InputError(folder.string(), "",
                     "holds no instance; expected *.cts.json files in it or below");
  std::ranges::sort(paths);
  Collector collector(folder);
  for (const fs::path& path : paths)
    collector.add(plain_entry(path, folder), path.lexically_relative(folder).string());
  return collector.take();
}

// --- manifests ---

class ManifestReader {
 public:
  explicit ManifestReader(const fs::path& path)
      : path_(path), folder_(path.parent_path()), collector_(path) {}

  std::vector<Entry> read() {
    const std::string text = read_text(path_);
    for (const std::string_view line : split_lines(text)) {
      place_ = fmt::format("line {}", ++line_);
      if (const std::string_view item = trimmed(line); !item.empty() && item.front() != '#')
        collector_.add(entry_of(item), place_);
    }
    std::vector<Entry> entries = collector_.take();
    if (entries.empty())
      throw InputError(path_.string(), "", "lists no instance; expected one path per line");
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

  // FILE.scen --map FILE.map --agents K; file names may hold blanks.
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
    const auto count = parse_number(text, 1, kMostAgents);
    if (!count)
      fail(fmt::format("found '{}'; expected a number of agents from 1 to {}", one_line(text),
                       kMostAgents));
    return *count;
  }

  std::string existing(std::string_view name) const {
    const fs::path path = folder_ / fs::path(name);
    std::error_code error;
    if (name.empty() || !fs::exists(path, error) || fs::is_directory(path, error))
      fail(fmt::format("there is no file {}; expected the path of one, relative to the manifest",
                       path.string()));
    return path.string();
  }

  const fs::path path_;
  const fs::path folder_;
  Collector collector_;
  int line_ = 0;
  std::string place_;
};

}  // namespace

std::vector<Entry> read_manifest(const fs::path& manifest_or_folder) {
  std::error_code error;
  if (fs::is_directory(manifest_or_folder, error)) return read_folder(manifest_or_folder);
  for (const std::string_view suffix : {".json", ".scen", ".map"})
    if (manifest_or_folder.string().ends_with(suffix))
      throw InputError(manifest_or_folder.string(), "",
                       "is no manifest; expected a folder, or a text file with the path of an "
                       "instance on each line");
  return ManifestReader(manifest_or_folder).read();
}

}  // namespace grove::detail::batch
