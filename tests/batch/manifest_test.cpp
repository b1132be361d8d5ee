// SPDX-License-Identifier: MIT
#include "batch/manifest.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/refusal.h"
#include "tests/support/temporary_directory.h"

namespace grove::detail::batch {
namespace manifest_test {

namespace fs = std::filesystem;

class Manifests : public ::testing::Test {
 protected:
  void add_file(const std::string& name, const std::string& content = "{}") {
    fs::create_directories(fs::path(directory_ / name).parent_path());
    directory_.write(name, content);
  }
  std::vector<Entry> read(const std::string& manifest) {
    return read_manifest(directory_.write("list.txt", manifest));
  }
  std::string refused(const std::string& manifest) {
    return refusal([&] { read(manifest); });
  }
  static std::vector<std::string> ids(const std::vector<Entry>& entries) {
    std::vector<std::string> ids;
    for (const Entry& entry : entries) ids.push_back(entry.id);
    return ids;
  }

  TemporaryDirectory directory_;
};

using Ids = std::vector<std::string>;

TEST_F(Manifests, ListInstancesInOrder) {
  add_file("b.cts.json");
  add_file("rooms/a with blanks.cts.json");
  add_file("c.json");
  const auto entries =
      read("# what\nb.cts.json\n\n  rooms/a with blanks.cts.json \r\n\t# so\nc.json\n");
  EXPECT_EQ(ids(entries), (Ids{"b", "rooms/a with blanks", "c"}));
  EXPECT_EQ(entries[1].path, directory_ / "rooms/a with blanks.cts.json");
  EXPECT_EQ(entries[1].agents, 0);
}

TEST_F(Manifests, ListScenarios) {
  add_file("maps/r oom.map");
  add_file("room-1.scen");
  const auto entries = read(
      "room-1.scen --map maps/r oom.map --agents 20\n"
      "room-1.scen  --map maps/r oom.map  --agents 30");
  EXPECT_EQ(ids(entries), (Ids{"room-1-20", "room-1-30"}));
  EXPECT_EQ(entries[0].path, directory_ / "room-1.scen");
  EXPECT_EQ(entries[0].map, directory_ / "maps/r oom.map");
  EXPECT_EQ(entries[0].agents, 20);
}

TEST_F(Manifests, OfAFolderListItsInstancesByName) {
  for (const char* name : {"s2/a.cts.json", "b.cts.json", "s1/z.cts.json", "s1/z.plan.json",
                           "m.map", "s1/deep/k.cts.json", "other.json"})
    add_file(name);
  const Ids expected{"b", "s1/deep/k", "s1/z", "s2/a"};
  EXPECT_EQ(ids(read_manifest(directory_.path())), expected);
  EXPECT_EQ(ids(read_manifest(directory_ / "")), expected);
}

TEST_F(Manifests, GiveIdsIndependentOfTheWorkingDirectory) {
  add_file("set/a.cts.json");
  add_file("other/b.cts.json");
  add_file("set/list.txt", "../other/b.cts.json\n" + directory_ / "set/a.cts.json");
  EXPECT_EQ(ids(read_manifest(directory_ / "set/list.txt")), (Ids{"other/b", "a"}));
  const fs::path before = fs::current_path();
  fs::current_path(directory_ / "set");
  EXPECT_EQ(ids(read_manifest("list.txt")), (Ids{"other/b", "a"}));
  EXPECT_EQ(ids(read_manifest(".")), Ids{"a"});
  EXPECT_EQ(read_manifest(".")[0].path, "./a.cts.json");
  fs::current_path(before);
}

// An id contains no absolute path.
TEST_F(Manifests, NameExternalFilesByTheirFolder) {
  add_file("far/away/set/b.cts.json");
  add_file("far/away/x.scen");
  add_file("far/away/m.map");
  add_file("c.cts.json");
  add_file("lists/list.txt", "../far/away/set/b.cts.json\n../c.cts.json\n" +
                                 (directory_ / "far/away/x.scen") +
                                 " --map ../far/away/m.map --agents 2");
  EXPECT_EQ(ids(read_manifest(directory_ / "lists/list.txt")), (Ids{"set/b", "c", "away/x-2"}));
}

TEST_F(Manifests, RefuseInvalidLinesWithTheirNumber) {
  add_file("a.cts.json");
  add_file("a.json");
  add_file("x.scen");
  add_file("x.map");
  EXPECT_EQ(refused(""), "list.txt: has no instance; expected one path per line");
  EXPECT_EQ(refused("# nothing\n\n"), "list.txt: has no instance; expected one path per line");
  EXPECT_EQ(refused("a.cts.json\n\nx.map\n"),
            "list.txt: line 3: x.map is a map; expected an instance, FILE.cts.json");
  EXPECT_NE(refused("a.cts.json\nb.cts.json\n").find("list.txt: line 2: there is no file "),
            std::string::npos);
  EXPECT_NE(refused(".\n").find("there is no file"), std::string::npos);
  for (const char* line :
       {"x.scen", "x.scen --map x.map", "x.scen --agents 3 --map x.map", "x.scen --map --agents 3"})
    EXPECT_EQ(refused(line), "list.txt: line 1: found '" + std::string(line) +
                                 "'; expected FILE.scen --map FILE.map --agents K");
  for (const char* count : {"0", "-1", "3 4", "x", "1000001", "1e3"})
    EXPECT_EQ(refused("x.scen --map x.map --agents " + std::string(count)),
              "list.txt: line 1: found '" + std::string(count) +
                  "'; expected a number of agents from 1 to 1000000");
}

TEST_F(Manifests, RefuseAnInstanceThatOccursTwice) {
  add_file("a.cts.json");
  add_file("a.json");
  add_file("s/b.cts.json");
  fs::create_symlink(directory_ / "a.cts.json", directory_ / "link.cts.json");
  EXPECT_EQ(refused("a.cts.json\ns/../a.cts.json"),
            "list.txt: line 2: is the same instance as line 1; expected distinct instances with "
            "distinct names");
  EXPECT_NE(refused("a.cts.json\nlink.cts.json").find("is the same instance as line 1"),
            std::string::npos);
  EXPECT_EQ(refused("s/b.cts.json\na.cts.json\na.json"),
            "list.txt: line 3: has the file name 'a', as has line 2; expected distinct instances "
            "with distinct names");
}

TEST_F(Manifests, CanBeASingleInstance) {
  add_file("a.cts.json");
  EXPECT_EQ(ids(read_manifest(directory_ / "a.cts.json")), Ids{"a"});
  EXPECT_NE(refusal([&] { read_manifest(directory_ / "b.cts.json"); }), "accepted");
}

TEST_F(Manifests, RefuseOtherFilesAndFolders) {
  add_file("a.json");
  EXPECT_EQ(refusal([&] { read_manifest(directory_ / "a.json"); }),
            "a.json: is not a manifest; expected a folder, or a text file with the path of an "
            "instance on each line");
  EXPECT_NE(refusal([&] { read_manifest(directory_ / "none"); }).find("none: cannot be read"),
            std::string::npos);
  fs::create_directory(directory_ / "empty");
  EXPECT_EQ(refusal([&] { read_manifest(directory_ / "empty"); }),
            "empty: has no instance; expected *.cts.json files in it or below");
  add_file("odd/a\xff.cts.json");
  EXPECT_NE(
      refusal([&] { read_manifest(directory_ / "odd"); }).find("is not suitable as a file name"),
      std::string::npos);
}

// A digest depends on the instance that is read, including its map, and not on the text or the
// location of the files.
TEST_F(Manifests, GiveADigestThatChangesWithTheInstance) {
  const std::string map = "type octile\nheight 1\nwidth 3\nmap\n...\n";
  const auto instance = [](const std::string& file, const std::string& id, int goal) {
    return R"({"map": ")" + file + R"(", "agents": [{"id": ")" + id +
           R"(", "start": [0, 0], "goal": [)" + std::to_string(goal) + R"(, 0]}], "tasks": []})";
  };
  const std::string rows = "version 1\n0\tm.map\t3\t1\t0\t0\t2\t0\t2\n";
  add_file("m.map", map);
  add_file("a.cts.json", instance("m.map", "a", 2));
  add_file("x.scen", rows);
  const std::string list = "a.cts.json\nx.scen --map m.map --agents 1\n";
  const auto before = read(list);
  EXPECT_NE(before[0].digest, before[1].digest);  // they differ in the agent's id
  const auto digests_after = [&](const std::string& name, const std::string& content) {
    add_file(name, content);
    const auto after = read(list);
    return std::pair(after[0].digest, after[1].digest);
  };
  const std::pair same(before[0].digest, before[1].digest);
  EXPECT_EQ(digests_after("a.cts.json", "\n" + instance("./m.map", "a", 2)), same);
  EXPECT_EQ(digests_after("m.map", "type octile\nheight 1\nwidth 3\nmap\n.G.\n"), same);
  EXPECT_EQ(digests_after("x.scen", rows + rows.substr(rows.find('0'))), same);  // one more row
  const auto other_map = digests_after("m.map", "type octile\nheight 2\nwidth 3\nmap\n...\n...\n");
  EXPECT_NE(other_map.first, same.first);
  EXPECT_NE(other_map.second, same.second);
  EXPECT_EQ(digests_after("m.map", map), same);
  EXPECT_NE(digests_after("a.cts.json", instance("m.map", "a", 1)).first, same.first);
  EXPECT_NE(digests_after("a.cts.json", instance("m.map", "b", 2)).first, same.first);
  EXPECT_NE(digests_after("x.scen", "version 1\n0\tm.map\t3\t1\t0\t0\t1\t0\t1\n").second,
            same.second);

  add_file("elsewhere/maps/m.map", map);
  add_file("elsewhere/b.cts.json", instance("maps/m.map", "a", 2));
  EXPECT_EQ(read("elsewhere/b.cts.json")[0].digest, same.first);
  for (const char* broken : {"", "{", "[]", "{\"map\": 3}", "{\"map\": \"none.map\"}"})
    EXPECT_EQ(digests_after("a.cts.json", broken).first, "") << broken;
}

}  // namespace manifest_test
}  // namespace grove::detail::batch
