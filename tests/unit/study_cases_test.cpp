// What suffuse-study works out without running anything: its runs, Pareto's front, the variables of a script.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <functional>

#include "files/csv_cell.h"
#include "suffuse/common/error.h"
#include "suffuse/common/script_variables.h"
#include "suffuse/study/study_cases.h"
#include "suffuse/study/study_launcher.h"
#include "suffuse/study/study_record.h"
#include "suffuse/study/study_table.h"
#include "suffuse/study/trade_off.h"
#include "user_error_message.h"

using namespace suffuse;
using namespace suffuse::study;

namespace {

namespace files = std::filesystem;

/// A folder that is gone again at the end.
struct Scratch {
  files::path path = files::temp_directory_path() / ("suffuse-study-" + std::to_string(getpid()));

  Scratch() { files::create_directories(path); }
  ~Scratch() { files::remove_all(path); }
  std::string write(const std::string& name, const std::string& text) const {
    files::create_directories((path / name).parent_path());
    std::ofstream(path / name) << text;
    return (path / name).string();
  }
};

std::vector<std::string> names_of(const std::vector<StudyCase>& cases) {
  std::vector<std::string> names;
  for (const StudyCase& run : cases) names.push_back(run.name);
  return names;
}

StudyRow row(const std::string& value, double wall, double core, double result) {
  StudyRow made;
  made.run.swept = {{"n", value}};
  made.record.status = RunRecord::Status::finished;
  made.record.wall = wall;
  made.record.core = core;
  made.values = {result};
  return made;
}

}  // namespace

TEST_CASE("a grid has every combination, the last variable fastest") {
  Study study;
  study.sweeps = {{{"a", {"1", "2"}}, {"b", {"x", "y", "z"}}}};
  CHECK(names_of(study_cases(study)) ==
        std::vector<std::string>{"a=1,b=x", "a=1,b=y", "a=1,b=z", "a=2,b=x", "a=2,b=y", "a=2,b=z"});
}

TEST_CASE("one at a time has the base and each value around it, no run twice") {
  Study study;
  study.one_at_a_time = true;
  study.base = {{"a", "1"}, {"b", "x"}};
  study.sweeps = {{{"a", {"1", "2"}}, {"b", {"y"}}}};
  study.finest = {{"a", "9"}, {"b", "x"}};
  const std::vector<StudyCase> cases = study_cases(study);
  CHECK(names_of(cases) == std::vector<std::string>{"a=1,b=x", "a=2,b=x", "a=1,b=y", "a=9,b=x"});
  CHECK(cases.back().is_reference);
  CHECK_FALSE(cases.front().is_reference);
}

TEST_CASE("a launcher says {ranks}, and is a program of PATH or of a folder") {
  const StudyLauncher env("env  -u NONE-{ranks} {ranks}{ranks}", "/", "study", "launcher");
  CHECK(env.words(12) == std::vector<std::string>{"env", "-u", "NONE-12", "1212"});
  CHECK_FALSE(env.is_srun());
  CHECK(StudyLauncher().words(1).empty());
  CHECK(StudyLauncher().words(3).back() == "3");
  CHECK_THROWS_AS(StudyLauncher("env -n 4", "/", "study", "launcher"), UserError);
  CHECK_THROWS_AS(StudyLauncher("no_such_launcher {ranks}", "/", "study", "launcher"), UserError);
  const Scratch scratch;
  const std::string own = scratch.write("bin/srun", "");
  CHECK_THROWS_AS(StudyLauncher("bin/srun {ranks}", scratch.path, "study", "launcher"), UserError);
  files::permissions(own, files::perms::owner_all);
  const StudyLauncher srun("bin/srun {ranks}", scratch.path, "study", "launcher");
  CHECK(srun.words(2) == std::vector<std::string>{own, "2"});
  CHECK(srun.is_srun());
}

TEST_CASE("rows stand in the order of the study, whichever run ends first") {
  Study study;
  study.quantities = {{"q", {}, 1.0, false, "", 0}};
  StudyTable table(study, StudyTime::wall);
  for (const std::size_t place : {2U, 0U, 1U}) {
    StudyRow made = row(std::to_string(place), 1, 1, 1.0 + 0.1 * static_cast<double>(place));
    made.place = place;
    CHECK(table.add(std::move(made)).run.swept[0].second == std::to_string(place));
  }
  for (std::size_t place = 0; place < 3; ++place) CHECK(table.rows()[place].place == place);
}

TEST_CASE("several grids fill up what they leave out from the base, and need one for it") {
  Study study;
  study.base = {{"b", "x"}};
  study.sweeps = {{{"a", {"1", "2"}}}, {{"a", {"2"}}, {"b", {"x", "y"}}}};
  CHECK(names_of(study_cases(study)) == std::vector<std::string>{"a=1,b=x", "a=2,b=x", "a=2,b=y"});
  study.base.clear();
  CHECK(message_of([&] { study_cases(study); }).find("[base] b") != std::string::npos);
}

TEST_CASE("values that a folder's name cannot hold still have folders of their own") {
  Study study;
  study.sweeps = {{{"fraction", {"subcells 5", "subcells/5", std::string(300, 'n')}}}};
  const std::vector<std::string> names = names_of(study_cases(study));
  REQUIRE(names.size() == 3);
  CHECK(names[0] != names[1]);
  for (const std::string& name : names) {
    CHECK(name.find_first_of(" /") == std::string::npos);
    CHECK(name.size() < 200);
  }
}

TEST_CASE("Pareto's front holds the runs that no other one beats, by hand") {
  //                                  front        front      beaten by 0  front (equal)  front      no error
  const std::vector<TradeOff> runs{{1, 0.10}, {2, 0.05}, {1.5, 0.10},
                                   {2, 0.05}, {8, 0.01}, {0.1, std::nullopt}};
  CHECK(pareto_front(runs) == std::vector<bool>{true, true, false, true, true, false});
  CHECK(fastest_within(runs, 0.05) == 1);
  CHECK(fastest_within(runs, 0.1) == 0);
  CHECK_FALSE(fastest_within(runs, 0.001));
  CHECK(most_accurate(runs) == 4);
  CHECK_FALSE(most_accurate({{1, std::nullopt}}));
  CHECK(relative_error(0.9, 1.0) == Approx(-0.1));
}

TEST_CASE("a table takes the largest error, no smaller than the reference is uncertain, and signs it") {
  Study study;
  study.sweeps = {{{"n", {"1", "2", "3"}}}};
  study.quantities.push_back({"drag", {}, 2.0, false, "by hand", 0.02});
  StudyTable table(study, StudyTime::wall);
  table.add(row("1", 1, 9, 1.8));    // -10 %
  table.add(row("2", 4, 4, 2.002));  // 0.1 %: counts as 2 %
  table.add(row("3", 9, 1, 2.0));    // 0: counts as 2 %, and is slower
  CHECK(table.rows()[0].errors[0] == Approx(-0.1));
  CHECK(table.rows()[1].error == Approx(0.02));
  CHECK(table.rows()[0].on_front);
  CHECK(table.rows()[1].on_front);
  CHECK_FALSE(table.rows()[2].on_front);
  CHECK(table.verdict() == "fastest within 3 %: n=2, 4 s (error 2 %)");
  StudyTable by_core(study, StudyTime::core);
  for (const StudyRow& one : table.rows()) by_core.add(one);
  CHECK(by_core.verdict() == "fastest within 3 %: n=3, 1 s (error 2 %)");
  study.quantities.push_back({"lift", {}, 1.0, false, "by hand", 0});
  StudyTable two(study, StudyTime::wall);
  for (StudyRow one : table.rows()) {
    one.values.push_back(one.record.wall == 9 ? 1 : 2);
    two.add(one);
  }
  CHECK(two.verdict() ==
        "fastest within 3 %: n=3, 9 s (error 2 %)\n  drag alone: fastest within 3 %: n=2, 4 s (error 2 %)\n"
        "  lift alone: fastest within 3 %: n=3, 9 s (error 0 %)");
  study.quantities.pop_back();
  study.within = 0.001;
  CHECK(table.verdict().find("no run is within 0.1 %; the most accurate: n=2") == 0);
}

TEST_CASE("the finest run is the reference, and takes no part") {
  Study study;
  study.sweeps = {{{"n", {"1", "2"}}}};
  study.finest = {{"n", "2"}};
  study.quantities.push_back({"drag", {}, std::nullopt, true, "", 0});
  StudyTable table(study, StudyTime::wall);
  table.add(row("1", 1, 1, 1.1));
  CHECK_FALSE(table.rows()[0].error);  // not known yet
  StudyRow finest = row("2", 10, 10, 1.0);
  finest.run.is_reference = true;
  table.add(finest);
  CHECK(table.rows()[0].error == Approx(0.1));
  CHECK(table.rows()[0].on_front);
  CHECK_FALSE(table.rows()[1].on_front);
}

TEST_CASE("a script's variables: those that -var can set, through its includes") {
  const Scratch scratch;
  const std::string script =
      scratch.write("in.scene",
                    "variable case index A B\nvariable d equal 1e-3*${factor}\n"
                    "include ${script_folder}/case_${case}.inc\nvariable twice equal 2*v_d\n"
                    "include ${output}/made_by_the_run.inc\n");
  scratch.write("case_A.inc", "variable tau index 0.6\n");
  scratch.write("case_B.inc", "variable speed index 1\n");
  scratch.write("other.inc", "variable unseen index 1\n");
  const ScriptVariables variables(script, "study.toml");
  for (const char* name : {"case", "tau", "speed", "factor", "output"})
    CHECK_NOTHROW(variables.require(name, "x"));
  CHECK(message_of([&] {
          variables.require("unseen", "x");
        }).find("used by in.scene; it has case, tau, speed") != std::string::npos);
  CHECK(message_of([&] { variables.require("d", "x"); }).find("`variable d index VALUE`") !=
        std::string::npos);
  const std::string without = scratch.write("in.without", "print \"no variables\"\n");
  CHECK(message_of([&] { ScriptVariables(without, "x").require("speed", "x"); }).ends_with("it has none"));
  // A folder that is not known may hold a file that uses the name.
  CHECK_NOTHROW(variables.require_known("unseen", "x"));
  const ScriptVariables all(script, "x", {{"output", scratch.path.string()}});
  CHECK_NOTHROW(all.require_known("d", "x"));
  CHECK(message_of([&] {
          all.require_known("unseen", "x");
        }).find("variable = unseen, must be used by in.scene") != std::string::npos);
  CHECK(message_of([&] { all.require_known("a(", "x"); }) != "");
  scratch.write("made_by_the_run.inc", "print \"${unseen}\"\n");
  CHECK_NOTHROW(
      ScriptVariables(script, "x", {{"output", scratch.path.string()}}).require_known("unseen", "x"));
  const std::string in_branch =
      scratch.write("in.branch", "if \"1 > 0\" then \"include ${script_folder}/other.inc\"\n");
  CHECK_NOTHROW(ScriptVariables(in_branch, "x").require_known("unseen", "x"));
  CHECK(message_of([&] { ScriptVariables(in_branch, "x").require_known("case", "x"); }) != "");
  // speed stands only in case_B.inc, and the script's own case is A.
  const std::string alone = scratch.write(
      "in.alone", "# a scene\nvariable case index A  # or B\n\ninclude ${script_folder}/case_${case}.inc\n");
  const auto of_case = [&](const std::string& value, const std::string& name) {
    const std::map<std::string, std::string> given{{"case", value}};
    return message_of([&] { ScriptVariables(alone, "x", given).require_known(name, "x"); });
  };
  const std::string not_read = message_of([&] { ScriptVariables(alone, "x").require_known("speed", "x"); });
  CHECK(not_read ==
        "x: variable = speed, must be used by in.alone as it is called here; it is with -var case B");
  CHECK_FALSE(ScriptVariables(alone, "x").reads("speed"));
  CHECK(of_case("A", "speed") == not_read);
  CHECK(message_of([&] {
          ScriptVariables(alone, "x", {{"a(", "1"}}).require_known("a(", "x");
        }).starts_with("x: variable = a(, must be used by in.alone or a file"));
  CHECK(of_case("B", "speed").empty());
  CHECK(of_case("A", "tau").empty());
  CHECK(of_case("B", "tau").ends_with("it is with -var case A"));
  // Where the script may choose anew, each choice may be the one that is read.
  const std::string choice = "include ${script_folder}/case_${case}.inc\n";
  for (const std::string& open :
       {"variable case index A B\n" + choice, "variable case index A\n" + choice + "next case\n",
        "variable kind index B\nvariable case index ${kind}\n" + choice,
        "variable case index &\nB\n" + choice, "variable case index \"B\"\n" + choice,
        "variable case string B\nvariable case index A\n" + choice,
        "variable case index A\nvariable case delete\nvariable case index B\n" + choice,
        "if \"1 > 0\" then \"variable case index B\"\nvariable case index A\n" + choice,
        "include ${output}/made_by_the_run.inc\nvariable case index A\n" + choice,
        "jump SELF two\nvariable case index A\nlabel two\nvariable case index B\n" + choice}) {
    CAPTURE(open);
    CHECK_NOTHROW(ScriptVariables(scratch.write("in.open", open), "x").require_known("speed", "x"));
  }
  // `include ${name}` reads the file of that name, not all that lies about.
  const auto by_name = [&](const std::string& definition, const std::string& name) {
    const std::string in = scratch.write("in.by_name", definition + "include ${file}\n");
    return message_of([&] { ScriptVariables(in, "x").require_known(name, "x"); }).empty();
  };
  CHECK(by_name("variable file index ${script_folder}/case_A.inc\n", "tau"));
  CHECK_FALSE(by_name("variable file index ${script_folder}/case_A.inc\n", "speed"));
  CHECK(by_name("variable file index ${script_folder}/case_A.inc ${script_folder}/case_B.inc\n", "speed"));
  CHECK(
      by_name("if \"1 > 0\" then \"variable file index ${script_folder}/case_B.inc\"\n"
              "variable file index ${script_folder}/case_A.inc\n",
              "speed"));
  CHECK(by_name("variable file string somewhere\n", "speed"));  // not known
  CHECK_NOTHROW(all.require_choice("case", "B", "x"));
  CHECK_NOTHROW(all.require_choice("tau", "anything", "x"));
  CHECK(message_of([&] { all.require_choice("case", "b", "x"); }) ==
        "x: case = b, must be one of A, B; did you mean B? each is a file beside in.scene");
  const std::string making = scratch.write("in.making",
                                           "print \"x\" file ${script_folder}/case_${case}.inc\n"
                                           "include ${script_folder}/case_${case}.inc\n");
  CHECK_NOTHROW(ScriptVariables(making, "x").require_choice("case", "C", "x"));
  const std::string choosing =
      scratch.write("in.choosing", "# -var case takes the place of tau, speed\nvariable case index none\n");
  const auto of_both = [&](const std::string& value) {
    return message_of([&] {
      ScriptVariables(choosing, "x").require_no_two_for_one({{"case", value}, {"speed", "1"}}, "x");
    });
  };
  CHECK(of_both("B") ==
        "x: speed = 1, must not be given beside -var case B; case takes the place of tau, speed; drop one of "
        "the two");
  CHECK(of_both("none").empty());
  const std::string before = variables.fingerprint();
  scratch.write("case_B.inc", "variable speed index 2\n");
  CHECK(ScriptVariables(script, "x").fingerprint() != before);
  CHECK(message_of([&] { ScriptVariables((scratch.path / "in.none").string(), "x"); }) != "");
}

TEST_CASE("numbers are found in tables of results and in series, with commas in quotes") {
  const Scratch scratch;
  const std::string results = scratch.write(
      "r.csv", "# made\ncase,quantity,value,source\nA,k,1.5,\"a, b\"\nB,k,2.5,\"say \"\"x\"\"\"\n");
  CHECK(analysis::read_csv_cell({results, "value", {{"case", "B"}, {"quantity", "k"}}, {}}, "x") == 2.5);
  CHECK(analysis::csv_cells("A,\"a, b\",\"say \"\"x\"\"\"") ==
        std::vector<std::string>{"A", "a, b", "say \"x\""});
  CHECK(analysis::csv_cells(analysis::csv_text("a, \"b\"")) == std::vector<std::string>{"a, \"b\""});
  const std::string series = scratch.write("s.csv", "t,v\n0,3\n1,-1\n2,4\n");
  using Take = analysis::CsvCell::Take;
  const std::pair<Take, double> taken[] = {
      {Take::last, 4}, {Take::first, 3}, {Take::largest, 4}, {Take::smallest, -1}, {Take::mean, 2}};
  for (const auto& [take, value] : taken)
    CHECK(analysis::read_csv_cell({series, "v", {}, take}, "x") == value);
  CHECK(message_of([&] {
          analysis::read_csv_cell({series, "w", {}, {}}, "x");
        }).find("no column w, must have it; it has t, v") != std::string::npos);
  CHECK(message_of([&] {
          analysis::read_csv_cell({results, "value", {{"quantity", "m"}}, {}}, "x");
        }).find("its quantity are k") != std::string::npos);
  CHECK(message_of([&] {
          analysis::read_csv_cell({results, "case", {{"quantity", "k"}}, {}}, "x");
        }).find("must be a number") != std::string::npos);
}

TEST_CASE("a run that is not steady yet takes no part and is no reference") {
  Study study;
  study.quantities.resize(1);
  study.quantities[0].name = "k";
  study.quantities[0].by_finest = true;
  study.sweeps = {{{"n", {"1", "2"}}}};
  study.finest = {{"n", "9"}};
  StudyRow finest = row("9", 50, 50, 2.0), fast = row("1", 1, 1, 2.02), slow = row("2", 5, 5, 2.2);
  finest.run.is_reference = true;
  fast.record.status = RunRecord::Status::unsteady;
  fast.record.notes = {"relaxation time 1.2 is large"};
  StudyTable table(study, StudyTime::wall);
  for (const StudyRow& one : {fast, slow, finest}) table.add(one);
  CHECK_FALSE(table.rows()[0].on_front);
  CHECK(table.rows()[1].on_front);
  CHECK(*table.rows()[0].error == Approx(0.01));
  CHECK(table.verdict().find("n=2") != std::string::npos);
  CHECK(table.text().find("u: not steady yet") != std::string::npos);
  finest.record.status = RunRecord::Status::unsteady;
  StudyTable without(study, StudyTime::wall);
  for (const StudyRow& one : {slow, finest}) without.add(one);
  CHECK_FALSE(without.rows()[0].error);
}

TEST_CASE("the table says which runs noted what, also those that failed, alike notes under one number") {
  Study study;
  study.quantities.resize(1);
  study.quantities[0].name = "k";
  study.quantities[0].reference = 2;
  study.sweeps = {{{"n", {"1", "2", "3", "4"}}}};
  StudyRow one = row("1", 1, 1, 2.02), two = row("2", 5, 5, 2.2), three = row("3", 7, 7, 2), four = one;
  one.record.notes = {"density 1.5 % off at 3e-05 s", "contacts are soft"};
  two.record.notes = {"density 2 % off at 0.1 s"};
  four.run.swept[0].second = "4";
  four.record.status = RunRecord::Status::failed;
  four.record.reason = "Mach number";
  four.record.notes = {"other", "contacts are soft"};
  StudyTable table(study, StudyTime::wall);
  one.place = 1, two.place = 2, three.place = 3, four.place = 4;
  for (const StudyRow& each : {three, two, one, four}) table.add(each);
  const std::string text = table.text();
  INFO(text);
  const auto says = [&](const std::string& part) { return text.find(part) != std::string::npos; };
  CHECK(says("error  notes\n"));
  CHECK(says("+1 %   1, 2\n"));
  CHECK(says("+10 %      1\n"));
  CHECK(says("+0 %\n"));
  CHECK(says("failed: Mach number\n  n=4 (1 s), notes 2, 3\n"));
  CHECK(says(
      "  1 (2 runs): density 1.5 % off at 3e-05 s\n  2 (2 runs): contacts are soft\n  3 (1 run): other\n"));
  StudyTable silent(study, StudyTime::wall);
  silent.add(three);
  CHECK(silent.text().find("notes") == std::string::npos);
}

TEST_CASE("a run's own notes become its record's, and say whether it was steady") {
  const Scratch scratch;
  ProcessEnd end;
  const std::string log =
      scratch.write("log.txt",
                    "lbm run: note: grains are fast\nnote: viscosity 1e-07\nnote: viscosity 2\nfootnote: no\n"
                    "WARNING: kappa < 1000\nlbm run: warning: Mach number at 2 s = 0.2\n"
                    "lbm run: comoving on from 1.5e-05 s: grains at 2 viscosities a cell\nlbm run: 2 s\n"
                    "lbm run: not yet steady after 0.2 s\n");
  const RunRecord record = record_of(end, log, 0, "s");
  CHECK(record.status == RunRecord::Status::unsteady);
  CHECK(has_results(record));
  CHECK(record.reason == "not yet steady after 0.2 s");
  CHECK(record.notes == std::vector<std::string>{
                            "grains are fast", "viscosity 1e-07", "kappa < 1000", "Mach number at 2 s = 0.2",
                            "comoving on from 1.5e-05 s: grains at 2 viscosities a cell"});
  write_record(scratch.path.string(), record);
  CHECK(read_record(scratch.path.string(), "s")->notes == record.notes);
  // A record from before notes were kept: its log tells.
  scratch.write("run.json",
                "{\"status\":\"finished\",\"reason\":\"\",\"wall_s\":1,\"core_s\":1,\"other_cores\":0,"
                "\"settings\":\"s\"}");
  CHECK(read_record(scratch.path.string(), "s")->status == RunRecord::Status::unsteady);
  CHECK(record_of(end, scratch.write("log.txt", "lbm run: steady after 0.1 s\n"), 0, "s").status ==
        RunRecord::Status::finished);
}

TEST_CASE("a record is taken up again with the same settings only, and a failure has the log's last error") {
  const Scratch scratch;
  RunRecord record;
  record.status = RunRecord::Status::too_long;
  record.reason = "stopped, \"after\" 3 s";
  record.settings = "abc";
  record.wall = 3.25;
  write_record(scratch.path.string(), record);
  const std::optional<RunRecord> read = read_record(scratch.path.string(), "abc");
  REQUIRE(read);
  CHECK(read->status == RunRecord::Status::too_long);
  CHECK(read->reason == record.reason);
  CHECK(read->wall == 3.25);
  CHECK_FALSE(read_record(scratch.path.string(), "abd"));
  scratch.write("run.json", "{\"settings\": \"abc\"");
  CHECK_FALSE(read_record(scratch.path.string(), "abc"));

  const std::string log = scratch.write(
      "log.txt", "suffuse: error: first\n 1 2 3\nsuffuse: error: lbm run: Mach 0.4\nmpirun: lost\n");
  ProcessEnd end;
  end.code = 1;
  CHECK(record_of(end, log, 0, "s").reason == "lbm run: Mach 0.4");
  CHECK(record_of(end, scratch.write("warned.txt", "lbm run: warning: Mach number\n"), 0, "s").notes ==
        std::vector<std::string>{"Mach number"});
  // A helper's mistake, in a script's `shell`, is the cause of what LIGGGHTS then misses.
  CHECK(last_error_in(scratch.write("shell.txt",
                                    "suffuse-analyse: error: sample: grading = A31, must be a name\n"
                                    "ERROR on proc 0: Cannot open input script ./sample.inc\n")) ==
        "sample: grading = A31, must be a name");
  CHECK(last_error_in(scratch.write("internal.txt", "suffuse: internal error, please report it: x\n")) ==
        "internal error, please report it: x");
  CHECK(last_error_in(scratch.write("proc.txt", "0: ERROR on proc 1: Bad (x.cpp:1)\n")) ==
        "ERROR on proc 1: Bad (x.cpp:1)");
  CHECK(last_error_in(scratch.write("other.txt", "ERROR: Lost atoms (thermo.cpp:1)\n")) ==
        "Lost atoms (thermo.cpp:1)");
  end.how = ProcessEnd::How::by_signal;
  end.code = 11;
  CHECK(record_of(end, scratch.write("empty.txt", ""), 0, "s").reason.find("signal 11") != std::string::npos);
}
