// SPDX-License-Identifier: MIT
#include "tests/fuzz/fuzz_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "engine/method.h"
#include "tests/fuzz/random.h"
#include "tests/fuzz/random_instance.h"
#include "tests/support/random_choices.h"

namespace grove::detail::fuzz {
namespace {

template <typename T, std::size_t N>
using Names = std::array<std::pair<T, std::string_view>, N>;

constexpr Names<RtspBackend, 4> kBackends{{{RtspBackend::kAuto, "auto"},
                                           {RtspBackend::kHeldKarp, "held-karp"},
                                           {RtspBackend::kBoundedDp, "bounded-dp"},
                                           {RtspBackend::kCbc, "cbc"}}};
constexpr Names<Policy, 3> kPolicies{
    {{Policy::kAuto, "auto"}, {Policy::kFixed, "fixed"}, {Policy::kFree, "free"}}};
constexpr Names<LowLevel, 4> kLowLevels{{{LowLevel::kOwn, "own"},
                                         {LowLevel::kVisitedSets, "visited-sets"},
                                         {LowLevel::kSingleLegs, "single-legs"},
                                         {LowLevel::kTimeIntervalForest, "forest"}}};
constexpr Names<ImposedLimit, 5> kImposedLimits{{{ImposedLimit::kNothing, "nothing"},
                                                 {ImposedLimit::kExpired, "expired"},
                                                 {ImposedLimit::kSoon, "soon"},
                                                 {ImposedLimit::kMemory, "memory"},
                                                 {ImposedLimit::kInterrupt, "interrupt"}}};

template <typename T, std::size_t N>
std::string_view name_of(const Names<T, N>& names, T value) {
  return std::ranges::find(names, value, &std::pair<T, std::string_view>::first)->second;
}

template <typename T, std::size_t N>
T value_of(const Names<T, N>& names, std::string_view name) {
  const auto found = std::ranges::find(names, name, &std::pair<T, std::string_view>::second);
  if (found == names.end()) throw std::invalid_argument(fmt::format("did not expect '{}'", name));
  return found->first;
}

std::uint64_t parse_number(const std::string& text) {
  std::uint64_t number = 0;
  const char* end = text.data() + text.size();
  if (std::from_chars(text.data(), end, number).ptr != end)
    throw std::invalid_argument(fmt::format("expected a number, not '{}'", text));
  return number;
}

Technique value_of_technique(const std::string& name) {
  const auto technique = parse_technique(name);
  if (!technique) throw std::invalid_argument(fmt::format("did not expect '{}'", name));
  return *technique;
}

void read_option(const std::string& line, FuzzCase& fuzz_case) {
  std::istringstream in(line);
  std::string key;
  std::string value;
  in >> key >> value;
  if (key.empty() || key.starts_with('#')) return;
  if (key == "omega")
    fuzz_case.options.omega = Omega::parse(value);
  else if (key == "policy")
    fuzz_case.options.policy = value_of(kPolicies, value);
  else if (key == "low-level")
    fuzz_case.options.low_level = value_of(kLowLevels, value);
  else if (key == "rtsp")
    fuzz_case.options.rtsp = value_of(kBackends, value);
  else if (key == "seed")
    fuzz_case.options.seed = parse_number(value);
  else if (key == "node-memory")
    fuzz_case.options.node_memory = parse_number(value);
  else if (key == "threads")
    fuzz_case.options.threads = static_cast<int>(parse_number(value));
  else if (key == "deterministic")
    fuzz_case.options.deterministic = value == "yes";
  else if (key == "without")
    fuzz_case.options.techniques = fuzz_case.options.techniques.without(value_of_technique(value));
  else if (key == "tune")
    set(fuzz_case.options.tuning, value);
  else if (key == "choices")
    fuzz_case.choices = parse_number(value);
  else if (key == "strike")
    fuzz_case.limit = value_of(kImposedLimits, value);
  else
    throw std::invalid_argument(fmt::format("did not expect the option '{}'", key));
}

// Returns the default techniques, none, the defaults without one, a single technique, or a random
// subset of the defaults.
Techniques random_techniques(Random& random) {
  const Technique one = kTechniques[random.below(static_cast<int>(kTechniques.size()))].technique;
  switch (random.below(6)) {
    case 0:
      return Techniques();
    case 1:
      return Techniques::defaults().without(one);
    case 2:
      return Techniques{one};
    case 3: {
      Techniques any = Techniques::defaults();
      for (const auto& [t, name] : kTechniques)
        if (random.below(2) == 0) any = any.without(t);
      return any;
    }
    default:
      return Techniques::defaults();
  }
}

Omega random_omega(Random& random) {
  constexpr std::string_view kChoices[] = {"0",   "0",   "0",   "0.01", "0.01",
                                           "0.1", "0.1", "0.5", "inf"};
  return Omega::parse(kChoices[random.below(std::size(kChoices))]);
}

// Unlimited in half of the cases; otherwise so small that nodes must be evicted.
std::size_t random_node_memory(Random& random) {
  constexpr std::size_t kUnlimited = SolveOptions::kUnlimited;
  return random.pick<std::size_t>({kUnlimited, kUnlimited, kUnlimited, 1'000, 3'000, 10'000});
}

// In a quarter of the cases up to eight tunables are at their minimum or differ from their default
// by a factor of up to eight. Some cases also start the joint search or the Lagrangian bound at
// once.
Tuning random_tuning(Random& random) {
  Tuning tuning;
  // By default tiny instances are solved before the joint search starts.
  if (random.percent(20)) {
    tuning.joint_start_work = 0;
    tuning.joint_step_work = random.pick<std::int64_t>({1, 20, 4000});
  }
  // By default the Lagrangian bound does not run with so few agents.
  if (random.percent(30)) {
    tuning.lagrangian_min_agents = 1;
    tuning.lagrangian_start_work = 0;
    tuning.lagrangian_max_share = random.pick<double>({0.5, 4, 100});
    tuning.lagrangian_step_work = random.pick<std::int64_t>({1, 100, 4000});
    tuning.lagrangian_level = random.pick<double>({0.03, 0.3});
    tuning.first_dual_solution_round = random.between(1, 3);
    tuning.lagrangian_lns_max_gap = random.pick<double>({0.1, 10});
  }
  if (random.below(4) > 0) return tuning;
  const auto all = tunables();
  for (int left = random.between(1, 8); left > 0; --left) {
    const Tunable& t = all[random.below(all.size())];
    std::visit(
        [&](auto at) {
          using Number = std::remove_cvref_t<decltype(tuning.*at)>;
          const double usual = static_cast<double>(Tuning().*at);
          const double some =
              random.pick<double>({t.min, usual / 8, usual / 2, 2 * usual, 8 * usual});
          tuning.*at = static_cast<Number>(std::clamp(some, t.min, t.max));
        },
        t.place);
  }
  return tuning;
}

ImposedLimit random_limit(Random& random) {
  const int dice = random.below(100);
  return dice < 84   ? ImposedLimit::kNothing
         : dice < 88 ? ImposedLimit::kExpired
         : dice < 92 ? ImposedLimit::kSoon
         : dice < 96 ? ImposedLimit::kMemory
                     : ImposedLimit::kInterrupt;
}

}  // namespace

Instance FuzzCase::build() const {
  Instance plain = instance.build();
  return choices == 0 ? plain : with_random_choices(plain, choices);
}

std::string FuzzCase::to_text() const {
  std::string text =
      fmt::format("{}options\nomega {}\npolicy {}\nrtsp {}\nseed {}\nstrike {}\n",
                  instance.to_text(), options.omega.to_string(), name_of(kPolicies, options.policy),
                  name_of(kBackends, options.rtsp), options.seed, name_of(kImposedLimits, limit));
  if (options.low_level != LowLevel::kOwn)
    text += fmt::format("low-level {}\n", name_of(kLowLevels, options.low_level));
  if (options.threads != 1) text += fmt::format("threads {}\n", options.threads);
  if (options.deterministic) text += "deterministic yes\n";
  if (choices != 0) text += fmt::format("choices {}\n", choices);
  for (const auto& [t, name] : kTechniques)
    if (!options.techniques.has(t)) text += fmt::format("without {}\n", name);
  if (options.node_memory != SolveOptions::kUnlimited)
    text += fmt::format("node-memory {}\n", options.node_memory);
  for (const Tunable& t : tunables())
    if (t.value(options.tuning) != t.value({}))
      text += fmt::format("tune {}={}\n", t.name(), t.value(options.tuning));
  return text;
}

FuzzCase FuzzCase::parse(std::string_view text) {
  constexpr std::string_view kHeading = "\noptions\n";
  FuzzCase fuzz_case;
  const std::size_t heading = text.find(kHeading);
  fuzz_case.instance = TinyInstance::parse(text.substr(0, heading));
  if (heading == std::string_view::npos) return fuzz_case;
  std::istringstream in{std::string(text.substr(heading + kHeading.size()))};
  for (std::string line; std::getline(in, line);) read_option(line, fuzz_case);
  return fuzz_case;
}

FuzzCase with_choices(FuzzCase fuzz_case, std::uint64_t seed) {
  fuzz_case.choices = seed;
  fuzz_case.options.low_level = LowLevel::kOwn;
  try {
    require_fit(Method::kAuto, fuzz_case.build(), fuzz_case.options);
  } catch (const InstanceError&) {  // an agent with a choice that turns
    fuzz_case.options.policy = Policy::kAuto;
  }
  return fuzz_case;
}

FuzzCase random_case(std::uint64_t seed) {
  FuzzCase fuzz_case;
  const int world = Random(seed ^ 0x70AD5).below(100);
  const bool on_plain_grid = world < 35;
  fuzz_case.instance = on_plain_grid ? random_instance(seed)
                       : world < 50  ? random_roads(seed)
                                     : random_world(seed);
  fuzz_case.instance.may_follow = Random(seed ^ 0xF0110).below(100) >= 15;
  Random random(~seed);
  fuzz_case.options.omega = random_omega(random);
  fuzz_case.options.policy =
      random.pick<Policy>({Policy::kAuto, Policy::kFixed, Policy::kFree, Policy::kFree});
  fuzz_case.options.rtsp = random.pick<RtspBackend>(
      {RtspBackend::kAuto, RtspBackend::kAuto, RtspBackend::kHeldKarp, RtspBackend::kHeldKarp,
       RtspBackend::kBoundedDp, RtspBackend::kBoundedDp, RtspBackend::kCbc});
  if (!is_built(fuzz_case.options.rtsp)) fuzz_case.options.rtsp = RtspBackend::kAuto;
  fuzz_case.options.seed = static_cast<std::uint64_t>(random.below(1000));
  fuzz_case.options.techniques = random_techniques(random);
  fuzz_case.limit = random_limit(random);
  fuzz_case.options.node_memory = random_node_memory(random);
  fuzz_case.options.threads = random.pick<int>({1, 1, 1, 1, 1, 2, 2, 3, 4});
  fuzz_case.options.deterministic = random.below(8) == 0;
  // Only for problems that the published low levels support.
  if (fuzz_case.options.policy != Policy::kFixed && random.below(6) == 0 && on_plain_grid)
    fuzz_case.options.low_level = random.pick<LowLevel>(
        {LowLevel::kVisitedSets, LowLevel::kSingleLegs, LowLevel::kTimeIntervalForest});
  fuzz_case.options.tuning = random_tuning(random);
  return fuzz_case;
}

}  // namespace grove::detail::fuzz
