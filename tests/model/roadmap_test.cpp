// SPDX-License-Identifier: MIT
#include "model/roadmap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "model/distance_field.h"

namespace grove::detail {
namespace roadmap_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

// A =3= B >2> C, and C >1> A. "=": two-way; ">": one-way; the number is the length in steps.
Roadmap triangle() {
  return Roadmap({{"A", {0, 0}}, {"B", {3, 0}}, {"C", {3, 4}}},
                 {{0, 1, 3, false}, {1, 2, 2, true}, {2, 0, 1, true}});
}

TEST(Roadmap, HasAPlaceForEachStepOfARoad) {
  const Roadmap roadmap = triangle();
  EXPECT_EQ(roadmap.place_count(), 3 + 2 + 1);
  EXPECT_EQ(roadmap.place_on_road(0, 0), 0);
  EXPECT_EQ(roadmap.place_on_road(0, 1), 3);
  EXPECT_EQ(roadmap.place_on_road(0, 2), 4);
  EXPECT_EQ(roadmap.place_on_road(0, 3), 1);
  EXPECT_EQ(roadmap.place_on_road(1, 1), 5);
  EXPECT_EQ(roadmap.spot(2).vertex, 2);
  EXPECT_EQ(roadmap.spot(4).road, 0);
  EXPECT_EQ(roadmap.spot(4).steps, 2);
  EXPECT_EQ(roadmap.at(4), (Point{2, 0}));
  EXPECT_EQ(roadmap.at(5), (Point{3, 2}));
}

TEST(Roadmap, MovesFollowTheDirectionsOfRoads) {
  const Roadmap roadmap = triangle();
  EXPECT_THAT(roadmap.moves(0), ElementsAre(3));
  EXPECT_THAT(roadmap.moves(3), UnorderedElementsAre(0, 4));
  EXPECT_THAT(roadmap.moves(1), UnorderedElementsAre(4, 5));
  EXPECT_THAT(roadmap.moves(5), ElementsAre(2));
  EXPECT_THAT(roadmap.moves_to(0), UnorderedElementsAre(2, 3));
  EXPECT_THAT(roadmap.moves_to(5), ElementsAre(1));
  EXPECT_THAT(roadmap.neighbors(5), UnorderedElementsAre(1, 2));
  EXPECT_FALSE(roadmap.is_plain());
  EXPECT_TRUE(Roadmap({{"A", {}}, {"B", {}}}, {{0, 1, 2, false}}).is_plain());
}

TEST(Roadmap, DistancesFollowTheDirections) {
  EXPECT_THAT(distance_field(triangle(), 0), ElementsAre(0, 3, 1, 1, 2, 2));
  EXPECT_THAT(distance_field(triangle(), 2), ElementsAre(5, 2, 0, 4, 3, 1));
  const Roadmap trap({{"A", {}}, {"B", {}}}, {{0, 1, 1, true}});
  EXPECT_THAT(distance_field(trap, 0), ElementsAre(0, kNever));
}

TEST(Roadmap, NamesItsPlaces) {
  const Roadmap roadmap({{"A", {}}, {"B", {}}, {"C", {}}},
                        {{0, 1, 2, true}, {1, 0, 2, true}, {1, 2, 2, false}});
  EXPECT_EQ(roadmap.name(1), "[\"B\"]");
  EXPECT_EQ(roadmap.name(roadmap.place_on_road(2, 1)), "[\"B\", \"C\", 1]");
  EXPECT_EQ(roadmap.name(roadmap.place_on_road(1, 1)), "[\"B\", \"A\", 1, 1]");
  EXPECT_THAT(roadmap.roads_between(0, 1), ElementsAre(0, 1));
  EXPECT_THAT(roadmap.roads_between(2, 0), IsEmpty());
}

TEST(Roadmap, TwoRoadsOfOneStepAreOneMove) {
  const Roadmap roadmap({{"A", {}}, {"B", {}}}, {{0, 1, 1, false}, {1, 0, 1, true}});
  EXPECT_THAT(roadmap.moves(1), ElementsAre(0));
  EXPECT_THAT(roadmap.moves(0), ElementsAre(1));
}

TEST(Roadmap, RefusesInvalidRoadmaps) {
  const std::vector<Vertex> two{{"A", {}}, {"B", {}}};
  EXPECT_THROW(Roadmap({}, {}), std::invalid_argument);
  EXPECT_THROW(Roadmap({{"A", {}}, {"A", {}}}, {}), std::invalid_argument);
  EXPECT_THROW(Roadmap({{"", {}}}, {}), std::invalid_argument);
  EXPECT_THROW(Roadmap(two, {{0, 2, 1, false}}), std::invalid_argument);
  EXPECT_THROW(Roadmap(two, {{0, 0, 3, false}}), std::invalid_argument);
  EXPECT_THROW(Roadmap(two, {{0, 1, 0, false}}), std::invalid_argument);
  EXPECT_THROW(Roadmap(two, {{0, 1, Roadmap::kMaxPlaces, false}}), std::invalid_argument);
}

}  // namespace roadmap_test
}  // namespace grove::detail
