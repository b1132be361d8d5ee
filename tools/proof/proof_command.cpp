// SPDX-License-Identifier: MIT
// grove proof: commands for certificates.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "io/input_error.h"
#include "proof/certificate_trim.h"
#include "tools/common/commands.h"
#include "tools/common/options.h"

namespace grove::detail {
namespace {

constexpr const char* kProofFooter =
    R"(A certificate, as 'grove solve --proof' writes it, proves that no plan costs less than a bound.
grove-verify checks certificates; 'grove view --proof' shows them.

Examples:
  grove solve my.cts.json --proof my.proof
  grove proof trim my.proof
  grove-verify my.cts.json my.proof)";

constexpr const char* kTrimFooter =
    R"(Removes what the theorem does not need: lemmas that are never named, repeated lemmas, splits
one branch of which does not use its constraint, and constraints of lemmas that their proofs do not
use. Reads certificates of other programs as well, compressed or not; the output has the same
compression. It does not need the instance and solves nothing: it assumes that the costs in a leaf
depend on all constraints of that leaf. The theorem does not change. Check the result with
grove-verify.

The file is read three times, piece by piece. Memory is needed for its lemmas, without their proofs,
and a byte per split, up to --memory-limit, because a small compressed file may have any number of
lines.

Prints one line and exits with 0. If FILE is not a certificate, exits with 2 and changes nothing.

Examples:
  grove proof trim my.proof
  grove proof trim their.proof -o short.proof)";

struct TrimArguments {
  std::string file;
  std::string output;
  double memory_limit_gb = 1;
};

void run(const TrimArguments& arguments) {
  const std::string& to = arguments.output.empty() ? arguments.file : arguments.output;
  const auto [before, after] = trim_certificate(
      arguments.file, to, static_cast<std::size_t>(arguments.memory_limit_gb * 1e9));
  fmt::print("wrote {}: {} lines, {} bytes; before: {} lines, {} bytes\n", one_line(to),
             after.lines, after.bytes, before.lines, before.bytes);
}

void add_trim_command(CLI::App& app) {
  const auto arguments = std::make_shared<TrimArguments>();
  CLI::App* command =
      app.add_subcommand("trim", "Remove from a certificate what its theorem does not need");
  command->footer(kTrimFooter);
  command->add_option("FILE", arguments->file, "certificate")->required()->type_name("");
  command
      ->add_option("-o,--output", arguments->output,
                   "file to write, completely or not at all; default: FILE itself")
      ->type_name("FILE");
  add_number(*command, "--memory-limit", arguments->memory_limit_gb, 0.01, 1e6,
             "refuse a certificate for which this program would need more memory, GB")
      ->type_name("GB");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace

void add_proof_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("proof", "Work on certificates of lower bounds");
  command->footer(kProofFooter)->require_subcommand(1);
  add_trim_command(*command);
}

}  // namespace grove::detail
