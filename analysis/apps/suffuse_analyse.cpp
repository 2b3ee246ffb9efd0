// suffuse-analyse: tables and figures from runs, one subcommand each (docs/analysis/suffuse-analyse.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>

#include "commands/constriction_command.h"
#include "commands/contacts_command.h"
#include "commands/fluidisation_command.h"
#include "commands/grading_command.h"
#include "commands/hydraulic_command.h"
#include "commands/reproduce_command.h"
#include "commands/rose_command.h"
#include "commands/sample_command.h"
#include "commands/shear_command.h"
#include "commands/verdict_command.h"
#include "suffuse/common/error.h"

namespace {

constexpr const char* kDescription =
    "Soil mechanics at the grain scale, after a run: what dumps and gradings say. SI units; compression is "
    "positive.\n`suffuse-analyse SUBCOMMAND --help` tells the options of one.";

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
  suffuse::analysis::add_rose(app);
  suffuse::analysis::add_reproduce(app);
  suffuse::analysis::add_shear(app);
  suffuse::analysis::add_verdict(app);
  try {
    app.parse(argc, argv);  // the chosen subcommand runs in here
    suffuse::require_printed_output();
    return 0;
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) return app.exit(problem);  // --help, --version
    return report(fmt::format("{}; see --help", problem.what()).c_str());
  } catch (const suffuse::UserError& problem) {
    return report(problem.what());
  } catch (const std::exception& failure) {
    if (const std::string refusal = suffuse::refusal_of_the_machine(failure); !refusal.empty())
      return report(refusal.c_str());
    report(fmt::format("internal: {}", failure.what()).c_str());
    return 2;
  }
}
