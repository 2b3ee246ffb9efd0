// suffuse-study: what accuracy costs in time, from runs of one script with many settings
// (docs/analysis/suffuse-study.md).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <string_view>

#include "suffuse/common/command_line_help.h"
#include "suffuse/common/error.h"
#include "suffuse/study/study_file.h"
#include "suffuse/study/study_runner.h"

namespace {

constexpr const char* kDescription =
    "What accuracy costs in time: runs a script once for every setting that a study file lists, and leaves a "
    "table\nand a figure of error against time. docs/analysis/suffuse-study.md describes the file.";

/// `what` may begin with the program's name: who has found the mistake.
int report(std::string_view what) {
  constexpr std::string_view name = "suffuse-study: ";
  if (what.starts_with(name)) what.remove_prefix(name.size());
  std::fflush(stdout);
  fmt::print(stderr, "{}error: {}\n", name, what);
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace suffuse::study;
  CLI::App app{kDescription, "suffuse-study"};
  app.set_version_flag("--version", "suffuse-study " SUFFUSE_VERSION);
  std::string file;
  std::string time = "wall", launcher;
  int ranks = 0;
  StudyRunSettings settings;
  bool no_figure = false;
  app.add_option("STUDY", file, "study file (TOML)")->required();
  app.add_option("--out", settings.out,
                 "folder for runs and results; runs/NAME of the study file if not given");
  app.add_option("--ranks", ranks, "MPI ranks of every run, instead of the study's")
      ->check(CLI::Range(1, 100000));
  app.add_option("--launcher", launcher,
                 "what starts the ranks, {ranks} their number: \"srun --exact -n {ranks}\"");
  app.add_option("--cores", settings.cores,
                 "cores that runs at once may take together; those of one run if not given")
      ->check(CLI::Range(1, 1000000));
  app.add_flag("--dry-run", settings.dry_run, "print the commands, run nothing");
  app.add_flag("--resume", settings.resume,
               "keep the runs that have ended in that folder, and do the others");
  app.add_flag("--retry-failed", settings.retry_failed, "with --resume: do those that failed again")
      ->needs("--resume");
  app.add_option("--time", time, "hold errors against wall or core seconds; wall if not given")
      ->check(CLI::IsMember({"wall", "core"}));
  app.add_flag("--no-figure", no_figure, "leave the figure out");
  app.add_option("--program", settings.program,
                 "the suffuse to run; the one beside this program if not given");
  try {
    app.parse(argc, argv);
    settings.figure = !no_figure;
    settings.time = time == "core" ? StudyTime::core : StudyTime::wall;
    Study study = read_study(file);
    if (ranks > 0) study.ranks = ranks;
    if (app.count("--launcher") > 0) study.launcher = {launcher, ".", "suffuse-study", "--launcher"};
    if (settings.out.empty()) settings.out = "runs/" + std::filesystem::path(file).stem().string();
    const int code = run_study(study, settings);
    suffuse::require_printed_output();
    return code;
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) return app.exit(problem);  // --help, --version
    return report(suffuse::explain(app, problem));
  } catch (const suffuse::UserError& problem) {
    return report(problem.what());
  } catch (const std::exception& failure) {
    if (const std::string refusal = suffuse::refusal_of_the_machine(failure); !refusal.empty())
      return report(refusal);
    report(fmt::format("internal: {}", failure.what()));
    return 2;
  }
}
