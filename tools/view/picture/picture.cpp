// SPDX-License-Identifier: MIT
#include "tools/view/picture/picture.h"

#include <cairo/cairo-svg.h>
#include <fmt/format.h>
#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tools/view/picture/legend.h"
#include "tools/view/picture/shapes.h"

namespace grove::detail {
namespace {

struct Free {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
};
using Surface = std::unique_ptr<cairo_surface_t, Free>;
using Context = std::unique_ptr<cairo_t, Free>;

constexpr int kGap = 12;           // pixels between two moments
constexpr int kMaxPixels = 30000;  // maximum width and height; cairo's limit is 32767
constexpr int kCaption = 20;       // height of the caption below each moment
constexpr int kMinWidthWithLegend = 640;

cairo_status_t append(void* text, const unsigned char* bytes, unsigned length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), length);
  return CAIRO_STATUS_SUCCESS;
}

void require(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(fmt::format("cairo: {}", cairo_status_to_string(status)));
}

// Layout in pixels: moments in rows of at most four, each with its caption below, and the legend at
// the bottom.
struct Strip {
  Strip(const Drawing& drawing, std::size_t count, int width, bool captioned)
      : panel_width(width),
        panel_height(std::max(1, static_cast<int>(std::lround(width * drawing.shape())))),
        caption(captioned && drawing.has_plan() ? kCaption : 0),
        columns(std::min<int>(static_cast<int>(count), 4)),
        rows((static_cast<int>(count) + columns - 1) / columns),
        legend(captioned && whole_width() >= kMinWidthWithLegend
                   ? legend_rows(drawing.instance()) * kLegendRow
                   : 0) {
    if (whole_width() > kMaxPixels || whole_height() > kMaxPixels)
      throw std::invalid_argument(
          fmt::format("found a picture of {} x {} pixels; expected at most {} in width and height",
                      whole_width(), whole_height(), kMaxPixels));
  }
  int whole_width() const { return columns * (panel_width + kGap) - kGap; }
  int row_height() const { return panel_height + caption + kGap; }
  int whole_height() const { return rows * row_height() - kGap + legend; }

  int panel_width;
  int panel_height;
  int caption;
  int columns;
  int rows;
  int legend;
};

// Draws a caption such as "t = 12", centred below a moment.
void draw_caption(cairo_t* cairo, const Strip& strip, double moment) {
  const std::string text = fmt::format("t = {}", moment);
  cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, 12);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text.c_str(), &extents);
  set(cairo, kText);
  cairo_move_to(cairo, (strip.panel_width - extents.x_advance) / 2, strip.panel_height + 14);
  cairo_show_text(cairo, text.c_str());
}

void draw_strip(cairo_t* cairo, const Drawing& drawing, std::span<const double> moments,
                const Strip& strip) {
  set(cairo, kFloor);
  cairo_paint(cairo);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const int column = static_cast<int>(i) % strip.columns;
    const int row = static_cast<int>(i) / strip.columns;
    cairo_save(cairo);
    cairo_translate(cairo, column * (strip.panel_width + kGap), row * strip.row_height());
    drawing.draw(cairo, strip.panel_width, moments[i]);
    if (strip.caption > 0) draw_caption(cairo, strip, moments[i]);
    cairo_restore(cairo);
  }
  if (strip.legend == 0) return;
  cairo_save(cairo);
  cairo_translate(cairo, 4, strip.whole_height() - strip.legend + 4);
  draw_legend(cairo, drawing.instance(), drawing.has_plan());
  cairo_restore(cairo);
}

Surface image(int width, int height) {
  Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
  require(cairo_surface_status(surface.get()));
  return surface;
}

// --- GIF ---

using Pixel = std::uint32_t;  // 0x00rrggbb

std::vector<Pixel> pixels_of(cairo_surface_t* surface) {
  cairo_surface_flush(surface);
  const int width = cairo_image_surface_get_width(surface);
  const int height = cairo_image_surface_get_height(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  const unsigned char* data = cairo_image_surface_get_data(surface);
  std::vector<Pixel> pixels;
  pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    const auto* row = reinterpret_cast<const Pixel*>(data + std::ptrdiff_t{y} * stride);
    for (int x = 0; x < width; ++x) pixels.push_back(row[x] & 0xffffff);
  }
  return pixels;
}

// The 255 most frequent colours. Maps any other colour to the nearest of them.
class Palette {
 public:
  static constexpr int kTransparent = 255;

  explicit Palette(const std::unordered_map<Pixel, std::int64_t>& counts) {
    std::vector<std::pair<std::int64_t, Pixel>> order;
    for (const auto& [pixel, count] : counts) order.emplace_back(-count, pixel);
    std::ranges::sort(order);
    for (const auto& [count, pixel] : order) {
      if (colors_.size() == kTransparent) break;
      colors_.push_back(pixel);
    }
  }

  GifByteType number(Pixel pixel) {
    const auto [known, is_new] = numbers_.try_emplace(pixel, GifByteType{0});
    if (is_new) known->second = nearest(pixel);
    return known->second;
  }

  std::vector<GifColorType> table() const {
    std::vector<GifColorType> table(256);
    for (std::size_t i = 0; i < colors_.size(); ++i)
      table[i] = {static_cast<GifByteType>(colors_[i] >> 16),
                  static_cast<GifByteType>(colors_[i] >> 8), static_cast<GifByteType>(colors_[i])};
    return table;
  }

 private:
  GifByteType nearest(Pixel pixel) const {
    const auto part = [](Pixel p, int shift) { return static_cast<int>(p >> shift & 255); };
    int best = 0;
    int least = 1 << 30;
    for (std::size_t i = 0; i < colors_.size(); ++i) {
      int distance = 0;
      for (const int shift : {0, 8, 16}) {
        const int difference = part(pixel, shift) - part(colors_[i], shift);
        distance += difference * difference;
      }
      if (distance < least) {
        least = distance;
        best = static_cast<int>(i);
      }
    }
    return static_cast<GifByteType>(best);
  }

  std::vector<Pixel> colors_;
  std::unordered_map<Pixel, GifByteType> numbers_;
};

int append_gif(GifFileType* file, const GifByteType* bytes, int length) {
  static_cast<std::string*>(file->UserData)
      ->append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(length));
  return length;
}

class GifWriter {
 public:
  GifWriter(int width, int height, const Palette& palette, std::string& bytes)
      : width_(width), height_(height) {
    int error = 0;
    file_ = EGifOpen(&bytes, append_gif, &error);
    if (file_ == nullptr) fail(error);
    EGifSetGifVersion(file_, true);
    colors_ = GifMakeMapObject(256, palette.table().data());
    if (colors_ == nullptr) fail(E_GIF_ERR_NOT_ENOUGH_MEM);
    require_ok(EGifPutScreenDesc(file_, width, height, 8, 0, colors_));
    const std::array<unsigned char, 3> forever{1, 0, 0};
    require_ok(EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE));
    require_ok(EGifPutExtensionBlock(file_, 11, "NETSCAPE2.0"));
    require_ok(EGifPutExtensionBlock(file_, static_cast<int>(forever.size()), forever.data()));
    require_ok(EGifPutExtensionTrailer(file_));
  }
  GifWriter(const GifWriter&) = delete;
  GifWriter& operator=(const GifWriter&) = delete;
  ~GifWriter() {
    if (colors_ != nullptr) GifFreeMapObject(colors_);
    if (file_ != nullptr) EGifCloseFile(file_, nullptr);
  }

  // Appends a frame, of which it writes only the smallest rectangle that contains all changes.
  void add(const std::vector<GifByteType>& frame, int centiseconds) {
    const Box box = last_.empty() ? Box{0, 0, width_, height_} : changed(frame);
    const GraphicsControlBlock control{
        DISPOSE_DO_NOT, false, centiseconds,
        last_.empty() ? NO_TRANSPARENT_COLOR : Palette::kTransparent};
    std::array<GifByteType, 4> extension{};
    EGifGCBToExtension(&control, extension.data());
    require_ok(EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE, 4, extension.data()));
    require_ok(EGifPutImageDesc(file_, box.x, box.y, box.width, box.height, false, nullptr));
    std::vector<GifByteType> line(static_cast<std::size_t>(box.width));
    for (int y = box.y; y < box.y + box.height; ++y) {
      for (int x = 0; x < box.width; ++x) {
        const std::size_t at = index(box.x + x, y);
        const bool same = !last_.empty() && last_[at] == frame[at];
        line[static_cast<std::size_t>(x)] =
            same ? static_cast<GifByteType>(Palette::kTransparent) : frame[at];
      }
      require_ok(EGifPutLine(file_, line.data(), box.width));
    }
    last_ = frame;
  }

  void close() {
    int error = 0;
    GifFileType* file = std::exchange(file_, nullptr);
    if (EGifCloseFile(file, &error) == GIF_ERROR) fail(error);
  }

 private:
  struct Box {
    int x, y, width, height;
  };

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  Box changed(const std::vector<GifByteType>& frame) const {
    Box box{width_, height_, 0, 0};  // least x and y, greatest x and y plus 1; empty at first
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        if (frame[index(x, y)] == last_[index(x, y)]) continue;
        box = {std::min(box.x, x), std::min(box.y, y), std::max(box.width, x + 1),
               std::max(box.height, y + 1)};
      }
    if (box.width == 0) return {0, 0, 1, 1};
    return {box.x, box.y, box.width - box.x, box.height - box.y};
  }

  void require_ok(int result) const {
    if (result == GIF_ERROR) fail(file_->Error);
  }
  [[noreturn]] static void fail(int error) {
    const char* text = GifErrorString(error);
    throw std::runtime_error(fmt::format("giflib: {}", text == nullptr ? "unknown error" : text));
  }

  int width_;
  int height_;
  GifFileType* file_ = nullptr;
  ColorMapObject* colors_ = nullptr;
  std::vector<GifByteType> last_;
};

constexpr int kMaxFrames = 2000;
constexpr double kFramesPerSecond = 20;
constexpr int kRestAtTheEnd = 150;  // pause at the end, in hundredths of a second

// Returns the number of frames per step, from 1 to 20: enough for kFramesPerSecond, but fewer if
// the whole plan would have more than kMaxFrames.
int frames_per_step(Time end, double steps_per_second) {
  const int wanted = static_cast<int>(std::lround(kFramesPerSecond / steps_per_second));
  const int allowed = end > 0 ? kMaxFrames / end : 1;
  return std::clamp(std::min(wanted, allowed), 1, 20);
}

}  // namespace

std::string svg_picture(const Drawing& drawing, std::span<const double> moments, int width) {
  const Strip strip(drawing, moments.size(), width, true);
  std::string svg;
  const Surface surface(
      cairo_svg_surface_create_for_stream(append, &svg, strip.whole_width(), strip.whole_height()));
  cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
  const Context cairo(cairo_create(surface.get()));
  draw_strip(cairo.get(), drawing, moments, strip);
  require(cairo_status(cairo.get()));
  cairo_surface_finish(surface.get());
  require(cairo_surface_status(surface.get()));
  return svg;
}

std::string png_picture(const Drawing& drawing, std::span<const double> moments, int width) {
  const Strip strip(drawing, moments.size(), width, true);
  const Surface surface = image(strip.whole_width(), strip.whole_height());
  const Context cairo(cairo_create(surface.get()));
  draw_strip(cairo.get(), drawing, moments, strip);
  require(cairo_status(cairo.get()));
  std::string png;
  require(cairo_surface_write_to_png_stream(surface.get(), append, &png));
  return png;
}

std::string gif_picture(const Drawing& drawing, int width, double steps_per_second) {
  const Strip strip(drawing, 1, width, false);
  const Surface surface = image(strip.panel_width, strip.panel_height);
  const Context cairo(cairo_create(surface.get()));
  const auto frame = [&](double time) {
    drawing.draw(cairo.get(), strip.panel_width, time);
    require(cairo_status(cairo.get()));
    return pixels_of(surface.get());
  };
  // Takes the palette from five moments, spread evenly over the plan.
  std::unordered_map<Pixel, std::int64_t> counts;
  for (int i = 0; i <= 4; ++i)
    for (const Pixel pixel : frame(drawing.end() * i / 4.0)) ++counts[pixel];
  Palette palette(counts);

  const int between = frames_per_step(drawing.end(), steps_per_second);
  const int delay = std::max(2, static_cast<int>(std::lround(100 / steps_per_second / between)));
  std::string bytes;
  GifWriter writer(strip.panel_width, strip.panel_height, palette, bytes);
  const int last = static_cast<int>(drawing.end()) * between;
  for (int i = 0; i <= last; ++i) {
    std::vector<GifByteType> numbers;
    for (const Pixel pixel : frame(static_cast<double>(i) / between))
      numbers.push_back(palette.number(pixel));
    writer.add(numbers, i == last ? kRestAtTheEnd : delay);
  }
  writer.close();
  return bytes;
}

}  // namespace grove::detail
