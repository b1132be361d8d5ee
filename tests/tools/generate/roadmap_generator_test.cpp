// SPDX-License-Identifier: MIT
#include "tools/generate/roadmap_generator.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/tools/generate/reach.h"

namespace grove::detail {
namespace roadmap_generator_test {

const Vertex& vertex(const Roadmap& roadmap, const std::string& id) {
  return roadmap.vertices()[roadmap.vertex(id).value()];
}

double length(const Roadmap& roadmap, const Road& road) {
  const Point a = roadmap.vertices()[road.from].at;
  const Point b = roadmap.vertices()[road.to].at;
  return std::hypot(a.x - b.x, a.y - b.y);
}

std::string text(const Roadmap& roadmap) {
  std::string text;
  for (const Vertex& v : roadmap.vertices())
    text += fmt::format("{} {} {}\n", v.id, v.at.x, v.at.y);
  for (const Road& r : roadmap.roads())
    text += fmt::format("{} {} {} {}\n", r.from, r.to, r.steps, r.one_way);
  return text;
}

std::int64_t one_way_count(const Roadmap& roadmap) {
  return std::ranges::count(roadmap.roads(), true, &Road::one_way);
}

bool is_strongly_connected(const Roadmap& roadmap) {
  return std::ssize(reached_from(roadmap, 0)) == roadmap.place_count() &&
         std::ssize(reaching(roadmap, 0)) == roadmap.place_count();
}

// --- planar ---

// Coordinates in centimetres, so that the test of planarity is exact.
struct Segment {
  std::int64_t ax, ay, bx, by;
};

Segment segment(const Roadmap& roadmap, const Road& road) {
  const Point a = roadmap.vertices()[road.from].at;
  const Point b = roadmap.vertices()[road.to].at;
  return {std::llround(a.x * 100), std::llround(a.y * 100), std::llround(b.x * 100),
          std::llround(b.y * 100)};
}

// Returns the side of the segment's line on which the point lies: 1, -1, or 0 if it is on the line.
int side(const Segment& s, std::int64_t x, std::int64_t y) {
  const std::int64_t turn = (s.bx - s.ax) * (y - s.ay) - (s.by - s.ay) * (x - s.ax);
  return turn > 0 ? 1 : turn < 0 ? -1 : 0;
}

bool is_within_box(const Segment& s, std::int64_t x, std::int64_t y) {
  return std::min(s.ax, s.bx) <= x && x <= std::max(s.ax, s.bx) && std::min(s.ay, s.by) <= y &&
         y <= std::max(s.ay, s.by);
}

bool is_on(const Segment& s, std::int64_t x, std::int64_t y) {
  return side(s, x, y) == 0 && is_within_box(s, x, y);
}

// Returns whether two segments without a common end meet.
bool meet(const Segment& s, const Segment& t) {
  if (is_on(s, t.ax, t.ay) || is_on(s, t.bx, t.by) || is_on(t, s.ax, s.ay) || is_on(t, s.bx, s.by))
    return true;
  return side(s, t.ax, t.ay) * side(s, t.bx, t.by) < 0 &&
         side(t, s.ax, s.ay) * side(t, s.bx, s.by) < 0;
}

bool is_planar(const Roadmap& roadmap) {
  const auto& roads = roadmap.roads();
  for (std::size_t i = 0; i < roads.size(); ++i) {
    const Segment s = segment(roadmap, roads[i]);
    for (int v = 0; v < std::ssize(roadmap.vertices()); ++v) {
      const Point at = roadmap.vertices()[v].at;
      if (v != roads[i].from && v != roads[i].to &&
          is_on(s, std::llround(at.x * 100), std::llround(at.y * 100)))
        return false;
    }
    for (std::size_t j = 0; j < i; ++j) {
      const std::set<int> ends{roads[i].from, roads[i].to, roads[j].from, roads[j].to};
      if (ends.size() < 3) return false;  // parallel roads
      if (ends.size() == 4 && meet(s, segment(roadmap, roads[j]))) return false;
    }
  }
  return true;
}

// Returns whether removing the road disconnects its ends if all roads count as two-way.
bool is_bridge(const Roadmap& roadmap, std::size_t road) {
  std::vector<Road> others = roadmap.roads();
  const Road removed = others[road];
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(road));
  for (Road& other : others) other.one_way = false;
  return !reached_from(Roadmap(roadmap.vertices(), others), removed.from).contains(removed.to);
}

TEST(PlanarRoadmap, VerticesAreInTheRectangleAtLeastAStepApart) {
  const Roadmap roadmap = planar_roadmap(
      {.vertices = 150, .width = 40, .height = 20, .metres_per_step = 1.5, .seed = 3});
  ASSERT_EQ(roadmap.vertices().size(), 150U);
  for (std::size_t a = 0; a < 150; ++a) {
    const Vertex& v = roadmap.vertices()[a];
    EXPECT_EQ(v.id, fmt::format("v{}", a));
    EXPECT_TRUE(v.at.x >= 0 && v.at.x <= 40 && v.at.y >= 0 && v.at.y <= 20) << v.id;
    for (std::size_t b = 0; b < a; ++b) {
      const Point other = roadmap.vertices()[b].at;
      EXPECT_GE(std::hypot(v.at.x - other.x, v.at.y - other.y), 1.5 - 1e-9);
    }
  }
}

TEST(PlanarRoadmap, RoundsRoadLengthsUpToSteps) {
  const Roadmap roadmap = planar_roadmap({.vertices = 60, .metres_per_step = 0.7, .seed = 1});
  for (const Road& road : roadmap.roads()) {
    EXPECT_GE(road.steps * 0.7, length(roadmap, road) - 1e-6);
    EXPECT_LT((road.steps - 1) * 0.7, length(roadmap, road));
  }
}

TEST(PlanarRoadmap, IsPlanarAndStronglyConnected) {
  for (const int vertices : {2, 3, 10, 60}) {
    for (const int one_way : {0, 30, 100}) {
      for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Roadmap roadmap =
            planar_roadmap({.vertices = vertices, .one_way = one_way, .seed = seed});
        EXPECT_TRUE(is_planar(roadmap)) << text(roadmap);
        EXPECT_TRUE(is_strongly_connected(roadmap)) << text(roadmap);
      }
    }
  }
}

// In rectangles of a few centimetres, collinear and cocircular points are frequent.
TEST(PlanarRoadmap, IsPlanarAndConnectedWithCocircularPoints) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Roadmap roadmap = planar_roadmap(
        {.vertices = 12, .width = 0.05, .height = 0.04, .metres_per_step = 0.01, .seed = seed});
    EXPECT_TRUE(is_planar(roadmap)) << text(roadmap);
    EXPECT_TRUE(is_strongly_connected(roadmap)) << text(roadmap);
  }
}

TEST(PlanarRoadmap, HasTheRequestedShareOfOneWayRoads) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Roadmap roadmap = planar_roadmap({.vertices = 80, .one_way = 30, .seed = seed});
    const auto roads = static_cast<double>(roadmap.roads().size());
    EXPECT_EQ(one_way_count(roadmap), std::lround(roads * 0.3));
  }
  EXPECT_EQ(one_way_count(planar_roadmap({.one_way = 0})), 0);
}

TEST(PlanarRoadmap, KeepsOnlyBridgesTwoWay) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Roadmap roadmap = planar_roadmap({.vertices = 40, .one_way = 100, .seed = seed});
    for (std::size_t k = 0; k < roadmap.roads().size(); ++k)
      EXPECT_EQ(!roadmap.roads()[k].one_way, is_bridge(roadmap, k)) << text(roadmap) << k;
  }
}

TEST(PlanarRoadmap, DependsOnlyOnTheSeed) {
  const PlanarRequest request{.vertices = 30, .one_way = 20, .seed = 5};
  PlanarRequest another = request;
  another.seed = 6;
  EXPECT_EQ(text(planar_roadmap(request)), text(planar_roadmap(request)));
  EXPECT_NE(text(planar_roadmap(request)), text(planar_roadmap(another)));
}

TEST(PlanarRoadmap, RefusesMoreVerticesThanFit) {
  EXPECT_THROW(planar_roadmap({.vertices = 200, .width = 10, .height = 10}), std::invalid_argument);
}

// --- warehouse ---

int ids_with(const Roadmap& roadmap, char letter) {
  return static_cast<int>(std::ranges::count_if(
      roadmap.vertices(), [&](const Vertex& v) { return v.id.starts_with(letter); }));
}

bool leads(const Roadmap& roadmap, const std::string& from, const std::string& to) {
  const int a = roadmap.vertex(from).value();
  const int b = roadmap.vertex(to).value();
  const auto between = roadmap.roads_between(a, b);
  return between.size() == 1 && roadmap.roads()[between[0]].from == a &&
         roadmap.roads()[between[0]].one_way;
}

TEST(WarehouseRoadmap, HasTheRequestedSlotsAndBays) {
  const Roadmap roadmap =
      warehouse_roadmap({.aisles = 6, .slots = 7, .cross_aisles = 3, .bays = 2});
  EXPECT_EQ(ids_with(roadmap, 'a'), 6 * 7);
  EXPECT_EQ(ids_with(roadmap, 'c'), 6 * 3 * 2);
  EXPECT_EQ(ids_with(roadmap, 'p'), 5 * 2 * 2);
  EXPECT_EQ(ids_with(roadmap, 'g'), 5 * 2 * 2);
  EXPECT_EQ(ids_with(warehouse_roadmap({.bays = 0}), 'p'), 0);
}

TEST(WarehouseRoadmap, IsStronglyConnected) {
  for (const int aisles : {2, 4, 20})
    for (const int cross_aisles : {2, 3, 5})
      for (const int bays : {0, 3})
        EXPECT_TRUE(is_strongly_connected(warehouse_roadmap(
            {.aisles = aisles, .slots = 9, .cross_aisles = cross_aisles, .bays = bays})));
}

TEST(WarehouseRoadmap, AislesAndLanesAreOneWay) {
  const Roadmap roadmap =
      warehouse_roadmap({.aisles = 4, .slots = 4, .cross_aisles = 3, .bays = 1});
  EXPECT_TRUE(leads(roadmap, "a1s0", "a1s1"));
  EXPECT_TRUE(leads(roadmap, "a1s1", "c1e1"));
  EXPECT_TRUE(leads(roadmap, "c1e1", "c1w1"));
  EXPECT_TRUE(leads(roadmap, "c1w1", "a1s2"));
  EXPECT_TRUE(leads(roadmap, "a2s1", "a2s0"));
  EXPECT_TRUE(leads(roadmap, "a2s0", "c0w2"));
  EXPECT_TRUE(leads(roadmap, "c1e1", "c1e2"));
  EXPECT_TRUE(leads(roadmap, "c1w2", "c1w1"));
  EXPECT_TRUE(leads(roadmap, "c0e0", "g0"));
  EXPECT_TRUE(leads(roadmap, "g0", "c0e1"));
  EXPECT_TRUE(leads(roadmap, "g3", "c2w0"));
  for (const Road& road : roadmap.roads())
    EXPECT_EQ(road.one_way, !roadmap.vertices()[road.to].id.starts_with('p'));
}

TEST(WarehouseRoadmap, IsMeasuredInMetres) {
  const Roadmap roadmap = warehouse_roadmap({.aisles = 4,
                                             .slots = 4,
                                             .cross_aisles = 2,
                                             .bays = 3,
                                             .aisle_spacing = 6,
                                             .slot_spacing = 1.2,
                                             .metres_per_step = 0.5});
  EXPECT_EQ(vertex(roadmap, "c0e0").at, (Point{0, 0}));
  EXPECT_EQ(vertex(roadmap, "c0w1").at, (Point{6, 1.2}));
  EXPECT_EQ(vertex(roadmap, "a3s0").at, (Point{18, 2.4}));
  EXPECT_EQ(vertex(roadmap, "g1").at, (Point{3, 0}));
  EXPECT_EQ(vertex(roadmap, "p1").at, (Point{3, -1.2}));
  EXPECT_EQ(vertex(roadmap, "p9").at, (Point{1.5, 9.6}));
  for (const Road& road : roadmap.roads())
    EXPECT_EQ(road.steps, std::lround(std::ceil(length(roadmap, road) / 0.5 - 1e-6)));
}

TEST(WarehouseRoadmap, RefusesInvalidSizes) {
  EXPECT_THROW(warehouse_roadmap({.aisles = 7}), std::invalid_argument);
  EXPECT_THROW(warehouse_roadmap({.slots = 2, .cross_aisles = 4}), std::invalid_argument);
  EXPECT_NO_THROW(warehouse_roadmap({.slots = 3, .cross_aisles = 4}));
}

TEST(StepsOf, RoundUp) {
  EXPECT_EQ(steps_of(3, 1), 3);
  EXPECT_EQ(steps_of(3.01, 1), 4);
  EXPECT_EQ(steps_of(0.3, 0.1), 3);
  EXPECT_EQ(steps_of(0.2, 1), 1);
}

}  // namespace roadmap_generator_test
}  // namespace grove::detail
