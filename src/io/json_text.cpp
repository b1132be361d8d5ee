// SPDX-License-Identifier: MIT
// Uses the parser of nlohmann::json with a document builder of its own, because nlohmann's builder
// accepts any depth of nesting, and accepts repeated keys without an error.
#include "io/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "io/input_error.h"
#include "io/text_file.h"

namespace grove::detail {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxDepth = 32;

// Extracts the cause from a message such as "[json.exception.parse_error.101] parse error at line
// 1, column 2: syntax error while parsing value - invalid literal; last read: 'x'; expected ...".
// The position is reported separately, and "last read" can quote a large part of the file.
std::string tidy(const nlohmann::detail::exception& error) {
  constexpr int kNumberOverflow = 406;
  if (error.id == kNumberOverflow) return "a number is too large; expected one of double precision";
  std::string message = error.what();
  message.erase(0, message.find("] ") + 2);
  if (message.starts_with("parse error at")) message.erase(0, message.find(": ") + 2);
  const std::size_t last_read = message.find("; last read: '");
  const std::size_t expected = message.rfind("; expected ");
  if (last_read != std::string::npos) {
    const bool says_expected = expected != std::string::npos && expected > last_read;
    message.erase(last_read, says_expected ? expected - last_read : std::string::npos);
  }
  if (message.find("expected") == std::string::npos) message += "; expected JSON";
  return message;
}

// Returns a message if `rest` begins with a common mistake in JSON; otherwise "".
std::string_view common_mistake(std::string_view rest) {
  struct Mistake {
    std::string_view beginning;
    std::string_view message;
  };
  constexpr std::string_view kNoComments =
      "found a comment, which JSON does not allow; expected a key that begins with '_' instead";
  constexpr std::string_view kNoNumber = "found no valid JSON number; expected a finite number";
  constexpr Mistake kMistakes[] = {{"//", kNoComments},
                                   {"/*", kNoComments},
                                   {"#", kNoComments},
                                   {"NaN", kNoNumber},
                                   {"nan", kNoNumber},
                                   {"Infinity", kNoNumber},
                                   {"-Infinity", kNoNumber},
                                   {"inf", kNoNumber},
                                   {"-inf", kNoNumber},
                                   {"'", "a single quote; expected text in double quotes"},
                                   {"True", "found True; expected true, in lower case"},
                                   {"False", "found False; expected false, in lower case"},
                                   {"None", "found None; expected null, or no such key"}};
  for (const Mistake& mistake : kMistakes)
    if (rest.starts_with(mistake.beginning)) return mistake.message;
  return {};
}

// Returns the offset of the token at which the parser failed. `offset` can be inside this token,
// because the parser has read its first characters, such as "Na" of NaN or "//" of a comment.
std::size_t begin_of_token(std::string_view text, std::size_t offset) {
  constexpr std::string_view kBetween = " \t\r\n,:[]{}\"";
  offset = std::min(offset, text.size());
  while (offset > 0 && kBetween.find(text[offset - 1]) == std::string_view::npos) --offset;
  return offset;
}

// True if the character at `offset` is a closing bracket that follows a comma, as in "[1, 2, ]".
bool is_behind_last_comma(std::string_view text, std::size_t offset) {
  if (offset >= text.size() || (text[offset] != '}' && text[offset] != ']')) return false;
  const std::size_t before = text.substr(0, offset).find_last_not_of(" \t\r\n");
  return before != std::string_view::npos && text[before] == ',';
}

// Builds the document from parser events, and checks depth and repeated keys.
class DocumentBuilder : public nlohmann::json_sax<Json> {
 public:
  DocumentBuilder(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  Json take() { return std::move(root_); }

  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(std::int64_t value) override { return add(value); }
  bool number_unsigned(std::uint64_t value) override { return add(value); }
  bool number_float(double value, const std::string&) override { return add(value); }
  bool string(std::string& value) override { return add(std::move(value)); }
  bool binary(Json::binary_t&) override { return false; }  // does not occur in JSON texts

  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(std::string& name) override {
    Level& level = levels_.back();
    if (level.container->contains(name))
      throw InputError(file_, path(levels_.size() - 1),
                       fmt::format("key '{}' appears twice; expected distinct keys", name));
    level.key = std::move(name);
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) override {
    const std::size_t offset = position > 0 ? position - 1 : 0;
    for (const std::size_t begin : {begin_of_token(text_, offset), std::min(offset, text_.size())})
      if (const auto mistake = common_mistake(text_.substr(begin)); !mistake.empty())
        throw InputError(file_, line_and_column_at(text_, begin),
                         fmt::format("malformed JSON: {}", mistake));
    if (is_behind_last_comma(text_, offset))
      throw InputError(file_, line_and_column_at(text_, offset),
                       "malformed JSON: a comma after the last value; expected none");
    throw InputError(file_, line_and_column_at(text_, offset), "malformed JSON: " + tidy(error));
  }

 private:
  // An open array or object. No elements are added to it while one of its elements is open, so
  // pointers to them remain valid.
  struct Level {
    Json* container;
    std::string key;  // key of the current member
  };

  bool add(Json value) {
    place(std::move(value));
    return true;
  }

  bool open(Json container) {
    if (levels_.size() == kMaxDepth)
      throw InputError(file_, path(levels_.size()),
                       fmt::format("nested too deeply; expected at most {} levels", kMaxDepth));
    levels_.push_back({place(std::move(container)), ""});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  Json* place(Json value) {
    if (levels_.empty()) return &(root_ = std::move(value));
    Json& container = *levels_.back().container;
    if (container.is_object()) return &(container[levels_.back().key] = std::move(value));
    container.push_back(std::move(value));
    return &container.back();
  }

  // The JSON Pointer of the open container at `depth`, where depth 0 is the document.
  std::string path(std::size_t depth) const {
    std::string result = depth == 0 ? "/" : "";
    for (std::size_t k = 0; k < depth; ++k) {
      const Level& level = levels_[k];
      const bool keyed = level.container->is_object();
      const bool entered = k + 1 < levels_.size();  // then the array already contains the element
      const std::size_t index = level.container->size() - (entered ? 1 : 0);
      result += "/" + (keyed ? level.key : std::to_string(index));
    }
    return result;
  }

  std::string_view text_;
  const std::string& file_;
  Json root_;
  std::vector<Level> levels_;
};

}  // namespace

nlohmann::json parse_json(std::string_view text, const std::string& file) {
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
    throw InputError(file, "", "is empty; expected a JSON object");
  DocumentBuilder builder(text, file);
  Json::sax_parse(text, &builder);
  return builder.take();
}

namespace {

using OrderedJson = nlohmann::ordered_json;

std::string compact(const OrderedJson& value) {
  return value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

template <typename DumpElement>
std::string dump_lines(const OrderedJson& value, const std::string& indent,
                       DumpElement dump_element) {
  const bool is_object = value.is_object();
  std::string text = is_object ? "{" : "[";
  std::string separator = "\n" + indent;
  for (const auto& [key, element] : value.items()) {
    text += separator + (is_object ? compact(key) + ": " : "") + dump_element(element);
    separator = ",\n" + indent;
  }
  return text + (is_object ? "}" : "]");
}

}  // namespace

std::string dump_by_lines(const OrderedJson& document) {
  const auto dump_member = [](const OrderedJson& value) {
    return value.is_structured() ? dump_lines(value, "  ", compact) : compact(value);
  };
  return dump_lines(document, " ", dump_member) + "\n";
}

}  // namespace grove::detail
