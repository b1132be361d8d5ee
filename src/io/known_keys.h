// SPDX-License-Identifier: MIT
// The keys of Grove's own files: one declaration for each kind of object, and one function that
// rejects every other key. It is worse to ignore a constraint than to reject a file.
#pragma once

#include <string_view>
#include <vector>

#include "io/json_value.h"

namespace grove::detail {

struct KnownObject;

struct KnownKey {
  std::string_view name;
  // The keys of the object in this key, or of each object in its list; nullptr: not checked.
  const KnownObject* inside = nullptr;
  // Synonyms, for hints.
  std::vector<std::string_view> aliases = {};
  std::string_view meaning = {};  // appended to the name in a hint: " (true: ...)"
};

struct KnownObject {
  std::string_view name;  // "an agent"
  std::vector<KnownKey> keys;
  // Only for a whole file: "an instance", and the keys that distinguish it from files of other
  // kinds.
  std::string_view kind = {};
  std::vector<std::string_view> marks = {};
};

const KnownObject& instance_keys();
// The part of an instance that is read onto an existing map: agents and tasks.
const KnownObject& robot_keys();
const KnownObject& roadmap_keys();
const KnownObject& plan_keys();
// A file of new tasks: a list, or a single task.
const KnownObject& new_tasks_keys();
const KnownObject& new_task_keys();
const KnownObject& solver_keys();

// Checks the keys of `value` and of the objects in it. Throws WrongFileKind if the file has the
// distinguishing keys of another kind of file and lacks one of its own. Throws InputError, without
// a quotation, if the file has no key of its kind. Throws InputError for the first unknown key. The
// message names a similar key, or the object where the key belongs, or says that Grove does not
// model it. "$schema" and keys that begin with '_' are for people and other programs, and are
// ignored.
void require_known_keys(const JsonValue& value, const KnownObject& known);

}  // namespace grove::detail
