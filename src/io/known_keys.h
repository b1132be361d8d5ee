// SPDX-License-Identifier: MIT
// The keys of Grove's own files: one declaration for each kind of object, and one function that
// rejects all other keys. Unknown keys are errors, because silently ignoring a constraint would be
// worse than rejecting the file.
#pragma once

#include <string_view>
#include <vector>

#include "io/json_value.h"

namespace grove::detail {

struct KnownObject;

struct KnownKey {
  std::string_view name;
  // The keys of the object that is the value of this key, or of each object in a list; nullptr:
  // these keys are not checked.
  const KnownObject* inside = nullptr;
  // Keys that users write by mistake in place of this one, for hints.
  std::vector<std::string_view> aliases = {};
  std::string_view meaning = {};  // appended to the name in a hint, such as " (true: ...)"
};

struct KnownObject {
  std::string_view name;  // for messages, such as "an agent"
  std::vector<KnownKey> keys;
  // Only for a whole file: the kind of file, such as "an instance", and the keys that distinguish
  // it from files of other kinds.
  std::string_view kind = {};
  std::vector<std::string_view> marks = {};
};

const KnownObject& instance_keys();
// The keys of the text that parse_instance_on() reads: agents and tasks.
const KnownObject& robot_keys();
const KnownObject& roadmap_keys();
const KnownObject& plan_keys();
// The keys of a file with new tasks, which has a list of tasks or is a single task.
const KnownObject& new_tasks_keys();
const KnownObject& task_keys();
const KnownObject& solver_keys();

// Checks the keys of `value` and of the objects in it. Throws WrongFileKind if the file lacks one
// of its distinguishing keys but contains those of another kind of file. Throws InputError, with a
// message that does not quote the file, if no key of the file is, or resembles, a key of its kind.
// Otherwise throws InputError for the first unknown key; the message suggests a similar key, names
// the object to which the key belongs, states that Grove does not model the key, or lists the known
// keys. Ignores "$schema" and keys that begin with '_', which are for people and other programs.
void require_known_keys(const JsonValue& value, const KnownObject& known);

}  // namespace grove::detail
