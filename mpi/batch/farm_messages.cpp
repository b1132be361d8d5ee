// SPDX-License-Identifier: MIT
#include "mpi/batch/farm_messages.h"

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/common.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/variant.hpp>
#include <sstream>
#include <utility>

namespace grove::batch {

template <typename Archive>
void serialize(Archive& archive, Entry& entry) {
  archive(entry.id, entry.path, entry.map, entry.agents, entry.digest);
}

template <typename Archive>
void serialize(Archive& archive, Result& result) {
  archive(result.status, result.cost, result.lower_bound, result.nodes_expanded,
          result.first_plan_s, result.stopped_by, result.plan_file);
}

template <typename Archive>
void serialize(Archive& archive, Row& row) {
  archive(row.id, row.instance, row.digest, row.result, row.error, row.version, row.ranks,
          row.threads, row.wall_s, row.started_at);
}

template <typename Archive>
void serialize(Archive& archive, Report& report) {
  archive(report.row);
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
