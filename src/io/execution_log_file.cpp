// SPDX-License-Identifier: MIT
#include "io/execution_log_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "io/input_error.h"
#include "io/json_value.h"
#include "io/text_file.h"

namespace grove::detail {
namespace {

// The web page that displays executions has the same limits (tools/view/drive/log.ts).
constexpr const char* kDriveFormat = "grove drive 1";
constexpr double kFarthest = 1e7;    // cells or metres
constexpr double kMaxSeconds = 1e9;  // seconds

class DriveReader {
 public:
  DriveReader(std::string file, const Instance& instance, const ActionDependencyGraph& order)
      : file_(std::move(file)), order_(order) {
    for (AgentIndex agent = 0; agent < instance.agent_count(); ++agent)
      agents_.emplace(instance.agent(agent).id, agent);
    log_.robots.resize(agents_.size());
  }

  ExecutionLog read(std::string_view text) {
    while (!text.empty()) {
      const std::string_view line = text.substr(0, text.find('\n'));
      text.remove_prefix(std::min(text.size(), line.size() + 1));
      read_line(line);
    }
    if (!is_begun_) fail_as_no_drive();
    return std::move(log_);
  }

 private:
  void read_line(std::string_view line) {
    place_ = fmt::format("{}: line {}", file_, ++lines_);
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) return;
    const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
    const JsonValue value(json, place_, "");
    if (!is_begun_) return begin(value);
    if (!json.is_object())
      throw InputError(place_, "", fmt::format("found {}; expected a JSON object", one_line(line)));
    see(value);
  }

  [[noreturn]] void fail_as_no_drive() const {
    throw InputError(
        file_, "line 1",
        fmt::format("expected the log of an execution, {{\"format\": \"{}\", ...}}, as "
                    "'grove toio --log' and 'grove vda5050 --log' write it",
                    kDriveFormat));
  }

  void begin(const JsonValue& value) {
    const nlohmann::json& json = value.json();
    if (!json.is_object() || json.value("format", nlohmann::json()) != kDriveFormat)
      fail_as_no_drive();
    log_.order = value.member("order").text();
    log_.seconds_per_step = seconds(value.member("seconds_per_step"), 0);
    const JsonValue robots = value.member("robots");
    for (std::size_t i = 0; i < robots.size(); ++i) {
      const JsonValue robot = robots.element(i);
      if (!agents_.contains(robot.text())) robot.fail_expected("a robot of the instance");
      named_.insert(robot.text());
    }
    is_begun_ = true;
  }

  void see(const JsonValue& value) {
    const AgentIndex agent = agent_of(value.member("robot"));
    std::vector<PoseSample>& before = log_.robots[agent];
    PoseSample now;
    now.seconds = seconds(value.member("t"), before.empty() ? 0 : before.back().seconds);
    const JsonValue at = value.member("at");
    if (at.size() != 2) at.fail_expected("[x, y]");
    now.x = coordinate(at.element(0));
    now.y = coordinate(at.element(1));
    const auto angle = value.find("angle");
    now.angle = angle ? angle->number() : std::numeric_limits<double>::quiet_NaN();
    now.completed = static_cast<std::int32_t>(
        value.member("action").integer(0, order_.end_of(agent) - order_.begin_of(agent)));
    now.state = state_of(value.member("state"));
    before.push_back(now);
  }

  AgentIndex agent_of(const JsonValue& robot) const {
    const std::string id = robot.text();
    if (!named_.contains(id)) robot.fail_expected("a robot that the first line names");
    return agents_.at(id);
  }

  static double seconds(const JsonValue& value, double least) {
    const double number = value.number();
    if (number < least || number > kMaxSeconds)
      value.fail_expected(fmt::format("seconds from {} on", least));
    return number;
  }

  static double coordinate(const JsonValue& value) {
    const double number = value.number();
    if (std::abs(number) > kFarthest) value.fail_expected("a place in the world");
    return number;
  }

  static std::uint8_t state_of(const JsonValue& value) {
    const auto* const found = std::ranges::find(kDriveStates, std::string_view(value.text()));
    if (found == kDriveStates.end())
      value.fail_expected(fmt::format("one of {}", fmt::join(kDriveStates, ", ")));
    return static_cast<std::uint8_t>(found - kDriveStates.begin());
  }

  const std::string file_;
  const ActionDependencyGraph& order_;
  std::unordered_map<std::string, AgentIndex> agents_;
  std::unordered_set<std::string> named_;  // ids of the robots in the first line
  ExecutionLog log_;
  std::string place_;
  std::size_t lines_ = 0;
  bool is_begun_ = false;
};

}  // namespace

ExecutionLog read_drive_file(const std::filesystem::path& path, const Instance& instance,
                             const ActionDependencyGraph& order) {
  const std::string text = read_text(path);
  const std::size_t whole = text.rfind('\n') + 1;  // npos + 1 is 0
  return DriveReader(path.string(), instance, order).read(std::string_view(text).substr(0, whole));
}

}  // namespace grove::detail
