// SPDX-License-Identifier: MIT
#include "mpi/batch/farm_messages.h"

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/common.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/variant.hpp>
#include <sstream>
#include <utility>

namespace grove::batch {

template <typename Archive>
void serialize(Archive& archive, Entry& entry) {
  archive(entry.id, entry.path, entry.map, entry.agents, entry.digest);
}

// As it will stand in the table.
template <typename Archive>
std::string save_minimal(const Archive&, const Report& report) {
  return json_line(report.row);
}
template <typename Archive>
void load_minimal(const Archive&, Report& report, const std::string& line) {
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
  std::ostringstream stream;
  cereal::PortableBinaryOutputArchive archive(stream);
  archive(message);
  return std::move(stream).str();
}

FarmMessage decode(const std::string& bytes) {
  std::istringstream stream(bytes);
  FarmMessage message;
  cereal::PortableBinaryInputArchive archive(stream);
  archive(message);
  return message;
}

}  // namespace grove::batch
