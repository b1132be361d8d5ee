// SPDX-License-Identifier: MIT
#include "engine/components/lagrangian_messages.h"

#include "engine/serialize.h"

namespace grove::detail {

template <class Archive>
void serialize(Archive& archive, RelaxedRow& row) {
  enumerated(archive, row.kind, RelaxedRow::Kind::kFinish);
  archive(row.a, row.b, row.time, row.time_b);
}

template <class Archive>
void serialize(Archive& archive, MultiplierUpdate& update) {
  archive(update.rows, update.multipliers);
}

template <class Archive>
void serialize(Archive& archive, PricingRequest& request) {
  archive(request.round, request.first, request.known, request.update);
}

template <class Archive>
void serialize(Archive& archive, PricingReply& reply) {
  archive(reply.round, reply.digest, reply.first, reply.values, reply.paths, reply.work);
}

std::string bytes_of(const PricingRequest& request) {
  return to_bytes(request);
}

std::string bytes_of(const PricingReply& reply) {
  return to_bytes(reply);
}

PricingRequest pricing_request_of(std::string_view bytes) {
  return from_bytes<PricingRequest>(bytes);
}

PricingReply pricing_reply_of(std::string_view bytes) {
  return from_bytes<PricingReply>(bytes);
}

}  // namespace grove::detail
