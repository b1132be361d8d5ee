// SPDX-License-Identifier: MIT
// grove view INSTANCE [PLAN...].
#include "tools/view/view_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "execution/action_dependency_graph.h"
#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/plan_file.h"
#include "io/plan_import.h"
#include "io/text_file.h"
#include "model/check.h"
#include "model/choices.h"
#include "proof/certificate_text.h"
#include "tools/common/commands.h"
#include "tools/common/helper_program.h"
#include "tools/common/instance_arguments.h"
#include "tools/common/options.h"
#include "tools/common/own_files.h"
#include "tools/view/browser.h"
#include "tools/view/drive_data.h"
#include "tools/view/page.h"
#include "tools/view/page_data.h"
#include "tools/view/run_log_file.h"

namespace grove::detail {
namespace {

namespace fs = std::filesystem;

constexpr const char* kViewFooter =
    R"(Writes one page that needs only a browser, no network. The page plays the plan and marks errors in
it: collisions, jumps, missing tasks.

PLAN is a plan file, or the output of another solver: the path lists of EECBS, CBSH2-RTC and
MAPF-LNS2 (--outputPaths) or the text of lacam and pibt. Without a plan, the page shows the
instance.

--drive shows robots that execute the plan, from the log of their execution (docs/drive-log.md):
position, action, progress, and the robot for which each one waits. With --follow, during the
execution.

--run shows a search instead, from its JSON log: bound and best plan over time with their sources,
splits, memory, ranks and, with --log-tree, the trees. With --follow it is shown during the run, to
browsers on this machine.

--proof shows a certificate of a lower bound (docs/proof.md), as 'grove solve --proof' writes it:
its splits, why no plan is lost, and what each part relies on, with places on the map; with PLAN,
also the distance of its cost to the bound. The page does not check the certificate; grove-verify does.

--svg, --png and --gif write pictures of the first plan instead, without a browser: SVG and PNG show
the moments --at side by side, GIF plays the whole plan.

Examples:
  grove view benchmarks/data/first.cts.json first.plan.json
  grove view my.cts.json my.plan.json --svg strip.svg --at 0,10,20,30
  grove view my.cts.json ours.plan.json theirs.txt -o both.html
  grove solve my.cts.json --quiet --log run.jsonl --log-format jsonl --log-tree 1000
  grove view --run run.jsonl
  grove view hall.cts.json hall.plan.json --drive drive.jsonl --follow --open
  grove solve hall.cts.json --omega 0 --proof hall.proof
  grove view hall.cts.json hall.plan.json --proof hall.proof)";

constexpr IntegerRange kWidths{16, 10'000};
constexpr std::size_t kMaxPlans = 2;  // on one page
constexpr IntegerRange kPorts{0, 65'535};
constexpr std::int64_t kMaxSplits = 5000;  // of a certificate that a page shows

struct ViewArguments {
  InstanceArguments instance;
  std::vector<std::string> plans;
  std::string output;
  bool open = false;
  std::string run;    // log of a run, instead of an instance
  std::string drive;  // log of an execution of the plan
  std::string proof;  // certificate of a lower bound
  bool follow = false;
  std::int64_t port = 0;
  PictureRequest pictures;

  bool wants_pictures() const { return !pictures.is_empty(); }
};

std::string size_text(std::size_t bytes) {
  const double kilobytes = static_cast<double>(bytes) / 1e3;
  return kilobytes < 1000 ? fmt::format("{:.0f} kB", std::ceil(kilobytes))
                          : fmt::format("{:.1f} MB", kilobytes / 1e3);
}

std::string name_of(const std::string& file) {
  return fs::path(file).filename().string();
}

// Returns the name of the page of a certificate, plan or instance. An instance page has a suffix of
// its own, because plans are usually named after their instance.
std::string default_output(const ViewArguments& arguments) {
  if (!arguments.proof.empty()) return name_of(arguments.proof) + ".html";
  if (arguments.plans.empty()) return arguments.instance.stem() + ".instance.html";
  const std::string name = fs::path(arguments.plans.front()).filename().string();
  return name.substr(0, name.find('.')) + ".html";
}

// Returns the name of the page to write, or "" if only pictures are requested.
std::string page_file(const ViewArguments& arguments) {
  if (!arguments.output.empty() || arguments.wants_pictures()) return arguments.output;
  return default_output(arguments);
}

// Refuses a file that exists and is not a page of Grove, unless the user has named it.
void require_own_page(const ViewArguments& arguments, const std::string& file) {
  if (!arguments.output.empty() || !fs::is_regular_file(file)) return;
  if (!is_page(read_text(file)))
    throw InputError(file, "",
                     fmt::format("exists and is not a page of Grove; expected '-o {}' to replace "
                                 "it, or another name",
                                 one_line(file)));
}

void write(const std::string& file, const std::string& bytes) {
  write_file_atomically(file, bytes);
  fmt::print("wrote {}: {}\n", file, size_text(bytes.size()));
}

void write_page(const ViewArguments& arguments, const Instance& instance,
                const std::vector<NamedPlan>& plans) {
  const std::string name = fs::path(arguments.instance.name()).filename().string();
  const std::string output = page_file(arguments);
  require_own_page(arguments, output);
  write(output, plan_page(name, page_data(name, instance, plans)));
  if (arguments.open) open_in_browser(fs::absolute(output).string());
}

void write_pictures(const PictureMaker& maker, PictureRequest order, const Instance& instance,
                    const std::vector<NamedPlan>& plans) {
  const Plan* plan = nullptr;
  if (!plans.empty() && plans.front().claimed.solution.plan)
    plan = &*plans.front().claimed.solution.plan;
  if (order.moments.empty()) order.moments.push_back(0);
  maker.draw(order, instance, plan, write);
}

// Replaces this process by the server, with the page as its standard input.
[[noreturn]] void follow(const ViewArguments& arguments, const std::string& log,
                         std::string_view page) {
  replace_standard_input(page);
  std::vector<std::string> words{log, "--port", std::to_string(arguments.port)};
  if (arguments.open) words.emplace_back("--open");
  exec_program("grove-follow", words);
}

// Writes the page of a log, and opens it if requested. Its default name is that of the log.
void write_log_page(const ViewArguments& arguments, const std::string& log,
                    const std::string& page) {
  const std::string output =
      arguments.output.empty() ? fs::path(log).stem().string() + ".html" : arguments.output;
  require_distinct_files(output, log, "the log");
  require_own_page(arguments, output);
  write(output, page);
  if (arguments.open) open_in_browser(fs::absolute(output).string());
}

void show_run(const ViewArguments& arguments) {
  const std::string& log = arguments.run;
  if (arguments.follow) follow(arguments, log, following_page(name_of(log)));
  write_log_page(arguments, log, run_page(name_of(log), read_run_log(log)));
}

void require_valid(const Instance& instance, const NamedPlan& plan, std::string_view expected) {
  const Solution& solution = plan.claimed.solution;
  const auto wrong = check_in_file(instance, solution, plan.claimed.order, 1);
  if (solution.plan && wrong.empty()) return;
  throw InputError(
      plan.name, wrong.empty() ? "" : wrong.front().json_pointer,
      fmt::format("{}; expected {}", wrong.empty() ? "contains no plan" : wrong.front().message,
                  expected));
}

void show_drive(const ViewArguments& arguments, const Instance& instance, const NamedPlan& plan) {
  // Passing orders do not have the visits that plans state.
  arguments.instance.require_no_choices(instance, "--drive does not support", kFixedChoices);
  require_valid(instance, plan, "the valid plan that is executed");
  const std::string name = name_of(arguments.instance.name());
  const std::string data = page_data(name, instance, std::span(&plan, 1));
  const ActionDependencyGraph order(instance, *plan.claimed.solution.plan);
  const std::string passing_order_text = order_data(instance, order);
  const std::string& log = arguments.drive;
  if (arguments.follow)
    follow(arguments, log, following_drive_page(name_of(log), data, passing_order_text));
  const ExecutionLog drive = read_drive_file(log, instance, order);
  write_log_page(arguments, log,
                 drive_page(name_of(log), data, passing_order_text, drive_data(drive)));
}

void show_proof(const ViewArguments& arguments, const Instance& instance,
                const std::vector<NamedPlan>& plans) {
  arguments.instance.require_no_choices(instance, "views of certificates do not support yet");
  const CertificateText certificate = read_certificate(arguments.proof, instance, kMaxSplits);
  const bool may_follow = certificate.may_follow;
  const Instance spoken_of = may_follow ? instance : instance.without_following();
  for (const NamedPlan& plan : plans)
    require_valid(spoken_of, plan,
                  may_follow ? "a valid plan"
                             : "a plan valid without following, as the certificate requires");
  const std::string data = page_data(name_of(arguments.instance.name()), instance, plans);
  const std::string output = page_file(arguments);
  require_distinct_files(output, arguments.proof, "the certificate");
  require_own_page(arguments, output);
  write(output, proof_page(name_of(arguments.proof), data, certificate.lines));
  if (arguments.open) open_in_browser(fs::absolute(output).string());
}

// Adds a warning if the plan is invalid. It is shown anyway: a page lists its violations, and a
// picture shows colliding robots in red.
void warn_if_invalid(const Instance& instance, const NamedPlan& plan,
                     std::vector<std::string>& warnings) {
  const Solution& solution = plan.claimed.solution;
  if (!solution.plan) return;
  const auto wrong = check_in_file(instance, solution, plan.claimed.order, 1);
  if (!wrong.empty())
    warnings.push_back(fmt::format("{} is not valid: {}: {}", one_line(plan.name),
                                   wrong.front().json_pointer, one_line(wrong.front().message)));
}

void run(const ViewArguments& arguments, const PictureMaker& maker) {
  if (arguments.wants_pictures() && maker.exec_picture_program) maker.exec_picture_program();
  if (!arguments.run.empty()) return show_run(arguments);
  const LoadedInstance loaded = arguments.instance.load();
  require_distinct_outputs({{"--output", page_file(arguments)},
                            {"--svg", arguments.pictures.svg},
                            {"--png", arguments.pictures.png},
                            {"--gif", arguments.pictures.gif}},
                           arguments.instance, loaded, arguments.plans);
  std::vector<std::string> warnings;
  std::vector<NamedPlan> plans;
  for (const std::string& file : arguments.plans)
    plans.push_back(
        {fs::path(file).filename().string(), read_plan_of_any_tool(file, loaded.instance)});
  if (!arguments.drive.empty()) return show_drive(arguments, loaded.instance, plans.front());
  if (!arguments.proof.empty()) return show_proof(arguments, loaded.instance, plans);
  for (const NamedPlan& plan : plans) warn_if_invalid(loaded.instance, plan, warnings);
  if (arguments.wants_pictures() && plans.size() > 1)
    warnings.push_back("pictures show only the first plan");
  if (plans.size() > kMaxPlans)
    warnings.push_back(fmt::format("a page shows {} plans; {} and later ones are left out",
                                   kMaxPlans, one_line(plans[kMaxPlans].name)));
  print_warnings(warnings);
  if (arguments.wants_pictures()) write_pictures(maker, arguments.pictures, loaded.instance, plans);
  if (!page_file(arguments).empty()) write_page(arguments, loaded.instance, plans);
}

void add_log_options(CLI::App& command, ViewArguments& arguments) {
  command
      .add_option("--drive", arguments.drive, "log of an execution of the plan, to show the robots")
      ->type_name("LOG.jsonl");
  command.add_option("--proof", arguments.proof, "certificate of a lower bound, to show as a tree")
      ->type_name("CERTIFICATE");
  command.add_option("--run", arguments.run, "log of a run to show, instead of an instance")
      ->type_name("LOG.jsonl");
  command.add_flag("--follow", arguments.follow,
                   "with --run or --drive: show the log while it grows");
  add_integer(command, "--port", arguments.port, kPorts, "with --follow: port; 0: any free port");
}

// Throws a CLI error if the options do not fit together. CLI11 could check this, but would add the
// conditions to every line of the help.
void require_fit(const CLI::App& command) {
  const auto given = [&](const char* name) { return !command.get_option(name)->empty(); };
  if (given("--follow") && !given("--run") && !given("--drive"))
    throw CLI::RequiresError("--follow", "--run or --drive");
  if (!given("INSTANCE") && !given("--run"))
    throw CLI::RequiredError("INSTANCE, or --run LOG.jsonl");
  if (given("--port") && !given("--follow")) throw CLI::RequiresError("--port", "--follow");
  for (const char* other : {"INSTANCE", "PLAN", "--drive", "--proof"})
    if (given("--run") && given(other)) throw CLI::ExcludesError("--run", other);
  if (given("--proof") && given("--drive")) throw CLI::ExcludesError("--proof", "--drive");
  for (const char* page : {"--run", "--drive", "--proof"})
    for (const char* other : {"--svg", "--png", "--gif", "--at", "--width", "--speed"})
      if (given(page) && given(other)) throw CLI::ExcludesError(page, other);
  for (const char* picture : {"--at", "--width"})
    if (given(picture) && !given("--svg") && !given("--png") && !given("--gif"))
      throw CLI::RequiresError(picture, "--svg, --png or --gif");
  if (given("--speed") && !given("--gif")) throw CLI::RequiresError("--speed", "--gif");
  if (given("--proof") && command.get_option("PLAN")->count() > 1)
    throw CLI::ValidationError("--proof", "found several plans; expected at most one PLAN");
  if (given("--drive") && command.get_option("PLAN")->count() != 1)
    throw CLI::RequiresError("--drive", "PLAN, the plan that is executed");
}

}  // namespace

void add_view_command(CLI::App& app, const PictureMaker& maker) {
  const auto arguments = std::make_shared<ViewArguments>();
  CLI::App* command =
      app.add_subcommand("view", "Show an instance, plans, a run or a certificate as a page");
  command->footer(kViewFooter);
  arguments->instance.add_to(*command);
  command->add_option("PLAN", arguments->plans, "plan files, or paths of other solvers")
      ->type_name("");
  command
      ->add_option("-o,--output", arguments->output,
                   "page to write, completely or not at all; default: named after the plan, log or "
                   "certificate")
      ->type_name("FILE.html");
  command->add_flag("--open", arguments->open, "open the page in the browser");
  command->add_option("--svg", arguments->pictures.svg, "write a vector picture")
      ->type_name("FILE.svg");
  command->add_option("--png", arguments->pictures.png, "write a picture")->type_name("FILE.png");
  command->add_option("--gif", arguments->pictures.gif, "write an animation")
      ->type_name("FILE.gif");
  command
      ->add_option("--at", arguments->pictures.moments,
                   "moments of --svg and --png, steps; default: 0")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(0.0, 1e9).description(""))
      ->type_name("T,T,...");
  add_integer(*command, "--width", arguments->pictures.width, kWidths, "width of a moment, pixels");
  command->add_option("--speed", arguments->pictures.speed, "speed of --gif, steps per second")
      ->check(CLI::Range(0.1, 50.0).description(""))
      ->type_name("X")
      ->capture_default_str();
  add_log_options(*command, *arguments);
  command->get_option("INSTANCE")->required(false);
  command->callback([command, arguments, maker] {
    require_fit(*command);
    run(*arguments, maker);
  });
}

}  // namespace grove::detail
