// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/temporary_directory.h"
#include "tests/tools/program.h"

namespace grove::detail {
namespace view_command_test {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string data(const std::string& name) {
  return std::string(GROVE_DATA) + "/" + name;
}

class ViewCommand : public ::testing::Test {
 protected:
  // Solves a shipped instance and returns the path of the plan file.
  std::string plan_of(const std::string& name) {
    const std::string file = directory_ / (name + ".plan.json");
    const ProcessResult solved =
        run_grove({"solve", data(name + ".cts.json"), "--quiet", "--output", file});
    EXPECT_EQ(solved.exit_code, 0) << solved.err;
    return file;
  }
  std::string read(const std::string& name) const {
    std::ifstream file(directory_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  nlohmann::json data_of(const std::string& page) const {
    const std::string html = read(page);
    const std::string begin = R"(<script type="application/json" id="grove-data">)";
    const auto from = html.find(begin) + begin.size();
    return nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
  }

  TemporaryDirectory directory_;
};

TEST_F(ViewCommand, WritesAPageWithInstanceAndPlan) {
  const ProcessResult done =
      run_grove({"view", data("shop.cts.json"), plan_of("shop"), "-o", directory_ / "shop.html"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("shop.html"));
  const nlohmann::json page = data_of("shop.html");
  EXPECT_EQ(page["format"], "grove view 1");
  EXPECT_EQ(page["world"]["free"], "4 1 8 1 17 1 8 1 4");
  EXPECT_EQ(page["agents"][1]["turn"], 2);
  EXPECT_EQ(page["tasks"][1]["duration"], 3);
  EXPECT_EQ(page["plans"][0]["claims"]["cost"], 66);
  EXPECT_THAT(page["plans"][0]["agents"][0]["path"], StartsWith("@0;"));
}

TEST_F(ViewCommand, ReplacesAForeignPageOnlyByName) {
  const std::string plan = plan_of("shop");
  ProcessOptions options;
  options.directory = directory_.path().string();
  const auto view = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"view", data("shop.cts.json"), plan};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_grove(arguments, options);
  };
  directory_.write("shop.html", "<!doctype html>\n<p>My shop</p>\n");
  const ProcessResult refused = view({});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.err,
            "grove: error: shop.html: exists and is not a page of Grove; expected '-o shop.html' "
            "to replace it, or another name\n");
  EXPECT_THAT(read("shop.html"), HasSubstr("My shop"));
  EXPECT_EQ(view({"-o", "shop.html"}).exit_code, 0);
  EXPECT_EQ(view({}).exit_code, 0) << "the page of an earlier call";
  EXPECT_THAT(read("shop.html"), Not(HasSubstr("My shop")));
}

TEST_F(ViewCommand, RoadmapIsInMetresAndPathsInPlaces) {
  const ProcessResult done =
      run_grove({"view", data("yard.cts.json"), plan_of("yard"), "-o", directory_ / "yard.html"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json page = data_of("yard.html");
  EXPECT_EQ(page["world"]["kind"], "roadmap");
  EXPECT_EQ(page["world"]["roads"][0].size(), 4u);
  EXPECT_FALSE(page["plans"][0]["agents"][0].contains("turns"));
}

TEST_F(ViewCommand, WithoutAPlanShowsTheInstance) {
  const ProcessResult done =
      run_grove({"view", data("first.cts.json"), "-o", directory_ / "first.html"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(data_of("first.html")["plans"].size(), 0u);
}

TEST_F(ViewCommand, ShowsPathsOfOtherSolversWithoutClaims) {
  directory_.write("m.map", "type octile\nheight 1\nwidth 3\nmap\n...\n");
  directory_.write(
      "i.json",
      R"({"map": "m.map", "agents": [{"id": "a", "start": [0, 0], "goal": [2, 0]}], "tasks": []})");
  directory_.write("paths.txt", "Agent 0: (0,0)->(0,2)->\n");
  const ProcessResult done = run_grove(
      {"view", directory_ / "i.json", directory_ / "paths.txt", "-o", directory_ / "p.html"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json plan = data_of("p.html")["plans"][0];
  EXPECT_EQ(plan["claims"], nlohmann::json::object());
  EXPECT_EQ(plan["agents"][0]["path"], "@0;@2;");  // a jump, unchanged
}

class ViewOfChoices : public ViewCommand {
 protected:
  // a may end on either end of the corridor, and one of a and b must visit "any".
  ViewOfChoices() {
    directory_.write("m.map", "type octile\nheight 2\nwidth 3\nmap\n...\n...\n");
    directory_.write("i.json", R"({"map": "m.map",
        "agents": [{"id": "a", "start": [1, 0], "goals": [[0, 0], [2, 0]]},
                   {"id": "b", "start": [0, 1]}],
        "tasks": [{"id": "any", "cell": [1, 1], "agents": "*", "need": 1},
                  {"id": "all", "cell": [0, 1], "agents": ["b"]},
                  {"id": "some", "cell": [1, 0], "agents": ["a"], "need": 1}]})");
    directory_.write("plan.json", R"({"status": "feasible", "cost": 3, "lower_bound": 0, "omega": 0,
        "agents": [{"id": "a", "sequence": ["some"], "cost": 1, "path": [[1, 0], [2, 0]]},
                   {"id": "b", "sequence": ["any", "all"], "cost": 2,
                    "path": [[0, 1], [1, 1], [0, 1]],
                    "work": [{"task": "any", "begin": 1, "end": 1}]}]})");
  }
};

TEST_F(ViewOfChoices, DataHaveChoicesAndStatedVisits) {
  const ProcessResult done = run_grove(
      {"view", directory_ / "i.json", directory_ / "plan.json", "-o", directory_ / "p.html"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const nlohmann::json page = data_of("p.html");
  EXPECT_EQ(page["agents"][0]["goals"], nlohmann::json({0, 2}));
  EXPECT_FALSE(page["agents"][0].contains("goal"));
  EXPECT_FALSE(page["agents"][1].contains("goals"));
  EXPECT_EQ(page["tasks"][0]["agents"], "*");
  EXPECT_EQ(page["tasks"][0]["need"], 1);
  EXPECT_EQ(page["tasks"][2]["agents"], nlohmann::json({0}));
  EXPECT_FALSE(page["tasks"][2].contains("need"));
  EXPECT_EQ(page["plans"][0]["agents"][1]["work"], nlohmann::json::parse("[[0, 1, 1]]"));
}

TEST_F(ViewOfChoices, PicturesHaveDashedOutlinesAndASecondRowInTheLegend) {
  const auto svg = [&](const std::string& instance) {
    const ProcessResult done =
        run_grove({"view", instance, "--svg", directory_ / "s.svg", "--width", "720"});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return read("s.svg");
  };
  EXPECT_THAT(svg(data("shop.cts.json")), Not(HasSubstr("stroke-dasharray")));
  const std::string choices = svg(directory_ / "i.json");
  EXPECT_THAT(choices, HasSubstr("stroke-dasharray"));
  EXPECT_THAT(choices, HasSubstr("height=\"532px\""));  // a map of 3 x 2 cells and two rows
}

TEST_F(ViewOfChoices, IsRefusedAsADrive) {
  EXPECT_THAT(complaint(run_grove({"view", directory_ / "i.json", directory_ / "plan.json",
                                   "--drive", directory_ / "drive.jsonl"})),
              HasSubstr(", which --drive does not support; expected an instance of "
                        "'grove convert --fix-choices', or "));
}

TEST_F(ViewCommand, EscapesIds) {
  directory_.write("m.map", "type octile\nheight 1\nwidth 3\nmap\n...\n");
  directory_.write(
      "i.json",
      R"({"map": "m.map", "agents": [{"id": "</script><b>", "start": [0, 0]}], "tasks": []})");
  const ProcessResult done =
      run_grove({"view", directory_ / "i.json", "-o", directory_ / "p.html"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(read("p.html"), Not(HasSubstr("</script><b>")));
  EXPECT_EQ(data_of("p.html")["agents"][0]["id"], "</script><b>");
}

TEST_F(ViewCommand, WritesPictures) {
  const std::string plan = plan_of("shop");
  const ProcessResult done = run_grove(
      {"view", data("shop.cts.json"), plan, "--svg", directory_ / "s.svg", "--png",
       directory_ / "s.png", "--gif", directory_ / "s.gif", "--at", "0,8,20.5", "--width", "300"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(read("s.svg"), HasSubstr("<svg"));
  EXPECT_THAT(read("s.svg"), HasSubstr("width=\"924px\""));  // three pictures and two gaps
  EXPECT_THAT(read("s.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(read("s.gif"), StartsWith("GIF89a"));
  EXPECT_EQ(read("s.gif").back(), ';');
  EXPECT_EQ(read("shop.html"), "");
}

TEST_F(ViewCommand, PicturesHaveCaptionAndLegend) {
  const auto height_with = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"view", data("shop.cts.json"), "--svg",
                                       directory_ / "s.svg"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult done = run_grove(arguments);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    const std::string svg = read("s.svg");
    const auto at = svg.find("height=\"") + 8;
    return std::stoi(svg.substr(at));
  };
  const std::string plan = plan_of("shop");
  EXPECT_EQ(height_with({"--width", "360"}), 200);             // a map of 9 x 5 cells
  EXPECT_EQ(height_with({"--width", "720"}), 400 + 26);        // with a legend
  EXPECT_EQ(height_with({plan, "--width", "360"}), 200 + 20);  // with a caption
  EXPECT_EQ(height_with({plan, "--width", "720"}), 400 + 46);  // with a caption and a legend
  EXPECT_EQ(height_with({plan, "--width", "360", "--at", "0,1,2,3,4"}), 2 * 220 + 12 + 26);
}

TEST_F(ViewCommand, PictureShowsASwapUntilItsEnd) {
  directory_.write("m.map", "type octile\nheight 1\nwidth 4\nmap\n....\n");
  directory_.write("i.json", R"({"map": "m.map", "tasks": [],
      "agents": [{"id": "a", "start": [0, 0]}, {"id": "b", "start": [3, 0]}]})");
  directory_.write(
      "paths.txt",
      "Agent 0: (0,0)->(0,1)->(0,2)->(0,3)->\nAgent 1: (0,3)->(0,2)->(0,1)->(0,0)->\n");
  const auto is_red_at = [&](const std::string& time) {
    const ProcessResult done = run_grove({"view", directory_ / "i.json", directory_ / "paths.txt",
                                          "--svg", directory_ / "s.svg", "--at", time});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return read("s.svg").find("rgb(81.568627%") != std::string::npos;
  };
  EXPECT_FALSE(is_red_at("1"));
  EXPECT_TRUE(is_red_at("1.5"));
  EXPECT_TRUE(is_red_at("2"));
  EXPECT_FALSE(is_red_at("3"));
}

TEST_F(ViewCommand, OpensThePageWithTheDesktopOpener) {
  directory_.write("xdg-open", "#!/bin/sh\necho \"$1\" > opened\n");
  ASSERT_EQ(::mkfifo((directory_ / "opened").c_str(), 0600),
            0);  // so that the test can wait for it
  std::filesystem::permissions(directory_ / "xdg-open", std::filesystem::perms::owner_all);
  ProcessOptions options;
  options.directory = directory_.path();
  ::setenv("PATH", (directory_.path().string() + ":/usr/bin:/bin").c_str(), 1);
  const ProcessResult done =
      run_grove({"view", data("first.cts.json"), "-o", "p.html", "--open"}, options);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(run_program({"/bin/cat", "opened"}, options).out,
            (directory_.path() / "p.html").string() + "\n");
}

constexpr const char* kHeader = R"({"event": "header", "instance": "</script>"})";

TEST_F(ViewCommand, ShowsARunUpToTheEndOfItsLog) {
  directory_.write("run.jsonl",
                   std::string(kHeader) + "\n{\"event\": \"progress\"}\n{\"event\": \"su");
  ProcessOptions options;
  options.directory = directory_.path();
  const ProcessResult done = run_grove({"view", "--run", "run.jsonl"}, options);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const std::string page = read("run.html");
  const std::string begin = R"(<script type="application/json" id="grove-log">)";
  const auto from = page.find(begin) + begin.size();
  EXPECT_EQ(
      page.substr(from, page.find("</script>", from) - from),
      "{\"event\": \"header\", \"instance\": \"\\u003c/script>\"}\n{\"event\": \"progress\"}\n");
}

TEST_F(ViewCommand, WarnsOfOmittedPlans) {
  const std::string plan = plan_of("first");
  const ProcessResult done =
      run_grove({"view", data("first.cts.json"), plan, plan, plan, "-o", directory_ / "x.html"});
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_THAT(
      done.err,
      HasSubstr("warning: a page shows 2 plans; first.plan.json and later ones are left out"));
}

TEST_F(ViewCommand, RefusesMalformedLogs) {
  const auto complaint = [&](const std::string& log) {
    directory_.write("run.jsonl", log);
    const ProcessResult done = run_grove({"view", "--run", directory_ / "run.jsonl"});
    EXPECT_EQ(done.exit_code, 2) << done.out;
    return done.err;
  };
  EXPECT_THAT(complaint(""), HasSubstr("run.jsonl: is empty; expected the header of a log"));
  EXPECT_THAT(complaint("Grove 0.1.0\n"), HasSubstr("line 1: expected the header of a log"));
  EXPECT_THAT(complaint("[1]\n"), HasSubstr("line 1"));
  EXPECT_THAT(complaint(std::string(kHeader) + "\n{\"event\": 7}\n"),
              HasSubstr("line 2: expected an object with a text \"event\""));
  for (const std::vector<std::string>& words : {std::vector<std::string>{"view"},
                                                {"view", "--follow"},
                                                {"view", "x.json", "--run", "y"},
                                                {"view", "--run", "y", "--svg", "z"},
                                                {"view", "x.json", "--at", "3"},
                                                {"view", "x.json", "--svg", "z", "--speed", "2"},
                                                {"view", "--run", "y", "--port", "1"},
                                                {"view", "--run", directory_ / "none.jsonl"}})
    EXPECT_EQ(run_grove(words).exit_code, 2) << words.back();
}

TEST_F(ViewCommand, RefusesMalformedExecutionLogs) {
  const std::string instance = data("first.cts.json");
  const std::string plan = plan_of("first");
  const std::string log = directory_ / "drive.jsonl";
  const auto complaint = [](const std::vector<std::string>& words) {
    const ProcessResult done = run_grove(words);
    EXPECT_EQ(done.exit_code, 2) << done.out;
    return done.err;
  };
  const auto of = [&](const std::string& text) {
    directory_.write("drive.jsonl", text);
    return complaint({"view", instance, plan, "--drive", log});
  };
  for (const char* text : {"", "red\n", "{\"format\": \"grove drive 2\"}\n", "{\"format\": 1}\n"})
    EXPECT_THAT(of(text), HasSubstr("drive.jsonl: line 1: expected the log of an execution"))
        << text;
  EXPECT_THAT(of("{\"format\": \"grove drive 1\", \"order\": \"o\", \"robots\": [], "
                 "\"seconds_per_step\": 1}\n{\"t\": 1}\n"),
              HasSubstr("drive.jsonl: line 2: /: key 'robot' is missing"));
  EXPECT_THAT(complaint({"view", instance, plan, "--drive", log, "--output", log}),
              HasSubstr("drive.jsonl"));
  EXPECT_THAT(read("drive.jsonl"), HasSubstr("grove drive 1"));
  EXPECT_THAT(complaint({"view", instance, "--drive", log}),
              HasSubstr("--drive requires PLAN, the plan that is executed"));
  EXPECT_THAT(complaint({"view", instance, plan, plan, "--drive", log}), HasSubstr("PLAN"));
  EXPECT_THAT(complaint({"view", instance, plan, "--drive", log, "--svg", "x"}),
              HasSubstr("--svg"));
  EXPECT_THAT(complaint({"view", instance, plan, "--drive", directory_ / "none.jsonl"}),
              HasSubstr("none.jsonl"));
  directory_.write("bad.plan.json", "{\"status\": \"bounded\", \"cost\": 0, \"agents\": []}");
  EXPECT_THAT(complaint({"view", instance, directory_ / "bad.plan.json", "--drive", log}),
              HasSubstr("bad.plan.json"));
}

TEST_F(ViewCommand, ShowsACertificateWithAndWithoutAPlan) {
  const std::string instance = data("first.cts.json");
  const std::string plan = directory_ / "first.plan.json";
  ProcessOptions options;
  options.directory = directory_.path();
  const ProcessResult solved = run_grove({"solve", instance, "--omega", "0", "--quiet", "--output",
                                          plan, "--proof", directory_ / "first.proof"});
  ASSERT_EQ(solved.exit_code, 0) << solved.err;
  const ProcessResult done = run_grove({"view", instance, plan, "--proof", "first.proof"}, options);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_EQ(data_of("first.proof.html")["plans"][0]["claims"]["cost"], 33);
  EXPECT_THAT(read("first.proof.html"), HasSubstr("id=\"grove-proof\">grove-proof 1\ninstance "));
  EXPECT_THAT(read("first.proof.html"), HasSubstr("\ntheorem 33\n"));
  const ProcessResult alone = run_grove(
      {"view", instance, "--proof", "first.proof", "-o", directory_ / "alone.html"}, options);
  ASSERT_EQ(alone.exit_code, 0) << alone.err;
  EXPECT_EQ(data_of("alone.html")["plans"].size(), 0u);
}

TEST_F(ViewCommand, RefusesCertificatesOfOtherInstances) {
  const std::string instance = data("first.cts.json");
  const std::string plan = plan_of("first");
  const std::string proof = directory_ / "c.proof";
  ASSERT_EQ(run_grove({"solve", instance, "--omega", "0", "--no-following", "--quiet", "--output",
                       directory_ / "apart.plan.json", "--proof", proof})
                .exit_code,
            0);
  const auto complaint_of = [](const std::vector<std::string>& words) {
    return complaint(run_grove(words));
  };
  const std::string certificate = read("c.proof");
  EXPECT_THAT(complaint_of({"view", data("shop.cts.json"), "--proof", proof}),
              HasSubstr("c.proof: line 2: found '"));
  EXPECT_THAT(complaint_of({"view", instance, "--proof", instance}),
              HasSubstr("first.cts.json: line 1: found '{'; expected 'grove-proof'"));
  EXPECT_THAT(complaint_of({"view", instance, "--proof", directory_ / "none.proof"}),
              HasSubstr("none.proof: cannot be read"));
  EXPECT_THAT(complaint_of({"view", instance, "--proof", proof, "-o", proof}),
              HasSubstr("c.proof: is the certificate; expected another file to write to"));
  EXPECT_EQ(read("c.proof"), certificate);
  EXPECT_THAT(complaint_of({"view", instance, plan, plan, "--proof", proof}),
              HasSubstr("--proof: found several plans; expected at most one PLAN"));
  EXPECT_THAT(complaint_of({"view", instance, "--proof", proof, "--svg", "x.svg"}),
              HasSubstr("--proof excludes --svg"));
  EXPECT_THAT(complaint_of({"view", "--run", "x", "--proof", proof}),
              HasSubstr("--run excludes --proof"));
  EXPECT_THAT(complaint_of({"view", instance, plan, "--proof", proof, "--drive", "x"}),
              HasSubstr("--proof excludes --drive"));
  directory_.write("bad.plan.json", R"({"status": "bounded", "cost": 0, "agents": []})");
  EXPECT_THAT(complaint_of({"view", instance, directory_ / "bad.plan.json", "--proof", proof}),
              HasSubstr("bad.plan.json"));
  // In this plan one robot follows another.
  EXPECT_THAT(complaint_of({"view", instance, plan, "--proof", proof}),
              HasSubstr("expected a plan valid without following, as the certificate requires"));
}

TEST_F(ViewCommand, RefusesInvalidArguments) {
  const auto complaint = [](const ProcessResult& result) {
    EXPECT_EQ(result.exit_code, 2) << result.out;
    return result.err;
  };
  EXPECT_THAT(complaint(run_grove({"view", data("first.cts.json"), "missing.json"})),
              HasSubstr("missing.json"));
  EXPECT_THAT(complaint(run_grove({"view", data("first.cts.json"), data("first.cts.json")})),
              HasSubstr("first.cts.json"));
  EXPECT_THAT(complaint(run_grove(
                  {"view", data("first.cts.json"), "--svg", directory_ / "x.svg", "--at", "-1"})),
              HasSubstr("--at"));
  EXPECT_THAT(complaint(run_grove(
                  {"view", data("first.cts.json"), "--gif", directory_ / "x.gif", "--width", "5"})),
              HasSubstr("--width"));
  EXPECT_THAT(complaint(run_grove({"view", data("first.cts.json"), "-o", "/nowhere/x.html"})),
              HasSubstr("/nowhere"));
}

}  // namespace view_command_test
}  // namespace grove::detail
