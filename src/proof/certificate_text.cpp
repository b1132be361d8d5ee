// SPDX-License-Identifier: MIT
#include "grove/detail/proof/certificate_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <vector>

#include "grove/detail/io/input_error.h"
#include "grove/detail/io/text_file.h"
#include "grove/detail/model/parse_number.h"
#include "grove/detail/proof/certificate.h"
#include "zstd_stream.h"

namespace grove::detail {
namespace {

constexpr std::string_view kZstd = "\x28\xB5\x2F\xFD";  // what is compressed begins with it
constexpr std::size_t kMostBytes = std::size_t{1} << 24;
constexpr std::uint64_t kTimes = std::uint64_t{1} << 31;

std::string decompressed(const std::string& file, std::string_view bytes) {
  ZstdDecompressor stream([&](char* buffer, std::size_t size) {
    const std::size_t count = bytes.copy(buffer, size);
    bytes.remove_prefix(count);
    return count;
  });
  std::string text;
  char block[1 << 16];
  while (text.size() <= kMostBytes) {
    const std::size_t size = stream.read(block, sizeof block);
    text.append(block, size);
    if (size < sizeof block) break;
  }
  if (stream.broken())
    throw InputError(file, "", "is damaged; expected what grove solve --proof compressed by zstd");
  return text;
}

std::string text_of(const std::filesystem::path& path) {
  std::string text = read_text(path);
  if (text.starts_with(kZstd)) text = decompressed(path.string(), text);
  if (text.size() > kMostBytes)
    throw InputError(path.string(), "",
                     fmt::format("is too large to be looked at; expected a certificate of at most "
                                 "{} bytes, uncompressed",
                                 kMostBytes));
  return text;
}

class Reader {
 public:
  Reader(std::string file, std::string_view text, const Instance& instance)
      : file_(std::move(file)), text_(text), instance_(instance) {}

  CertificateText read() {
    CertificateText read{std::string(text_), 0, true};
    take_line();
    keyword("grove-proof");
    keyword("1");
    end_line();
    take_checksum();
    take_line();
    keyword("following");
    read.may_follow = one_of({"yes", "no"}) == 0;
    end_line();
    take_line();
    while (one_of({"lemma", "theorem"}) == 0) take_lemma();
    read.bound = bound();
    end_line();
    take_proof();
    take_line();
    keyword("end");
    end_line();
    if (!text_.empty()) fail("found more behind it", "nothing after 'end'");
    return read;
  }

  std::int64_t splits() const { return splits_; }

 private:
  // --- lines and words ---

  void take_line() {
    ++line_;
    const std::size_t end = text_.find('\n');
    if (end == std::string_view::npos)
      fail(text_.empty() ? "the file ends" : "the file ends within it", "a line, ended by LF");
    words_ = text_.substr(0, end);
    text_.remove_prefix(end + 1);
  }
  // Parted by one blank: two of them have an empty word between them, and what is behind the last
  // word is no word.
  std::string_view word(std::string_view expected) {
    if (!words_) fail("the line ends", expected);
    const std::string_view all = *words_;
    const std::size_t end = all.find(' ');
    if (end == std::string_view::npos)
      words_.reset();
    else
      words_ = all.substr(end + 1);
    return all.substr(0, end);
  }
  void end_line() {
    if (words_) fail_at(*words_, "the end of the line");
  }
  [[noreturn]] void fail(std::string_view found, std::string_view expected) const {
    throw InputError(file_, fmt::format("line {}", line_),
                     fmt::format("{}; expected {}", found, expected));
  }
  [[noreturn]] void fail_at(std::string_view found, std::string_view expected) const {
    fail(fmt::format("found '{}'", one_line(found)), expected);
  }

  void keyword(std::string_view expected) {
    const std::string quoted = fmt::format("'{}'", expected);
    const std::string_view found = word(quoted);
    if (found != expected) fail_at(found, quoted);
  }
  // Its number among them.
  int one_of(std::initializer_list<std::string_view> words) {
    const std::string expected = fmt::format("{}", fmt::join(words, " or "));
    const std::string_view found = word(expected);
    const auto at = std::ranges::find(words, found);
    if (at == words.end()) fail_at(found, expected);
    return static_cast<int>(at - words.begin());
  }
  std::uint64_t number(std::string_view what, std::uint64_t below) {
    const std::string expected = below == 0 ? fmt::format("{}, of which there is none", what)
                                            : fmt::format("{}, from 0 to {}", what, below - 1);
    const std::string_view found = word(expected);
    const auto value = parse_number<std::uint64_t>(found);
    if (!value || *value >= below) fail_at(found, expected);
    return *value;
  }
  bool take_inf() {
    if (!words_ || words_->substr(0, words_->find(' ')) != "inf") return false;
    word("inf");
    return true;
  }

  // --- numbers of things ---

  int agent() { return static_cast<int>(number("the number of an agent", agents())); }
  void place() {
    number("the number of a place", static_cast<std::uint64_t>(instance_.world().place_count()));
  }
  void task() {
    number("the number of a task", static_cast<std::uint64_t>(instance_.task_count()));
  }
  void lemma() { number("the number of an earlier lemma", lemmas_); }
  void time() { number("a time", kTimes); }
  // From when until when.
  void span() {
    time();
    if (!take_inf()) number("a time or inf", kTimes);
  }
  // An agent with a goal, and a time.
  void late() {
    const int whose = agent();
    if (!instance_.agent(whose).goal)
      fail_at(fmt::to_string(whose), "the number of an agent with a goal");
    time();
  }
  // Two agents, each with a time.
  void pair() {
    agent();
    time();
    agent();
    time();
  }
  Cost bound() {
    if (take_inf()) return kInfiniteCost;
    return static_cast<Cost>(number("a cost or inf", static_cast<std::uint64_t>(kInfiniteCost)));
  }
  std::uint64_t agents() const { return static_cast<std::uint64_t>(instance_.agent_count()); }

  // --- what lines say ---

  void take_checksum() {
    take_line();
    keyword("instance");
    const std::string expected =
        fmt::format("{:016x}, the checksum of this instance", certificate_checksum(instance_));
    const std::string_view found = word(expected);
    if (found != expected.substr(0, 16)) fail_at(found, expected);
    end_line();
  }

  // The demand's agent.
  int demand() {
    const int whose = agent();
    switch (one_of({"bar", "move", "norest", "rest", "pass", "stop", "nostop"})) {
      case 0:
        place();
        span();
        break;
      case 1:
      case 4:
        place();
        place();
        span();
        break;
      case 2:
      case 3:
        place();
        time();
        break;
      default:
        number("the number of a stop", static_cast<std::uint64_t>(instance_.task_count()));
        task();
    }
    return whose;
  }

  // Behind the word "lemma"; and the first word of what comes after it.
  void take_lemma() {
    bound();
    std::vector<int> whose{agent()};
    while (words_) {
      const std::string_view rest = *words_;
      whose.push_back(agent());
      if (whose.back() <= whose[whose.size() - 2]) fail_at(rest, "agents in ascending order");
    }
    take_line();
    while (words_->starts_with("demand ")) {
      keyword("demand");
      const std::string_view rest = *words_;
      if (!std::ranges::binary_search(whose, demand()))
        fail_at(rest, "a demand on an agent of the lemma");
      end_line();
      take_line();
    }
    take_proof_from_here();
    ++lemmas_;
    take_line();
  }

  void take_proof() {
    take_line();
    take_proof_from_here();
  }

  // Its first line is taken. As deep as it is long, so without recursion.
  void take_proof_from_here() {
    for (std::int64_t open = 1 + step(); open > 0; open += step()) take_line();
  }

  // By how much it changes the number of proofs that are still to come.
  int step() {
    switch (one_of({"leaf", "split", "later", "joint", "prices"})) {
      case 0:
        while (words_) lemma();
        return -1;
      case 1:
        demand();
        keyword("|");
        demand();
        end_line();
        ++splits_;
        return 1;
      case 2:
        late();
        late();
        lemma();
        end_line();
        ++splits_;
        return 1;
      case 3:
        end_line();
        return -1;
      default:
        end_line();
        take_rows();
        return -1;
    }
  }

  void take_rows() {
    for (bool ended = false; !ended;) {
      take_line();
      switch (one_of({"place", "edge", "finish", "end"})) {
        case 0:
          place();
          time();
          charge();
          break;
        case 1:
          place();
          place();
          time();
          charge();
          break;
        case 2:
          pair();
          charge();
          break;
        default:
          ended = true;
      }
      end_line();
    }
  }
  void charge() { number("a price", static_cast<std::uint64_t>(kInfiniteCost)); }

  const std::string file_;
  std::string_view text_;  // what is left of it
  const Instance& instance_;
  std::optional<std::string_view> words_;  // what is left of the line; none: it has ended
  std::int64_t line_ = 0;
  std::uint64_t lemmas_ = 0;  // so far
  std::int64_t splits_ = 0;
};

}  // namespace

CertificateText read_certificate(const std::filesystem::path& path, const Instance& instance,
                                 std::int64_t most_splits) {
  const std::string text = text_of(path);
  Reader reader(path.string(), text, instance);
  CertificateText read = reader.read();
  if (reader.splits() > most_splits)
    throw InputError(path.string(), "",
                     fmt::format("has {} splits; expected at most {}, which people can look at",
                                 reader.splits(), most_splits));
  return read;
}

}  // namespace grove::detail
