// suffuse-analyse: tables and figures from runs, one subcommand each (docs/analysis/suffuse-analyse.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <exception>
#include <string>

#include "contacts/contacts_command.h"
#include "contacts/rose_command.h"
#include "grading/constriction_command.h"
#include "grading/grading_command.h"
#include "grading/hydraulic_command.h"
#include "grading/sample_command.h"
#include "suffuse/common/command_line_help.h"
#include "suffuse/common/error.h"
#include "verdict/fluidisation_command.h"
#include "verdict/lifting_command.h"
#include "verdict/reproduce_command.h"
#include "verdict/shear_command.h"
#include "verdict/suffusion_command.h"
#include "verdict/verdict_command.h"

namespace {

constexpr const char* kDescription =
    "Soil mechanics at the grain scale, after a run: what dumps and gradings say. SI units; compression is "
    "positive.\n`suffuse-analyse SUBCOMMAND --help` tells the options of one.";

/// What CLI11 takes for numbers without a word: nothing at all (0), nan, inf, hexadecimal digits, -1 as a
/// huge count.
std::string refusal_of_number(const std::string& text, bool count) {
  double value = 0;
  const char* end = text.data() + text.size();
  const char* begin = text.starts_with('+') ? text.data() + 1 : text.data();
  const auto [at, problem] = std::from_chars(begin, end, value);
  if (text.empty() || problem != std::errc() || at != end || !std::isfinite(value))
    return fmt::format("'{}' must be a finite number", text);
  return count && value < 0 ? fmt::format("{} must be >= 0", text) : "";
}

/// Every option that takes numbers takes finite ones.
void require_numbers(CLI::App& app) {
  for (CLI::App* command : app.get_subcommands({})) require_numbers(*command);
  for (CLI::Option* option : app.get_options()) {
    const std::string type = option->get_type_name();
    const bool count = type.starts_with("UINT");
    if (count || type.starts_with("FLOAT") || type.starts_with("INT"))
      option->check([count](const std::string& text) { return refusal_of_number(text, count); }, "");
  }
}

int report(const char* what) {
  std::fflush(stdout);
  fmt::print(stderr, "suffuse-analyse: error: {}\n", what);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{kDescription, "suffuse-analyse"};
  app.set_version_flag("--version", "suffuse-analyse " SUFFUSE_VERSION);
  app.require_subcommand(1);
  suffuse::analysis::add_contacts(app);
  suffuse::analysis::add_grading(app);
  suffuse::analysis::add_sample(app);
  suffuse::analysis::add_constriction(app);
  suffuse::analysis::add_hydraulic(app);
  suffuse::analysis::add_fluidisation(app);
  suffuse::analysis::add_lifting(app);
  suffuse::analysis::add_suffusion(app);
  suffuse::analysis::add_rose(app);
  suffuse::analysis::add_reproduce(app);
  suffuse::analysis::add_shear(app);
  suffuse::analysis::add_verdict(app);
  require_numbers(app);
  try {
    app.parse(argc, argv);  // the chosen subcommand runs in here
    suffuse::require_printed_output();
    return 0;
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) return app.exit(problem);  // --help, --version
    return report(suffuse::explain(app, problem).c_str());
  } catch (const suffuse::UserError& problem) {
    return report(problem.what());
  } catch (const std::exception& failure) {
    if (const std::string refusal = suffuse::refusal_of_the_machine(failure); !refusal.empty())
      return report(refusal.c_str());
    report(fmt::format("internal: {}", failure.what()).c_str());
    return 2;
  }
}
