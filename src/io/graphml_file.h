// SPDX-License-Identifier: MIT
// Roads as GraphML, the XML format of networkx, yEd, igraph, Gephi and others.
//
// Read of each node are the data x and y, in metres (or, of yEd, the middle of its drawing), and of
// each edge its length in metres, called length, distance, weight or cost, the first of these that
// it has, and its time in seconds, called duration or time. Names are those of the keys
// (attr.name), in letters of either case; keys may have defaults. A length that is missing is the
// distance of the ends. Edges are one way where they are directed: by themselves, else by the
// graph's edgedefault.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/road_network.h"

namespace grove::detail {

// Throws InputError, with line and column, on anything malformed: no UTF-8, several graphs, graphs
// within nodes, hyperedges, ids that are repeated or unknown, numbers that are not finite, lengths
// and times that are not positive, a document type with declarations of its own (entities are not
// expanded). Appends to `warnings` one line for each name of data, and of elements, that it does
// not know.
RoadNetwork read_graphml(const std::filesystem::path& path,
                         std::vector<std::string>* warnings = nullptr);
// The same of the text of such a file: `name` stands for it in messages.
RoadNetwork parse_graphml(std::string_view text, const std::string& name,
                          std::vector<std::string>* warnings = nullptr);

}  // namespace grove::detail
