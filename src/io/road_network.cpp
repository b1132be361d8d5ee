// SPDX-License-Identifier: MIT
#include "io/road_network.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include "io/input_error.h"
#include "model/assert.h"

namespace grove::detail {
namespace {

// Quotients within this relative distance of an integer count as the integer. Due to rounding, 1.2
// / 0.4 is slightly less than 3, and other quotients and lengths computed from positions can be
// slightly too large. No robot is that accurate.
constexpr double kNoise = 1e-9;

double without_noise(double steps) {
  const double whole = std::round(steps);
  return std::abs(steps - whole) <= kNoise * std::max(1.0, whole) ? whole : steps;
}

double exact_steps(const RoadNetwork& network, const Link& link, const StepScale& scale) {
  double steps = 0;
  if (scale.metres_per_step) steps = link.metres / *scale.metres_per_step;
  if (scale.seconds_per_step && link.seconds)
    steps = std::max(steps, *link.seconds / *scale.seconds_per_step);
  else if (!scale.metres_per_step)
    throw InputError(network.file, link.place,
                     "this edge has no time; expected a maximum speed (LIF), a duration (GraphML), "
                     "or --metres-per-step for the speed of the robots");
  return steps;
}

Rounding rounded_up(const RoadNetwork& network, int index, const StepScale& scale) {
  const Link& link = network.links[index];
  const double exact = exact_steps(network, link, scale);
  if (!(exact <= Roadmap::kMaxPlaces))
    throw InputError(
        network.file, link.place,
        fmt::format("this edge takes {:.6g} steps; expected at most {}; use longer steps", exact,
                    Roadmap::kMaxPlaces));
  const double tidy = without_noise(exact);
  const Time steps = std::max<Time>(1, static_cast<Time>(std::ceil(tidy)));
  return {tidy == steps ? -1 : index, tidy == steps ? tidy : exact, steps};
}

void require_room(const RoadNetwork& network, const Link& link, std::int64_t places,
                  const InputRules& rules) {
  require_memory(rules, network.file, link.place, places, "places of the roads up to this one",
                 kBytesPerPlace);
  if (places > Roadmap::kMaxPlaces)
    throw InputError(
        network.file, link.place,
        fmt::format(
            "the roads up to this one have more than {} places; expected fewer; use longer steps",
            Roadmap::kMaxPlaces));
}

// Returns the one-way roads, grouped by their unordered pair of ends. Within a group the roads in
// one direction come before those in the other direction, and the roads in each direction are
// sorted by steps.
std::vector<int> by_ends(const std::vector<Road>& roads) {
  std::vector<int> order;
  for (std::size_t r = 0; r < roads.size(); ++r)
    if (roads[r].one_way) order.push_back(static_cast<int>(r));
  std::ranges::sort(order, {}, [&](int r) {
    const Road& road = roads[r];
    return std::tuple(std::min(road.from, road.to), std::max(road.from, road.to),
                      road.from > road.to, road.steps, r);
  });
  return order;
}

// Calls visit(there, back) for each unordered pair of vertices that one-way roads join, with the
// one-way roads in one direction and those in the opposite direction, each sorted by steps.
template <typename Visit>
void for_each_pair_of_ends(const std::vector<Road>& roads, Visit visit) {
  const std::vector<int> order = by_ends(roads);
  const auto ends = [&](int r) { return std::minmax(roads[r].from, roads[r].to); };
  for (auto begin = order.begin(); begin != order.end();) {
    const auto key = std::pair<int, int>(ends(*begin));
    const auto end = std::find_if(begin, order.end(),
                                  [&](int r) { return std::pair<int, int>(ends(r)) != key; });
    const auto back = std::find_if(begin, end, [&](int r) { return roads[r].from > roads[r].to; });
    visit(std::vector<int>(begin, back), std::vector<int>(back, end));
    begin = end;
  }
}

// Matches opposite roads with equal numbers of steps, each road at most once. Precondition: `there`
// and `back` are sorted by steps.
std::vector<std::pair<int, int>> pairs_alike(const std::vector<Road>& roads,
                                             const std::vector<int>& there,
                                             const std::vector<int>& back) {
  const auto steps = [&](int road) { return roads[road].steps; };
  GROVE_CHECK(std::ranges::is_sorted(there, {}, steps) && std::ranges::is_sorted(back, {}, steps),
              "roads are matched in order of their steps");
  std::vector<std::pair<int, int>> pairs;
  for (auto a = there.begin(), b = back.begin(); a != there.end() && b != back.end();) {
    const Time steps_a = roads[*a].steps;
    const Time steps_b = roads[*b].steps;
    if (steps_a == steps_b) pairs.emplace_back(*a, *b);
    if (steps_a <= steps_b) ++a;
    if (steps_b <= steps_a) ++b;
  }
  return pairs;
}

}  // namespace

SteppedRoads in_steps(const RoadNetwork& network, const StepScale& scale, const InputRules& rules) {
  SteppedRoads result;
  std::int64_t places = std::ssize(network.vertices);
  for (std::size_t k = 0; k < network.links.size(); ++k) {
    const Link& link = network.links[k];
    if (link.from == link.to)
      throw InputError(network.file, link.place,
                       "leads from a node to itself; expected two different nodes");
    const Rounding rounding = rounded_up(network, static_cast<int>(k), scale);
    places += rounding.steps - 1;
    require_room(network, link, places, rules);
    result.roads.push_back({link.from, link.to, rounding.steps, link.one_way});
    if (rounding.link < 0) continue;
    if (rounding.absolute() > result.max_absolute.absolute()) result.max_absolute = rounding;
    if (rounding.relative() > result.max_relative.relative()) result.max_relative = rounding;
  }
  return result;
}

OppositeRoads opposite_roads(const std::vector<Road>& roads) {
  OppositeRoads count;
  for_each_pair_of_ends(roads, [&](const std::vector<int>& there, const std::vector<int>& back) {
    const auto pairs = pairs_alike(roads, there, back);
    count.alike += static_cast<int>(pairs.size());
    count.unlike += static_cast<int>(std::min(there.size(), back.size()) - pairs.size());
    count.single_step += static_cast<int>(std::ranges::count_if(
        pairs, [&](const auto& pair) { return roads[pair.first].steps == 1; }));
  });
  return count;
}

std::vector<Road> with_merged_lanes(const std::vector<Road>& roads) {
  std::vector<Road> changed = roads;
  std::vector<bool> is_gone(roads.size());
  for_each_pair_of_ends(roads, [&](const std::vector<int>& there, const std::vector<int>& back) {
    for (const auto& pair : pairs_alike(roads, there, back)) {
      GROVE_CHECK(!is_gone[pair.first] && !is_gone[pair.second], "a lane is merged once");
      changed[std::min(pair.first, pair.second)].one_way = false;
      is_gone[std::max(pair.first, pair.second)] = true;
    }
  });
  std::vector<Road> left;
  for (std::size_t r = 0; r < roads.size(); ++r)
    if (!is_gone[r]) left.push_back(changed[r]);
  return left;
}

}  // namespace grove::detail
