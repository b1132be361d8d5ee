// SPDX-License-Identifier: MIT
#include "tools/generate/generate_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "batch/folder.h"
#include "io/atomic_file.h"
#include "io/instance_file.h"
#include "tools/generate/generate_commands.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

using UseInstance = std::function<void(const std::string& name, const Instance& instance)>;

void for_each_instance(const MapSet& map, const SetSizes& sizes, const UseInstance& use) {
  const std::string stem = fs::path(map.map).stem().string();
  for (const auto& [number, scenario, seed] : map.scenarios) {
    for (const std::int64_t agents : sizes.agents) {
      for (const std::int64_t tasks : sizes.tasks) {
        for (const bool mg : sizes.mg) {
          const InstanceRequest request{.agents = static_cast<int>(agents),
                                        .tasks = static_cast<int>(tasks),
                                        .seed = static_cast<std::uint64_t>(seed),
                                        .mg = mg,
                                        .extras = sizes.extras,
                                        .choices = sizes.choices};
          use(fmt::format("{}_s{}_n{}_m{}{}{}{}.cts.json", stem, number, agents, tasks,
                          sizes.extras.suffix(), sizes.choices.suffix(), mg ? "_mg" : ""),
              generate_instance(map.grid, scenario, request));
        }
      }
    }
  }
}

}  // namespace

void require_fitting(const std::vector<MapSet>& maps, const SetSizes& sizes) {
  for (const MapSet& map : maps)
    for_each_instance(map, sizes, [](const std::string&, const Instance&) {});
}

void write_set(const fs::path& directory, const std::vector<MapSet>& maps, const SetSizes& sizes) {
  batch::make_folder(directory);
  std::string manifest;
  std::string parts[2];  // CTS-MAPF, MG-MAPF
  for (const MapSet& map : maps) {
    const std::string seen = map_as_seen_from(directory / "any", map.map);
    for_each_instance(map, sizes, [&](const std::string& name, const Instance& instance) {
      write_instance(directory / name, instance, seen,
                     Durability::kProcess);  // no fsync, because there can be thousands of files
      manifest += name + "\n";
      parts[name.ends_with("_mg.cts.json") ? 1 : 0] += name + "\n";
    });
  }
  write_file_atomically(directory / "manifest.txt", manifest);
  if (sizes.mg.size() > 1) {
    write_file_atomically(directory / "manifest-cts.txt", parts[0]);
    write_file_atomically(directory / "manifest-mg.txt", parts[1]);
  }
  fmt::print("wrote {}: {} instances\n", (directory / "manifest.txt").string(),
             std::ranges::count(manifest, '\n'));
}

}  // namespace grove::detail
