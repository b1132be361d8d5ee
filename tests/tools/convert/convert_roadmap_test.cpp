// SPDX-License-Identifier: MIT
// Tests `grove convert` from GraphML and LIF to roadmaps as users call it.
#include <gtest/gtest.h>

#include "tests/support/temporary_directory.h"
#include "tests/tools/program.h"

namespace grove::detail {
namespace convert_roadmap_test {

using Arguments = std::vector<std::string>;

// Written by hand in the style of networkx, with an aisle of 4 m and a ramp of 2.6 m.
const std::string kGraphml = R"(<?xml version='1.0' encoding='utf-8'?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns">
  <key id="d2" for="edge" attr.name="length" attr.type="double" />
  <key id="d1" for="node" attr.name="y" attr.type="double" />
  <key id="d0" for="node" attr.name="x" attr.type="double" />
  <graph edgedefault="undirected">
    <node id="dock"><data key="d0">0.0</data><data key="d1">0.0</data></node>
    <node id="mid"><data key="d0">4.0</data><data key="d1">0.0</data></node>
    <node id="end"><data key="d0">4.0</data><data key="d1">2.5</data></node>
    <edge source="dock" target="mid" />
    <edge source="mid" target="end"><data key="d2">2.6</data></edge>
    <edge source="end" target="dock" directed="true"><data key="d2">6</data></edge>
  </graph>
</graphml>
)";

std::string lif_node(const std::string& id, const std::string& x, const std::string& y) {
  return R"({"nodeId": ")" + id + R"(", "mapId": "m", "nodePosition": {"x": )" + x + R"(, "y": )" +
         y + R"(}, "vehicleTypeNodeProperties": [{"vehicleTypeId": "T"}]})";
}
std::string lif_edge(const std::string& from, const std::string& to, const std::string& speed) {
  return R"({"edgeId": ")" + from + to + R"(", "startNodeId": ")" + from + R"(", "endNodeId": ")" +
         to +
         R"(", "vehicleTypeEdgeProperties": [{"vehicleTypeId": "T", "rotationAllowed": false, )"
         R"("maxSpeed": )" +
         speed + "}]}";
}
// A street from "in" to "out" with a press next to it; each road has an edge in both directions.
const std::string kLif =
    R"({"metaInformation": {"projectIdentification": "plant", "creator": "us",
  "exportTimestamp": "2024-03-01T10:00:00.00Z", "lifVersion": "1.0.0"},
 "layouts": [{"layoutId": "hall", "layoutVersion": "1", "nodes": [)" +
    lif_node("in", "0", "0") + ",\n" + lif_node("fork", "5.2", "0") + ",\n" +
    lif_node("out", "10.4", "0") + ",\n" + lif_node("press", "5.2", "4") + R"(],
  "edges": [)" +
    lif_edge("in", "fork", "1.5") + ",\n" + lif_edge("fork", "in", "1.5") + ",\n" +
    lif_edge("fork", "out", "1.5") + ",\n" + lif_edge("out", "fork", "0.8") + ",\n" +
    lif_edge("fork", "press", "0.3") + ",\n" + lif_edge("press", "fork", "0.3") + R"(],
  "stations": [{"stationId": "S1", "interactionNodeIds": ["press"]}]}]})";

const std::string kInstance =
    R"({"roadmap": "o.roadmap.json", "agents": [{"id": "a", "start": "in", "goal": "out"},
  {"id": "b", "start": "out", "goal": "in"}],
 "tasks": [{"id": "t", "cell": "press", "agents": ["a"]}]})";

class ConvertRoadmap : public ::testing::Test {
 protected:
  ConvertRoadmap() {
    directory_.write("g.graphml", kGraphml);
    directory_.write("p.lif.json", kLif);
    directory_.write("i.cts.json", kInstance);
  }
  ProcessResult grove(const Arguments& arguments) const {
    return run_grove(arguments, {.directory = directory_.path().string()});
  }
  ProcessResult run(Arguments arguments) const {
    arguments.insert(arguments.begin(), "convert");
    return grove(arguments);
  }
  std::string converted(const Arguments& arguments, const std::string& warnings = "") const {
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, warnings);
    return result.out;
  }
  std::string refused(const Arguments& arguments) const {
    const auto files = directory_.files();
    const std::string text = complaint(run(arguments));
    EXPECT_EQ(directory_.files(), files);
    return text;
  }
  // Solves the instance to optimality and returns the output of `grove check`.
  std::string solved() const {
    const Arguments solve = {"solve", "i.cts.json", "--omega", "0", "--quiet", "--output", "plan"};
    EXPECT_EQ(grove(solve).exit_code, 0);
    return grove({"check", "i.cts.json", "plan"}).out;
  }

  TemporaryDirectory directory_;
};

const std::string kHint = " (see 'grove convert --help')";

TEST_F(ConvertRoadmap, GraphmlIsConvertedToASolvableRoadmap) {
  EXPECT_EQ(converted({"g.graphml", "o.roadmap.json", "--metres-per-step", "0.5"}),
            "wrote o.roadmap.json: 3 vertices, 3 roads, 1 of them one way, 26 places\n"
            "rounding: at most 0.8 steps (0.4 m): 5.2 became 6, line 11, column 5 from 'mid' to "
            "'end'\n"
            "rounding: at most 15.38 %: 5.2 became 6, line 11, column 5 from 'mid' to 'end'\n");
  EXPECT_EQ(file_content(directory_ / "o.roadmap.json"),
            "{\n \"vertices\": [\n  {\"id\":\"dock\",\"at\":[0.0,0.0]},\n"
            "  {\"id\":\"mid\",\"at\":[4.0,0.0]},\n  {\"id\":\"end\",\"at\":[4.0,2.5]}],\n"
            " \"edges\": [\n  {\"from\":\"dock\",\"to\":\"mid\",\"steps\":8},\n"
            "  {\"from\":\"mid\",\"to\":\"end\",\"steps\":6},\n"
            "  {\"from\":\"end\",\"to\":\"dock\",\"steps\":12,\"one_way\":true}]}\n");
  directory_.write("i.cts.json",
                   R"({"roadmap": "o.roadmap.json", "tasks": [],
  "agents": [{"id": "a", "start": "dock", "goal": "end"}]})");
  EXPECT_EQ(solved(), "valid: cost 14, lower bound 14, gap 0.00 %, 1 agent\n");
}

TEST_F(ConvertRoadmap, ReportsThatNothingWasRounded) {
  EXPECT_EQ(converted({"g.graphml", "o", "--to", "roadmap", "--metres-per-step", "0.2"}),
            "wrote o: 3 vertices, 3 roads, 1 of them one way, 63 places\n"
            "rounding: none; every road takes a whole number of steps\n");
}

const std::string kLanes =
    "grove: warning: p.lif.json: 3 pairs of opposite edges are two lanes each, on which robots "
    "pass one another; use --merge-lanes if robots share one lane\n";

TEST_F(ConvertRoadmap, LifIsConvertedWithTwoLanesOrOne) {
  const Arguments convert = {"p.lif.json", "o.roadmap.json",     "--metres-per-step",
                             "1",          "--seconds-per-step", "1"};
  EXPECT_EQ(converted(convert, kLanes),
            "wrote o.roadmap.json: 4 vertices, 6 roads, 6 of them one way, 51 places\n"
            "rounding: at most 0.8 steps (0.8 s): 5.2 became 6, /layouts/0/edges/0 from 'in' to "
            "'fork'\n"
            "rounding: at most 15.38 %: 5.2 became 6, /layouts/0/edges/0 from 'in' to 'fork'\n");
  // a: 6 + 14 + 14 + 6, b: 7 + 6. Each robot has its own lane.
  EXPECT_EQ(solved(), "valid: cost 53, lower bound 53, gap 0.00 %, 2 agents\n");

  Arguments merge = convert;
  merge.emplace_back("--merge-lanes");
  EXPECT_EQ(converted(merge,
                      "grove: warning: p.lif.json: 1 pairs of opposite edges take different "
                      "numbers of steps and remain two lanes each\n")
                .substr(0, 72),
            "wrote o.roadmap.json: 4 vertices, 4 roads, 2 of them one way, 33 places\n");
  EXPECT_EQ(solved(), "valid: cost 53, lower bound 53, gap 0.00 %, 2 agents\n");
}

TEST_F(ConvertRoadmap, RobotsCannotPassEachOtherOnOneLane) {
  directory_.write("i.cts.json",
                   R"({"roadmap": "o.roadmap.json", "tasks": [], "agents": [
  {"id": "a", "start": "in", "goal": "fork"}, {"id": "b", "start": "fork", "goal": "in"}]})");
  Arguments convert = {"p.lif.json", "o.roadmap.json", "--metres-per-step", "2"};
  EXPECT_EQ(run(convert).exit_code, 0);
  EXPECT_EQ(solved(), "valid: cost 6, lower bound 6, gap 0.00 %, 2 agents\n");
  // On one lane each robot moves aside for the other. An exhaustive search finds the same cost.
  convert.emplace_back("--merge-lanes");
  EXPECT_EQ(run(convert).exit_code, 0);
  EXPECT_EQ(solved(), "valid: cost 12, lower bound 12, gap 0.00 %, 2 agents\n");
}

TEST_F(ConvertRoadmap, RoadsWithoutAnEdgeAreRefused) {
  directory_.write(
      "one.graphml",
      "<graphml><key id='x' for='node' attr.name='x' attr.type='double'/>"
      "<key id='y' for='node' attr.name='y' attr.type='double'/><graph edgedefault='directed'>"
      "<node id='a'><data key='x'>0</data><data key='y'>0</data></node></graph></graphml>");
  EXPECT_EQ(refused({"one.graphml", "o.roadmap.json", "--metres-per-step", "1"}),
            "one.graphml: has no edge; expected at least one");
  std::string lif = kLif;
  for (std::size_t at = 0; (at = lif.find("\"T\", \"rot", at)) != std::string::npos;)
    lif.replace(at, 3, "\"U\"");  // the edges are then for a vehicle type other than T
  directory_.write("u.lif.json", lif);
  EXPECT_EQ(
      refused({"u.lif.json", "o.roadmap.json", "--metres-per-step", "1", "--vehicle-type", "T"}),
      "u.lif.json: has no edge that vehicle type 'T' may use; expected at least one");
}

TEST_F(ConvertRoadmap, WarnsOfIgnoredSpeeds) {
  const ProcessResult result = run({"p.lif.json", "o.roadmap.json", "--metres-per-step", "6"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err,
            "grove: warning: p.lif.json: has a speed or a duration for 6 edges; expected "
            "--seconds-per-step to use them\n" +
                kLanes +
                "grove: warning: p.lif.json: robots cannot pass one another on 3 of these "
                "pairs, which take one step; use shorter steps to allow it\n");
}

TEST_F(ConvertRoadmap, UnsuitableOptionsAreRefused) {
  const Arguments good = {"g.graphml", "o.roadmap.json", "--metres-per-step", "1"};
  const auto with = [&](const Arguments& more) {
    Arguments all = good;
    all.insert(all.end(), more.begin(), more.end());
    return refused(all);
  };
  EXPECT_EQ(refused({"g.graphml", "o.roadmap.json"}),
            "--metres-per-step: required; expected metres per step, or "
            "--seconds-per-step" +
                kHint);
  for (const std::string wrong : {"0", "-1", "nan", "inf", "x", ""})
    EXPECT_EQ(refused({"g.graphml", "o.roadmap.json", "--seconds-per-step", wrong}),
              "--seconds-per-step: found '" + wrong + "'; expected a number from 1e-06 to 1000000" +
                  kHint);
  EXPECT_EQ(refused({"g.graphml", "o.json", "--metres-per-step", "1"}),
            "--to: found 'o.json'; graphml contains roads; expected roadmap, or a file "
            "*.roadmap.json" +
                kHint);
  EXPECT_EQ(refused({"g.graphml", "o.yaml", "--to", "libmrp"}),
            "--to: found 'libmrp'; graphml contains roads; expected roadmap, or a file "
            "*.roadmap.json" +
                kHint);
  EXPECT_EQ(
      refused({"plant.json", "o.roadmap.json"}),
      "--from: required, because the suffix of 'plant.json' is not that of a format; expected "
      "graphml or lif, because OUT is a roadmap" +
          kHint);
  EXPECT_EQ(refused({"i.cts.json", "o.roadmap.json", "--from", "grove"}),
            "--from: found 'grove'; expected graphml or lif, because OUT is a roadmap" + kHint);
  EXPECT_EQ(with({"--layout", "x"}), "--layout: allowed only with LIF" + kHint);
  EXPECT_EQ(with({"--vehicle-type", "x"}), "--vehicle-type: allowed only with LIF" + kHint);
  const std::string only = ": allowed only with instances and plans" + kHint;
  EXPECT_EQ(with({"--plan", "p"}), "--plan" + only);
  EXPECT_EQ(with({"--map", "m"}), "--map" + only);
  EXPECT_EQ(with({"--agents", "3"}), "--agents" + only);
  EXPECT_EQ(with({"--drop", "ids"}), "--drop" + only);
  EXPECT_EQ(with({"--scenario", "even-1"}), "--scenario" + only);
  EXPECT_EQ(with({"--flip-up-down"}), "--flip-up-down" + only);
  const std::string roads =
      ": allowed only with roads: a *.graphml or *.lif.json INSTANCE, or --from graphml or lif";
  for (const Arguments& option : {Arguments{"--metres-per-step", "1"},
                                  {"--layout", "l"},
                                  {"--vehicle-type", "t"},
                                  {"--merge-lanes"}}) {
    Arguments all = {"i.cts.json", "o.mapfw.json"};
    all.insert(all.end(), option.begin(), option.end());
    EXPECT_EQ(refused(all), option[0] + roads + kHint);
  }
  EXPECT_EQ(refused({"i.cts.json", "o.mapfw.json", "--seconds-per-step", "1"}),
            "--seconds-per-step" + roads + "; or --to waypoints or nav-path" + kHint);
}

TEST_F(ConvertRoadmap, UnsuitableFilesAreRefused) {
  EXPECT_EQ(refused({"p.lif.json", "o.roadmap.json", "--from", "graphml", "--metres-per-step", "1"})
                .substr(0, 12),
            "p.lif.json: ");
  EXPECT_EQ(refused({"g.graphml", "g.graphml", "--to", "roadmap", "--metres-per-step", "1"}),
            "g.graphml: is the roads; expected another file to write to");
  EXPECT_EQ(refused({"g.graphml", "none/o.roadmap.json", "--metres-per-step", "1"}),
            "none/o.roadmap.json: cannot be written: No such file or directory");
  EXPECT_EQ(refused({"none.graphml", "o.roadmap.json", "--metres-per-step", "1"}),
            "none.graphml: cannot be read: No such file or directory");
  EXPECT_EQ(
      refused({"p.lif.json", "o.roadmap.json", "--metres-per-step", "1", "--layout", "attic"}),
      "p.lif.json: /layouts: there is no layout 'attic'; expected one of 'hall'");
  EXPECT_EQ(refused({"g.graphml", "o.roadmap.json", "--seconds-per-step", "1"}),
            "g.graphml: line 10, column 5: this edge has no time; expected a maximum speed (LIF), "
            "a duration (GraphML), or --metres-per-step for the speed of the robots");
}

}  // namespace convert_roadmap_test
}  // namespace grove::detail
