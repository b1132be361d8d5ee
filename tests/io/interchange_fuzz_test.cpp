// SPDX-License-Identifier: MIT
// Random mutations of valid files of other tools. A reader must either throw InputError or return
// an instance that survives writing and reading. GROVE_FUZZ_FACTOR multiplies the number of cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "io/format_support.h"
#include "io/input_error.h"
#include "io/libmrp_file.h"
#include "io/mapfw_file.h"
#include "model/fingerprint.h"
#include "tests/support/fuzz_factor.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail {
namespace interchange_fuzz_test {

const std::string kMapf =
    "map:\n  dimensions: [5, 3]\n  obstacles:\n    - [1, 0]\n    - !!python/tuple [3, 2]\n"
    "agents:\n  - name: agent0\n    start: [0, 0]\n    goal: [4, 0]\n"
    "  - name: \"on\"\n    start: [3, 0]\n    potentialGoals: [[1, 2]]\n";
const std::string kTargets =
    "map: {dimensions: [5, 3], obstacles: [[1, 0], [3, 2]]}\n"
    "agents:\n  - name: agent0\n    start: [4, 1]\n    potentialGoals:\n      - [0, 2]\n"
    "      - [2, 0]\n  - name: agent1\n    start: [0, 0]\n    potentialGoals: [[2, 0], [3, 1]]\n";
const std::string kMgMapf =
    "map: {dimensions: [5, 3], obstacles: [[1, 0], [3, 2]]}\n"
    "agents:\n  - &first\n    name: agent0\n    start: [4, 1]\n    goals:\n      - [0, 2]\n"
    "      - [2, 0]\n  - name: agent1\n    start: [0, 0]\n    goals: [[2, 0], [3, 1]]\n";
const std::string kMapfw =
    R"({"grid": [[0,1,0,0,0],[0,0,0,0,0],[0,0,0,1,1]], "width": 5, "height": 3,
 "starts": [[0,0],[3,0]], "goals": [[4,0],[1,2]], "waypoints": [[[2,1]],[[0,1],[2,1]]]})";

constexpr std::array<std::string_view, 34> kPieces = {"-1",         "99999999999999999999",
                                                      "2147483648", "1e9",
                                                      "0.5",        "[",
                                                      "]",          "{",
                                                      "}",          ",",
                                                      ": ",         "- ",
                                                      "\n",         "\n  ",
                                                      "&a ",        "*a",
                                                      "*first",     "<<: ",
                                                      "!!",         "? ",
                                                      "| ",         "> ",
                                                      "'",          "\"",
                                                      "#",          "---\n",
                                                      "...\n",      "%YAML 1.2\n",
                                                      "null",       "goal",
                                                      "goals",      "\xff\xfe",
                                                      "\t",         "@"};

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string mutated(std::string text) {
    for (std::size_t k = 1 + below(2); k > 0; --k) mutate(text);
    return text;
  }

 private:
  std::size_t below(std::size_t end) { return random_() % end; }

  void mutate(std::string& text) {
    const std::size_t at = below(text.size() + 1);
    const std::size_t length = 1 + below(6);
    switch (below(6)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, kPieces[below(kPieces.size())]);
        break;
      case 2:
        text.replace(at, std::min(length, text.size() - at), kPieces[below(kPieces.size())]);
        break;
      case 3:
        text.insert(at, text.substr(below(text.size() + 1), 2 * length));
        break;
      case 4:
        text.insert(at, 1, static_cast<char>(below(256)));
        break;
      default:
        if (below(4) == 0) text.resize(at);
        if (at < text.size()) text[at] = static_cast<char>('0' + below(10));
    }
    if (text.empty()) text = " ";
  }

  std::mt19937 random_;
};

int cases() {
  return testing::fuzz_rounds(1000);
}

// Reads mutations of `text`. An instance that is read must survive `write` and `read`, unless
// `write` cannot represent it. Returns the number of mutations that were read.
template <typename Read, typename Write>
int survivors(const std::string& text, Read read, Write write) {
  const TemporaryDirectory directory;
  int survived = 0;
  for (int seed = 0; seed < cases(); ++seed) {
    const std::string broken = Mutator(static_cast<unsigned>(seed)).mutated(text);
    SCOPED_TRACE(broken);
    try {
      const Instance instance = with_default_task_ids(read(directory.write("in", broken)));
      ++survived;
      write(directory / "out", instance);
      EXPECT_EQ(fingerprint(read(directory / "out")), fingerprint(instance));
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("in: "), std::string::npos) << error.what();
    } catch (const NotRepresentable&) {
      continue;  // a mixture of agents with and without goals
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
  return survived;
}

Instance read_yaml(const std::string& path) {
  return read_libmrp_instance(path);
}

TEST(InterchangeFuzz, LibmrpInstancesAreReadOrRefused) {
  const int survived = survivors(kMapf, read_yaml, write_libmrp_instance);
  EXPECT_GT(survived, 10);
  EXPECT_LT(survived, cases());
}

TEST(InterchangeFuzz, InstancesWithPotentialGoalsAreReadOrRefused) {
  const int survived = survivors(kTargets, read_yaml, write_potential_goals);
  EXPECT_GT(survived, 10);
  EXPECT_LT(survived, cases());
}

TEST(InterchangeFuzz, MgcbsInstancesAreReadOrRefused) {
  const int survived = survivors(kMgMapf, read_yaml, write_mgcbs_instance);
  EXPECT_GT(survived, 10);
  EXPECT_LT(survived, cases());
}

TEST(InterchangeFuzz, MapfwProblemsAreReadOrRefused) {
  const auto read = [](const std::string& path) { return read_mapfw_problem(path); };
  const int survived = survivors(kMapfw, read, write_mapfw_problem);
  EXPECT_GT(survived, 10);
  EXPECT_LT(survived, cases());
}

}  // namespace interchange_fuzz_test
}  // namespace grove::detail
