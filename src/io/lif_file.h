// SPDX-License-Identifier: MIT
// Roads as LIF 1, the Layout Interchange Format of the VDMA: track layouts that go with VDA 5050.
//
//   {"layouts": [{"layoutId": "hall",
//     "nodes": [{"nodeId": "N1", "nodePosition": {"x": 0.0, "y": 0.0}}, ...],
//     "edges": [{"edgeId": "E1", "startNodeId": "N1", "endNodeId": "N2",
//                "vehicleTypeEdgeProperties": [{"vehicleTypeId": "T", "maxSpeed": 1.5}]}, ...]}]}
//
// (github.com/Intralogistics-2X-LIF/Layout-Interchange-Format.) Positions are in metres, maxSpeed
// in m/s. Every edge is directed, so every road is one way. An edge is as long as its ends are
// apart, or as its trajectory, a NURBS curve, where that is longer.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/road_network.h"

namespace grove::detail {

// Which roads of a file; empty where there is only one of the kind.
struct LifChoice {
  std::string layout{};        // layoutId
  std::string vehicle_type{};  // vehicleTypeId: edges and nodes that it may not use are left out
};

// Throws InputError, with the JSON path, on anything malformed: ids that are repeated or unknown,
// speeds that are not positive, ends at one point; a choice that is not there, or is not made where
// there are several. Appends to `warnings` one line for each key that LIF does not know, and one
// about edges that lead to another layout, which are left out.
RoadNetwork read_lif(const std::filesystem::path& path, const LifChoice& choice = {},
                     std::vector<std::string>* warnings = nullptr);
// The same of the text of such a file: `name` stands for it in messages.
RoadNetwork parse_lif(std::string_view text, const std::string& name, const LifChoice& choice = {},
                      std::vector<std::string>* warnings = nullptr);

}  // namespace grove::detail
