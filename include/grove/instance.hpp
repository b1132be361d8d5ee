// SPDX-License-Identifier: MIT
// A CTS-MAPF instance: robots, the places each has to visit in an order that the solver chooses,
// and where they rest.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "grove/export.hpp"
#include "grove/world.hpp"

namespace grove {

// Work that a robot has begun before it starts: so many steps of it are done.
struct WorkBegun {
  std::string task = {};
  int done = 0;
};

struct Agent {
  std::string id = {};
  Pose start = {};
  // Where it ends. None: on its last task; without tasks wherever it wants, so it gives way.
  std::optional<Place> goal = std::nullopt;
  // Steps of a quarter turn of a robot that moves only where it looks; 0: it moves freely. On
  // grids.
  int turn_steps = 0;
  std::optional<Heading> goal_heading = std::nullopt;  // in which it has to rest
  std::optional<WorkBegun> working = std::nullopt;
};

struct Task {
  std::string id = {};
  Place place = {};
  std::vector<std::string> agents = {};  // ids: each of them has to visit it
  int duration = 0;                      // steps of work there
};

// What holds for all robots.
struct Rules {
  // May a robot enter a place in the step in which another leaves it?
  bool following = true;
};

// A valid instance; immutable, cheap to copy, for any number of threads.
class GROVE_API Instance {
 public:
  // Throws InvalidArgument: field() is "/agents/<i>/..." or "/tasks/<i>/...".
  Instance(World world, std::vector<Agent> agents, std::vector<Task> tasks, Rules rules = {});

  World world() const;
  const std::vector<Agent>& agents() const;
  const std::vector<Task>& tasks() const;
  Rules rules() const;

 private:
  friend struct Access;
  struct Data;
  explicit Instance(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

// Reads a *.cts.json file and the map or roadmap that it names. Throws InputError. Appends remarks,
// a line each, to `warnings`.
GROVE_API Instance read_instance(const std::filesystem::path& path,
                                 std::vector<std::string>* warnings = nullptr);
// The same of the text of such a file; the map is relative to `folder`.
GROVE_API Instance parse_instance(std::string_view text, const std::filesystem::path& folder = ".",
                                  std::vector<std::string>* warnings = nullptr);
// What such a file says of agents and tasks, {"agents": [...], "tasks": [...]}, in this world; and
// back.
GROVE_API Instance parse_instance(std::string_view text, const World& world, Rules rules = {},
                                  std::vector<std::string>* warnings = nullptr);
GROVE_API std::string instance_text(const Instance& instance);
// Classical MAPF: the first `agents` rows of a Moving AI scenario. Throws InputError.
GROVE_API Instance read_scenario(const std::filesystem::path& scenario,
                                 const std::filesystem::path& map, int agents);
// Writes *.cts.json and, beside it, its map or roadmap (`STEM.map`, `STEM.roadmap.json`), each
// whole or not at all. Throws InputError.
GROVE_API void write_instance(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove
