// SPDX-License-Identifier: MIT
// The keys of Grove's own files: one declaration for each kind of object, and the one check that
// refuses every other key. A constraint that is dropped is worse than a file that is refused.
#pragma once

#include <string_view>
#include <vector>

#include "io/json_value.h"

namespace grove::detail {

struct KnownObject;

struct KnownKey {
  std::string_view name;
  // What the object in this key, or each object of the list in it, may hold; null: not looked into.
  const KnownObject* inside = nullptr;
  // Other words for it, for hints.
  std::vector<std::string_view> aliases = {};
  std::string_view meaning = {};  // follows the name in a hint: " (true: ...)"
};

struct KnownObject {
  std::string_view name;  // "an agent"
  std::vector<KnownKey> keys;
  // Of a whole file: "an instance", and the keys by which it is told apart from those of other
  // kinds.
  std::string_view kind = {};
  std::vector<std::string_view> marks = {};
};

const KnownObject& instance_keys();
// What an instance holds on a world that is given already: agents and tasks.
const KnownObject& robot_keys();
const KnownObject& roadmap_keys();
const KnownObject& plan_keys();
// A file of new tasks: a list of them, or one.
const KnownObject& new_tasks_keys();
const KnownObject& new_task_keys();
const KnownObject& solver_keys();

// Throws WrongFileKind for a file that has the marks of another kind of file and lacks one of its
// own; InputError, which quotes nothing, for a file that has no key of its kind; and InputError for
// the first key of `value`, or of an object in it, that `known` does not have: what resembles it,
// where it belongs, or that Grove does not model it. "$schema" and keys that begin with '_' are for
// people and other programs, and are not looked into.
void require_known_keys(const JsonValue& value, const KnownObject& known);

}  // namespace grove::detail
