// SPDX-License-Identifier: MIT
#include "io/known_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <string>

#include "io/input_error.h"
#include "io/spelling.h"

namespace grove::detail {
namespace {

using Words = std::vector<std::string_view>;

struct Unmodelled {
  std::string_view key;
  std::string_view feature;
};

// Keys that users may expect in Grove's files, for features that Grove does not model (see
// docs/formats.md).
constexpr std::array kUnmodelled{
    Unmodelled{"after", "an order among tasks"},
    Unmodelled{"before", "an order among tasks"},
    Unmodelled{"capacity", "capacities"},
    Unmodelled{"deadline", "deadlines"},
    Unmodelled{"due", "deadlines"},
    Unmodelled{"finish_by", "deadlines"},
    Unmodelled{"footprint", "the size of robots"},
    Unmodelled{"jobs", "jobs"},
    Unmodelled{"objective", "objectives other than the sum of costs"},
    Unmodelled{"precedence", "an order among tasks"},
    Unmodelled{"priority", "priorities"},
    Unmodelled{"radius", "the size of robots"},
    Unmodelled{"release", "times before which a task cannot be visited"},
    Unmodelled{"speed", "speeds"},
    Unmodelled{"window", "time windows"},
};

// --- declarations ---

const KnownObject& working_keys() {
  static const KnownObject known{"\"working\"", {{"task"}, {"done"}}};
  return known;
}

const KnownObject& agent_keys() {
  static const KnownObject known{"an agent",
                                 {{"id", nullptr, {"name"}},
                                  {"start", nullptr, {"position", "location", "from", "source"}},
                                  {"goal", nullptr, {"target", "destination", "dest", "to", "end"}},
                                  {"goals", nullptr, {"targets", "destinations", "potentialGoals"}},
                                  {"motion"},
                                  {"turn_steps"},
                                  {"heading", nullptr, {"orientation", "theta", "direction"}},
                                  {"goal_heading"},
                                  {"working", &working_keys()}}};
  return known;
}

KnownObject robots_of(std::string_view name, Words worlds) {
  KnownObject known{name, {}};
  for (const std::string_view world : worlds) known.keys.push_back({world});
  known.keys.push_back({"agents", &agent_keys(), {"robots", "vehicles"}});
  known.keys.push_back({"tasks", &task_keys()});
  return known;
}

const KnownObject& vertex_keys() {
  static const KnownObject known{
      "a vertex",
      {{"id", nullptr, {"name"}},
       {"at", nullptr, {"position", "pos", "location", "coordinates", "xy"}}}};
  return known;
}

const KnownObject& edge_keys() {
  static const KnownObject known{
      "an edge",
      {{"from", nullptr, {"source", "start"}},
       {"to", nullptr, {"target", "end"}},
       {"steps", nullptr, {"length", "distance", "cost", "weight", "time", "duration"}},
       {"one_way",
        nullptr,
        {"directed", "undirected", "bidirectional", "two_way"},
        " (true: only from 'from' to 'to')"}}};
  return known;
}

const KnownObject& work_keys() {
  static const KnownObject known{
      "work", {{"task"}, {"begin", nullptr, {"start"}}, {"end", nullptr, {"finish"}}}};
  return known;
}

const KnownObject& agent_plan_keys() {
  static const KnownObject known{"an agent",
                                 {{"id", nullptr, {"name"}},
                                  {"sequence", nullptr, {"tasks", "order"}},
                                  {"cost"},
                                  {"path"},
                                  {"work", &work_keys()}}};
  return known;
}

const KnownObject& claim_keys() {
  static const KnownObject known{"a claim", {{"file"}, {"regex"}, {"unit"}}};
  return known;
}

const KnownObject& claims_keys() {
  static const KnownObject known{"the claims",
                                 {{"solved", &claim_keys()},
                                  {"cost", &claim_keys()},
                                  {"lower_bound", &claim_keys()},
                                  {"seconds", &claim_keys()},
                                  {"first_plan", &claim_keys()}}};
  return known;
}

const KnownObject& trace_keys() {
  static const KnownObject known{"a trace", {{"file"}, {"regex"}, {"groups"}}};
  return known;
}

// --- hints ---

// Normalizes a key: lower case, without '_', '-' and blanks, such as "oneway" for "One-Way".
std::string folded(std::string_view key) {
  std::string text;
  for (const char c : key)
    if (c != '_' && c != '-' && c != ' ')
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string singular(std::string_view key) {
  std::string text = folded(key);
  if (text.size() > 1 && text.back() == 's') text.pop_back();
  return text;
}

constexpr std::size_t kMinPrefixLength = 3;  // shorter prefixes are too ambiguous

// True if `key` is a prefix of `known` of sufficient length, such as "dur" of "duration".
bool begins(const std::string& key, std::string_view known) {
  return key.size() >= kMinPrefixLength && folded(known).starts_with(key);
}

bool has_key(const JsonValue& object, const KnownKey& key) {
  return object.json().contains(key.name);
}

std::string hint(const KnownKey& key) {
  return fmt::format("expected '{}'{}, if that is meant", key.name, key.meaning);
}

// Returns the known key that the user probably meant, other than keys that the object already has;
// nullptr if there is none.
const KnownKey* key_meant(const JsonValue& object, const std::string& key,
                          const KnownObject& known) {
  std::vector<std::string> spelt;
  std::vector<const KnownKey*> keys;
  for (const KnownKey& each : known.keys) {
    if (has_key(object, each)) continue;
    if (singular(key) == singular(each.name)) return &each;
    if (std::ranges::find(each.aliases, folded(key), folded) != each.aliases.end()) return &each;
    keys.push_back(&each);
    spelt.push_back(folded(each.name));
  }
  const auto near = nearest_word(folded(key), Words(spelt.begin(), spelt.end()));
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (near && spelt[i] == *near) return keys[i];
  const auto begun = std::ranges::find_if(
      keys, [&](const KnownKey* each) { return begins(folded(key), each->name); });
  return begun == keys.end() ? nullptr : *begun;
}

const Unmodelled* unmodelled(const std::string& key) {
  const auto found = std::ranges::find(kUnmodelled, folded(key),
                                       [](const Unmodelled& each) { return folded(each.key); });
  return found == kUnmodelled.end() ? nullptr : &*found;
}

const Unmodelled* nearly_unmodelled(const std::string& key) {
  Words words;
  for (const Unmodelled& each : kUnmodelled) words.push_back(each.key);
  const auto near = nearest_word(key, words);
  return near ? unmodelled(std::string(*near)) : nullptr;
}

// Returns the object in this kind of file that has the key; nullptr if there is none.
const KnownObject* owner(const std::string& key, const KnownObject& file) {
  for (const KnownKey& each : file.keys)
    if (each.name == key) return &file;
  for (const KnownKey& each : file.keys)
    if (const KnownObject* found = each.inside ? owner(key, *each.inside) : nullptr) return found;
  return nullptr;
}

std::string names_of(const KnownObject& known) {
  Words names;
  for (const KnownKey& key : known.keys) names.push_back(key.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string what_was_meant(const JsonValue& object, const std::string& key,
                           const KnownObject& known, const KnownObject& file) {
  const auto not_modelled = [](const Unmodelled& found) {
    return fmt::format("Grove does not model {}; expected no such key", found.feature);
  };
  const KnownKey* meant = key_meant(object, key, known);
  if (const Unmodelled* found = unmodelled(key)) return not_modelled(*found);
  if (meant && singular(key) == singular(meant->name)) return hint(*meant);
  if (const KnownObject* found = owner(key, file))
    return fmt::format("this key belongs to {}; expected it there", found->name);
  if (meant) return hint(*meant);
  if (const Unmodelled* found = nearly_unmodelled(key)) return not_modelled(*found);
  return fmt::format("expected one of {}, or a name that begins with '_', for a remark",
                     names_of(known));
}

bool is_remark(std::string_view key) {
  return key.starts_with('_') || key == "$schema";
}

bool has_marks_of(const JsonValue& root, const KnownObject& file) {
  return std::ranges::all_of(file.marks,
                             [&](std::string_view mark) { return root.json().contains(mark); });
}

void refuse_other_kind(const JsonValue& root, const KnownObject& known) {
  if (known.kind.empty() || has_marks_of(root, known)) return;
  for (const KnownObject* other : {&instance_keys(), &roadmap_keys(), &plan_keys()})
    if (has_marks_of(root, *other)) throw WrongFileKind(root.file(), other->kind, known.kind);
}

// Rejects a file that has keys, but none that is or resembles a key of its kind. The message does
// not quote the keys, because the user may have named this file by mistake.
void refuse_unrelated(const JsonValue& root, const KnownObject& known) {
  if (known.kind.empty()) return;
  bool has_others = false;
  for (const auto& [key, value] : root.json().items()) {
    if (is_remark(key)) continue;
    if (std::ranges::find(known.keys, std::string_view(key), &KnownKey::name) != known.keys.end() ||
        key_meant(root, key, known))
      return;
    has_others = true;
  }
  if (has_others)
    root.fail(fmt::format("has none of the keys {}; expected {}", names_of(known), known.kind));
}

void require_known(const JsonValue& object, const KnownObject& known, const KnownObject& file) {
  if (!object.json().is_object()) return;
  for (const auto& [key, value] : object.json().items()) {
    if (is_remark(key)) continue;
    const auto found = std::ranges::find(known.keys, std::string_view(key), &KnownKey::name);
    if (found == known.keys.end())
      object.fail(fmt::format("unknown key '{}'; {}", one_line(key),
                              what_was_meant(object, key, known, file)));
    if (!found->inside) continue;
    const JsonValue inner = object.member(key.c_str());
    if (!value.is_array())
      require_known(inner, *found->inside, file);
    else
      for (std::size_t i = 0; i < value.size(); ++i)
        require_known(inner.element(i), *found->inside, file);
  }
}

}  // namespace

const KnownObject& task_keys() {
  static const KnownObject known{
      "a task",
      {{"id", nullptr, {"name"}},
       {"cell", nullptr, {"place", "position", "pos", "location", "vertex", "node", "goal"}},
       {"agents", nullptr, {"robots", "vehicles", "agent", "robot"}},
       {"duration", nullptr, {"time", "service_time", "work"}},
       {"need", nullptr, {"needs", "required", "visits"}}}};
  return known;
}

const KnownObject& new_tasks_keys() {
  static const KnownObject known{"the file", {{"tasks", &task_keys()}}};
  return known;
}

const KnownObject& instance_keys() {
  static const KnownObject known = [] {
    KnownObject keys = robots_of("the file", {"map", "roadmap"});
    keys.kind = "an instance";
    keys.marks = {"agents", "tasks"};
    return keys;
  }();
  return known;
}

const KnownObject& robot_keys() {
  static const KnownObject known = robots_of("the instance", {});
  return known;
}

const KnownObject& roadmap_keys() {
  static const KnownObject known{
      "the file",
      {{"vertices", &vertex_keys(), {"nodes"}}, {"edges", &edge_keys(), {"roads", "links"}}},
      "a roadmap",
      {"vertices", "edges"}};
  return known;
}

// The keys in a plan's "stats" are not checked, because they are for people and differ between
// versions.
const KnownObject& plan_keys() {
  static const KnownObject known{"the file",
                                 {{"status"},
                                  {"cost"},
                                  {"lower_bound", nullptr, {"bound"}},
                                  {"omega"},
                                  {"following"},
                                  {"agents", &agent_plan_keys(), {"robots", "paths"}},
                                  {"stats"}},
                                 "a plan",
                                 {"status", "lower_bound"}};
  return known;
}

const KnownObject& solver_keys() {
  static const KnownObject known{"the file",
                                 {{"name"},
                                  {"about"},
                                  {"command"},
                                  {"instance"},
                                  {"plan"},
                                  {"anytime"},
                                  {"threads"},
                                  {"claims", &claims_keys()},
                                  {"trace", &trace_keys()}}};
  return known;
}

void require_known_keys(const JsonValue& value, const KnownObject& known) {
  refuse_other_kind(value, known);
  refuse_unrelated(value, known);
  require_known(value, known, known);
}

}  // namespace grove::detail
