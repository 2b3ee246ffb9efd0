#include "grading/grading_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "files/csv_file.h"
#include "files/number_parser.h"
#include "files/project_files.h"
#include "suffuse/common/error.h"

namespace suffuse::analysis {
namespace {

namespace files = std::filesystem;

std::vector<NamedGrading> all_named(const std::string& who) {
  for (const files::path& folder :
       project_folders("SUFFUSE_GRADINGS", "input_scripts/gradings", "input_scripts/gradings")) {
    if (!files::is_regular_file(folder / "samples.csv")) continue;
    const CsvFile table = read_csv((folder / "samples.csv").string(), who);
    const auto column = [&](const char* name) {
      const auto at = std::find(table.names.begin(), table.names.end(), name);
      if (at == table.names.end())
        throw_user_error(
            {who, (folder / "samples.csv").string(), fmt::format("no column {}", name), "have it", ""});
      return static_cast<std::size_t>(at - table.names.begin());
    };
    const std::size_t name = column("name"), file = column("file"), of_4_1 = column("table_4_1"),
                      of_5_1 = column("table_5_1"), grains = column("thesis_grains");
    std::vector<NamedGrading> all;
    for (const CsvFile::Row& row : table.rows) {
      NamedGrading one{row.cells[name], (folder / row.cells[file]).string(), row.cells[of_4_1],
                       row.cells[of_5_1], 0};
      if (!parse_number(std::string_view(row.cells[grains]), one.thesis_grains))
        throw_user_error({who, fmt::format("{}, line {}", (folder / "samples.csv").string(), row.line),
                          row.cells[grains], "be a number of grains", ""});
      all.push_back(std::move(one));
    }
    return all;
  }
  return {};
}

}  // namespace

std::optional<NamedGrading> named_grading(const std::string& name, const std::string& who) {
  for (NamedGrading& one : all_named(who))
    if (!name.empty() && (name == one.name || name == one.table_4_1 || name == one.table_5_1))
      return std::move(one);
  return std::nullopt;
}

std::string grading_path(const std::string& name, const std::string& who) {
  if (files::exists(name)) return name;
  if (const auto named = named_grading(name, who)) return named->path;
  std::string names;
  for (const NamedGrading& one : all_named(who)) names += (names.empty() ? "" : ", ") + one.name;
  throw_user_error({who, "grading", name, "be a file or a name",
                    names.empty() ? std::string("check the path") : "the names are " + names});
}

}  // namespace suffuse::analysis
