// SPDX-License-Identifier: MIT
/// \file
/// CTS-MAPF instances: robots, the tasks that each of them must visit in an order that the solver
/// chooses, and destinations.
#pragma once

#include <cstddef>
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

/// A task that a robot is executing at time 0.
struct WorkBegun {
  std::string task = {};  ///< Id of a task of this robot, at the place where the robot starts.
  int done = 0;           ///< Steps that are done, from 0 to the duration of the task - 1.
};

/// A robot.
struct Agent {
  std::string id = {};  ///< Unique among agents; not empty.
  Pose start = {};      ///< Pose at time 0. No two agents start at the same place.
  /// Destination; no two agents have the same. std::nullopt: the agent ends on the task that it
  /// visits last; without tasks it may end anywhere, so it can make way for others.
  std::optional<Place> goal = std::nullopt;
  /// Time steps of a quarter turn, for a robot that moves only in the direction of its heading; 0:
  /// it moves in any direction. Above 0 only on grids.
  int turn_steps = 0;
  std::optional<Heading> goal_heading = std::nullopt;  ///< Heading at rest; std::nullopt: any.
  std::optional<WorkBegun> working = std::nullopt;     ///< Task in execution at time 0.
};

/// A place that each of the given robots must visit.
struct Task {
  std::string id = {};                   ///< Unique among tasks; not empty.
  Place place = {};                      ///< A cell or a vertex. Tasks may share a place.
  std::vector<std::string> agents = {};  ///< Ids of the agents that must visit it; at least one.
  int duration = 0;                      ///< Time steps of execution; 0: a visit is enough.
};

/// Rules for all robots.
struct Rules {
  /// Whether a robot may enter a place in the time step in which another robot leaves it.
  bool following = true;
};

/// A valid instance. Immutable: any thread may use it. Copies are cheap, because they share the
/// data.
class GROVE_API Instance {
 public:
  /// Throws InvalidArgument with field() "/agents/<i>/..." or "/tasks/<i>/...".
  Instance(World world, std::vector<Agent> agents, std::vector<Task> tasks, Rules rules = {});

  World world() const;                       ///< Grid or roadmap.
  const std::vector<Agent>& agents() const;  ///< In the order given; valid as long as this object.
  const std::vector<Task>& tasks() const;    ///< In the order given; valid as long as this object.
  Rules rules() const;                       ///< Rules for all robots.

 private:
  friend struct Access;
  struct Data;
  explicit Instance(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

/// Restrictions for untrusted files; see read_instance().
struct Trust {
  /// Refuses a file that names a map or roadmap outside its own directory, by an absolute path, by
  /// `..` or by a symbolic link.
  bool confine = false;
  /// Limit in bytes on the map and the states of the robots on it. A file that needs more is
  /// refused before the memory is allocated. std::nullopt: no limit.
  std::optional<std::size_t> memory_limit = std::nullopt;
};

/// Reads a `*.cts.json` file and the map or roadmap that it names. Appends warnings, one line each,
/// to `warnings` unless it is nullptr. Throws InputError.
GROVE_API Instance read_instance(const std::filesystem::path& path,
                                 std::vector<std::string>* warnings = nullptr);
/// The same with restrictions, for untrusted files.
GROVE_API Instance read_instance(const std::filesystem::path& path, const Trust& trust,
                                 std::vector<std::string>* warnings = nullptr);
/// The same for the text of such a file. The path of the map is relative to `folder`.
GROVE_API Instance parse_instance(std::string_view text, const std::filesystem::path& folder = ".",
                                  std::vector<std::string>* warnings = nullptr);
/// The same with restrictions, for untrusted texts.
GROVE_API Instance parse_instance(std::string_view text, const std::filesystem::path& folder,
                                  const Trust& trust, std::vector<std::string>* warnings = nullptr);
/// Reads the agents and tasks of such a file, `{"agents": [...], "tasks": [...]}`, for the given
/// world. Throws InputError.
GROVE_API Instance parse_instance(std::string_view text, const World& world, Rules rules = {});
/// Returns the agents and tasks as the text that parse_instance() reads with the same world.
GROVE_API std::string instance_text(const Instance& instance);
/// Returns the classical MAPF instance of the first `agents` rows of a Moving AI scenario, as
/// agents a0, a1, ... Throws InputError.
GROVE_API Instance read_scenario(const std::filesystem::path& scenario,
                                 const std::filesystem::path& map, int agents);
/// Writes a `*.cts.json` file and, in the same directory, its map or roadmap (`STEM.map`,
/// `STEM.roadmap.json`). Each file is written completely or not at all. Rules are not written,
/// because they are not part of instance files. Throws InputError.
GROVE_API void write_instance(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove
