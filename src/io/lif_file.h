// SPDX-License-Identifier: MIT
// Roads in LIF 1, the Layout Interchange Format of the VDMA: track layouts for VDA 5050.
//
//   {"layouts": [{"layoutId": "hall",
//     "nodes": [{"nodeId": "N1", "nodePosition": {"x": 0.0, "y": 0.0}}, ...],
//     "edges": [{"edgeId": "E1", "startNodeId": "N1", "endNodeId": "N2",
//                "vehicleTypeEdgeProperties": [{"vehicleTypeId": "T", "maxSpeed": 1.5}]}, ...]}]}
//
// (github.com/Intralogistics-2X-LIF/Layout-Interchange-Format.) Positions are in metres, maxSpeed
// is in m/s. Every edge is directed, so every road is one way. The length of an edge is the
// distance between its ends or the length of its trajectory, a NURBS curve, whichever is greater.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/road_network.h"

namespace grove::detail {

// The layout and vehicle type to read; empty if the file has only one.
struct LifChoice {
  std::string layout{};        // layoutId
  std::string vehicle_type{};  // vehicleTypeId; edges and nodes that it may not use are omitted
};

// Throws InputError, with the JSON Pointer, for invalid files: repeated or unknown ids, speeds that
// are not positive, edges whose ends are at the same point. Also throws if the choice does not
// exist, or is empty although the file has several layouts or types. Appends to `warnings` one line
// for each key that LIF does not define, and one about edges to other layouts, which are omitted.
RoadNetwork read_lif(const std::filesystem::path& path, const LifChoice& choice = {},
                     std::vector<std::string>* warnings = nullptr);
// The same for the text of such a file. `name` stands for the file in messages.
RoadNetwork parse_lif(std::string_view text, const std::string& name, const LifChoice& choice = {},
                      std::vector<std::string>* warnings = nullptr);

}  // namespace grove::detail
