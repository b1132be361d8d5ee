// SPDX-License-Identifier: MIT
#include "tools/generate/random.h"

namespace grove {
namespace {

std::mt19937_64 seeded_engine(std::uint64_t seed, Random::Use use) {
  std::seed_seq words{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32),
                      static_cast<std::uint32_t>(use)};
  return std::mt19937_64(words);
}

}  // namespace

Random::Random(std::uint64_t seed, Use use) : engine_(seeded_engine(seed, use)) {}

std::size_t Random::below(std::size_t bound) {
  const std::uint64_t n = bound;
  const std::uint64_t uneven = -n % n;  // 2^64 mod n: so many of the lowest draws are one too many
  std::uint64_t draw = engine_();
  while (draw < uneven) draw = engine_();
  return draw % n;
}

}  // namespace grove
