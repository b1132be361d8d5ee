// SPDX-License-Identifier: MIT
#include "tests/fuzz/random_crowd.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "tests/fuzz/random.h"
#include "tests/fuzz/random_map.h"

namespace grove::detail::fuzz {
namespace {

// --- tiny instances ---

constexpr int kMaxPlaces = 9;
constexpr double kMaxArrangements = 20'000;

// Returns an instance whose vertices are the cells of one row.
TinyInstance tiny_roads(Random& random) {
  TinyInstance crowd;
  const int vertices = random.between(3, kMaxPlaces - 1);
  crowd.rows = {std::string(static_cast<std::size_t>(vertices), '.')};
  int places = vertices;
  const auto add = [&](int a, int b) {
    Time steps = random.percent(15) ? random.between(2, 3) : 1;
    if (places + steps - 1 > kMaxPlaces) steps = 1;
    places += steps - 1;
    crowd.roads.push_back({{a, 0}, {b, 0}, steps, false});
  };
  const int bends = random.below(100);  // the higher, the more the tree resembles a path
  for (int v = 1; v < vertices; ++v) add(random.percent(bends) ? v - 1 : random.below(v), v);
  for (int more = random.below(4); more > 0; --more) {
    const int a = random.below(vertices);
    const int b = random.below(vertices);
    if (a != b) add(a, b);
  }
  return crowd;
}

int place_count(const TinyInstance& crowd) {
  int places = static_cast<int>(passable_cells(crowd.rows).size());
  for (const TinyInstance::Road& road : crowd.roads) places += road.steps - 1;
  return places;
}

TinyInstance tiny_board(Random& random) {
  if (random.percent(60)) return tiny_roads(random);
  TinyInstance crowd;
  do {
    crowd.rows = random_map(static_cast<Shape>(random.below(kShapeCount)), random);
  } while (place_count(crowd) > kMaxPlaces);
  return crowd;
}

int agents_that_fit(int places, int free) {
  int agents = places - free;
  const auto arrangements = [&] {
    return std::exp(std::lgamma(places + 1) - std::lgamma(places - agents + 1));
  };
  while (agents > 1 && arrangements() > kMaxArrangements) --agents;
  return agents;
}

template <class Item>
void shuffle_items(std::vector<Item>& items, Random& random) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.below(i)]);
}

// --- large instances ---

// A board, with the data for choosing a change that makes an instance on it infeasible.
struct CrowdBoard {
  enum class Kind { kOpen, kCorridors, kTree, kRing, kRooms, kTail, kTriangles };
  Kind kind;
  std::optional<Grid> grid;
  std::optional<Roadmap> roads;
  std::vector<std::vector<Place>> next_to = {};  // by place
  std::vector<Place> places = {};                // those with a neighbor
  // kRooms: the places of the first room. kTail: the places of the tail, from its end.
  std::vector<Place> marked = {};

  Map map() const { return grid ? Map(*grid) : Map(*roads); }
};

CrowdBoard on_grid(CrowdBoard::Kind kind, const std::vector<std::string>& rows,
                   const std::vector<Position>& marked = {}) {
  std::vector<bool> passable;
  for (const std::string& row : rows)
    for (const char c : row) passable.push_back(c == '.');
  CrowdBoard board{
      .kind = kind,
      .grid = Grid(static_cast<int>(rows[0].size()), static_cast<int>(rows.size()), passable),
      .roads = {}};
  for (const Position p : marked) board.marked.push_back(board.grid->cell(p));
  return board;
}

CrowdBoard on_roads(CrowdBoard::Kind kind, int vertices,
                    const std::vector<std::pair<int, int>>& joined) {
  std::vector<Vertex> all;
  for (int v = 0; v < vertices; ++v) all.push_back({fmt::format("v{}", v), {}});
  std::vector<Road> roads;
  for (const auto& [a, b] : joined) roads.push_back({a, b, 1, false});
  return {.kind = kind, .grid = {}, .roads = Roadmap(std::move(all), std::move(roads))};
}

std::vector<std::string> wall(int width, int height) {
  return std::vector<std::string>(static_cast<std::size_t>(height),
                                  std::string(static_cast<std::size_t>(width), '@'));
}

CrowdBoard open_board(int places) {
  const int width = std::max(3, static_cast<int>(std::sqrt(places)));
  const int height = std::max(3, (places + width - 1) / width);
  auto rows = wall(width, height);
  for (std::string& row : rows) std::ranges::fill(row, '.');
  return on_grid(CrowdBoard::Kind::kOpen, rows);
}

// Two open rooms joined by one cell.
CrowdBoard two_rooms(int places) {
  const int side = std::max(3, static_cast<int>(std::sqrt(places / 2)));
  auto rows = wall(2 * side + 1, side);
  std::vector<Position> first;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      rows[y][x] = rows[y][side + 1 + x] = '.';
      first.push_back({x, y});
    }
  rows[side / 2][side] = '.';
  return on_grid(CrowdBoard::Kind::kRooms, rows, first);
}

// A room with a dead-end corridor, the tail.
CrowdBoard room_with_tail(int places, int tail) {
  const int side = std::max(3, static_cast<int>(std::sqrt(std::max(9, places - tail))));
  auto rows = wall(side + tail, side);
  for (std::string& row : rows) std::fill(row.begin(), row.begin() + side, '.');
  std::vector<Position> marked;
  for (int x = side + tail - 1; x >= side; --x) {
    rows[0][x] = '.';
    marked.push_back({x, 0});
  }
  return on_grid(CrowdBoard::Kind::kTail, rows, marked);
}

// Grows the board cell by cell; a cell that closes a ring is rarely added.
CrowdBoard corridor_board(int places, Random& random) {
  const int side = static_cast<int>(2 * std::sqrt(places)) + 3;
  auto rows = wall(side, side);
  rows[side / 2][side / 2] = '.';
  const int chance = random.below(30);
  for (int count = 1, tries = 0; count < places && tries < 400 * places; ++tries) {
    const int x = random.below(side);
    const int y = random.below(side);
    const int around = passable_around(rows, x, y);
    if (rows[y][x] == '.' || around == 0 || (around > 1 && !random.percent(chance))) continue;
    rows[y][x] = '.';
    ++count;
  }
  return on_grid(CrowdBoard::Kind::kCorridors, rows);
}

CrowdBoard tree_board(int places, Random& random) {
  std::vector<std::pair<int, int>> joined;
  const int bends = random.below(100);
  for (int v = 1; v < places; ++v)
    joined.emplace_back(random.percent(bends) ? v - 1 : random.below(v), v);
  return on_roads(CrowdBoard::Kind::kTree, places, joined);
}

CrowdBoard ring_board(int places) {
  std::vector<std::pair<int, int>> joined;
  for (int v = 0; v < places; ++v) joined.emplace_back(v, (v + 1) % places);
  return on_roads(CrowdBoard::Kind::kRing, places, joined);
}

// Every triangle after the first shares a corner with an earlier triangle.
CrowdBoard triangle_board(int places, Random& random) {
  std::vector<std::pair<int, int>> joined;
  int vertices = 1;
  for (; vertices + 2 <= std::max(9, places); vertices += 2) {
    const int at = random.below(vertices);
    joined.emplace_back(at, vertices);
    joined.emplace_back(vertices, vertices + 1);
    joined.emplace_back(vertices + 1, at);
  }
  return on_roads(CrowdBoard::Kind::kTriangles, vertices, joined);
}

CrowdBoard with_places(CrowdBoard board) {
  const Map map = board.map();
  const World& world = ground(map);
  for (Place place = 0; place < world.place_count(); ++place) {
    const auto next = world.neighbors(place);
    board.next_to.emplace_back(next.begin(), next.end());
    if (!next.empty()) board.places.push_back(place);
  }
  return board;
}

// Moves agents at random without collisions, starting from random places.
class Stroll {
 public:
  Stroll(const CrowdBoard& board, int agents, bool may_follow, Random& random)
      : board_(board), may_follow_(may_follow), random_(random), on_(board.next_to.size(), -1) {
    std::vector<Place> places = board.places;
    shuffle_items(places, random);
    where_.assign(places.begin(), places.begin() + agents);
    free_.assign(places.begin() + agents, places.end());
    for (int agent = 0; agent < agents; ++agent) on_[where_[agent]] = agent;
  }

  const std::vector<Place>& where() const { return where_; }
  void go(int steps) {
    for (; steps > 0; --steps)
      if (!free_.empty() && (!may_follow_ || random_.percent(80)))
        walk_free_place(free_[random_.below(free_.size())]);
      else if (may_follow_)
        rotate_cycle();
  }

 private:
  void put(int agent, Place place) {
    where_[agent] = place;
    on_[place] = agent;
  }
  // Repeatedly moves an agent from a neighbouring place to `free`, so that the free place makes a
  // random walk.
  void walk_free_place(Place& free) {
    Place last = kNoPlace;
    for (int i = random_.between(1, 30); i > 0; --i) {
      const Place from = random_.pick(board_.next_to[free]);
      if (on_[from] < 0 || (from == last && random_.percent(80))) continue;
      put(on_[from], free);
      on_[from] = -1;
      last = free;
      free = from;
    }
  }
  void rotate_cycle() {
    std::vector<Place> way{random_.pick(board_.places)};
    while (true) {
      std::vector<Place> next = board_.next_to[way.back()];
      if (way.size() > 1) std::erase(next, way[way.size() - 2]);
      if (next.empty()) return;
      way.push_back(random_.pick(next));
      const auto first = std::ranges::find(way, way.back());
      if (first == way.end() - 1) continue;
      way.erase(way.begin(), first);
      break;
    }
    if (std::ranges::any_of(way, [&](Place p) { return on_[p] < 0; })) return;
    std::vector<int> agents;
    for (std::size_t i = 0; i + 1 < way.size(); ++i) agents.push_back(on_[way[i]]);
    for (std::size_t i = 0; i + 1 < way.size(); ++i) put(agents[i], way[i + 1]);
  }

  const CrowdBoard& board_;
  const bool may_follow_;
  Random& random_;
  std::vector<int> on_;  // agent by place; -1: none
  std::vector<Place> where_;
  std::vector<Place> free_;
};

// Two agents; swapping their goals makes the instance infeasible.
using Pair = std::pair<int, int>;

class CrowdMaker {
 public:
  explicit CrowdMaker(std::uint64_t seed) : random_(seed ^ 0xC20D) {}

  KnownCrowd make() {
    const int agents = static_cast<int>(std::lround(10 * std::pow(200, random_.unit())));
    const bool is_to_break = random_.percent(50);
    may_follow_ = random_.percent(50);
    free_ = random_.percent(30) ? random_.below(2) : random_.between(0, 12);
    board_ = with_places(choose_board(agents, is_to_break));
    const int count = std::max(3, static_cast<int>(board_.places.size()) - free_);
    Stroll stroll(board_, count, may_follow_, random_);
    const std::vector<Place> starts = stroll.where();
    std::vector<std::pair<int, Place>> tasks;
    for (int part = 0; part < 5; ++part) {
      stroll.go(10 * count);
      const int agent = random_.below(count);
      tasks.emplace_back(agent, stroll.where()[agent]);
    }
    std::vector<Place> goals = stroll.where();
    const std::optional<Pair> pair = is_to_break ? pair_to_swap(starts) : std::nullopt;
    if (pair) std::swap(goals[pair->first], goals[pair->second]);
    return {instance(starts, goals, tasks), !pair, name()};
  }

 private:
  using Kind = CrowdBoard::Kind;

  CrowdBoard choose_board(int agents, bool is_to_break) {
    const int places = agents + free_;
    switch (is_to_break ? random_.between(1, 6) : random_.below(7)) {
      case 0:
        return corridor_board(places, random_);
      case 1:
        if (is_to_break) free_ = random_.below(2);
        return tree_board(places, random_);
      case 2:
        return ring_board(places);
      case 3:
        if (is_to_break) may_follow_ = false, free_ = 1;
        return open_board(places);
      case 4:
        if (is_to_break) may_follow_ = true, free_ = 0;
        return two_rooms(places);
      case 5:
        return room_with_tail(places, free_ + random_.between(4, 9));
      default:
        if (is_to_break) may_follow_ = true, free_ = 0;
        return triangle_board(places, random_);
    }
  }

  // Returns two agents whose swapped goals leave no plan, or nullopt if no such pair is known. The
  // reason depends on the kind of board:
  // - On a tree with at most one free place, the free place determines the whole configuration.
  // - On a ring no agent can pass another. In a tail, agents cannot change their order if there are
  //   more places of the tail between them and the room than free places.
  // - On a grid with one free place and without following, each step exchanges an agent and the
  //   free place. Two reachable configurations with the same free place differ by an even number of
  //   steps, hence by an even permutation; swapped goals would be an odd one. Triangles without a
  //   free place also allow only even permutations.
  // - With two rooms and no free place, no agent can leave its room.
  std::optional<Pair> pair_to_swap(const std::vector<Place>& starts) {
    const auto agents = static_cast<int>(starts.size());
    const Pair any{0, random_.between(1, agents - 1)};
    switch (board_.kind) {
      case Kind::kTree:
        return free_ <= 1 ? std::optional(any) : std::nullopt;
      case Kind::kOpen:
        return free_ == 1 && !may_follow_ ? std::optional(any) : std::nullopt;
      case Kind::kTriangles:
        return free_ == 0 ? std::optional(any) : std::nullopt;
      case Kind::kRing:
        return any;
      case Kind::kRooms:
        return free_ == 0 ? pair_where(
                                starts, [&](Place p) { return marked(p) >= 0; },
                                [&](Place p) { return marked(p) < 0; })
                          : std::nullopt;
      case Kind::kTail: {
        const int deep = static_cast<int>(board_.marked.size()) - free_ - 2;
        const auto is_deep = [&](Place p) { return marked(p) >= 0 && marked(p) < deep; };
        return pair_where(starts, is_deep, is_deep);
      }
      case Kind::kCorridors:
        return std::nullopt;
    }
    return std::nullopt;
  }
  template <class First, class Second>
  static std::optional<Pair> pair_where(const std::vector<Place>& starts, First first,
                                        Second second) {
    const auto count = static_cast<int>(starts.size());
    for (int a = 0; a < count; ++a)
      for (int b = count - 1; b > a; --b)
        if ((first(starts[a]) && second(starts[b])) || (first(starts[b]) && second(starts[a])))
          return Pair{a, b};
    return std::nullopt;
  }
  int marked(Place place) const {
    const auto found = std::ranges::find(board_.marked, place);
    return found == board_.marked.end() ? -1 : static_cast<int>(found - board_.marked.begin());
  }

  Instance instance(const std::vector<Place>& starts, const std::vector<Place>& goals,
                    const std::vector<std::pair<int, Place>>& tasks) const {
    InstanceBuilder builder(board_.map());
    if (!may_follow_) builder.forbid_following();
    for (std::size_t agent = 0; agent < starts.size(); ++agent)
      builder.add_agent(fmt::format("a{}", agent), State{starts[agent]}, goals[agent]);
    for (std::size_t task = 0; task < tasks.size(); ++task)
      builder.add_task(fmt::format("t{}", task), tasks[task].second,
                       std::vector<std::string>{fmt::format("a{}", tasks[task].first)});
    return std::move(builder).build();
  }
  std::string name() const {
    constexpr const char* kNames[] = {"open",  "corridors", "tree",     "ring",
                                      "rooms", "tail",      "triangles"};
    return std::string(kNames[static_cast<int>(board_.kind)]) + ", " +
           std::to_string(board_.places.size()) + " places, " + std::to_string(free_) + " free" +
           (may_follow_ ? "" : ", no following");
  }

  Random random_;
  bool may_follow_ = true;
  int free_ = 0;
  CrowdBoard board_;
};

}  // namespace

TinyInstance tiny_crowd(std::uint64_t seed) {
  Random random(seed ^ 0x7C20D);
  TinyInstance crowd = tiny_board(random);
  crowd.may_follow = random.percent(50);
  std::vector<Position> cells = passable_cells(crowd.rows);
  shuffle_items(cells, random);
  const int places = place_count(crowd);
  const int agents =
      agents_that_fit(places, random.percent(50) ? random.below(2) : random.below(places));
  for (int agent = 0; agent < agents; ++agent) {
    TinyInstance::Agent a{.start = agent < static_cast<int>(cells.size()) ? cells[agent] : cells[0],
                          .goal = {}};
    crowd.agents.push_back(a);
  }
  // Agents without a cell start on the roads.
  int agent = static_cast<int>(cells.size());
  for (int road = 0; road < static_cast<int>(crowd.roads.size()); ++road)
    for (Time along = 1; along < crowd.roads[road].steps && agent < agents; ++along, ++agent) {
      crowd.agents[agent].road = road;
      crowd.agents[agent].along = along;
    }
  return crowd;
}

KnownCrowd known_crowd(std::uint64_t seed) {
  return CrowdMaker(seed).make();
}

}  // namespace grove::detail::fuzz
