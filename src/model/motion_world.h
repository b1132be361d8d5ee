// SPDX-License-Identifier: MIT
// Agents that need time to turn, and work that takes time, over the places of a map.
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

// On a grid; N is up, y smaller.
enum class Heading : std::uint8_t { kNorth, kEast, kSouth, kWest };
inline constexpr std::array<Heading, 4> kHeadings{Heading::kNorth, Heading::kEast, Heading::kSouth,
                                                  Heading::kWest};
// 'N', 'E', 'S', 'W', and back; none.
char letter(Heading heading);
std::optional<Heading> heading_of(std::string_view text);
// The next one clockwise, and the other way round.
Heading right_of(Heading heading);
Heading left_of(Heading heading);

// How an agent moves: it turns for nothing, or by quarter turns of so many steps each.
struct Motion {
  Time turn_steps = 0;  // 0: it turns freely
  friend bool operator==(const Motion&, const Motion&) = default;
};

// Where an agent is and which way it looks; on its way to `to`, the next heading on either side, if
// `steps` > 0: so many steps of a quarter turn are made.
struct Pose {
  Place place = kNoPlace;
  Heading heading = Heading::kNorth;
  Heading to = Heading::kNorth;
  Time steps = 0;
  friend bool operator==(const Pose&, const Pose&) = default;
};

// A world over the places of a map (docs/design.md, section 1) with
//
// - for each motion with turns (grids only) a kind of base states: four headings on each place and,
//   if a quarter turn takes d > 1 steps, d - 1 states within each of the eight turns. A move goes
//   one cell ahead, or makes one step of a turn; from within a turn it only goes on;
// - for each task that takes d steps and each base state it may be done in a chain of d states at
//   work, entered from that state; the last one has the moves of the state itself. (An agent that
//   starts at work with nothing done starts before the first.)
class MotionWorld : public World {
 public:
  // A task that takes `duration` steps in this base state. `from_nothing`: with a state before the
  // first step as well.
  struct Job {
    TaskIndex task;
    Time duration;
    State base;
    bool from_nothing = false;
  };

  // `motions`: those with turns, distinct; motion i is kind i + 1. Jobs are distinct. Throws
  // std::invalid_argument for turns on a map that is no grid, and where states are too many.
  MotionWorld(std::shared_ptr<const Map> map, std::vector<Motion> motions,
              std::span<const Job> jobs);

  // The same before there are jobs: the numbers of base states do not depend on them.
  static State base_state(const Map& map, std::span<const Motion> motions, int kind,
                          const Pose& pose);

  State state(int kind, const Pose& pose) const { return base_state(*map_, motions_, kind, pose); }
  // Of base states that are not of kind 0.
  Pose pose(State base) const;
  // The state of an agent at work on this task in a base state, `done` steps of it done. There must
  // be such work.
  State working(TaskIndex task, State base, Time done) const;

  std::string name(State state) const override;

  // States are numbers of 32 bits, and there are tables of several numbers for each.
  static constexpr std::int64_t kMostStates = std::int64_t{1} << 28;

 private:
  struct Parts;
  MotionWorld(std::shared_ptr<const Map> map, std::vector<Motion> motions, Parts parts);
  static Parts parts(const Map& map, std::span<const Motion> motions, std::span<const Job> jobs);

  std::shared_ptr<const Map> map_;
  std::vector<Motion> motions_;
};

}  // namespace grove::detail
