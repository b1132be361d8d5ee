// SPDX-License-Identifier: MIT
#include "io/lif_file.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace lif_file_test {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.replace(text.find(from), from.size(), to);
}

const std::string kPlant = R"({
  "metaInformation": {"projectIdentification": "plant", "creator": "x", "lifVersion": "1.0.0"},
  "layouts": [{
    "layoutId": "hall", "layoutVersion": "1",
    "nodes": [
      {"nodeId": "in", "mapId": "m", "nodePosition": {"x": -1.5, "y": 0},
       "vehicleTypeNodeProperties": [{"vehicleTypeId": "T", "theta": 0.0}]},
      {"nodeId": "out", "nodePosition": {"x": 1.5, "y": 4}}],
    "edges": [
      {"edgeId": "e1", "startNodeId": "in", "endNodeId": "out",
       "vehicleTypeEdgeProperties": [{"vehicleTypeId": "T", "maxSpeed": 0.5}]},
      {"edgeId": "e2", "startNodeId": "out", "endNodeId": "in"}],
    "stations": [{"stationId": "S", "interactionNodeIds": ["in"]}]}]})";

// Two floors connected by a lift.
const std::string kFloors = R"({"layouts": [
  {"layoutId": "low", "nodes": [{"nodeId": "A", "nodePosition": {"x": 0, "y": 0}},
                                {"nodeId": "B", "nodePosition": {"x": 2, "y": 0}}],
   "edges": [{"edgeId": "AB", "startNodeId": "A", "endNodeId": "B"},
             {"edgeId": "BC", "startNodeId": "B", "endNodeId": "C"}]},
  {"layoutId": "high", "nodes": [{"nodeId": "C", "nodePosition": {"x": 2, "y": 0}}],
   "edges": [{"edgeId": "CB", "startNodeId": "C", "endNodeId": "B"}]}]})";

// Vehicle types T1 and T2, which may use different nodes and edges.
const std::string kTypes = R"({"layouts": [{"layoutId": "l", "nodes": [
    {"nodeId": "A", "nodePosition": {"x": 0, "y": 0}, "vehicleTypeNodeProperties":
      [{"vehicleTypeId": "T1"}, {"vehicleTypeId": "T2"}]},
    {"nodeId": "B", "nodePosition": {"x": 2, "y": 0}, "vehicleTypeNodeProperties":
      [{"vehicleTypeId": "T1"}, {"vehicleTypeId": "T2"}]},
    {"nodeId": "C", "nodePosition": {"x": 2, "y": 2}, "vehicleTypeNodeProperties":
      [{"vehicleTypeId": "T1"}]}],
  "edges": [
    {"edgeId": "AB", "startNodeId": "A", "endNodeId": "B", "vehicleTypeEdgeProperties":
      [{"vehicleTypeId": "T1", "maxSpeed": 1}, {"vehicleTypeId": "T2", "maxSpeed": 2}]},
    {"edgeId": "BA", "startNodeId": "B", "endNodeId": "A", "vehicleTypeEdgeProperties":
      [{"vehicleTypeId": "T2"}]},
    {"edgeId": "BC", "startNodeId": "B", "endNodeId": "C", "vehicleTypeEdgeProperties":
      [{"vehicleTypeId": "T1"}, {"vehicleTypeId": "T2"}]}]}]})";

std::string with_trajectory(const std::string& trajectory) {
  return replaced(kPlant, "\"maxSpeed\": 0.5", "\"trajectory\": " + trajectory);
}

std::string refused(const std::string& text, const LifChoice& choice = {}) {
  return refusal([&] { parse_lif(text, "p.lif.json", choice); });
}

TEST(LifFile, EdgesAreOneWayRoads) {
  std::vector<std::string> warnings;
  const RoadNetwork network = parse_lif(kPlant, "p", {}, &warnings);
  EXPECT_TRUE(warnings.empty());
  ASSERT_EQ(network.vertices.size(), 2u);
  EXPECT_EQ(network.vertices[0].id, "in");
  EXPECT_EQ(network.vertices[0].at, (Point{-1.5, 0}));
  ASSERT_EQ(network.links.size(), 2u);
  EXPECT_TRUE(network.links[0].one_way);
  EXPECT_DOUBLE_EQ(network.links[0].metres, 5);
  EXPECT_DOUBLE_EQ(network.links[0].seconds.value(), 10);
  EXPECT_EQ(network.links[1].from, 1);
  EXPECT_EQ(network.links[1].to, 0);
  EXPECT_FALSE(network.links[1].seconds);
  EXPECT_EQ(network.links[1].place, "/layouts/0/edges/1");
}

TEST(LifFile, NullAndEmptyPropertiesAreIgnored) {
  EXPECT_FALSE(parse_lif(replaced(kPlant, "0.5", "null"), "p").links[0].seconds);
  EXPECT_FALSE(
      parse_lif(replaced(kPlant, R"([{"vehicleTypeId": "T", "maxSpeed": 0.5}])", "[]"), "p")
          .links[0]
          .seconds);
}

TEST(LifFile, SeveralLayoutsRequireAChoice) {
  EXPECT_EQ(refused(kFloors),
            "p.lif.json: /layouts: found 2 layouts; expected --layout with one of 'high', 'low'");
  EXPECT_EQ(refused(kFloors, {.layout = "roof"}),
            "p.lif.json: /layouts: there is no layout 'roof'; expected one of 'high', 'low'");
  std::vector<std::string> warnings;
  const RoadNetwork low = parse_lif(kFloors, "p", {.layout = "low"}, &warnings);
  EXPECT_EQ(low.vertices.size(), 2u);
  ASSERT_EQ(low.links.size(), 1u);
  EXPECT_EQ(low.links[0].place, "/layouts/0/edges/0");
  EXPECT_EQ(warnings,
            (std::vector<std::string>{
                "p: /layouts/0/edges: 1 edges lead from or to another layout and are left out"}));
  EXPECT_EQ(parse_lif(kFloors, "p", {.layout = "high"}).vertices[0].id, "C");
}

TEST(LifFile, SeveralVehicleTypesRequireAChoice) {
  EXPECT_EQ(
      refused(kTypes),
      "p.lif.json: /layouts/0: found 2 vehicle types with different roads and speeds; expected "
      "--vehicle-type with one of 'T1', 'T2'");
  EXPECT_EQ(refused(kTypes, {.vehicle_type = "T3"}),
            "p.lif.json: /layouts/0: there is no vehicle type 'T3'; expected one of 'T1', 'T2'");
  EXPECT_EQ(refused(kFloors, {.layout = "low", .vehicle_type = "T"}),
            "p.lif.json: /layouts/0: has no vehicle types; expected no --vehicle-type");
  const RoadNetwork first = parse_lif(kTypes, "p", {.vehicle_type = "T1"});
  EXPECT_EQ(first.vertices.size(), 3u);
  ASSERT_EQ(first.links.size(), 2u);  // AB and BC
  EXPECT_EQ(first.links[0].seconds, 2);
  EXPECT_EQ(first.links[1].to, 2);
  const RoadNetwork second = parse_lif(kTypes, "p", {.vehicle_type = "T2"});
  EXPECT_EQ(second.vertices.size(), 2u);
  ASSERT_EQ(second.links.size(), 2u);  // AB and BA
  EXPECT_EQ(second.links[0].seconds, 1);
  EXPECT_EQ(second.links[1].from, 1);
}

TEST(LifFile, TrajectoriesGiveTheLength) {
  // First an exact quarter circle of radius 6, then a polyline with a corner and the default
  // degree.
  const RoadNetwork arc =
      parse_lif(with_trajectory(R"({"degree": 2.0, "knotVector": [0,0,0,1,1,1], "controlPoints": [
        {"x": 6, "y": 0}, {"x": 6, "y": 6, "weight": 0.70710678118654757}, {"x": 0, "y": 6}]})"),
                "p");
  EXPECT_NEAR(arc.links[0].metres, 3 * std::numbers::pi, 1e-3);
  const RoadNetwork corner =
      parse_lif(with_trajectory(R"({"knotVector": [0,0,0.25,1,1], "controlPoints":
        [{"x": 0, "y": 0}, {"x": 3, "y": 4}, {"x": 3, "y": 10}]})"),
                "p");
  EXPECT_NEAR(corner.links[0].metres, 11, 1e-9);
  // A cubic with an interior knot that is a straight line, so that its length is known.
  const RoadNetwork straight = parse_lif(
      with_trajectory(R"({"degree": 3, "knotVector": [0,0,0,0,0.5,1,1,1,1], "controlPoints":
        [{"x": 0, "y": 0}, {"x": 1, "y": 0}, {"x": 4, "y": 0}, {"x": 5, "y": 0}, {"x": 8, "y": 0}]})"),
      "p");
  EXPECT_NEAR(straight.links[0].metres, 8, 1e-9);
  // Some exporters write local coordinates. The length is never below the straight-line distance of
  // the nodes.
  const RoadNetwork elsewhere = parse_lif(
      with_trajectory(
          R"({"knotVector": [0,0,1,1], "controlPoints": [{"x": 0, "y": 0}, {"x": 1, "y": 0}]})"),
      "p");
  EXPECT_DOUBLE_EQ(elsewhere.links[0].metres, 5);
}

TEST(LifFile, WarnsOnceAboutEachUnknownKey) {
  std::vector<std::string> warnings;
  std::string text = replaced(kPlant, "\"nodeId\": \"in\"", "\"nodeId\": \"in\", \"colour\": 1");
  parse_lif(replaced(text, "\"nodeId\": \"out\"", "\"nodeId\": \"out\", \"colour\": 1"), "p", {},
            &warnings);
  EXPECT_EQ(warnings,
            (std::vector<std::string>{"p: /layouts/0/nodes/0: unknown key 'colour' is ignored"}));
}

TEST(LifFile, AcceptsAByteOrderMark) {
  const TemporaryDirectory directory;
  EXPECT_EQ(read_lif(directory.write("p.lif.json", "\xEF\xBB\xBF" + kPlant)).links.size(), 2u);
}

TEST(LifFile, RefusesInvalidFilesWithThePlace) {
  const auto curve = [](const std::string& degree, const std::string& knots,
                        const std::string& points) {
    return with_trajectory("{\"degree\": " + degree + ", \"knotVector\": " + knots +
                           ", \"controlPoints\": " + points + "}");
  };
  const std::string two = R"([{"x": 0, "y": 0}, {"x": 1, "y": 0}])";
  struct Bad {
    std::string text;
    std::string message;  // after "p.lif.json: "
  };
  const std::string node = "/layouts/0/nodes/0";
  const std::string edge = "/layouts/0/edges/0";
  const std::string properties = edge + "/vehicleTypeEdgeProperties/0";
  const std::vector<Bad> all = {
      {"", "is empty; expected a JSON object"},
      {"[]", "/: found an array; expected a JSON object"},
      {"{}", "/: key 'layouts' is missing; expected it in this object"},
      {R"({"origins": []})", "/: found 'origins', a key of LIF 2; expected 'layouts', as in LIF 1"},
      {R"({"layouts": {}})", "/layouts: found an object; expected an array"},
      {R"({"layouts": []})", "/layouts: expected at least one layout"},
      {R"({"layouts": [7]})", "/layouts/0: found 7; expected an object"},
      {R"({"layouts": [{}]})", "/layouts/0: key 'layoutId' is missing; expected it in this object"},
      {replaced(kFloors, "high", "low"),
       "/layouts/1/layoutId: id 'low' is used twice; expected distinct ids"},
      {replaced(kPlant, "\"nodes\"", "\"nudes\""),
       "/layouts/0: key 'nodes' is missing; expected it in this object"},
      {replaced(kPlant, "\"edges\"", "\"hedges\""),
       "/layouts/0: key 'edges' is missing; expected it in this object"},
      {R"({"layouts": [{"layoutId": "l", "nodes": [], "edges": []}]})",
       "/layouts/0/nodes: expected at least one node"},
      {replaced(kPlant, "\"nodeId\": \"in\", ", ""),
       node + ": key 'nodeId' is missing; expected it in this object"},
      {replaced(kPlant, "\"nodeId\": \"in\"", "\"nodeId\": 1"),
       node + "/nodeId: found 1; expected a string"},
      {replaced(kPlant, "\"nodeId\": \"in\"", "\"nodeId\": \"\""),
       node + "/nodeId: expected an id that is not empty"},
      {replaced(kPlant, "\"nodeId\": \"out\"", "\"nodeId\": \"in\""),
       "/layouts/0/nodes/1/nodeId: id 'in' is used twice; expected distinct ids"},
      {replaced(kPlant, "\"nodePosition\": {\"x\": -1.5, \"y\": 0}", "\"nodePosition\": [0, 0]"),
       node + "/nodePosition: found an array; expected an object"},
      {replaced(kPlant, "\"x\": -1.5", "\"x\": \"-1.5\""),
       node + "/nodePosition/x: found \"-1.5\"; expected a number"},
      {replaced(kPlant, "\"x\": -1.5", "\"x\": null"),
       node + "/nodePosition/x: found null; expected a number"},
      {replaced(kPlant, "\"edgeId\": \"e2\"", "\"edgeId\": \"e1\""),
       "/layouts/0/edges/1/edgeId: id 'e1' is used twice; expected distinct ids"},
      {replaced(kPlant, "\"edgeId\": \"e1\", ", ""),
       edge + ": key 'edgeId' is missing; expected it in this object"},
      {replaced(kPlant, "\"startNodeId\": \"in\", ", ""),
       edge + ": key 'startNodeId' is missing; expected it in this object"},
      {replaced(kPlant, "\"endNodeId\": \"out\"", "\"endNodeId\": \"up\""),
       edge + "/endNodeId: there is no node 'up'; expected the id of one of this file"},
      {replaced(kPlant, "\"endNodeId\": \"out\"", "\"endNodeId\": \"in\""),
       edge + ": has a length of 0 m; expected ends, or a trajectory, at a positive distance"},
      {replaced(replaced(kPlant, "\"x\": -1.5", "\"x\": -1e308"), "\"x\": 1.5", "\"x\": 1e308"),
       edge + ": has a length of inf m; expected ends, or a trajectory, at a positive distance"},
      {replaced(kPlant, "0.5", "0"),
       properties + "/maxSpeed: found 0; expected a positive number of metres per second"},
      {replaced(kPlant, "0.5", "-1"),
       properties + "/maxSpeed: found -1; expected a positive number of metres per second"},
      {replaced(kPlant, "0.5", "\"fast\""),
       properties + "/maxSpeed: found \"fast\"; expected a number"},
      {replaced(kPlant, "{\"vehicleTypeId\": \"T\", \"maxSpeed\"", "{\"maxSpeed\""),
       properties + ": key 'vehicleTypeId' is missing; expected it in this object"},
      {replaced(kPlant, "0.5}", "0.5}, {\"vehicleTypeId\": \"T\"}"),
       edge +
           "/vehicleTypeEdgeProperties/1/vehicleTypeId: vehicle type 'T' appears twice; expected "
           "distinct ones"},
      {curve("0", "[0,0,1,1]", two),
       properties + "/trajectory/degree: found 0; expected a whole number from 1 to 16"},
      {curve("1.5", "[0,0,1,1]", two),
       properties + "/trajectory/degree: found 1.5; expected a whole number from 1 to 16"},
      {curve("1e300", "[0,0,1,1]", two),
       properties + "/trajectory/degree: found 1e+300; expected a whole number from 1 to 16"},
      {curve("2", "[0,0,1,1]", two),
       properties + "/trajectory/controlPoints: found 2 points; expected more than the degree, 2"},
      {curve("1", "[0,0,1]", two),
       properties +
           "/trajectory/knotVector: found 3 knots; expected 4, for 2 control points and degree 1"},
      {curve("1", "[0,1,0.5,1]", two),
       properties + "/trajectory/knotVector/2: found 0.5; expected at least the knot before"},
      {curve("1", "[0,0,1,1]", R"([{"x": 0, "y": 0, "weight": 0}, {"x": 1, "y": 0}])"),
       properties + "/trajectory/controlPoints/0/weight: found 0; expected a positive number"},
      {replaced(kPlant, "\"layoutVersion\": \"1\"", "\"layoutId\": \"1\""),
       "/layouts/0: key 'layoutId' appears twice; expected distinct keys"},
  };
  for (const Bad& bad : all) EXPECT_EQ(refused(bad.text), "p.lif.json: " + bad.message) << bad.text;
}

TEST(LifFile, DamagedTextsAreReadOrRefused) {
  for (std::size_t k = 0; k < kPlant.size(); ++k) {
    std::string changed = kPlant;
    changed[k] = static_cast<char>(changed[k] ^ (1 << (k % 8)));
    for (const std::string& broken : {kPlant.substr(0, k), changed}) {
      const std::string message = refused(broken);
      EXPECT_TRUE(message == "accepted" || message.starts_with("p.lif.json: ")) << message;
    }
  }
}

}  // namespace lif_file_test
}  // namespace grove::detail
