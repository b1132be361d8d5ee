// SPDX-License-Identifier: MIT
#include "mpi/batch/farm_messages.h"

#include <cereal/types/variant.hpp>

#include "engine/serialize.h"

namespace grove::detail::batch {

template <typename Archive>
void serialize(Archive& archive, Entry& entry) {
  archive(entry.id, entry.path, entry.map, entry.agents, entry.digest);
}

// A message contains a row as the row's line in the table.
template <typename Archive>
void save(Archive& archive, const Report& report) {
  archive(json_line(report.row));
}
template <typename Archive>
void load(Archive& archive, Report& report) {
  std::string line;
  archive(line);
  report.row = parse_json_line(line);
}

template <typename Archive>
void serialize(Archive& archive, Assignment& assignment) {
  archive(assignment.entry);
}

template <typename Archive>
void serialize(Archive& archive, Ended& ended) {
  archive(ended.error);
}

std::string encode(const FarmMessage& message) {
  return to_bytes(message);
}

FarmMessage decode(std::string_view bytes) {
  return from_bytes<FarmMessage>(bytes);
}

}  // namespace grove::detail::batch
