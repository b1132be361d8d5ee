// SPDX-License-Identifier: MIT
// Reads road networks from GraphML, the XML format of networkx, yEd, igraph, Gephi and others.
//
// A node has data x and y in metres; for yEd, the centre of the node's drawing is used. An edge may
// have a length in metres (key length, distance, weight or cost; the first of these that is present
// counts) and a travel time in seconds (key duration or time). A key is identified by its attr.name
// in upper or lower case, or by its id if the file does not declare it, and may have a default. If
// the length is missing, it is the distance between the ends. An edge is one-way if it is directed,
// according to its own attribute or else to the graph's edgedefault.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/road_network.h"

namespace grove::detail {

// Reads a file. Throws InputError, with line and column if they are known, for invalid files.
// Invalid are: encodings other than UTF-8, no node, several graphs, nodes without a position,
// graphs within nodes, hyperedges, repeated or unknown ids, numbers that are not finite, lengths
// and times that are not positive, and a document type with declarations of its own (entities are
// not expanded). Appends to `warnings`, unless it is nullptr, one line for each unknown data key
// and each unknown element name.
RoadNetwork read_graphml(const std::filesystem::path& path,
                         std::vector<std::string>* warnings = nullptr);
// Parses the text of such a file. `name` is the name of the file in messages.
RoadNetwork parse_graphml(std::string_view text, const std::string& name,
                          std::vector<std::string>* warnings = nullptr);

}  // namespace grove::detail
