// SPDX-License-Identifier: MIT
// Reads roads from GraphML, the XML format of networkx, yEd, igraph, Gephi and others.
//
// Data of a node: x and y in metres (for yEd, the centre of its drawing). Data of an edge: its
// length in metres, named length, distance, weight or cost (the first of these that it has), and
// its time in seconds, named duration or time. These are the names of the keys (attr.name), in
// upper or lower case. Keys may have defaults. A missing length is the distance between the ends.
// An edge is one way if it is directed, by its own attribute or else by the graph's edgedefault.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/road_network.h"

namespace grove::detail {

// Throws InputError, with line and column, for invalid files: invalid UTF-8, several graphs, graphs
// within nodes, hyperedges, repeated or unknown ids, numbers that are not finite, lengths and times
// that are not positive, a document type with its own declarations (entities are not expanded).
// Appends to `warnings` one line for each unknown name of data and of elements.
RoadNetwork read_graphml(const std::filesystem::path& path,
                         std::vector<std::string>* warnings = nullptr);
// The same for the text of such a file. `name` stands for the file in messages.
RoadNetwork parse_graphml(std::string_view text, const std::string& name,
                          std::vector<std::string>* warnings = nullptr);

}  // namespace grove::detail
