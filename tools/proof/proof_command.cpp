// SPDX-License-Identifier: MIT
// grove proof trim FILE
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
    R"(Certificates are what 'grove solve --proof' writes: why no plan costs less. grove-verify checks
them; 'grove view --proof' shows them.

Examples:
  grove solve my.cts.json --proof my.proof
  grove proof trim my.proof
  grove-verify my.cts.json my.proof)";

constexpr const char* kTrimFooter =
    R"(Leaves out what the theorem does not need: lemmas that nothing names, lemmas said twice, splits
of which what is below one side does without that side, demands of lemmas that their proofs do
without. Certificates of other programs are read as well as Grove's, compressed or not, and stay as
they are in that. The instance is not needed, for nothing is solved: what agents cost under the
demands of a leaf is taken to need all of these. What is proven stays so, and is checked as ever,
by grove-verify.

The file is read three times, piece by piece; in memory are its lemmas, without their proofs, and a
byte for each split, within --memory-limit: a small compressed file may hold any number of lines.

Prints one line, and exits with 0; or with 2 where FILE is no certificate, and leaves all as it was.

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
      app.add_subcommand("trim", "Leave out of a certificate what its theorem does not need");
  command->footer(kTrimFooter);
  command->add_option("FILE", arguments->file, "the certificate")->required()->type_name("");
  command
      ->add_option("-o,--output", arguments->output,
                   "file to write, whole or not at all; by default FILE itself")
      ->type_name("FILE");
  add_number(*command, "--memory-limit", arguments->memory_limit_gb, 0.01, 1e6,
             "refuse a certificate for which this program would need more than so many gigabytes")
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
