// SPDX-License-Identifier: MIT
#include "grove/detail/io/change_file.h"

#include "json_value.h"
#include "path_entry.h"

namespace grove::detail {
namespace {

NewTask read_task(const JsonValue& json, const Instance& instance, UnknownKeys& unknown) {
  NewTask task;
  task.id = json.member("id").text();
  const JsonValue cell = json.member("cell");
  task.place = instance.roadmap() ? read_vertex(*instance.roadmap(), cell)
                                  : read_pose(instance.map(), {}, cell).place;
  task.agents = json.member("agents").texts();
  if (const auto duration = json.find("duration"))
    task.duration = static_cast<Time>(duration->integer(0, InstanceBuilder::kLongest));
  unknown.look_at(json, {"id", "cell", "agents", "duration"});
  return task;
}

}  // namespace

std::vector<ReadTask> read_new_tasks(const std::filesystem::path& path, const Instance& instance,
                                     std::vector<std::string>* warnings) {
  const JsonDocument document(path);
  UnknownKeys unknown(path.string(), warnings, Misspelt::kRefused);
  const auto list = document.root().find("tasks");
  std::vector<ReadTask> tasks;
  if (!list) {
    tasks.push_back({read_task(document.root(), instance, unknown), ""});
    return tasks;
  }
  unknown.look_at(document.root(), {"tasks"});
  for (std::size_t i = 0; i < list->size(); ++i)
    tasks.push_back({read_task(list->element(i), instance, unknown), list->element(i).path()});
  return tasks;
}

}  // namespace grove::detail
