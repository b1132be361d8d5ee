// SPDX-License-Identifier: MIT
#include "tests/fuzz/certificate_mutation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <string_view>
#include <utility>

#include "tests/fuzz/random.h"

namespace grove::detail::fuzz {
namespace {

using Lines = std::vector<std::string>;

class Mutation {
 public:
  Mutation(Lines lines, std::uint64_t seed) : lines_(std::move(lines)), random_(seed) {}

  Lines made() {
    for (int left = random_.percent(80) ? 1 : random_.between(2, 4); left > 0; --left) change();
    if (random_.percent(60)) raise_theorem();
    return lines_;
  }

 private:
  void change() {
    const int at = random_.below(static_cast<int>(lines_.size()));
    switch (random_.below(10)) {
      case 0:
      case 1:
      case 2:
        return change_number(lines_[at]);
      case 3:
        lines_.erase(lines_.begin() + at);
        return;
      case 4:
        lines_.insert(lines_.begin() + at, random_.pick(lines_));
        return;
      case 5:
        std::swap(lines_[at], lines_[random_.below(static_cast<int>(lines_.size()))]);
        return;
      case 6:
        return cut_off(at);
      case 7:
        return flip_sign(lines_[at]);
      case 8:
        return insert_clause(at);
      default:
        return change_word(lines_[at]);
    }
  }

  void change_number(std::string& line) {
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < line.size(); ++i)
      if (std::isdigit(static_cast<unsigned char>(line[i])) && (i == 0 || line[i - 1] == ' '))
        numbers.push_back(i);
    if (numbers.empty()) return;
    const std::size_t begin = random_.pick(numbers);
    const std::size_t end = std::min(line.find(' ', begin), line.size());
    std::int64_t number = 0;
    std::from_chars(line.data() + begin, line.data() + end, number);
    number += random_.pick<int>({-1, 1, 1, 2, -2, 10, -10});
    line.replace(begin, end - begin, fmt::to_string(std::max<std::int64_t>(0, number)));
  }

  // Negates a literal of a formula.
  void flip_sign(std::string& line) {
    if (!line.starts_with("clause ") && !line.starts_with("sum ") && !line.starts_with("split "))
      return;
    std::vector<std::size_t> blanks;
    for (std::size_t i = 0; i < line.size(); ++i)
      if (line[i] == ' ') blanks.push_back(i + 1);
    const std::size_t at = random_.pick(blanks);
    if (at < line.size() && line[at] == '-')
      line.erase(at, 1);
    else
      line.insert(at, "-");
  }

  // Inserts a clause of one or two literals among the clauses of a formula.
  void insert_clause(int at) {
    if (!lines_[at].starts_with("clause") && !lines_[at].starts_with("core")) return;
    std::string line = "clause";
    for (int left = random_.between(1, 2); left > 0; --left)
      line += fmt::format(" {}{}", random_.percent(50) ? "-" : "", random_.between(1, 200));
    lines_.insert(lines_.begin() + at, line);
  }

  void change_word(std::string& line) {
    if (random_.percent(50))
      return change_word(line, std::array<std::string_view, 6>{"visit", "last", "rests", "within",
                                                               "inside", "ends"});
    change_word(line, std::array<std::string_view, 8>{"bar", "move", "norest", "rest", "pass",
                                                      "stop", "nostop", "inf"});
  }

  template <std::size_t N>
  void change_word(std::string& line, const std::array<std::string_view, N>& words) {
    const std::string_view to = words[random_.below(N)];
    for (const std::string_view word : words)
      if (const std::size_t at = line.find(word); at != std::string::npos) {
        line.replace(at, word.size(), to);
        return;
      }
  }

  // Replaces the split at line `at`, if there is one, and its whole subtree by a leaf.
  void cut_off(int at) {
    const auto opens = [](const std::string& line) {
      return line.starts_with("split") || line.starts_with("later");
    };
    const auto closes = [](const std::string& line) {
      return line.starts_with("leaf") || line == "joint";
    };
    if (!opens(lines_[at])) return;
    int open = 1;
    std::size_t end = at;
    for (; end < lines_.size() && open > 0; ++end)
      open += opens(lines_[end]) ? 1 : closes(lines_[end]) ? -1 : 0;
    lines_.erase(lines_.begin() + at, lines_.begin() + static_cast<std::ptrdiff_t>(end));
    lines_.insert(lines_.begin() + at, random_.percent(50) ? "leaf" : "leaf 0");
  }

  void raise_theorem() {
    for (std::string& line : lines_)
      if (line.starts_with("theorem ")) {
        if (random_.percent(10))
          line = "theorem inf";
        else if (line.size() > 8 && std::isdigit(static_cast<unsigned char>(line[8])))
          line = fmt::format("theorem {}", std::stoll(line.substr(8)) + random_.between(1, 3));
      }
  }

  Lines lines_;
  Random random_;
};

}  // namespace

Lines mutated(Lines lines, std::uint64_t seed) {
  return Mutation(std::move(lines), seed).made();
}

}  // namespace grove::detail::fuzz
