// SPDX-License-Identifier: MIT
// FNV-1a (Fowler, Noll, Vo) with 64 bits.
#include "grove/batch/instance_digest.h"

#include <fmt/format.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "grove/io/input_error.h"
#include "grove/io/text_file.h"

namespace grove::batch {
namespace {

constexpr std::uint64_t kOffset = 0xcbf29ce484222325;
constexpr std::uint64_t kPrime = 0x100000001b3;

std::uint64_t extended(std::uint64_t hash, std::string_view bytes) {
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * kPrime;
  return hash;
}

std::string content(const std::filesystem::path& path) {
  try {
    return read_text(path);
  } catch (const InputError&) {
    return {};
  }
}

// The map that an instance file names; none: whoever solves it will say what is wrong.
std::filesystem::path map_of(const Entry& entry, const std::string& text) {
  if (!entry.map.empty()) return entry.map;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("map") || !json["map"].is_string()) return {};
  return std::filesystem::path(entry.path).parent_path() / json["map"].get<std::string>();
}

}  // namespace

std::string InstanceDigests::of(const Entry& entry) {
  const std::string text = content(entry.path);
  const std::uint64_t map = of_map(map_of(entry, text));
  return fmt::format("{:016x}", extended(extended(kOffset, text), fmt::format("{:016x}", map)));
}

std::uint64_t InstanceDigests::of_map(const std::filesystem::path& map) {
  const auto [known, is_new] = maps_.try_emplace(map, 0);
  if (is_new && !map.empty()) known->second = extended(kOffset, content(map));
  return known->second;
}

}  // namespace grove::batch
