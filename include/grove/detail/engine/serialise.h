// SPDX-License-Identifier: MIT
// Values as bytes, for files and for other processes, by cereal's portable binary format: written
// low bytes first, so that every machine writes and reads the same.
//
// A type takes part by a function serialize(Archive&, T&) in its namespace, like those below, made
// of numbers, strings, vectors, maps and optionals. What bytes may hold beyond its shape - cells on
// the world, paths that are walks - is for the receiver to check.
#pragma once

#include <cereal/archives/portable_binary.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <sstream>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <string_view>

#include "grove/detail/model/plan.h"
#include "grove/detail/search/node_record.h"
#include "grove/detail/search/tree_record.h"

namespace grove::detail {

// Bytes as a stream that knows how many are left; a view.
class BytesBuffer : public std::streambuf {
 public:
  explicit BytesBuffer(std::string_view bytes) {
    char* const begin = const_cast<char*>(bytes.data());  // only read from
    setg(begin, begin, begin + bytes.size());
  }
  std::size_t left() const { return static_cast<std::size_t>(egptr() - gptr()); }
};

// cereal's portable archive for bytes that nobody vouches for. An element of a container takes at
// least a byte, so a count beyond the bytes left is refused before memory is asked for: what is
// read takes at most some 40 times the memory of its bytes. Throws cereal::Exception.
class GuardedInput : public cereal::InputArchive<GuardedInput, cereal::AllowEmptyClassElision> {
 public:
  explicit GuardedInput(std::string_view bytes)
      : InputArchive(this), buffer_(bytes), stream_(&buffer_), archive_(stream_) {}

  std::size_t left() const { return buffer_.left(); }
  template <std::streamsize ItemSize>
  void load_binary(void* data, std::streamsize size) {
    archive_.loadBinary<ItemSize>(data, size);
  }
  void require(bool holds, const char* what) const {
    if (!holds) throw cereal::Exception(what);
  }

 private:
  BytesBuffer buffer_;
  std::istream stream_;
  cereal::PortableBinaryInputArchive archive_;
};

template <class T>
requires std::is_arithmetic_v<T>
void CEREAL_LOAD_FUNCTION_NAME(GuardedInput& in, T& value) {
  in.load_binary<sizeof(T)>(&value, sizeof(T));
}

inline void CEREAL_LOAD_FUNCTION_NAME(GuardedInput& in, bool& value) {
  std::uint8_t byte = 0;
  in(byte);
  in.require(byte <= 1, "expected 0 or 1 for no or yes");
  value = byte != 0;
}

template <class T>
void CEREAL_LOAD_FUNCTION_NAME(GuardedInput& in, cereal::NameValuePair<T>& pair) {
  in(pair.value);
}

template <class T>
void CEREAL_LOAD_FUNCTION_NAME(GuardedInput& in, cereal::SizeTag<T>& tag) {
  in(tag.size);
  in.require(tag.size <= in.left(), "more items are announced than there are bytes left");
}

template <class T>
void CEREAL_LOAD_FUNCTION_NAME(GuardedInput& in, cereal::BinaryData<T>& data) {
  in.load_binary<sizeof(std::remove_pointer_t<T>)>(data.data,
                                                   static_cast<std::streamsize>(data.size));
}

template <class Archive>
void serialize(Archive& archive, Constraint& c) {
  auto kind = static_cast<std::uint8_t>(c.kind);
  archive(c.cell, c.from, c.begin, c.end, kind);
  const auto known = constraint_kind(kind);
  if (!known) throw cereal::Exception("a constraint of no known kind");
  c.kind = *known;
}

template <class Archive>
void serialize(Archive& archive, AgentConstraint& c) {
  archive(c.agent, c.constraint);
}

template <class Archive>
void serialize(Archive& archive, SequenceClass& c) {
  archive(c.prefix, c.forbidden_next);
}

template <class Archive>
void serialize(Archive& archive, NodeRecord::Walk& walk) {
  archive(walk.agent, walk.steps, walk.words);
}

template <class Archive>
void serialize(Archive& archive, NodeRecord& record) {
  archive(record.tree, record.constraints, record.paths, record.cost, record.bound,
          record.conflicts, record.bounded);
}

template <class Archive>
void serialize(Archive& archive, TreeRecord::Order& order) {
  archive(order.sequences, order.fixed, order.steps, order.words);
}

template <class Archive>
void serialize(Archive& archive, TreeRecord& record) {
  archive(record.orders);
}

template <class Archive>
void serialize(Archive& archive, WorkTime& work) {
  archive(work.task, work.begin, work.end);
}

template <class Archive>
void serialize(Archive& archive, AgentPlan& plan) {
  archive(plan.cost, plan.sequence, plan.path, plan.work);
}

template <class Archive>
void serialize(Archive& archive, Plan& plan) {
  archive(plan.cost, plan.agents);
}

// The bytes of `value`.
template <class T>
std::string to_bytes(const T& value) {
  std::ostringstream stream;
  {
    using Archive = cereal::PortableBinaryOutputArchive;
    Archive archive(stream, Archive::Options::LittleEndian());
    archive(value);
  }
  return std::move(stream).str();
}

// The value whose bytes these are, all of them. Throws std::invalid_argument for bytes that are no
// T's: cut short, too long, or otherwise damaged in a way that shows.
template <std::default_initializable T>
T from_bytes(std::string_view bytes) try {
  GuardedInput in(bytes);
  T value;
  in(value);
  in.require(in.left() == 0, "more bytes than belong to it");
  return value;
} catch (const cereal::Exception& error) {
  throw std::invalid_argument(error.what());
}

}  // namespace grove::detail

CEREAL_REGISTER_ARCHIVE(grove::detail::GuardedInput)
