// SPDX-License-Identifier: MIT
// MotionWorld: the world of an instance in which turning or executing tasks takes time.
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

// The heading of an agent on a grid. North is up, towards smaller y.
enum class Heading : std::uint8_t { kNorth, kEast, kSouth, kWest };
inline constexpr std::array<Heading, 4> kHeadings{Heading::kNorth, Heading::kEast, Heading::kSouth,
                                                  Heading::kWest};
// letter() returns 'N', 'E', 'S' or 'W'. heading_of() is its inverse; it returns nullopt if `text`
// is not one of these letters.
char letter(Heading heading);
std::optional<Heading> heading_of(std::string_view text);
// The adjacent headings: clockwise, and counterclockwise.
Heading right_of(Heading heading);
Heading left_of(Heading heading);

// How an agent moves: it turns freely, or a quarter turn takes `turn_steps` steps.
struct Motion {
  Time turn_steps = 0;  // 0: it turns freely
  friend bool operator==(const Motion&, const Motion&) = default;
};

// The place and heading of an agent. If `steps` > 0, the agent has made `steps` steps of a quarter
// turn from `heading` to the adjacent heading `to`. Otherwise `to` should be equal to `heading`,
// because operator== compares it.
struct Pose {
  Place place = kNoPlace;
  Heading heading = Heading::kNorth;
  Heading to = Heading::kNorth;
  Time steps = 0;
  friend bool operator==(const Pose&, const Pose&) = default;
};

// A world over the places of a map (docs/design.md, section 1) with
//
// - for each motion in which turning takes time (only on grids), one kind of base states: the four
//   headings on each place and, if a quarter turn takes d > 1 steps, d - 1 states within each of
//   the eight turns (from each heading to the right or left). A move leads one cell ahead, or makes
//   one step of a turn. The only move from a state within a turn continues that turn;
// - for each task that takes d steps, and for each base state in which it can be executed, a chain
//   of d states at work. A move leads from the base state to the first state of the chain. The last
//   state has the moves of the base state. (For an agent that starts at work with no step done, the
//   chain has an additional state in front, in which the agent starts.)
class MotionWorld : public World {
 public:
  // Execution of a task that takes `duration` steps, in base state `base`. With `has_initial_state`
  // the chain has an additional state before the first step.
  struct Job {
    TaskIndex task;
    Time duration;
    State base;
    bool has_initial_state = false;
  };

  // `motions`: distinct motions with turn_steps > 0; motion i defines kind i + 1. `jobs`: no two
  // with the same task and base state. Throws std::invalid_argument if there are motions but the
  // map is not a grid, or if there would be more than kMaxStates states if every job had an initial
  // state.
  MotionWorld(std::shared_ptr<const Map> map, std::vector<Motion> motions,
              std::span<const Job> jobs);

  // As state(), but needs no MotionWorld, because the numbers of base states do not depend on the
  // jobs. For creating the jobs of a world, which refer to base states.
  static State base_state(const Map& map, std::span<const Motion> motions, int kind,
                          const Pose& pose);

  State state(int kind, const Pose& pose) const { return base_state(*map_, motions_, kind, pose); }
  // The pose of a base state. Precondition: its kind is not 0.
  Pose pose(State base) const;
  // The state of an agent at work on `task` in base state `base`, with `done` steps done. Throws
  // std::invalid_argument if this world has no such state.
  State working(TaskIndex task, State base, Time done) const;

  std::string name(State state) const override;

  // The maximum number of states. State numbers have 32 bits, and some tables have several entries
  // per state.
  static constexpr std::int64_t kMaxStates = std::int64_t{1} << 28;

 private:
  struct Parts;
  MotionWorld(std::shared_ptr<const Map> map, std::vector<Motion> motions, Parts parts);
  static Parts parts(const Map& map, std::span<const Motion> motions, std::span<const Job> jobs);

  std::shared_ptr<const Map> map_;
  std::vector<Motion> motions_;
};

}  // namespace grove::detail
