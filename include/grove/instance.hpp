// SPDX-License-Identifier: MIT
/// \file
/// A CTS-MAPF instance: robots, the places each has to visit in an order that the solver chooses,
/// and where they rest.
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

/// What a robot has begun to work on before it starts.
struct WorkBegun {
  std::string task = {};  ///< Its id: a task of the robot where it starts.
  int done = 0;           ///< So many steps of it are done: from 0 to its duration - 1.
};

/// A robot.
struct Agent {
  std::string id = {};  ///< Not empty; no other agent has it.
  Pose start = {};      ///< Where it is at time 0; no other agent starts at this place.
  /// Where it ends, and no other agent. None: on its last task; without tasks wherever it wants, so
  /// it gives way.
  std::optional<Place> goal = std::nullopt;
  /// Steps of a quarter turn of a robot that moves only where it looks; 0: it moves freely. On
  /// grids.
  int turn_steps = 0;
  std::optional<Heading> goal_heading = std::nullopt;  ///< In which it has to rest; none: any.
  std::optional<WorkBegun> working = std::nullopt;     ///< It starts at work.
};

/// A place that each of some robots has to visit.
struct Task {
  std::string id = {};                   ///< Not empty; no other task has it.
  Place place = {};                      ///< A cell or a vertex; tasks may share one.
  std::vector<std::string> agents = {};  ///< Ids: each of them has to visit it. One at least.
  int duration = 0;                      ///< Steps of work there; 0: it is visited in passing.
};

/// What holds for all robots.
struct Rules {
  /// May a robot enter a place in the step in which another leaves it?
  bool following = true;
};

/// A valid instance; immutable, cheap to copy, for any number of threads. Copies share what it
/// holds.
class GROVE_API Instance {
 public:
  /// Throws InvalidArgument: field() is "/agents/<i>/..." or "/tasks/<i>/...".
  Instance(World world, std::vector<Agent> agents, std::vector<Task> tasks, Rules rules = {});

  World world() const;                       ///< What they move on.
  const std::vector<Agent>& agents() const;  ///< As they were given; lives as long as this.
  const std::vector<Task>& tasks() const;    ///< As they were given; lives as long as this.
  Rules rules() const;                       ///< As they were given.

 private:
  friend struct Access;
  struct Data;
  explicit Instance(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

/// What an untrusted file may name, and how much memory it may take; see read_instance().
struct Trust {
  /// Refuses a file that names a map or roadmap outside of its own folder: by an absolute name, by
  /// `..` or by a symbolic link.
  bool confine = false;
  /// Bytes that the map and the states of the robots on it may take; more is refused before it is
  /// taken. None: as much as there is.
  std::optional<std::size_t> memory_limit = std::nullopt;
};

/// Reads a `*.cts.json` file and the map or roadmap that it names. Appends remarks, a line each, to
/// `warnings`, if there is one. Throws InputError.
GROVE_API Instance read_instance(const std::filesystem::path& path,
                                 std::vector<std::string>* warnings = nullptr);
/// The same within bounds, for untrusted files.
GROVE_API Instance read_instance(const std::filesystem::path& path, const Trust& trust,
                                 std::vector<std::string>* warnings = nullptr);
/// The same of the text of such a file; the map is relative to `folder`.
GROVE_API Instance parse_instance(std::string_view text, const std::filesystem::path& folder = ".",
                                  std::vector<std::string>* warnings = nullptr);
/// The same within bounds, for untrusted texts.
GROVE_API Instance parse_instance(std::string_view text, const std::filesystem::path& folder,
                                  const Trust& trust, std::vector<std::string>* warnings = nullptr);
/// What such a file says of agents and tasks, `{"agents": [...], "tasks": [...]}`, in this world.
/// Throws InputError.
GROVE_API Instance parse_instance(std::string_view text, const World& world, Rules rules = {});
/// Its agents and tasks as parse_instance() reads them in its world.
GROVE_API std::string instance_text(const Instance& instance);
/// Classical MAPF: the first `agents` rows of a Moving AI scenario, as agents a0, a1, ... Throws
/// InputError.
GROVE_API Instance read_scenario(const std::filesystem::path& scenario,
                                 const std::filesystem::path& map, int agents);
/// Writes `*.cts.json` and, beside it, its map or roadmap (`STEM.map`, `STEM.roadmap.json`), each
/// whole or not at all. Rules are not written: they are no part of files. Throws InputError.
GROVE_API void write_instance(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove
