// SPDX-License-Identifier: MIT
#include "batch/entry_collector.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "batch/entry.h"
#include "io/input_error.h"
#include "model/assert.h"

namespace grove::detail::batch {
namespace {

namespace fs = std::filesystem;

std::string without_suffix(std::string name) {
  for (const std::string_view suffix :
       {kInstanceSuffix, std::string_view(".json"), std::string_view(".scen")})
    if (name.ends_with(suffix)) return name.substr(0, name.size() - suffix.size());
  return name;
}

// Returns "" for an invalid instance; the row of the instance will report the error.
std::string digest_of(const Entry& entry) {
  try {
    return instance_digest(load(entry).instance);
  } catch (const InputError&) {
    return "";
  }
}

}  // namespace

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

std::vector<Entry> EntryCollector::take() {
  GROVE_CHECK(ids_.size() == entries_.size(), "each entry has an id of its own");
  return std::move(entries_);
}

void EntryCollector::add(Entry entry, const std::string& place) {
  if (one_line(entry.id) != entry.id || entry.id.empty())
    throw InputError(
        source_.string(), place,
        "the path is not suitable as a file name; expected printable UTF-8, at most 400 bytes");
  std::error_code error;
  const fs::path file = fs::weakly_canonical(entry.path, error);
  require_new(files_, fmt::format("{} {}", file.string(), entry.agents), place,
              "is the same instance as");
  require_new(ids_, entry.id, place, fmt::format("has the file name '{}', as has", entry.id));
  entry.rules = rules_;
  entry.digest = digest_of(entry);
  entries_.push_back(std::move(entry));
}

void EntryCollector::require_new(Places& places, const std::string& key, const std::string& place,
                                 const std::string& what) const {
  const auto [first, is_new] = places.try_emplace(key, place);
  if (is_new) return;
  throw InputError(
      source_.string(), place,
      fmt::format("{} {}; expected distinct instances with distinct names", what, first->second));
}

}  // namespace grove::detail::batch
