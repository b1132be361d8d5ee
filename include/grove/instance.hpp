// SPDX-License-Identifier: MIT
/// \file
/// CTS-MAPF instances: agents (robots) with starts and destinations, and the tasks that agents must
/// or may visit in an order that the solver chooses.
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

/// A task that an agent is executing at time 0.
struct WorkBegun {
  std::string task = {};  ///< Id of a task of this agent that has a duration and is at its start.
  int done = 0;           ///< Time steps executed so far, from 0 to the task's duration - 1.
};

/// An agent: one robot.
struct Agent {
  std::string id = {};  ///< Unique among agents; not empty.
  Pose start = {};      ///< Pose at time 0. No two agents have the same start place.
  /// Destination; no two agents have the same. std::nullopt and no `goals`: the agent ends at the
  /// place of a task that it has visited or, without tasks that it must visit, at any place, so
  /// that it can make way for others.
  std::optional<Place> goal = std::nullopt;
  /// Time steps that a quarter turn takes, for an agent that moves only in the direction of its
  /// heading. 0: it moves in any direction. Must be 0 on roadmaps.
  int turn_steps = 0;
  /// Heading at `goal`, or at the chosen one of `goals`; std::nullopt: any.
  std::optional<Heading> goal_heading = std::nullopt;
  std::optional<WorkBegun> working = std::nullopt;  ///< Task in progress at time 0.
  /// Places on any one of which the agent may end; distinct. Several agents may list the same
  /// place. Not together with `goal`.
  std::vector<Place> goals = {};
};

/// A place that agents of a list visit, at any time from 0 on: `need` of them must visit it at
/// least once.
struct Task {
  std::string id = {};                   ///< Unique among tasks; not empty.
  Place place = {};                      ///< A cell or a vertex. Tasks may share a place.
  std::vector<std::string> agents = {};  ///< Ids of its agents, distinct, >= 1.
  int duration = 0;  ///< Time steps that its execution takes; 0: a visit is enough.
  /// Number of its agents that must visit it, from 1 on; std::nullopt: all of them. If fewer than
  /// all must, the solver chooses them, and the plan states each visit (AgentPlan::work).
  std::optional<int> need = std::nullopt;
  /// True: its agents are all agents of the instance. `agents` must then be empty or list all of
  /// them; Instance::tasks() lists them.
  bool all_agents = false;
};

/// Rules of motion for all agents.
struct Rules {
  /// True: an agent may enter a place in the time step in which another agent leaves it.
  bool following = true;
};

/// A valid instance. Immutable: any thread may read it. Copies are cheap, because they share the
/// data.
class GROVE_API Instance {
 public:
  /// Throws InvalidArgument if the arguments do not form a valid instance. field() is "/agents" or
  /// "/agents/<i>/...", "/tasks/<i>/...", or "/map" or "/roadmap" if motion and durations do not
  /// suit the world.
  Instance(World world, std::vector<Agent> agents, std::vector<Task> tasks, Rules rules = {});

  World world() const;                       ///< Grid or roadmap.
  const std::vector<Agent>& agents() const;  ///< In the order given; lives as long as any copy.
  const std::vector<Task>& tasks() const;    ///< In the order given; lives as long as any copy.
  /// Returns true if an agent may choose its destination, or whether to visit a task.
  bool has_choices() const;
  Rules rules() const;  ///< Rules of motion for all agents.

 private:
  friend struct Access;
  struct Data;
  explicit Instance(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

/// Restrictions for untrusted files and texts; see read_instance() and parse_instance().
struct Trust {
  /// True: refuses a file that names its map or roadmap by an absolute path, or outside its own
  /// directory (for a text: outside `folder`) by `..` or a symbolic link.
  bool confine = false;
  /// Limit, in bytes, on the memory for the map, the states of the agents on it, and the agents of
  /// tasks of all agents ("*"). A file that needs more is refused before the memory is allocated;
  /// 64 MiB are always granted. std::nullopt: no limit.
  std::optional<std::size_t> memory_limit = std::nullopt;
};

/// Reads a `*.cts.json` file and the map or roadmap that it names. Appends warnings, one line each,
/// to `warnings` unless it is nullptr. Throws InputError.
GROVE_API Instance read_instance(const std::filesystem::path& path,
                                 std::vector<std::string>* warnings = nullptr);
/// Reads a file like the overload above, under the restrictions of `trust`. Throws InputError.
GROVE_API Instance read_instance(const std::filesystem::path& path, const Trust& trust,
                                 std::vector<std::string>* warnings = nullptr);
/// Parses the text of a `*.cts.json` file and reads the map or roadmap that it names by a path
/// relative to `folder`. Appends warnings like read_instance(). Throws InputError.
GROVE_API Instance parse_instance(std::string_view text, const std::filesystem::path& folder = ".",
                                  std::vector<std::string>* warnings = nullptr);
/// Parses a text like the overload above, under the restrictions of `trust`. Throws InputError.
GROVE_API Instance parse_instance(std::string_view text, const std::filesystem::path& folder,
                                  const Trust& trust, std::vector<std::string>* warnings = nullptr);
/// Parses a text with the agents and tasks of a `*.cts.json` file, but without a map, and places
/// them on `world`: `{"agents": [...], "tasks": [...]}`. Throws InputError.
GROVE_API Instance parse_instance(std::string_view text, const World& world, Rules rules = {});
/// Returns the agents and tasks as a JSON text, which parse_instance(text, world) reads. The text
/// contains neither the world nor the rules.
GROVE_API std::string instance_text(const Instance& instance);
/// Returns the classical MAPF instance of the first `agents` rows of a Moving AI scenario. The
/// agents are named a0, a1, ... in row order. Throws InputError.
GROVE_API Instance read_scenario(const std::filesystem::path& scenario,
                                 const std::filesystem::path& map, int agents);
/// Writes a `*.cts.json` file and, in the same directory, its map or roadmap (`STEM.map` or
/// `STEM.roadmap.json`, where STEM is the file name up to its first dot). Each file is written
/// completely or not at all. Rules are not written, because they are not part of instance files.
/// Throws InputError.
GROVE_API void write_instance(const std::filesystem::path& path, const Instance& instance);

}  // namespace grove
