// SPDX-License-Identifier: MIT
#include "io/lif_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "io/input_error.h"
#include "io/json_value.h"
#include "io/text_file.h"
#include "model/roadmap.h"

namespace grove::detail {
namespace {

constexpr int kPartsOfSpan = 64;    // number of segments per span of a curve, in its polyline
constexpr int kHighestDegree = 16;  // maximum degree of a curve; vehicle paths need less

// A non-uniform rational B-spline (NURBS) with more than `degree` points. `knots` is non-decreasing
// and has points + degree + 1 entries. The weights are positive.
struct Nurbs {
  int degree = 1;
  std::vector<double> knots;
  std::vector<Point> points;
  std::vector<double> weights;  // one per point
};

// Evaluates the curve by De Boor's algorithm in homogeneous coordinates (w x, w y, w).
// Precondition: t is between knots[span] and knots[span + 1].
Point point_at(const Nurbs& curve, int span, double t) {
  const int p = curve.degree;
  std::vector<std::array<double, 3>> d;
  for (int j = span - p; j <= span; ++j) {
    const double w = curve.weights[j];
    d.push_back({w * curve.points[j].x, w * curve.points[j].y, w});
  }
  for (int level = 1; level <= p; ++level)
    for (int j = p; j >= level; --j) {
      const double begin = curve.knots[span - p + j];
      const double end = curve.knots[span + 1 + j - level];
      const double part = (t - begin) / (end - begin);  // begin <= knot span < knot span + 1 <= end
      for (int k = 0; k < 3; ++k) d[j][k] = (1 - part) * d[j - 1][k] + part * d[j][k];
    }
  return {d[p][0] / d[p][2], d[p][1] / d[p][2]};
}

// The length of a polyline through many points of the curve. For a bent curve this is slightly less
// than its length.
double length_of(const Nurbs& curve) {
  double length = 0;
  for (int span = curve.degree; span < std::ssize(curve.points); ++span) {
    const double begin = curve.knots[span];
    const double end = curve.knots[span + 1];
    if (!(begin < end)) continue;
    Point last = point_at(curve, span, begin);
    for (int k = 1; k <= kPartsOfSpan; ++k) {
      const Point next = point_at(curve, span, begin + (end - begin) * k / kPartsOfSpan);
      length += std::hypot(next.x - last.x, next.y - last.y);
      last = next;
    }
  }
  return length;
}

// Returns the value of a key. Returns nullopt if it is missing or null, because exporters write
// null for unknown values.
std::optional<JsonValue> find_given(const JsonValue& object, const char* key) {
  auto value = object.find(key);
  return value && value->json().is_null() ? std::nullopt : value;
}

std::string id_of(const JsonValue& object, const char* key) {
  const JsonValue value = object.member(key);
  std::string id = value.text();
  if (id.empty()) value.fail("expected an id that is not empty");
  return id;
}

// Returns the names as a list for messages, such as "'a', 'b'".
std::string listed(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names)
    text += fmt::format("{}'{}'", text.empty() ? "" : ", ", name);
  return text;
}

class LifReader {
 public:
  LifReader(std::string_view text, const std::string& name, const LifChoice& choice,
            std::vector<std::string>* warnings)
      : document_(text, name), choice_(choice), warnings_(warnings), unknown_(name, warnings) {
    network_.file = name;
  }

  RoadNetwork read() {
    const JsonValue layout = chosen_layout();
    unknown_.look_at(layout, {"layoutId", "layoutName", "layoutVersion", "layoutLevelId",
                              "layoutDescription", "nodes", "edges", "stations"});
    require_vehicle_type(layout);
    const JsonValue nodes = layout.member("nodes");
    for (std::size_t k = 0; k < nodes.size(); ++k) read_node(nodes.element(k));
    if (network_.vertices.empty())
      nodes.fail(unusable_.empty() ? "expected at least one node"
                                   : "expected at least one node for this vehicle type");
    const JsonValue edges = layout.member("edges");
    for (std::size_t k = 0; k < edges.size(); ++k) read_edge(edges.element(k));
    if (edges_away_ > 0 && warnings_ != nullptr)
      warnings_->push_back(
          fmt::format("{}: {}: {} edges lead from or to another layout and are left out",
                      one_line(network_.file), edges.path(), edges_away_));
    return std::move(network_);
  }

 private:
  JsonValue chosen_layout() {
    const JsonValue root = document_.root();
    if (!root.find("layouts") && root.find("origins"))
      root.fail("found 'origins', a key of LIF 2; expected 'layouts', as in LIF 1");
    unknown_.look_at(root, {"metaInformation", "layouts"});
    const JsonValue layouts = root.member("layouts");
    std::set<std::string> ids;
    std::optional<JsonValue> chosen;
    for (std::size_t k = 0; k < layouts.size(); ++k) {
      const JsonValue layout = layouts.element(k);
      const std::string id = id_of(layout, "layoutId");
      if (!ids.insert(id).second)
        layout.fail(fmt::format("id '{}' is used twice; expected distinct ids", id), "layoutId");
      if (choice_.layout.empty() || id == choice_.layout)
        chosen = layout;
      else
        remember_nodes(layout);
    }
    if (ids.empty()) layouts.fail("expected at least one layout");
    if (!chosen)
      layouts.fail(
          fmt::format("there is no layout '{}'; expected one of {}", choice_.layout, listed(ids)));
    if (choice_.layout.empty() && ids.size() > 1)
      layouts.fail(fmt::format("found {} layouts; expected --layout with one of {}", ids.size(),
                               listed(ids)));
    return *chosen;
  }

  void remember_nodes(const JsonValue& layout) {
    const JsonValue nodes = layout.member("nodes");
    for (std::size_t k = 0; k < nodes.size(); ++k)
      elsewhere_.insert(nodes.element(k).member("nodeId").text());
  }

  // The vehicle types that occur in nodes and edges of the layout.
  std::set<std::string> vehicle_types(const JsonValue& layout) const {
    std::set<std::string> types;
    for (const auto& [list, key] : {std::pair{"nodes", "vehicleTypeNodeProperties"},
                                    std::pair{"edges", "vehicleTypeEdgeProperties"}}) {
      const JsonValue elements = layout.member(list);
      for (std::size_t k = 0; k < elements.size(); ++k)
        if (const auto properties = find_given(elements.element(k), key))
          for (std::size_t i = 0; i < properties->size(); ++i)
            types.insert(id_of(properties->element(i), "vehicleTypeId"));
    }
    return types;
  }

  void require_vehicle_type(const JsonValue& layout) const {
    const auto types = vehicle_types(layout);
    const std::string& type = choice_.vehicle_type;
    if (type.empty() && types.size() > 1)
      layout.fail(
          fmt::format("found {} vehicle types with different roads and speeds; expected "
                      "--vehicle-type with one of {}",
                      types.size(), listed(types)));
    if (!type.empty() && !types.contains(type))
      layout.fail(types.empty() ? "has no vehicle types; expected no --vehicle-type"
                                : fmt::format("there is no vehicle type '{}'; expected one of {}",
                                              type, listed(types)));
  }

  // Whether the vehicle type may use a node or an edge, and its properties there; nullopt: none are
  // given. A type that the caller has named may use only the elements that list it.
  struct Use {
    bool may = true;
    std::optional<JsonValue> properties;
  };
  Use use_of(const JsonValue& element, const char* key) const {
    Use use{choice_.vehicle_type.empty(), {}};
    const auto list = find_given(element, key);
    std::set<std::string> types;
    for (std::size_t k = 0; list && k < list->size(); ++k) {
      const JsonValue properties = list->element(k);
      const std::string type = id_of(properties, "vehicleTypeId");
      if (!types.insert(type).second)
        properties.fail(
            fmt::format("vehicle type '{}' appears twice; expected distinct ones", type),
            "vehicleTypeId");
      if (choice_.vehicle_type.empty() || choice_.vehicle_type == type) use = {true, properties};
    }
    return use;
  }

  void read_node(const JsonValue& node) {
    unknown_.look_at(node, {"nodeId", "nodeName", "nodeDescription", "mapId", "nodePosition",
                            "vehicleTypeNodeProperties"});
    std::string id = id_of(node, "nodeId");
    if (numbers_.contains(id) || unusable_.contains(id))
      node.fail(fmt::format("id '{}' is used twice; expected distinct ids", id), "nodeId");
    const JsonValue position = node.member("nodePosition");
    unknown_.look_at(position, {"x", "y", "theta"});
    const Point at{position.member("x").number(), position.member("y").number()};
    if (!use_of(node, "vehicleTypeNodeProperties").may) {
      unusable_.insert(std::move(id));
      return;
    }
    numbers_.emplace(id, static_cast<int>(network_.vertices.size()));
    network_.vertices.push_back({std::move(id), at});
  }

  // The vertex at an end of an edge. Returns nullopt if the node is in a different layout, in which
  // case it sets `is_elsewhere` to true, or if it is not for this vehicle type.
  std::optional<int> end_of(const JsonValue& edge, const char* key, bool& is_elsewhere) const {
    const JsonValue value = edge.member(key);
    const std::string id = value.text();
    const auto found = numbers_.find(id);
    if (found != numbers_.end()) return found->second;
    if (unusable_.contains(id)) return std::nullopt;
    if (!elsewhere_.contains(id))
      value.fail(fmt::format("there is no node '{}'; expected the id of one of this file", id));
    is_elsewhere = true;
    return std::nullopt;
  }

  void require_new_edge_id(const JsonValue& edge) {
    const std::string id = id_of(edge, "edgeId");
    if (!edge_ids_.insert(id).second)
      edge.fail(fmt::format("id '{}' is used twice; expected distinct ids", id), "edgeId");
  }

  void read_edge(const JsonValue& edge) {
    unknown_.look_at(edge, {"edgeId", "edgeName", "edgeDescription", "startNodeId", "endNodeId",
                            "vehicleTypeEdgeProperties"});
    require_new_edge_id(edge);
    bool is_away = false;
    const auto from = end_of(edge, "startNodeId", is_away);
    const auto to = end_of(edge, "endNodeId", is_away);
    edges_away_ += is_away;
    const Use use = use_of(edge, "vehicleTypeEdgeProperties");
    if (!from || !to || !use.may) return;
    Link link{*from, *to, true, 0, {}, edge.path()};
    link.metres = length_of_edge(edge, link, use);
    if (use.properties) link.seconds = seconds(*use.properties, link.metres);
    network_.links.push_back(std::move(link));
  }

  std::optional<double> seconds(const JsonValue& properties, double metres) {
    unknown_.look_at(
        properties,
        {"vehicleTypeId", "vehicleOrientation", "orientationType", "rotationAllowed",
         "rotationAtStartNodeAllowed", "rotationAtEndNodeAllowed", "maxSpeed", "maxRotationSpeed",
         "minHeight", "maxHeight", "loadRestriction", "actions", "trajectory", "reentryAllowed"});
    const auto speed = find_given(properties, "maxSpeed");
    if (!speed) return std::nullopt;
    const double seconds = metres / speed->number();
    if (!(seconds > 0) || !std::isfinite(seconds))
      speed->fail_expected("a positive number of metres per second");
    return seconds;
  }

  double length_of_edge(const JsonValue& edge, const Link& link, const Use& use) const {
    const Point& a = network_.vertices[link.from].at;
    const Point& b = network_.vertices[link.to].at;
    double metres = std::hypot(a.x - b.x, a.y - b.y);
    if (const auto curve =
            use.properties ? find_given(*use.properties, "trajectory") : std::nullopt)
      metres = std::max(metres, length_of(read_curve(*curve)));
    if (!(metres > 0) || !std::isfinite(metres))
      edge.fail(fmt::format(
          "has a length of {} m; expected ends, or a trajectory, at a positive distance", metres));
    return metres;
  }

  static int read_degree(const JsonValue& curve) {
    const auto value = find_given(curve, "degree");
    if (!value) return 1;
    const double degree = value->number();
    if (degree != std::floor(degree) || degree < 1 || degree > kHighestDegree)
      value->fail_expected(fmt::format("a whole number from 1 to {}", kHighestDegree));
    return static_cast<int>(degree);
  }

  static Nurbs read_curve(const JsonValue& value) {
    Nurbs curve{read_degree(value), {}, {}, {}};
    const JsonValue points = value.member("controlPoints");
    for (std::size_t k = 0; k < points.size(); ++k) {
      const JsonValue point = points.element(k);
      curve.points.push_back({point.member("x").number(), point.member("y").number()});
      const auto weight = find_given(point, "weight");
      curve.weights.push_back(weight ? weight->number() : 1);
      if (!(curve.weights.back() > 0)) weight->fail_expected("a positive number");
    }
    if (std::ssize(curve.points) <= curve.degree)
      points.fail(fmt::format("found {} points; expected more than the degree, {}",
                              curve.points.size(), curve.degree));
    read_knots(value.member("knotVector"), curve);
    return curve;
  }

  static void read_knots(const JsonValue& knots, Nurbs& curve) {
    for (std::size_t k = 0; k < knots.size(); ++k) {
      const JsonValue knot = knots.element(k);
      curve.knots.push_back(knot.number());
      if (k > 0 && curve.knots[k] < curve.knots[k - 1])
        knot.fail_expected("at least the knot before");
    }
    const std::size_t count = curve.points.size() + static_cast<std::size_t>(curve.degree) + 1;
    if (curve.knots.size() != count)
      knots.fail(fmt::format("found {} knots; expected {}, for {} control points and degree {}",
                             curve.knots.size(), count, curve.points.size(), curve.degree));
  }

  JsonDocument document_;
  LifChoice choice_;
  std::vector<std::string>* warnings_;  // may be nullptr
  UnknownKeys unknown_;
  RoadNetwork network_;
  std::unordered_map<std::string, int> numbers_;  // index of the vertex, by id
  std::unordered_set<std::string> unusable_;      // nodes that this vehicle type may not use
  std::unordered_set<std::string> elsewhere_;     // nodes in other layouts
  std::unordered_set<std::string> edge_ids_;
  int edges_away_ = 0;
};

}  // namespace

RoadNetwork parse_lif(std::string_view text, const std::string& name, const LifChoice& choice,
                      std::vector<std::string>* warnings) {
  return LifReader(text, name, choice, warnings).read();
}

RoadNetwork read_lif(const std::filesystem::path& path, const LifChoice& choice,
                     std::vector<std::string>* warnings) {
  return parse_lif(read_text(path), path.string(), choice, warnings);
}

}  // namespace grove::detail
