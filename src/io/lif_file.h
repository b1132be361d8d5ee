// SPDX-License-Identifier: MIT
// Reads road networks from LIF 1, the VDMA's Layout Interchange Format for track layouts (VDA
// 5050).
//
//   {"layouts": [{"layoutId": "hall",
//     "nodes": [{"nodeId": "N1", "nodePosition": {"x": 0.0, "y": 0.0}}, ...],
//     "edges": [{"edgeId": "E1", "startNodeId": "N1", "endNodeId": "N2",
//                "vehicleTypeEdgeProperties": [{"vehicleTypeId": "T", "maxSpeed": 1.5}]}, ...]}]}
//
// (github.com/Intralogistics-2X-LIF/Layout-Interchange-Format.) Positions are in metres, and
// maxSpeed is in m/s. Every edge is directed, so every road is one-way. The length of an edge is
// the greater of the distance between its ends and the length of its trajectory, a NURBS curve.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/road_network.h"

namespace grove::detail {

// The layout and the vehicle type to read. `layout` may be empty if the file has only one layout;
// `vehicle_type`, if the layout has at most one vehicle type.
struct LifChoice {
  std::string layout{};        // layoutId
  std::string vehicle_type{};  // vehicleTypeId; nodes and edges that it may not use are omitted
};

// Reads a file. Throws InputError, with the JSON Pointer, for invalid files. Invalid are repeated
// or unknown ids, speeds that are not positive, and edges of length 0. Also throws InputError if
// the chosen layout or vehicle type does not exist, or is empty although the file has several.
// Appends to `warnings`, unless it is nullptr, one line for each key that LIF does not define, and
// one line if edges from or to other layouts were omitted.
RoadNetwork read_lif(const std::filesystem::path& path, const LifChoice& choice = {},
                     std::vector<std::string>* warnings = nullptr);
// Parses the text of such a file. `name` is the name of the file in messages.
RoadNetwork parse_lif(std::string_view text, const std::string& name, const LifChoice& choice = {},
                      std::vector<std::string>* warnings = nullptr);

}  // namespace grove::detail
