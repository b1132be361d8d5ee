// SPDX-License-Identifier: MIT
// Numbering of the base states on one place, for a kind that turns: first the four headings; then,
// for each heading, the states within the turn to the right; then, for each heading, the states
// within the turn to the left.
#include "model/motion_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "model/assert.h"

namespace grove::detail {
namespace {

constexpr std::string_view kLetters = "NESW";

int number(Heading heading) {
  return static_cast<int>(heading);
}

Heading turned(Heading heading, int quarters) {
  return static_cast<Heading>((number(heading) + quarters) % 4);
}

int states_on_a_place(Motion motion) {
  return motion.turn_steps == 0 ? 1 : 4 + 8 * (motion.turn_steps - 1);
}

// The rank of a pose among the base states of its kind on its place.
int rank_of_pose(Motion motion, const Pose& pose) {
  if (pose.steps == 0) return number(pose.heading);
  const int turn = (pose.to == left_of(pose.heading) ? 4 : 0) + number(pose.heading);
  return 4 + turn * (motion.turn_steps - 1) + pose.steps - 1;
}

Pose pose_of_rank(Motion motion, Place place, int rank) {
  if (rank < 4) return {place, static_cast<Heading>(rank), static_cast<Heading>(rank), 0};
  const int turn = (rank - 4) / (motion.turn_steps - 1);
  const auto heading = static_cast<Heading>(turn % 4);
  return {place, heading, turn < 4 ? right_of(heading) : left_of(heading),
          (rank - 4) % (motion.turn_steps - 1) + 1};
}

// The maximum time from one base state to a different one on the same place. In the worst case the
// agent completes its current turn, makes two more turns, and makes all but the last step of a
// fourth turn.
Time steps_about(Motion motion) {
  return motion.turn_steps == 0 ? 0 : 4 * motion.turn_steps - 2;
}

std::int64_t count_bases(const World& ground, std::span<const Motion> motions) {
  std::int64_t count = ground.place_count();
  for (const Motion& motion : motions)
    count += std::int64_t{states_on_a_place(motion)} * ground.place_count();
  return count;
}

// Generates the moves of base states.
class MovesOfBases {
 public:
  MovesOfBases(const Map& map, std::span<const Motion> motions) : map_(map), motions_(motions) {}

  // Sets `moves` to the moves from a base state, except for moves to states at work.
  void add(State state, int kind, State first, std::vector<State>& moves) const {
    if (kind == 0) {
      const auto ways = ground(map_).moves(state);
      moves.assign(ways.begin(), ways.end());
      return;
    }
    moves.clear();
    const Motion motion = motions_[static_cast<std::size_t>(kind - 1)];
    const int on_a_place = states_on_a_place(motion);
    const Pose pose =
        pose_of_rank(motion, (state - first) / on_a_place, (state - first) % on_a_place);
    const auto go_to = [&](const Pose& next) {
      moves.push_back(first + next.place * on_a_place + rank_of_pose(motion, next));
    };
    const auto turn = [&](Heading to, Time steps) {
      if (steps == motion.turn_steps)
        go_to({pose.place, to, to, 0});
      else
        go_to({pose.place, pose.heading, to, steps});
    };
    if (pose.steps > 0) return turn(pose.to, pose.steps + 1);
    const auto& grid = std::get<Grid>(map_);
    if (!grid.passable(pose.place)) return;
    if (const Cell next = ahead(grid, pose); next != kNoCell)
      go_to({next, pose.heading, pose.heading, 0});
    turn(right_of(pose.heading), 1);
    turn(left_of(pose.heading), 1);
  }

 private:
  static Cell ahead(const Grid& grid, const Pose& pose) {
    constexpr std::array<Position, 4> kSteps{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
    const Position step = kSteps[static_cast<std::size_t>(number(pose.heading))];
    const Position from = grid.position(pose.place);
    const Position to{from.x + step.x, from.y + step.y};
    return grid.contains(to) && grid.passable(grid.cell(to)) ? grid.cell(to) : kNoCell;
  }

  const Map& map_;
  std::span<const Motion> motions_;
};

}  // namespace

char letter(Heading heading) {
  return kLetters[static_cast<std::size_t>(number(heading))];
}

std::optional<Heading> heading_of(std::string_view text) {
  const auto at = kLetters.find(text);
  if (text.size() != 1 || at == std::string_view::npos) return std::nullopt;
  return static_cast<Heading>(at);
}

Heading right_of(Heading heading) {
  return turned(heading, 1);
}

Heading left_of(Heading heading) {
  return turned(heading, 3);
}

struct MotionWorld::Parts {
  std::vector<Kind> kinds;
  std::vector<Work> work;
  CsrArray moves;
};

MotionWorld::Parts MotionWorld::parts(const Map& map, std::span<const Motion> motions,
                                      std::span<const Job> jobs) {
  const World& places = ground(map);
  if (!motions.empty() && !std::holds_alternative<Grid>(map))
    throw std::invalid_argument("agents can turn only on grids");
  std::int64_t count = count_bases(places, motions);
  const std::int64_t bases = count;
  for (const Job& job : jobs) count += job.duration + 1;
  if (count > kMaxStates)
    throw std::invalid_argument(fmt::format("a world has at most {} states", kMaxStates));

  Parts parts;
  parts.kinds.push_back({});
  for (State first = places.place_count(); const Motion& motion : motions) {
    parts.kinds.push_back({first, states_on_a_place(motion), steps_about(motion)});
    first += states_on_a_place(motion) * places.place_count();
  }
  std::unordered_map<State, std::vector<State>>
      entries;  // by base state: the first states of its chains
  for (const Job& job : jobs) {
    const Time first = job.has_initial_state ? 0 : 1;
    entries[job.base].push_back(static_cast<State>(bases + std::ssize(parts.work)) + 1 - first);
    for (Time done = first; done <= job.duration; ++done)
      parts.work.push_back({job.task, done, done == job.duration, job.base});
  }

  const MovesOfBases moves_of_bases(map, motions);
  std::vector<State> moves;
  const auto moves_of_base = [&](State base) {
    std::size_t kind = parts.kinds.size() - 1;
    while (parts.kinds[kind].first > base) --kind;
    moves_of_bases.add(base, static_cast<int>(kind), parts.kinds[kind].first, moves);
    if (const auto chains = entries.find(base); chains != entries.end())
      moves.insert(moves.end(), chains->second.begin(), chains->second.end());
  };
  const auto end_row = [&] {
    for (const State next : moves) parts.moves.add(next);
    parts.moves.end_row();
  };
  for (State base = 0; base < bases; ++base) {
    moves_of_base(base);
    end_row();
  }
  for (std::size_t w = 0; w < parts.work.size(); ++w) {
    if (parts.work[w].completed) {
      moves_of_base(parts.work[w].base);
    } else {
      GROVE_ASSERT(parts.work[w + 1].base == parts.work[w].base &&
                       parts.work[w + 1].done == parts.work[w].done + 1,
                   "the next state of a task execution has one more step done");
      moves.assign(1, static_cast<State>(bases) + static_cast<State>(w) + 1);
    }
    end_row();
  }
  GROVE_CHECK(parts.moves.count() == bases + std::ssize(parts.work),
              "there is one row of moves for each state");
  return parts;
}

MotionWorld::MotionWorld(std::shared_ptr<const Map> map, std::vector<Motion> motions,
                         std::span<const Job> jobs)
    : MotionWorld(map, motions, parts(*map, motions, jobs)) {}

MotionWorld::MotionWorld(std::shared_ptr<const Map> map, std::vector<Motion> motions, Parts parts)
    : World(ground(*map), std::move(parts.kinds), std::move(parts.work), std::move(parts.moves)),
      map_(std::move(map)),
      motions_(std::move(motions)) {}

State MotionWorld::base_state(const Map& map, std::span<const Motion> motions, int kind,
                              const Pose& pose) {
  if (kind == 0) return pose.place;
  const auto before = motions.first(static_cast<std::size_t>(kind - 1));
  const Motion motion = motions[static_cast<std::size_t>(kind - 1)];
  return static_cast<State>(count_bases(ground(map), before)) +
         pose.place * states_on_a_place(motion) + rank_of_pose(motion, pose);
}

Pose MotionWorld::pose(State base) const {
  const int kind = this->kind(base);
  const Place here = place(base);
  const Pose pose = pose_of_rank(motions_[static_cast<std::size_t>(kind - 1)], here,
                                 base - bases(here, kind).first);
  GROVE_ASSERT(state(kind, pose) == base, "a base state and its pose determine each other");
  return pose;
}

State MotionWorld::working(TaskIndex task, State base, Time done) const {
  State found = kNoState;
  for_each_state(place(base), [&](State state) {
    if (!is_working(state)) return;
    const Work& w = work(state);
    if (w.task == task && w.base == base && w.done == done) found = state;
  });
  if (found == kNoState)
    throw std::invalid_argument("there is no such task execution in this world");
  return found;
}

std::string MotionWorld::name(State state) const {
  const State base = this->base(state);
  std::string name = ground(*map_).name(place(base));
  if (kind(base) == 0) return name;
  const Pose p = pose(base);
  name.pop_back();
  name += fmt::format(", \"{}\"", letter(p.heading));
  if (p.steps > 0) name += fmt::format(", \"{}\", {}", letter(p.to), p.steps);
  return name + "]";
}

}  // namespace grove::detail
