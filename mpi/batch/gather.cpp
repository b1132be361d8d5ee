// SPDX-License-Identifier: MIT
// Rank 0 hears all and tells all, so nobody can be a round ahead of anybody it hears from.
#include "mpi/batch/gather.h"

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <sstream>
#include <utility>

namespace grove::batch {
namespace {

using Texts = std::vector<std::string>;

std::string bytes_of(const Texts& texts) {
  std::ostringstream stream;
  cereal::PortableBinaryOutputArchive archive(stream);
  archive(texts);
  return std::move(stream).str();
}

Texts texts_of(const std::string& bytes) {
  std::istringstream stream(bytes);
  cereal::PortableBinaryInputArchive archive(stream);
  Texts texts;
  archive(texts);
  return texts;
}

Parcel next(Transport& transport, const std::function<void()>& wait) {
  for (;;) {
    if (std::optional<Parcel> parcel = transport.receive()) return std::move(*parcel);
    wait();
  }
}

}  // namespace

std::vector<std::string> gather(Transport& transport, const std::string& mine,
                                const std::function<void()>& wait) {
  if (transport.rank() != 0) {
    transport.send(0, mine);
    return texts_of(next(transport, wait).bytes);
  }
  Texts texts(static_cast<std::size_t>(transport.ranks()));
  texts[0] = mine;
  for (int left = transport.ranks() - 1; left > 0; --left) {
    Parcel parcel = next(transport, wait);
    texts[static_cast<std::size_t>(parcel.from)] = std::move(parcel.bytes);
  }
  const std::string all = bytes_of(texts);
  for (int rank = 1; rank < transport.ranks(); ++rank) transport.send(rank, all);
  return texts;
}

}  // namespace grove::batch
