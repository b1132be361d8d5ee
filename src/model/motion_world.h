// SPDX-License-Identifier: MIT
// The world of agents that need time to turn, and of tasks that take time.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/grid.h"
#include "model/map.h"

namespace grove::detail {

// On a grid. North is up, towards smaller y.
enum class Heading : std::uint8_t { kNorth, kEast, kSouth, kWest };
inline constexpr std::array<Heading, 4> kHeadings{Heading::kNorth, Heading::kEast, Heading::kSouth,
                                                  Heading::kWest};
// letter() returns 'N', 'E', 'S' or 'W'. heading_of() is the inverse and returns nullopt for any
// other text.
char letter(Heading heading);
std::optional<Heading> heading_of(std::string_view text);
// The next heading clockwise, and the next one counterclockwise.
Heading right_of(Heading heading);
Heading left_of(Heading heading);

// How an agent moves: it turns freely, or a quarter turn takes `turn_steps` steps.
struct Motion {
  Time turn_steps = 0;  // 0: it turns freely
  friend bool operator==(const Motion&, const Motion&) = default;
};

// An agent's place and heading. If `steps` > 0, it is within a quarter turn to `to`, an adjacent
// heading, and has made `steps` steps of this turn.
struct Pose {
  Place place = kNoPlace;
  Heading heading = Heading::kNorth;
  Heading to = Heading::kNorth;
  Time steps = 0;
  friend bool operator==(const Pose&, const Pose&) = default;
};

// A world over the places of a map (docs/design.md, section 1) with
//
// - for each motion with turns (grids only), a kind of base states: four headings on each place
//   and, if a quarter turn takes d > 1 steps, d - 1 states within each of the eight turns. A move
//   leads one cell ahead, or makes one step of a turn. From a state within a turn the only move
//   continues this turn;
// - for each task that takes d steps, and for each base state in which it may be done, a chain of d
//   states of work. A move leads from the base state to the first one. The last one has the moves
//   of the base state. (An agent that starts at work with no step done starts in an additional
//   state before the first one.)
class MotionWorld : public World {
 public:
  // A task that takes `duration` steps, done in base state `base`. With `from_nothing` there is an
  // additional state before the first step.
  struct Job {
    TaskIndex task;
    Time duration;
    State base;
    bool from_nothing = false;
  };

  // `motions`: distinct motions with turns; motion i is kind i + 1. `jobs`: distinct. Throws
  // std::invalid_argument for turns on a map that is not a grid, and for too many states.
  MotionWorld(std::shared_ptr<const Map> map, std::vector<Motion> motions,
              std::span<const Job> jobs);

  // The same as state(), before there are jobs. The numbers of base states do not depend on jobs.
  static State base_state(const Map& map, std::span<const Motion> motions, int kind,
                          const Pose& pose);

  State state(int kind, const Pose& pose) const { return base_state(*map_, motions_, kind, pose); }
  // The pose of a base state. Precondition: its kind is not 0.
  Pose pose(State base) const;
  // The state of an agent that works on this task in base state `base`, with `done` steps done.
  // Throws std::invalid_argument if the world has no such state.
  State working(TaskIndex task, State base, Time done) const;

  std::string name(State state) const override;

  // The maximum number of states. States are 32-bit numbers, and there are tables with several
  // numbers for each state.
  static constexpr std::int64_t kMaxStates = std::int64_t{1} << 28;

 private:
  struct Parts;
  MotionWorld(std::shared_ptr<const Map> map, std::vector<Motion> motions, Parts parts);
  static Parts parts(const Map& map, std::span<const Motion> motions, std::span<const Job> jobs);

  std::shared_ptr<const Map> map_;
  std::vector<Motion> motions_;
};

}  // namespace grove::detail
