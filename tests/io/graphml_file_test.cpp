// SPDX-License-Identifier: MIT
#include "io/graphml_file.h"

#include <gtest/gtest.h>

#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace graphml_file_test {

// An undirected graph as networkx writes it: one key for each type of number, and data in any
// order.
const std::string kNetworkx = R"(<?xml version='1.0' encoding='utf-8'?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns"
         xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance">
  <key id="d4" for="edge" attr.name="length" attr.type="double" />
  <key id="d3" for="node" attr.name="y" attr.type="long" />
  <key id="d2" for="node" attr.name="x" attr.type="long" />
  <key id="d1" for="node" attr.name="y" attr.type="double" />
  <key id="d0" for="node" attr.name="x" attr.type="double" />
  <graph edgedefault="undirected">
    <node id="dock">
      <data key="d0">0.0</data>
      <data key="d1">-1.5</data>
    </node>
    <node id="mid">
      <data key="d2">3</data>
      <data key="d3">0</data>
    </node>
    <node id="end">
      <data key="d1">4.0</data>
      <data key="d2">6</data>
    </node>
    <edge source="dock" target="mid">
      <data key="d4">3.25</data>
    </edge>
    <edge source="mid" target="end" />
  </graph>
</graphml>
)";

// A graph as yEd writes it: positions are in the drawing, unrelated elements are everywhere, and
// all edges are directed.
const std::string kYed = R"(<?xml version="1.0" encoding="UTF-8" standalone="no"?>
<graphml xmlns="http://graphml.graphdrawing.org/xmlns" xmlns:y="http://www.yworks.com/xml/graphml">
  <!--Created by yEd 3.22-->
  <key for="port" id="d1" yfiles.type="portgeometry"/>
  <key attr.name="description" attr.type="string" for="node" id="d5"/>
  <key for="node" id="d6" yfiles.type="nodegraphics"/>
  <key attr.name="Weight" attr.type="double" for="edge" id="d8"><default>2.5</default></key>
  <key for="edge" id="d10" yfiles.type="edgegraphics"/>
  <graph edgedefault="directed" id="G">
    <data key="d0" xml:space="preserve"/>
    <node id="n0">
      <data key="d6">
        <y:ShapeNode>
          <y:Geometry height="30.0" width="20.0" x="100.0" y="50.0"/>
          <y:NodeLabel>dock</y:NodeLabel>
        </y:ShapeNode>
      </data>
    </node>
    <node id="n1">
      <data key="d5"/>
      <data key="d6"><y:ShapeNode><y:Geometry height="30" width="30" x="0" y="0"/></y:ShapeNode></data>
    </node>
    <edge id="e0" source="n0" target="n1">
      <data key="d10"><y:PolyLineEdge><y:Arrows source="none" target="none"/></y:PolyLineEdge></data>
    </edge>
    <edge id="e1" source="n1" target="n0" directed="false"><data key="d8">7</data></edge>
  </graph>
</graphml>
)";

std::string graphml(const std::string& graph, const std::string& before = "") {
  return "<graphml>" + before + "<graph edgedefault='directed'>" + graph + "</graph></graphml>";
}
const std::string kA = "<node id='A'><data key='x'>0</data><data key='y'>0</data></node>";
const std::string kB = "<node id='B'><data key='x'>3</data><data key='y'>4</data></node>";

std::string refused(const std::string& text) {
  return refusal([&] { parse_graphml(text, "g.graphml"); });
}
// Returns a network with an edge from A to B whose element contains `inside`.
RoadNetwork with_edge(const std::string& inside, const std::string& before = "") {
  return parse_graphml(
      graphml(kA + kB + "<edge source='A' target='B'>" + inside + "</edge>", before), "g.graphml");
}

TEST(GraphmlFile, ReadsFilesOfNetworkx) {
  std::vector<std::string> warnings;
  const RoadNetwork network = parse_graphml(kNetworkx, "g.graphml", &warnings);
  EXPECT_TRUE(warnings.empty());
  ASSERT_EQ(network.vertices.size(), 3u);
  EXPECT_EQ(network.vertices[0].id, "dock");
  EXPECT_EQ(network.vertices[0].at, (Point{0, -1.5}));
  EXPECT_EQ(network.vertices[2].at, (Point{6, 4}));
  ASSERT_EQ(network.links.size(), 2u);
  EXPECT_EQ(network.links[0].metres, 3.25);
  EXPECT_FALSE(network.links[0].one_way);
  EXPECT_FALSE(network.links[0].seconds);
  EXPECT_EQ(network.links[1].from, 1);
  EXPECT_EQ(network.links[1].to, 2);
  EXPECT_DOUBLE_EQ(network.links[1].metres, 5);  // the distance between its ends
  EXPECT_EQ(network.links[1].place, "line 25, column 5");
}

TEST(GraphmlFile, ReadsFilesOfYed) {
  std::vector<std::string> warnings;
  const RoadNetwork network = parse_graphml(kYed, "g.graphml", &warnings);
  EXPECT_EQ(
      warnings,
      (std::vector<std::string>{"g.graphml: line 20, column 7: data 'description' is ignored"}));
  ASSERT_EQ(network.vertices.size(), 2u);
  EXPECT_EQ(network.vertices[0].at, (Point{110, 65}));
  EXPECT_EQ(network.vertices[1].at, (Point{15, 15}));
  ASSERT_EQ(network.links.size(), 2u);
  EXPECT_TRUE(network.links[0].one_way);
  EXPECT_EQ(network.links[0].metres, 2.5);  // the default value of the key
  EXPECT_FALSE(network.links[1].one_way);
  EXPECT_EQ(network.links[1].metres, 7);
}

TEST(GraphmlFile, FollowsThePreferenceOrderOfLengthNames) {
  EXPECT_EQ(with_edge("<data key='cost'>4</data><data key='weight'>3</data>").links[0].metres, 3);
  EXPECT_EQ(with_edge("<data key='weight'>3</data><data key='distance'>2</data>").links[0].metres,
            2);
  EXPECT_EQ(with_edge("<data key='distance'>2</data><data key='LENGTH'>1e0</data>").links[0].metres,
            1);
  EXPECT_EQ(with_edge("<data key='time'>8</data><data key='duration'>9.5</data>").links[0].seconds,
            9.5);
  EXPECT_EQ(with_edge("<data key='time'> 8\n</data>").links[0].seconds, 8);
}

TEST(GraphmlFile, ReadsTextsWithEntitiesAndCdata) {
  EXPECT_EQ(with_edge("<data key='length'>1<!-- ! -->2<![CDATA[3]]></data>").links[0].metres, 123);
  const RoadNetwork network = parse_graphml(
      graphml("<node id='&#x41;&amp;\xC3\xA4'><data key='x'>0</data><data key='y'>0</data></node>"),
      "g");
  EXPECT_EQ(network.vertices[0].id, "A&\xC3\xA4");
}

TEST(GraphmlFile, AcceptsPrefixesAndEdgesBeforeTheirNodes) {
  const RoadNetwork network = parse_graphml(
      "<g:graphml xmlns:g='http://graphml.graphdrawing.org/xmlns'><g:graph "
      "edgedefault='undirected'><g:edge source='A' target='A'><g:data key='length'>2</g:data>"
      "</g:edge><g:node id='A'><g:data key='x'>1</g:data><g:data key='y'>2</g:data></g:node>"
      "</g:graph></g:graphml>",
      "g");
  EXPECT_EQ(network.vertices[0].at, (Point{1, 2}));
  ASSERT_EQ(network.links.size(), 1u);
  EXPECT_EQ(network.links[0].from, network.links[0].to);
}

TEST(GraphmlFile, AcceptsAByteOrderMarkAndAPlainDocumentType) {
  const TemporaryDirectory directory;
  const std::string path = directory.write(
      "g.graphml",
      "\xEF\xBB\xBF<?xml version='1.0'?><!DOCTYPE graphml SYSTEM 'graphml.dtd'>" + graphml(kA));
  EXPECT_EQ(read_graphml(path).vertices.size(), 1u);
}

TEST(GraphmlFile, WarnsOnceAboutEachUnknownName) {
  std::vector<std::string> warnings;
  parse_graphml(graphml(kA + kB +
                        "<edge source='A' target='B'><data key='lanes'>2</data></edge>"
                        "<edge source='B' target='A'><data key='lanes'>2</data></edge>"
                        "<wall/><wall/><desc>plant</desc>"),
                "g", &warnings);
  EXPECT_EQ(warnings, (std::vector<std::string>{"g: line 1, column 196: data 'lanes' is ignored",
                                                "g: line 1, column 290: element 'wall' is "
                                                "ignored"}));
}

struct Bad {
  std::string text;
  std::string message;  // after "g.graphml: "
};

TEST(GraphmlFile, RefusesInvalidFilesWithThePlace) {
  const auto node = [](const std::string& x) {
    return graphml("<node id='A'><data key='x'>" + x + "</data><data key='y'>0</data></node>");
  };
  const auto edge = [](const std::string& text) { return graphml(kA + kB + text); };
  const auto length = [&](const std::string& text) {
    return edge("\n<edge source='A' target='B'><data key='length'>" + text + "</data></edge>");
  };
  const std::vector<Bad> all = {
      {"", "is empty; expected GraphML"},
      {" \n", "is empty; expected GraphML"},
      {"hello", "line 1, column 6: malformed XML: No document element found; expected GraphML"},
      {"{\"vertices\": []}",
       "line 1, column 17: malformed XML: No document element found; expected GraphML"},
      {"<graphml><graph edgedefault='directed'>",
       "line 1, column 39: malformed XML: Start-end tags mismatch; expected GraphML"},
      {"<graphml>\n<graph </graphml>",
       "line 2, column 8: malformed XML: Error parsing start element tag; expected GraphML"},
      {graphml(kA).substr(0, 60),
       "line 1, column 61: malformed XML: Error parsing element attribute; expected GraphML"},
      {std::string("<graphml>\n\0</graphml>", 21),
       "line 2, column 1: found a NUL character; expected text in UTF-8"},
      {"<?xml version='1.0' encoding='ISO-8859-1'?>" + graphml(kA),
       "is encoded in another way; expected UTF-8"},
      {std::string("\xFF\xFE<\0g\0/\0>\0", 10), "is encoded in another way; expected UTF-8"},
      {"<svg/>", "line 1, column 1: found element 'svg'; expected 'graphml'"},
      {"<graphml/>", "line 1, column 1: has no element 'graph'; expected one"},
      {"<graphml><graph edgedefault='directed'/><graph edgedefault='directed'/></graphml>",
       "line 1, column 41: found a second graph; expected one per file"},
      {"<graphml><graph/></graphml>",
       "line 1, column 10: attribute 'edgedefault' is missing; expected it in this element"},
      {"<graphml><graph edgedefault='both'/></graphml>",
       "line 1, column 10: found edgedefault 'both'; expected directed or undirected"},
      {graphml(""), "line 1, column 10: has no node; expected at least one"},
      {graphml("<node/>"),
       "line 1, column 40: attribute 'id' is missing; expected it in this element"},
      {graphml("<node id=''/>"), "line 1, column 40: expected an id that is not empty"},
      {graphml(kA + "\n" + kA), "line 2, column 1: id 'A' is used twice; expected distinct ids"},
      {graphml("<node id='\xE4'/>"),
       "line 1, column 40: id '\\xe4' is not in UTF-8; expected UTF-8"},
      {graphml("<node id='A'/>"),
       "line 1, column 40: data 'x' is missing; expected x and y of the node, in metres"},
      {graphml("<node id='A'><data key='x'>1</data></node>"),
       "line 1, column 40: data 'y' is missing; expected x and y of the node, in metres"},
      {graphml("<node id='A'><data>1</data></node>"),
       "line 1, column 53: attribute 'key' is missing; expected it in this element"},
      {graphml("<node id='A'><data key='x'>1</data>\n<data key='x'>1</data></node>"),
       "line 2, column 1: data 'x' is given twice; expected it once"},
      {node("1,5"), "line 1, column 53: found '1,5' for x; expected a finite number"},
      {node(""), "line 1, column 53: found '' for x; expected a finite number"},
      {node("nan"), "line 1, column 53: found 'nan' for x; expected a finite number"},
      {node("-inf"), "line 1, column 53: found '-inf' for x; expected a finite number"},
      {node("1e999"), "line 1, column 53: found '1e999' for x; expected a finite number"},
      {node("0x10"), "line 1, column 53: found '0x10' for x; expected a finite number"},
      {graphml("<node id='A'>\n<graph edgedefault='directed'/></node>"),
       "line 2, column 1: found a graph within a node; expected a graph without groups"},
      {graphml("<node id='A'><data key='d'><s><Geometry x='0' y='1' width='2'/></s></data></node>"),
       "line 1, column 70: attribute 'height' is missing; expected it in this element"},
      {edge("\n<hyperedge/>"),
       "line 2, column 1: found a hyperedge; expected edges between two nodes"},
      {edge("\n<edge target='A'/>"),
       "line 2, column 1: attribute 'source' is missing; expected it in this element"},
      {edge("\n<edge source='A' target='C'/>"),
       "line 2, column 1: there is no node 'C', its target; expected the id of one of this graph"},
      {edge("\n<edge source='a' target='B'/>"),
       "line 2, column 1: there is no node 'a', its source; expected the id of one of this graph"},
      {edge("\n<edge source='A' target='B' directed='yes'/>"),
       "line 2, column 1: found directed 'yes'; expected true or false"},
      {edge("\n<edge source='A' target='A'/>"),
       "line 2, column 1: has no length, and its ends are 0 m apart; expected data 'length', or "
       "ends at a positive distance"},
      {graphml("<node id='A'><data key='x'>-1e308</data><data key='y'>0</data></node>"
               "<node id='B'><data key='x'>1e308</data><data key='y'>0</data></node>"
               "\n<edge source='A' target='B'/>"),
       "line 2, column 1: has no length, and its ends are inf m apart; expected data 'length', or "
       "ends at a positive distance"},
      {length("0"), "line 2, column 29: found 0 for length; expected a positive number of metres"},
      {length("-2"),
       "line 2, column 29: found -2 for length; expected a positive number of metres"},
      {length("inf"), "line 2, column 29: found 'inf' for length; expected a finite number"},
      {length("NaN"), "line 2, column 29: found 'NaN' for length; expected a finite number"},
      {length("3 m"), "line 2, column 29: found '3 m' for length; expected a finite number"},
      {length("&three;"),
       "line 2, column 29: found '&three;' for length; expected a finite number"},
      {edge("\n<edge source='A' target='B'><data key='time'>0.0</data></edge>"),
       "line 2, column 29: found 0.0 for time; expected a positive number of seconds"},
      {graphml(kA + kB + "<edge source='A' target='B'/>",
               "\n<key id='d' for='edge' attr.name='length'><default>-1</default></key>"),
       "line 2, column 1: found -1 for length; expected a positive number of metres"},
      {graphml(kA, "<key id='d'/>\n<key id='d'/>"),
       "line 2, column 1: key 'd' is declared twice; expected distinct ids"},
      {graphml(kA, "<key/>"),
       "line 1, column 10: attribute 'id' is missing; expected it in this element"},
      {"<!DOCTYPE graphml [<!ENTITY a 'lol'><!ENTITY b '&a;&a;&a;&a;'>]>" + graphml(kA),
       "its document type has declarations; expected none, because entities are not expanded"},
  };
  for (const Bad& bad : all) EXPECT_EQ(refused(bad.text), "g.graphml: " + bad.message) << bad.text;
}

TEST(GraphmlFile, SurvivesDeepNesting) {
  std::string deep;
  for (int k = 0; k < 300'000; ++k) deep += "<a>";
  EXPECT_EQ(refused(deep).substr(0, 11), "g.graphml: ");
  std::string closed = deep;
  for (int k = 0; k < 300'000; ++k) closed += "</a>";
  EXPECT_EQ(parse_graphml(graphml(kA + closed), "g").vertices.size(), 1u);
}

// Truncates each text at every byte, and flips one bit of every byte. Each result must be either
// read or refused.
TEST(GraphmlFile, DamagedTextsAreReadOrRefused) {
  for (const std::string& text : {kNetworkx, kYed})
    for (std::size_t k = 0; k < text.size(); ++k) {
      std::string changed = text;
      changed[k] = static_cast<char>(changed[k] ^ (1 << (k % 8)));
      for (const std::string& broken : {text.substr(0, k), changed}) {
        const std::string message = refused(broken);
        EXPECT_TRUE(message == "accepted" || message.starts_with("g.graphml: ")) << message;
      }
    }
}

}  // namespace graphml_file_test
}  // namespace grove::detail
