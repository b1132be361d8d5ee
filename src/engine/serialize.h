// SPDX-License-Identifier: MIT
// Serialisation of values to bytes, for files and messages, with cereal. The encoding is the same
// on every machine:
// - Integers: LEB128, 7 bits per byte, low bits first; signed integers are zigzag-encoded. The
//   constraints of a node are mostly small numbers, so they take a third of their fixed-width size,
//   and writing a checkpoint of millions of nodes takes half the time.
// - Numbers of one byte, floating-point numbers, and arrays of numbers (packed paths): fixed width,
//   little-endian.
//
// A type can be serialised if its namespace has a function serialize(Archive&, T&) like those
// below. Its members can be numbers, strings, vectors, maps, optionals and other such types. The
// receiver must check everything that the type does not express, for instance that cells are on the
// map and that each step of a path is a move or a wait.
#pragma once

#include <algorithm>
#include <bit>
#include <cereal/cereal.hpp>
#include <cereal/types/map.hpp>
#include <cereal/types/optional.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

#include "model/plan.h"
#include "search/node_record.h"
#include "search/tree_record.h"

namespace grove::detail {

// Output archive that appends to a string.
class BytesOutput : public cereal::OutputArchive<BytesOutput, cereal::AllowEmptyClassElision> {
 public:
  // `bytes` must outlive this object.
  explicit BytesOutput(std::string& bytes) : OutputArchive(this), bytes_(bytes) {}

  void put(std::uint8_t byte) { bytes_ += static_cast<char>(byte); }
  void put_number(std::uint64_t number) {
    for (; number >= 0x80; number >>= 7) put(static_cast<std::uint8_t>(number | 0x80));
    put(static_cast<std::uint8_t>(number));
  }
  // Writes `count` items of fixed width.
  template <class T>
  void put_array(const T* items, std::size_t count) {
    const std::size_t begin = bytes_.size();
    bytes_.append(reinterpret_cast<const char*>(items), count * sizeof(T));
    low_bytes_first<T>(bytes_.data() + begin, count);
  }

  // Converts between the byte order of this machine and little-endian.
  template <class T>
  static void low_bytes_first(char* bytes, std::size_t count) {
    if constexpr (std::endian::native != std::endian::little && sizeof(T) > 1)
      for (std::size_t i = 0; i < count; ++i)
        std::reverse(bytes + i * sizeof(T), bytes + (i + 1) * sizeof(T));
  }

 private:
  std::string& bytes_;
};

// Input archive for untrusted bytes. Each element of a container takes at least one byte, so the
// archive refuses a count that exceeds the number of remaining bytes, before it allocates memory. A
// decoded value takes at most about 40 times the memory of its bytes. The archive also refuses a
// number with a longer encoding than necessary, so that each value has exactly one encoding. Throws
// cereal::Exception.
class GuardedInput : public cereal::InputArchive<GuardedInput, cereal::AllowEmptyClassElision> {
 public:
  // `bytes` must outlive this object.
  explicit GuardedInput(std::string_view bytes) : InputArchive(this), rest_(bytes) {}

  std::size_t left() const { return rest_.size(); }
  std::uint8_t get() {
    require(!rest_.empty(), "ends too early");
    const auto byte = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    return byte;
  }
  std::uint64_t get_number() {
    constexpr int kLastShift = 63;  // shift of the last byte, of which only one bit fits
    std::uint64_t number = 0;
    for (int shift = 0;; shift += 7) {
      const std::uint8_t byte = get();
      require(shift < kLastShift || byte <= 1, "found a number with too many bits");
      number |= std::uint64_t{byte & 0x7Fu} << shift;
      if (byte >= 0x80) continue;
      require(byte > 0 || shift == 0, "found a number that is longer than necessary");
      return number;
    }
  }
  template <class T>
  void get_array(T* items, std::size_t count) {
    require(count <= left() / sizeof(T), "ends too early");
    if (count == 0) return;
    std::memcpy(items, rest_.data(), count * sizeof(T));
    BytesOutput::low_bytes_first<T>(reinterpret_cast<char*>(items), count);
    rest_.remove_prefix(count * sizeof(T));
  }
  void require(bool holds, const char* what) const {
    if (!holds) throw cereal::Exception(what);
  }

 private:
  std::string_view rest_;
};

// True for types that are written at fixed width: numbers of one byte and floating-point numbers.
template <class T>
inline constexpr bool kAsItIs = std::is_floating_point_v<T> || sizeof(T) == 1;

template <class T>
requires std::is_arithmetic_v<T>
void CEREAL_SAVE_FUNCTION_NAME(BytesOutput& out, const T& value) {
  if constexpr (kAsItIs<T>) {
    out.put_array(&value, 1);
  } else if constexpr (std::is_signed_v<T>) {
    const auto wide = static_cast<std::int64_t>(value);
    out.put_number(static_cast<std::uint64_t>(wide) << 1 ^ static_cast<std::uint64_t>(wide >> 63));
  } else {
    out.put_number(value);
  }
}

template <class T>
requires std::is_arithmetic_v<T>
void CEREAL_LOAD_FUNCTION_NAME(GuardedInput& in, T& value) {
  if constexpr (kAsItIs<T>) {
    in.get_array(&value, 1);
  } else {
    const std::uint64_t number = in.get_number();
    const std::uint64_t unfolded =
        std::is_signed_v<T> ? number >> 1 ^ (std::uint64_t{0} - (number & 1)) : number;
    value = static_cast<T>(unfolded);
    in.require(static_cast<std::uint64_t>(value) == unfolded, "found a number with too many bits");
  }
}

inline void CEREAL_LOAD_FUNCTION_NAME(GuardedInput& in, bool& value) {
  const std::uint8_t byte = in.get();
  in.require(byte <= 1, "expected 0 or 1 for no or yes");
  value = byte != 0;
}

template <class T>
void CEREAL_SAVE_FUNCTION_NAME(BytesOutput& out, const cereal::NameValuePair<T>& pair) {
  out(pair.value);
}

template <class T>
void CEREAL_LOAD_FUNCTION_NAME(GuardedInput& in, cereal::NameValuePair<T>& pair) {
  in(pair.value);
}

template <class T>
void CEREAL_SAVE_FUNCTION_NAME(BytesOutput& out, const cereal::SizeTag<T>& tag) {
  out.put_number(tag.size);
}

template <class T>
void CEREAL_LOAD_FUNCTION_NAME(GuardedInput& in, cereal::SizeTag<T>& tag) {
  tag.size = in.get_number();
  in.require(tag.size <= in.left(), "found a number of items above the number of bytes left");
}

// `data.size` is the size of all items in bytes.
template <class T>
void CEREAL_SAVE_FUNCTION_NAME(BytesOutput& out, const cereal::BinaryData<T>& data) {
  using Item = std::remove_pointer_t<T>;
  out.put_array(static_cast<const Item*>(data.data), data.size / sizeof(Item));
}

template <class T>
void CEREAL_LOAD_FUNCTION_NAME(GuardedInput& in, cereal::BinaryData<T>& data) {
  using Item = std::remove_pointer_t<T>;
  in.get_array(static_cast<Item*>(data.data), data.size / sizeof(Item));
}

template <class Archive>
void serialize(Archive& archive, Constraint& c) {
  auto kind = static_cast<std::uint8_t>(c.kind);
  archive(c.cell, c.from, c.begin, c.end, kind);
  const auto known = constraint_kind(kind);
  if (!known || is_about_sequence({.kind = *known}))
    throw cereal::Exception("unknown kind of constraint");
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

// Serialises an enumeration of one byte whose values are 0 to `last`.
template <class Archive, class Enum>
void enumerated(Archive& archive, Enum& value, Enum last) {
  auto number = static_cast<std::uint8_t>(value);
  archive(number);
  if (number > static_cast<std::uint8_t>(last)) throw cereal::Exception("unknown kind");
  value = static_cast<Enum>(number);
}

// Returns the bytes of `value`.
template <class T>
std::string to_bytes(const T& value) {
  std::string bytes;
  BytesOutput archive(bytes);
  archive(value);
  return bytes;
}

// Decodes a value, which must take up all of `bytes`. Throws std::invalid_argument if `bytes` does
// not encode a T: it is too short, too long, or otherwise detectably damaged.
template <std::default_initializable T>
T from_bytes(std::string_view bytes) try {
  GuardedInput in(bytes);
  T value;
  in(value);
  in.require(in.left() == 0, "found more bytes than expected");
  return value;
} catch (const cereal::Exception& error) {
  throw std::invalid_argument(error.what());
}

}  // namespace grove::detail

CEREAL_REGISTER_ARCHIVE(grove::detail::BytesOutput)
CEREAL_REGISTER_ARCHIVE(grove::detail::GuardedInput)
CEREAL_SETUP_ARCHIVE_TRAITS(grove::detail::GuardedInput, grove::detail::BytesOutput)
