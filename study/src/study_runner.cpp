#include "suffuse/study/study_runner.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numeric>

#include "files/csv_cell.h"
#include "files/figure_script.h"
#include "files/project_files.h"
#include "files/shell_word.h"
#include "suffuse/common/count_text.h"
#include "suffuse/common/error.h"
#include "suffuse/common/paths.h"
#include "suffuse/common/progress.h"
#include "suffuse/common/safe_file.h"
#include "suffuse/common/script_variables.h"
#include "suffuse/common/signal_watch.h"
#include "suffuse/study/placeholder.h"
#include "suffuse/study/timed_process.h"

namespace suffuse::study {
namespace {

namespace files = std::filesystem;

constexpr const char* kWho = "suffuse-study";

std::string find_program(const std::string& given) {
  if (!given.empty()) {
    if (access(given.c_str(), X_OK) != 0 || is_folder(given))
      throw_user_error({kWho, "--program", given, "be a program that can be run", ""});
    return files::absolute(given).string();
  }
  const files::path beside = analysis::program_folder() / "suffuse";  // without /proc, PATH must do
  return is_there(beside) ? beside.string() : "suffuse";
}

int runs_at_once(const Study& study, const StudyRunSettings& settings) {
  if (settings.cores == 0) return 1;
  if (settings.cores < study.ranks)
    throw_user_error({kWho, "--cores", fmt::format("{}", settings.cores),
                      fmt::format("hold a run, of {} ranks", study.ranks), ""});
  return settings.cores / study.ranks;
}

class Runner {
 public:
  Runner(const Study& study, const StudyRunSettings& settings)
      : study_(study),
        settings_(settings),
        cases_(study_cases(study)),
        at_once_(runs_at_once(study, settings)),
        table_(study, settings.time, at_once_ > 1) {
    out_ = files::absolute(settings.out).lexically_normal();
    program_ = find_program(settings.program);
    first_words_ = study.launcher.words(study.ranks);
    first_words_.push_back(program_);
    if (program_.find('/') != std::string::npos) program_ = one_name_of(program_);
    check_variables();
  }

  int run() {
    if (settings_.dry_run) return list_commands();
    make_folders();
    const SignalWatch watch({{SIGINT, SignalWatch::Second::noted}, {SIGTERM, SignalWatch::Second::noted}});
    prepare();
    run_cases();
    const int signal = SignalWatch::received();
    report();
    if (signal == 0 && table_.none_finished())
      throw_user_error(
          {study_.file, "runs", "all failed", "finish, one at least", "the reasons stand above"});
    if (signal == 0) return 0;
    fmt::print("interrupted: {} of {} are done; --resume goes on\n", table_.size(),
               count_text(static_cast<std::int64_t>(cases_.size()), "run"));
    return 128 + signal;
  }

 private:
  void check_variables() {
    const ScriptVariables variables(study_.script, study_.file, {study_.fixed.begin(), study_.fixed.end()});
    for (const std::string& name : swept_names(study_)) variables.require(name, study_.file);
    for (const auto& [name, value] : study_.fixed) variables.require(name, study_.file);
    script_ = variables.fingerprint();
    if (!study_.preparation) return;
    const VariableValues& given = study_.preparation->variables;
    const ScriptVariables before(study_.preparation->script, study_.file, {given.begin(), given.end()});
    for (const auto& [name, value] : given) before.require(name, study_.file + ", [prepare]");
    prepared_ = before.fingerprint() + variables_text(given);
  }

  std::string folder_of(const StudyCase& run) const { return (out_ / "runs" / run.name).string(); }

  std::vector<std::string> command(const std::string& script, const VariableValues& variables) const {
    std::vector<std::string> words = first_words_;
    words.insert(words.end(), {"-in", script});
    // A variable of another choice would change nothing, and be refused.
    const ScriptVariables read(script, study_.file, {variables.begin(), variables.end()});
    for (const auto& [name, value] : variables)
      if (read.reads(name))
        words.insert(words.end(),
                     {"-var", name, with_value(value, "{prepare}", (out_ / "prepare").string())});
    return words;
  }

  VariableValues variables_of(const StudyCase& run) const {
    VariableValues variables = study_.fixed;
    variables.insert(variables.end(), run.swept.begin(), run.swept.end());
    return variables;
  }

  std::string settings_of(const VariableValues& variables, const std::string& script) const {
    return fingerprint_of(
        fmt::format("{}\n{}\n{}\n{}", study_.ranks, variables_text(variables), script, prepared_));
  }

  std::optional<RunRecord> done_before(const std::string& folder, const std::string& settings) const {
    if (!settings_.resume) return std::nullopt;
    std::optional<RunRecord> record = read_record(folder, settings);
    // What failed before a preparation that was made anew may have failed for want of it.
    const bool again = settings_.retry_failed || prepared_anew_;
    if (record && again && !has_results(*record)) record.reset();
    return record;
  }

  int list_commands() {
    prepared_anew_ = study_.preparation && !preparation_done();
    if (study_.preparation)
      print_command((out_ / "prepare").string(),
                    command(study_.preparation->script, study_.preparation->variables));
    std::size_t done = 0;
    for (const StudyCase& run : cases_) {
      const std::optional<RunRecord> record =
          done_before(folder_of(run), settings_of(variables_of(run), script_));
      if (record) {
        ++done;
        fmt::print("# {} in {}:\n# ", to_string(record->status), duration_text(record->wall));
      }
      print_command(folder_of(run), command(study_.script, variables_of(run)));
    }
    fmt::print("# {}, {} of them done\n", count_text(static_cast<std::int64_t>(cases_.size()), "run"), done);
    return 0;
  }

  static void print_command(const std::string& folder, const std::vector<std::string>& words) {
    fmt::print("mkdir -p {0} && cd {0} &&", analysis::shell_word(folder));
    for (const std::string& word : words) fmt::print(" {}", analysis::shell_word(word));
    fmt::print("\n");
  }

  void make_folders() {
    if (!settings_.resume && is_there(out_ / "runs") && !files::is_empty(out_ / "runs"))
      throw_user_error(
          {kWho, "--out", settings_.out, "have no runs yet", "give --resume to go on, or another folder"});
    std::error_code problem;
    files::create_directories(out_ / "runs", problem);
    if (problem)
      throw_user_error({kWho, "--out", settings_.out, "be a folder that can be made", problem.message()});
  }

  /// In an empty folder.
  ProcessCommand process_in(const std::string& folder, const std::vector<std::string>& words) const {
    std::error_code problem;
    files::remove_all(folder, problem);
    if (!problem) files::create_directories(folder, problem);
    if (problem) throw_user_error({kWho, "folder", folder, "be writable", problem.message()});
    return {words, folder, kRunLog, study_.time_limit};
  }

  /// Keeps the record of a run that has ended; nothing where it was interrupted.
  std::optional<RunRecord> keep_record(ProcessEnd end, const std::string& folder,
                                       const std::string& settings) const {
    if (end.how == ProcessEnd::How::interrupted) return std::nullopt;
    if (study_.launcher.is_srun()) end.core = end.wall * study_.ranks;
    RunRecord record = record_of(end, (files::path(folder) / kRunLog).string(), study_.time_limit, settings);
    record.program = program_;
    write_record(folder, record);
    return record;
  }

  std::string preparation_folder() const { return (out_ / "prepare").string(); }
  std::string preparation_settings() const { return settings_of(study_.preparation->variables, prepared_); }

  /// One that failed is none: no run can do without it.
  bool preparation_done() const {
    const std::optional<RunRecord> record = done_before(preparation_folder(), preparation_settings());
    return record && has_results(*record);
  }

  void prepare() {
    if (!study_.preparation || preparation_done()) return;
    prepared_anew_ = true;
    const std::string folder = preparation_folder();
    fmt::print("preparing: ");
    std::fflush(stdout);
    const std::vector<std::string> words = command(study_.preparation->script, study_.preparation->variables);
    const auto record = keep_record(run_timed(process_in(folder, words)), folder, preparation_settings());
    if (!record) return;  // interrupted
    fmt::print("{}\n", duration_text(record->wall));
    if (!has_results(*record))
      throw_user_error(
          {study_.file, "[prepare]", record->reason, "finish", "its log is " + folder + "/" + kRunLog});
  }

  /// In the order of the study; several at once begin with the finest, which takes longest.
  void run_cases() {
    std::vector<std::size_t> waiting(cases_.size());
    std::iota(waiting.begin(), waiting.end(), std::size_t{0});
    if (at_once_ > 1) {
      std::stable_partition(waiting.begin(), waiting.end(),
                            [&](std::size_t number) { return cases_[number].is_reference; });
      fmt::print("{}, up to {} at once\n", count_text(static_cast<std::int64_t>(cases_.size()), "run"),
                 at_once_);
      setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 0);  // each mpirun would take the same first cores
    }
    std::reverse(waiting.begin(), waiting.end());
    TimedProcesses processes;
    while (true) {
      while (static_cast<int>(processes.running()) < at_once_ && !waiting.empty() &&
             SignalWatch::received() == 0) {
        begin_case(waiting.back(), processes);
        waiting.pop_back();
      }
      if (processes.running() == 0) return;
      const auto [number, end] = processes.wait_for_one();
      end_case(number, end);
    }
  }

  /// Takes up a run that is there, or starts it.
  void begin_case(std::size_t number, TimedProcesses& processes) {
    const StudyCase& run = cases_[number];
    const std::string folder = folder_of(run);
    if (const auto record = done_before(folder, settings_of(variables_of(run), script_))) {
      if (!record->program.empty() && record->program != program_) ++runs_of_others_[record->program];
      take_up(number, *record);
      return;
    }
    if (at_once_ == 1) tell_name(number);
    processes.start(number, process_in(folder, command(study_.script, variables_of(run))));
  }

  void end_case(std::size_t number, const ProcessEnd& end) {
    const std::string folder = folder_of(cases_[number]);
    const auto record = keep_record(end, folder, settings_of(variables_of(cases_[number]), script_));
    if (at_once_ > 1) tell_name(number);
    if (!record) {
      fmt::print("interrupted\n");
      return;
    }
    fmt::print("{}", duration_text(record->wall));
    try {
      tell_result(take_up(number, *record));
    } catch (const UserError&) {
      fmt::print("\n");
      throw;
    }
  }

  const StudyRow& take_up(std::size_t number, const RunRecord& record) {
    StudyRow row{number, cases_[number], record, {}, {}, {}, false};
    if (has_results(record)) read_values(folder_of(row.run), row);
    const StudyRow& added = table_.add(std::move(row));
    table_.write_csv((out_ / "study.csv").string());
    return added;
  }

  void require_file(const StudyQuantity& quantity, const std::string& folder) const {
    if (is_file(files::path(folder) / quantity.cell.file)) return;
    std::vector<std::string> names;
    for (const files::directory_entry& entry : files::directory_iterator(folder))
      if (entry.path().extension() == ".csv") names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    throw_user_error({study_.file + ": " + quantity.name, "file", quantity.cell.file, "be left by a run",
                      names.empty() ? "no CSV file in " + folder
                                    : fmt::format("its folder has {}", fmt::join(names, ", "))});
  }

  /// A quantity that a run lacks is the study's mistake, unless others have it: then this run went wrong.
  void read_values(const std::string& folder, StudyRow& row) {
    for (const StudyQuantity& quantity : study_.quantities) {
      analysis::CsvCell cell = quantity.cell;
      cell.file = (files::path(folder) / cell.file).string();
      std::string problem;
      try {
        require_file(quantity, folder);
        const double value = analysis::read_csv_cell(cell, study_.file + ": " + quantity.name);
        if (std::isfinite(value)) {
          row.values.emplace_back(value);
          continue;
        }
        problem = fmt::format("{} is {}", quantity.name, value);
      } catch (const UserError& missing) {
        if (!has_values_) throw;
        problem = missing.what();
      }
      row.record.status = RunRecord::Status::failed;
      row.record.reason = problem;
      row.values.clear();
      return;
    }
    has_values_ = true;
  }

  void tell_name(std::size_t number) const {
    fmt::print("[{}/{}] {}: ", number + 1, cases_.size(), variables_text(cases_[number].swept));
    std::fflush(stdout);
  }

  static void tell_result(const StudyRow& row) {
    if (row.record.status != RunRecord::Status::finished)
      fmt::print(", {}: {}", to_string(row.record.status), row.record.reason);
    else if (row.error && !row.run.is_reference)
      fmt::print(", error {:.2g} %", 100 * *row.error);
    fmt::print("\n");
    std::fflush(stdout);
  }

  void report() {
    if (table_.size() == 0) return;
    fmt::print("\n{}\n{}\n{}\n\n{}\n", study_.title, table_.text(), table_.verdict(),
               (out_ / "study.csv").string());
    for (const auto& [program, runs] : runs_of_others_)
      fmt::print(
          "warning: {} taken as {} left {}, not done with {}: --out FOLDER does all with one program\n",
          count_text(runs, "run"), program, runs == 1 ? "it" : "them", program_);
    std::fflush(stdout);
    bool has_error = false;
    for (const StudyRow& row : table_.rows()) has_error = has_error || (row.error && !row.run.is_reference);
    if (!settings_.figure || !has_error) return;
    std::string names;
    for (const std::string& name : swept_names(study_)) names += (names.empty() ? "" : ",") + name;
    const std::string figure = (out_ / "study.png").string();
    std::vector<std::string> words{(out_ / "study.csv").string(),
                                   "--variables",
                                   names,
                                   "--time",
                                   settings_.time == StudyTime::wall ? "wall" : "core",
                                   "--within",
                                   fmt::format("{}", study_.within),
                                   "--title",
                                   study_.title,
                                   "--output",
                                   figure};
    if (study_.extrapolate) words.insert(words.end(), {"--extrapolated", study_.extrapolate->variable});
    analysis::make_figure("accuracy_and_time.py", words, kWho);
    fmt::print("{}\n", figure);
  }

  const Study& study_;
  const StudyRunSettings& settings_;
  std::vector<StudyCase> cases_;
  int at_once_;
  StudyTable table_;
  files::path out_;
  std::vector<std::string> first_words_;
  std::string program_;                                 ///< by the one name of its file
  std::map<std::string, std::int64_t> runs_of_others_;  ///< taken up, by another program than this one's
  std::string script_, prepared_;                       ///< fingerprints
  bool has_values_ = false, prepared_anew_ = false;
};

}  // namespace

int run_study(const Study& study, const StudyRunSettings& settings) {
  return Runner(study, settings).run();
}

}  // namespace suffuse::study
