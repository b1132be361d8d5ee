// SPDX-License-Identifier: MIT
#include "tools/convert/occupancy_map.h"

#include <fmt/format.h>
#include <png.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "io/input_error.h"
#include "io/map_file.h"
#include "io/text_file.h"
#include "model/parse_number.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

struct Image {
  int width = 0;
  int height = 0;
  std::vector<double> light;  // from 0 (black) to 1 (white), row by row from the top
};

constexpr std::size_t kLargestYaml = std::size_t{1} << 16;
// Peak memory per pixel, for the decoded image and the maps made from it.
constexpr std::size_t kBytesPerPixel = 32;

void require_size(const std::string& file, std::int64_t width, std::int64_t height,
                  const InputRules& rules) {
  if (width < 1 || height < 1 || width * height > kMaxMapCells)
    throw InputError(
        file, "",
        fmt::format("found {} x {} pixels; expected 1 to {} in all", width, height, kMaxMapCells));
  require_memory(rules, file, "", width * height, "pixels", kBytesPerPixel);
}

// Reads a Netpbm greyscale image (PGM), binary (P5) or plain text (P2).
class PgmReader {
 public:
  PgmReader(const fs::path& path, const InputRules& rules)
      : file_(path.string()), text_(read_text(path)), rules_(rules) {}

  Image read() {
    const std::string kind = word();
    if (kind != "P5" && kind != "P2")
      fail("is not a PGM image; expected P5 or P2 at its beginning");
    Image image;
    image.width = number(1, kMaxMapCells, "a width");
    image.height = number(1, kMaxMapCells, "a height");
    require_size(file_, image.width, image.height, rules_);
    const int most = number(1, 65535, "a greatest value");
    const std::size_t count =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    if (kind == "P5") ++at_;  // the single whitespace character before the pixels
    for (std::size_t i = 0; i < count; ++i)
      image.light.push_back(
          static_cast<double>(kind == "P5" ? raw(most) : number(0, most, "a value")) / most);
    return image;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file_, fmt::format("byte {}", at_), message);
  }
  std::string word() {
    const auto is_blank = [&] { return std::isspace(static_cast<unsigned char>(text_[at_])) != 0; };
    while (at_ < text_.size() && (is_blank() || text_[at_] == '#')) {
      if (text_[at_] == '#')
        at_ = std::min(text_.find('\n', at_), text_.size());
      else
        ++at_;
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank()) ++at_;
    return text_.substr(begin, std::min<std::size_t>(at_ - begin, 40));
  }
  int number(int least, int most, const char* what) {
    const std::string text = word();
    const auto value = parse_number(text, least, most);
    if (!value)
      fail(fmt::format("found '{}'; expected {} from {} to {}", one_line(text), what, least, most));
    return *value;
  }
  int raw(int most) {
    const std::size_t bytes = most > 255 ? 2 : 1;
    if (at_ + bytes > text_.size()) fail("the file ends here; expected more pixels");
    int value = static_cast<unsigned char>(text_[at_++]);
    if (bytes == 2) value = 256 * value + static_cast<unsigned char>(text_[at_++]);
    return std::min(value, most);
  }

  std::string file_;
  std::string text_;
  const InputRules& rules_;
  std::size_t at_ = 0;
};

// Reads a PNG image as greyscale. Transparency darkens pixels; a fully transparent pixel is black.
Image read_png(const fs::path& path, const InputRules& rules) {
  const std::string bytes = read_text(path);
  if (!bytes.starts_with("\x89PNG\r\n\x1a\n"))
    throw InputError(path.string(), "", "is not a PNG image; expected one");
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, void (*)(png_image*)> freed_at_last(&png, png_image_free);
  const auto require = [&](int succeeded) {
    if (succeeded == 0)
      throw InputError(path.string(), "", fmt::format("not a valid PNG image:  {}", png.message));
  };
  require(png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()));
  require_size(path.string(), png.width, png.height, rules);
  png.format = PNG_FORMAT_RGBA;
  std::vector<png_byte> pixels(PNG_IMAGE_SIZE(png));
  require(png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr));
  Image image;
  image.width = static_cast<int>(png.width);
  image.height = static_cast<int>(png.height);
  image.light.reserve(pixels.size() / 4);
  for (std::size_t i = 0; i < pixels.size(); i += 4)
    image.light.push_back((pixels[i] + pixels[i + 1] + pixels[i + 2]) * pixels[i + 3] /
                          (3 * 255.0 * 255.0));
  return image;
}

// Reads the keys of a map.yaml file.
class Keys {
 public:
  explicit Keys(const fs::path& path) : file_(path.string()) {
    try {
      const std::string text = read_text(path);
      if (text.size() > kLargestYaml)
        throw InputError(file_, "", "is too large; expected at most 64 KiB, the keys of a ROS map");
      root_ = YAML::Load(text);
    } catch (const YAML::Exception& error) {
      throw InputError(file_, fmt::format("line {}", error.mark.line + 1), one_line(error.msg));
    }
    if (!root_.IsMap() || !root_["image"])
      throw InputError(file_, "", "expected the keys of a ROS map: image, resolution, origin, ...");
  }

  const std::string& file() const { return file_; }
  std::string text(const char* key, const std::string& otherwise) const {
    const YAML::Node node = root_[key];
    return node && node.IsScalar() ? node.Scalar() : otherwise;
  }
  double number(const char* key, double least, double most, double otherwise) const {
    const YAML::Node node = root_[key];
    if (!node && !std::isnan(otherwise)) return otherwise;
    return as_number(node, key, least, most);
  }
  Point origin() const {
    const YAML::Node node = root_["origin"];
    if (!node || !node.IsSequence() || node.size() < 2)
      throw InputError(file_, "origin", "expected [x, y, yaw], metres and radians");
    if (node.size() > 2 && as_number(node[2], "origin", -10, 10) != 0)
      throw InputError(
          file_, "origin",
          fmt::format("found a yaw of {}; expected 0; rotate the image first", node[2].Scalar()));
    return {as_number(node[0], "origin", -1e6, 1e6), as_number(node[1], "origin", -1e6, 1e6)};
  }

 private:
  double as_number(const YAML::Node& node, const char* key, double least, double most) const {
    const std::string text = node && node.IsScalar() ? node.Scalar() : "";
    if (const auto value = parse_number(text, least, most)) return *value;
    throw InputError(
        file_, key,
        fmt::format("found '{}'; expected a number from {} to {}", one_line(text), least, most));
  }

  std::string file_;
  YAML::Node root_;
};

fs::path image_of(const Keys& keys, const fs::path& folder, const InputRules& rules) {
  try {
    return file_in_folder(rules, folder, keys.text("image", ""));
  } catch (const std::invalid_argument& error) {
    throw InputError(keys.file(), "image", error.what());
  }
}

constexpr double kRequired = std::numeric_limits<double>::quiet_NaN();

}  // namespace

OccupancyMap::OccupancyMap(const fs::path& yaml, const InputRules& rules) {
  const Keys keys(yaml);
  if (const std::string mode = keys.text("mode", "trinary"); mode != "trinary" && mode != "scale")
    throw InputError(keys.file(), "mode",
                     fmt::format("found '{}'; expected trinary or scale", one_line(mode)));
  resolution_ = keys.number("resolution", 1e-4, 100, kRequired);
  origin_ = keys.origin();
  const double free_below = keys.number("free_thresh", 0, 1, 0.25);
  const std::string negate = keys.text("negate", "0");
  const bool is_negated = negate == "1" || negate == "true";
  const fs::path file = image_of(keys, yaml.parent_path(), rules);
  const std::string suffix = file.extension().string();
  const Image image =
      suffix == ".png" || suffix == ".PNG" ? read_png(file, rules) : PgmReader(file, rules).read();
  width_ = image.width;
  height_ = image.height;
  for (const double light : image.light)
    free_.push_back((is_negated ? light : 1 - light) < free_below);
}

OccupancyMap::OccupancyMap(int width, int height, std::vector<bool> free, double resolution,
                           Point origin)
    : width_(width),
      height_(height),
      free_(std::move(free)),
      resolution_(resolution),
      origin_(origin) {}

bool OccupancyMap::is_free(int x, int y) const {
  return x >= 0 && x < width_ && y >= 0 && y < height_ &&
         free_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x)];
}

bool OccupancyMap::is_clear(Point at, double radius) const {
  // Coordinates in pixels, y downwards.
  const double px = at.x / resolution_;
  const double py = height_ - at.y / resolution_;
  const double reach = radius / resolution_;
  const auto first = [&](double p) { return static_cast<int>(std::floor(p - reach)); };
  const auto last = [&](double p) { return static_cast<int>(std::floor(p + reach)); };
  for (int y = first(py); y <= last(py); ++y)
    for (int x = first(px); x <= last(px); ++x) {
      const double dx = std::max({0.0, x - px, px - (x + 1)});
      const double dy = std::max({0.0, y - py, py - (y + 1)});
      const bool is_here = std::floor(px) == x && std::floor(py) == y;
      if ((is_here || dx * dx + dy * dy < reach * reach) && !is_free(x, y)) return false;
    }
  return true;
}

namespace {

class Cells {
 public:
  Cells(const OccupancyMap& map, double cell_size, double radius)
      : map_(map),
        size_(cell_size),
        radius_(radius),
        // 1e-6 cells of tolerance, so that rounding errors do not exclude a cell that fits exactly.
        width_(static_cast<int>(std::floor(map.width() / cell_size + 1e-6))),
        height_(static_cast<int>(std::floor(map.height() / cell_size + 1e-6))) {
    if (width_ < 1 || height_ < 1)
      throw std::invalid_argument(fmt::format("no cell of {} m fits into {:.4g} x {:.4g} m",
                                              cell_size, map.width(), map.height()));
  }

  CellMap run() {
    int too_near = 0;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        passable_.push_back(map_.is_clear(middle(x, y), radius_));
        if (!passable_.back() && map_.is_clear(middle(x, y), 0)) ++too_near;
      }
    const int narrow = block_narrow();
    return {Grid(width_, height_, passable_), too_near, narrow};
  }

 private:
  Point middle(int x, int y) const { return {(x + 0.5) * size_, (height_ - y - 0.5) * size_}; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  bool passable(int x, int y) const {
    return x >= 0 && x < width_ && y >= 0 && y < height_ && passable_[index(x, y)];
  }
  bool are_connected(int ax, int ay, int bx, int by) const {
    const Point a = middle(ax, ay);
    const Point b = middle(bx, by);
    const int steps = std::max(1, static_cast<int>(std::ceil(2 * size_ / map_.resolution())));
    for (int i = 1; i < steps; ++i) {
      const double part = static_cast<double>(i) / steps;
      if (!map_.is_clear({a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)}, radius_))
        return false;
    }
    return true;
  }
  int connection_count(int x, int y) const {
    int count = 0;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
      if (passable(x + dx, y + dy) && are_connected(x, y, x + dx, y + dy)) ++count;
    return count;
  }
  int block_narrow() {
    int blocked = 0;
    const auto separate = [&](int ax, int ay, int bx, int by) {
      if (!passable(ax, ay) || !passable(bx, by) || are_connected(ax, ay, bx, by)) return;
      const bool first = connection_count(ax, ay) < connection_count(bx, by);
      passable_[first ? index(ax, ay) : index(bx, by)] = false;
      ++blocked;
    };
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        separate(x, y, x + 1, y);
        separate(x, y, x, y + 1);
      }
    return blocked;
  }

  const OccupancyMap& map_;
  const double size_;
  const double radius_;
  const int width_;
  const int height_;
  std::vector<bool> passable_;
};

}  // namespace

CellMap cells_of(const OccupancyMap& map, double cell_size, double robot_radius) {
  return Cells(map, cell_size, robot_radius).run();
}

}  // namespace grove::detail
