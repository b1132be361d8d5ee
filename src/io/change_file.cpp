// SPDX-License-Identifier: MIT
#include "io/change_file.h"

#include "io/agents_entry.h"
#include "io/json_value.h"
#include "io/known_keys.h"
#include "io/path_entry.h"

namespace grove::detail {
namespace {

NewTask read_task(const JsonValue& json, const Instance& instance) {
  NewTask task;
  task.id = json.member("id").text();
  const JsonValue cell = json.member("cell");
  task.place = instance.roadmap() ? read_vertex(*instance.roadmap(), cell)
                                  : read_pose(instance.map(), {}, cell).place;
  task.agents = agents_of_task(json, [&] { return instance.agent_ids(); });
  if (const auto duration = json.find("duration"))
    task.duration = static_cast<Time>(duration->integer(0, InstanceBuilder::kMaxDuration));
  task.need = need_of_task(json, task.agents.size());
  return task;
}

}  // namespace

std::vector<ReadTask> read_new_tasks(const std::filesystem::path& path, const Instance& instance,
                                     std::vector<std::string>* hints) {
  const JsonDocument document(path);
  const auto list = document.root().find("tasks");
  require_known_keys(document.root(), list ? new_tasks_keys() : task_keys());
  if (hints)
    *hints = hints_on_need(list ? *list : document.root(), instance.agents().size(), path.string());
  std::vector<ReadTask> tasks;
  if (!list) {
    tasks.push_back({read_task(document.root(), instance), ""});
    return tasks;
  }
  for (std::size_t i = 0; i < list->size(); ++i)
    tasks.push_back({read_task(list->element(i), instance), list->element(i).path()});
  return tasks;
}

}  // namespace grove::detail
