// SPDX-License-Identifier: MIT
// The parser is pugixml. It does not use recursion. It expands only the five predefined entities of
// XML and leaves references to other entities unchanged. It does not validate all of XML, so this
// file rejects content that would be misread.
#include "io/graphml_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <span>
#include <unordered_map>

#include "io/input_error.h"
#include "io/text_file.h"
#include "model/parse_number.h"

namespace grove::detail {
namespace {

using pugi::xml_node;

constexpr std::array<std::string_view, 2> kNodeData = {"x", "y"};
constexpr std::array<std::string_view, 4> kLengths = {"length", "distance", "weight", "cost"};
constexpr std::array<std::string_view, 2> kTimes = {"duration", "time"};
constexpr std::array<std::string_view, 6> kEdgeData = {"length", "distance", "weight",
                                                       "cost",   "duration", "time"};

std::string_view local_name(xml_node node) {
  const std::string_view name = node.name();
  return name.substr(name.find(':') + 1);  // npos + 1 == 0: no prefix
}

bool is_element(xml_node node, std::string_view name) {
  return node.type() == pugi::node_element && local_name(node) == name;
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

// Returns the complete text of an element, including text after comments and in CDATA sections.
std::string text_of(xml_node element) {
  std::string text;
  for (const xml_node child : element.children())
    if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
      text += child.value();
  return text;
}

// A parsed file that can report the position of its elements.
class XmlFile {
 public:
  XmlFile(std::string_view text, const std::string& name) : file_(name), lines_(text) {
    require_text(text);
    const auto result =
        document_.load_buffer(text.data(), text.size(), pugi::parse_default | pugi::parse_doctype);
    if (result.encoding != pugi::encoding_utf8)
      throw InputError(file_, "", "is encoded in another way; expected UTF-8");
    if (!result)
      throw InputError(file_,
                       lines_.place(static_cast<std::size_t>(
                           std::max<std::ptrdiff_t>(0, std::min(result.offset, std::ssize(text))))),
                       fmt::format("malformed XML: {}; expected GraphML", result.description()));
    for (const xml_node node : document_.children())
      if (node.type() == pugi::node_doctype &&
          std::string_view(node.value()).find('[') != std::string_view::npos)
        throw InputError(
            file_, "",
            "its document type has declarations; expected none, because entities are not expanded");
  }

  const std::string& file() const { return file_; }
  xml_node root() const { return document_.document_element(); }

  std::string place(xml_node element) const {
    const std::ptrdiff_t offset = element.offset_debug();  // offset of the name, after <
    return offset > 0 ? lines_.place(static_cast<std::size_t>(offset) - 1) : "";
  }
  [[noreturn]] void fail(xml_node element, std::string_view message) const {
    throw InputError(file_, place(element), message);
  }

 private:
  void require_text(std::string_view text) const {
    if (trimmed(text).empty()) throw InputError(file_, "", "is empty; expected GraphML");
    const std::size_t nul = text.find('\0');
    const bool is_wide = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
    if (nul != std::string_view::npos && !is_wide)
      throw InputError(file_, lines_.place(nul), "found a NUL character; expected text in UTF-8");
  }

  std::string file_;
  LineStarts lines_;
  pugi::xml_document document_;
};

// A declaration of data by a <key> element.
struct Key {
  std::string name;  // attr.name in lower case; empty: a yEd key for drawings
  std::string element;
  std::optional<std::string> preset;  // <default>
  xml_node at;
};

class GraphmlReader {
 public:
  GraphmlReader(std::string_view text, const std::string& name, std::vector<std::string>* warnings)
      : xml_(text, name), warnings_(warnings) {}

  RoadNetwork read() {
    if (!is_element(xml_.root(), "graphml"))
      xml_.fail(xml_.root(), fmt::format("found element '{}'; expected 'graphml'",
                                         one_line(xml_.root().name())));
    read_keys();
    const xml_node graph = only_graph();
    is_directed_ = default_of(graph);
    network_.file = xml_.file();
    for (const xml_node child : graph.children())
      if (is_element(child, "node")) read_node(child);
    if (network_.vertices.empty()) xml_.fail(graph, "has no node; expected at least one");
    for (const xml_node child : graph.children()) read_other(child);
    return std::move(network_);
  }

 private:
  struct Datum {
    std::string text;
    xml_node at;
  };
  using Data = std::map<std::string, Datum, std::less<>>;

  void warn_once(xml_node at, const std::string& what) {
    if (!warned_.insert(what).second || warnings_ == nullptr) return;
    warnings_->push_back(fmt::format("{}: {}: {} is ignored", one_line(xml_.file()), xml_.place(at),
                                     one_line(what)));
  }

  std::string attribute(xml_node element, const char* name) const {
    const pugi::xml_attribute found = element.attribute(name);
    if (!found)
      xml_.fail(element,
                fmt::format("attribute '{}' is missing; expected it in this element", name));
    return found.value();
  }

  void read_keys() {
    for (const xml_node element : xml_.root().children()) {
      if (!is_element(element, "key")) continue;
      Key key{lower(element.attribute("attr.name").value()),
              element.attribute("for").value(),
              {},
              element};
      for (const xml_node child : element.children())
        if (is_element(child, "default")) key.preset = text_of(child);
      const std::string id = attribute(element, "id");
      if (!keys_.emplace(id, std::move(key)).second)
        xml_.fail(element, fmt::format("key '{}' is declared twice; expected distinct ids", id));
    }
  }

  xml_node only_graph() const {
    xml_node graph;
    for (const xml_node child : xml_.root().children()) {
      if (!is_element(child, "graph")) continue;
      if (graph) xml_.fail(child, "found a second graph; expected one per file");
      graph = child;
    }
    if (!graph) xml_.fail(xml_.root(), "has no element 'graph'; expected one");
    return graph;
  }

  bool default_of(xml_node graph) const {
    const std::string text = attribute(graph, "edgedefault");
    if (text != "directed" && text != "undirected")
      xml_.fail(graph,
                fmt::format("found edgedefault '{}'; expected directed or undirected", text));
    return text == "directed";
  }

  // The name of the data in a <data> element. If there is no <key> element for it, as in files
  // written by hand, the name is the id of the key.
  std::string name_of(xml_node data) const {
    const std::string id = attribute(data, "key");
    const auto key = keys_.find(id);
    return key == keys_.end() ? lower(id) : key->second.name;
  }

  // The data of an element by name, for the names in `known`, including defaults.
  Data data_of(xml_node element, std::span<const std::string_view> known) {
    Data data;
    for (const xml_node child : element.children()) {
      if (!is_element(child, "data")) continue;
      const std::string name = name_of(child);
      if (std::ranges::find(known, name) == known.end()) {
        if (!name.empty()) warn_once(child, fmt::format("data '{}'", name));
      } else if (!data.emplace(name, Datum{text_of(child), child}).second) {
        xml_.fail(child, fmt::format("data '{}' is given twice; expected it once", name));
      }
    }
    for (const auto& [id, key] : keys_)
      if (key.preset && (key.element == local_name(element) || key.element == "all") &&
          std::ranges::find(known, key.name) != known.end())
        data.emplace(key.name, Datum{*key.preset, key.at});
    return data;
  }

  double number(const Datum& datum, std::string_view name) const {
    const auto value = parse_number<double>(trimmed(datum.text));
    if (!value)
      xml_.fail(datum.at, fmt::format("found '{}' for {}; expected a finite number",
                                      one_line(datum.text), name));
    return *value;
  }

  // The value of the first of `names` that is present. Returns nullopt if none is.
  std::optional<double> positive_number(const Data& data, std::span<const std::string_view> names,
                                        std::string_view unit) const {
    for (const std::string_view name : names) {
      const auto found = data.find(name);
      if (found == data.end()) continue;
      const double value = number(found->second, name);
      if (!(value > 0))
        xml_.fail(found->second.at, fmt::format("found {} for {}; expected a positive number of {}",
                                                trimmed(found->second.text), name, unit));
      return value;
    }
    return std::nullopt;
  }

  std::string new_id(xml_node node) {
    std::string id = attribute(node, "id");
    if (id.empty()) xml_.fail(node, "expected an id that is not empty");
    if (!is_utf8(id)) xml_.fail(node, fmt::format("id '{}' is not in UTF-8; expected UTF-8", id));
    if (!numbers_.emplace(id, static_cast<int>(network_.vertices.size())).second)
      xml_.fail(node, fmt::format("id '{}' is used twice; expected distinct ids", id));
    return id;
  }

  // The centre of a node's drawing by yEd, which stores the corner and the size.
  std::optional<Point> middle_of_drawing(xml_node node) const {
    for (const xml_node data : node.children("data"))
      for (const xml_node shape : data.children())
        for (const xml_node part : shape.children())
          if (is_element(part, "Geometry")) {
            const auto value = [&](const char* name) {
              return number({attribute(part, name), part}, name);
            };
            return Point{value("x") + value("width") / 2, value("y") + value("height") / 2};
          }
    return std::nullopt;
  }

  Point position(xml_node node) {
    const Data data = data_of(node, kNodeData);
    const auto x = data.find("x");
    const auto y = data.find("y");
    if (x != data.end() && y != data.end()) return {number(x->second, "x"), number(y->second, "y")};
    if (const auto drawn = middle_of_drawing(node)) return *drawn;
    xml_.fail(node, fmt::format("data '{}' is missing; expected x and y of the node, in metres",
                                x == data.end() ? "x" : "y"));
  }

  void read_node(xml_node node) {
    std::string id = new_id(node);
    for (const xml_node child : node.children())
      if (is_element(child, "graph"))
        xml_.fail(child, "found a graph within a node; expected a graph without groups");
    network_.vertices.push_back({std::move(id), position(node)});
  }

  void read_other(xml_node child) {
    if (child.type() != pugi::node_element || is_element(child, "node")) return;
    if (is_element(child, "edge")) return read_edge(child);
    if (is_element(child, "hyperedge"))
      xml_.fail(child, "found a hyperedge; expected edges between two nodes");
    if (!is_element(child, "data") && !is_element(child, "desc"))
      warn_once(child, fmt::format("element '{}'", local_name(child)));
  }

  int end_of(xml_node edge, const char* name) const {
    const std::string id = attribute(edge, name);
    const auto found = numbers_.find(id);
    if (found == numbers_.end())
      xml_.fail(edge, fmt::format("there is no node '{}', its {}; expected the id of one of this "
                                  "graph",
                                  id, name));
    return found->second;
  }

  bool is_one_way(xml_node edge) const {
    const pugi::xml_attribute found = edge.attribute("directed");
    if (!found) return is_directed_;
    const std::string_view text = found.value();
    const bool is_true = text == "true" || text == "1";
    if (!is_true && text != "false" && text != "0")
      xml_.fail(edge, fmt::format("found directed '{}'; expected true or false", text));
    return is_true;
  }

  double distance(xml_node edge, const Link& link) const {
    const Point& a = network_.vertices[link.from].at;
    const Point& b = network_.vertices[link.to].at;
    const double metres = std::hypot(a.x - b.x, a.y - b.y);
    if (!(metres > 0) || !std::isfinite(metres))
      xml_.fail(edge, fmt::format("has no length, and its ends are {} m apart; expected data "
                                  "'length', or ends at a positive distance",
                                  metres));
    return metres;
  }

  void read_edge(xml_node edge) {
    Link link{end_of(edge, "source"), end_of(edge, "target"), is_one_way(edge), 0, {}, {}};
    const Data data = data_of(edge, kEdgeData);
    const auto length = positive_number(data, kLengths, "metres");
    link.metres = length ? *length : distance(edge, link);
    link.seconds = positive_number(data, kTimes, "seconds");
    link.place = xml_.place(edge);
    network_.links.push_back(std::move(link));
  }

  XmlFile xml_;
  std::vector<std::string>* warnings_;  // may be nullptr
  std::set<std::string> warned_;
  std::map<std::string, Key> keys_;
  bool is_directed_ = false;
  RoadNetwork network_;
  std::unordered_map<std::string, int> numbers_;  // index of the vertex, by id
};

}  // namespace

RoadNetwork parse_graphml(std::string_view text, const std::string& name,
                          std::vector<std::string>* warnings) {
  return GraphmlReader(text, name, warnings).read();
}

RoadNetwork read_graphml(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  return parse_graphml(read_text(path), path.string(), warnings);
}

}  // namespace grove::detail
