// suffuse: LIGGGHTS with our fixes, computes and commands, and a fluid. Runs an ordinary LIGGGHTS script.

#include <fmt/format.h>
#include <mpi.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "../commands/interruption.h"
#include "../commands/lbm_command.h"
#include "command_line.h"
#include "error.h"
#include "input.h"
#include "lammps.h"
#include "register_styles.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/end_together.h"
#include "suffuse/common/error.h"
#include "suffuse/common/hdf5_file.h"
#include "suffuse/common/provenance.h"

/// LIGGGHTS ends by this on its own errors, and what it said would be lost where screen and log are files
/// that have not been flushed yet.
extern "C" int MPI_Abort(MPI_Comm communicator, int code) {
  std::fflush(nullptr);
  return PMPI_Abort(communicator, code);
}

namespace {

constexpr const char* kHelp = R"(suffuse {version}: soil mechanics at the grain scale, on LIGGGHTS

usage: suffuse -in SCRIPT [LIGGGHTS options]
       mpirun -np N suffuse -in SCRIPT [LIGGGHTS options]

LIGGGHTS options pass through, among them:
  -in FILE            the script (otherwise it is read from standard input)
  -var NAME VALUE     set a script variable, e.g. -var scale quick; one that the script does not know is refused
  -log FILE           name of the log file (none: no log)
  -screen FILE        screen output to a file (none: no screen output)
  -echo WHAT          none, screen, log or both
  -suffix off         LIGGGHTS's own neighbour lists and contact loop instead of ours: its numbers bit for bit

Our own:
  --help              this text
  --help lbm [LINE]   the lines of `lbm`, or one of them with its words
  --version           the version
  --styles            the fixes, computes and commands that suffuse adds, each with its page
  --words             all words of `lbm`, as a table for programs
)";

bool given(int argc, char** argv, const char* option) {
  for (int i = 1; i < argc; ++i)
    if (std::strcmp(argv[i], option) == 0) return true;
  return false;
}

/// The words behind --help; false without the option.
bool asks_for_help(int argc, char** argv, std::vector<std::string>& about) {
  for (int i = 1; i < argc; ++i)
    for (const char* option : {"--help", "-help", "-h"})
      if (std::strcmp(argv[i], option) == 0) {
        about.assign(argv + i + 1, argv + argc);
        return true;
      }
  return false;
}

/// What the program says of itself where it is asked to, without a script. A UserError for a line of `lbm`
/// that there is not.
std::optional<std::string> own_answer(int argc, char** argv) {
  std::vector<std::string> about;
  if (asks_for_help(argc, argv, about)) {
    if (!about.empty() && about[0] == "lbm") return suffuse::lbm_help(about.size() > 1 ? about[1] : "");
    std::string text = kHelp;
    return text.replace(text.find("{version}"), 9, SUFFUSE_VERSION);
  }
  if (given(argc, argv, "--version")) return fmt::format("suffuse {}\n", SUFFUSE_VERSION);
  if (given(argc, argv, "--words")) return suffuse::words_text();
  if (given(argc, argv, "--styles")) return suffuse::styles_text();
  return {};
}

/// Lets a script find files beside it, and the programs beside this one: ${script_folder} is the folder of
/// -in FILE (LIGGGHTS takes relative names from the folder of the run), ${suffuse_folder} that of this
/// program. A -var of the same name on the command line is read first and wins.
void add_folders(std::vector<char*>& arguments, const char* script) {
  static std::string folder, programs;
  static char option[] = "-var", name[] = "script_folder", programs_name[] = "suffuse_folder";
  std::error_code ignored;  // without /proc PATH's program may do
  programs = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path().string();
  if (programs.empty()) programs = ".";
  arguments.insert(arguments.end(), {option, programs_name, programs.data()});
  if (script == nullptr) return;
  folder = std::filesystem::path(script).parent_path().string();
  if (folder.empty()) folder = ".";
  arguments.insert(arguments.end(), {option, name, folder.data()});
}

/// LIGGGHTS 3.8 writes to a null stream in some styles after `-screen none` and crashes; an empty device is
/// as silent.
std::vector<char*> with_a_real_screen(int argc, char** argv) {
  static char empty_device[] = "/dev/null";
  std::vector<char*> arguments(argv, argv + argc);
  for (std::size_t i = 1; i + 1 < arguments.size(); ++i) {
    const bool is_screen = std::strcmp(arguments[i], "-screen") == 0 || std::strcmp(arguments[i], "-sc") == 0;
    if (is_screen && std::strcmp(arguments[i + 1], "none") == 0) arguments[i + 1] = empty_device;
  }
  return arguments;
}

/// `-suffix off` is ours: LIGGGHTS would look for styles with that ending. Takes the two words out.
suffuse::GrainLoop take_grain_loop(std::vector<char*>& arguments) {
  for (std::size_t i = 1; i + 1 < arguments.size(); ++i) {
    const bool is_suffix = std::strcmp(arguments[i], "-suffix") == 0 || std::strcmp(arguments[i], "-sf") == 0;
    if (!is_suffix || std::strcmp(arguments[i + 1], "off") != 0) continue;
    const auto first = arguments.begin() + static_cast<std::ptrdiff_t>(i);
    arguments.erase(first, first + 2);
    return suffuse::GrainLoop::stock;
  }
  return suffuse::GrainLoop::vector;
}

/// How a script has ended.
struct End {
  int code = 0;
  std::string line;  ///< last words, the same on all ranks but for a fault that one alone has met
};

/// Last words on the terminal and in the log, once for all ranks.
void tell_the_end(const std::string& line, const LAMMPS_NS::LAMMPS* lmp, int rank) {
  std::fflush(nullptr);
  if (rank != 0) return;
  fmt::print(stderr, "{}\n", line);
  if (lmp != nullptr && lmp->logfile != nullptr) {
    fmt::print(lmp->logfile, "{}\n", line);
    std::fflush(lmp->logfile);
  }
}

/// Runs the script; LIGGGHTS ends the process itself on errors of its own.
End run_script(int argc, char** argv, int rank) {
  LAMMPS_NS::LAMMPS* lmp = nullptr;
  try {
    suffuse::on_first_rank("suffuse", MPI_COMM_WORLD, [&] {
      suffuse::require_known_options(argc, argv);
      suffuse::require_a_readable_script(argc, argv);
      suffuse::require_known_variables(argc, argv);
    });
    const char* script = suffuse::script_name(argc, argv);
    suffuse::set_provenance({SUFFUSE_VERSION, script != nullptr ? script : ""});
    std::vector<char*> arguments = with_a_real_screen(argc, argv);
    const suffuse::GrainLoop loop = take_grain_loop(arguments);
    add_folders(arguments, script);
    lmp = new LAMMPS_NS::LAMMPS(static_cast<int>(arguments.size()), arguments.data(), MPI_COMM_WORLD);
    suffuse::register_styles(lmp, loop);
    suffuse::coupling::LbmCommand::add_to(lmp);
    lmp->input->file();
    suffuse::coupling::LbmCommand::remove_from(lmp);
    delete lmp;
    return {};
  } catch (const suffuse::LostRun& end) {
    const std::string line = fmt::format("suffuse: error: {}", end.what());
    tell_the_end(line, lmp, rank);
    return {suffuse::kLostRunExitCode, line};
  } catch (const suffuse::UserError& problem) {
    // Thrown on all ranks alike; the half-built LIGGGHTS is left to the operating system.
    const std::string line = fmt::format("suffuse: error: {}", problem.what());
    tell_the_end(line, lmp, rank);
    return {1, line};
  } catch (const suffuse::coupling::Interrupted& end) {
    tell_the_end(end.what(), lmp, rank);
    suffuse::coupling::LbmCommand::remove_from(lmp);
    delete lmp;  // closes dumps and the log
    return {end.exit_code(), end.what()};
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "suffuse: error: rank {} is out of memory; use a larger spacing or more machines\n",
               rank);
    MPI_Abort(MPI_COMM_WORLD, 1);
    return {1, ""};
  } catch (const std::exception& failure) {
    if (const std::string refusal = suffuse::refusal_of_the_machine(failure); !refusal.empty()) {
      fmt::print(stderr, "suffuse: error: {}\n", refusal);
      MPI_Abort(MPI_COMM_WORLD, 1);
    }
    fmt::print(stderr, "suffuse: internal error on rank {}: {}\n", rank, failure.what());
    MPI_Abort(MPI_COMM_WORLD, 2);
    return {2, ""};
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is then an error of the write, which is said
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm ends = MPI_COMM_NULL;
  MPI_Comm_dup(MPI_COMM_WORLD, &ends);
  int code = 0;
  std::optional<std::string> answer;
  try {
    answer = own_answer(argc, argv);
    if (answer && rank == 0) std::fputs(answer->c_str(), stdout);
  } catch (const suffuse::UserError& problem) {
    answer = "";
    tell_the_end(fmt::format("suffuse: error: {}", problem.what()), nullptr, rank);
    code = 1;
  }
  if (!answer) {
    const End end = run_script(argc, argv, rank);
    code = end.code;
    // Rank 0 has said its own words.
    if (code != 0) suffuse::end_together(ends, code, rank == 0 ? "" : end.line);
  }
  if (suffuse::Hdf5File::left_open()) {
    std::fflush(nullptr);
    MPI_Barrier(MPI_COMM_WORLD);
    std::_Exit(code);
  }
  MPI_Finalize();
  return code;
}
