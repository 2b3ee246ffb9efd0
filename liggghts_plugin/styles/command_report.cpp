#include "command_report.h"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "laws/expected_values.h"
#include "style_support.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/error.h"
#include "suffuse/common/safe_file.h"

using namespace LAMMPS_NS;
using suffuse::throw_user_error;

namespace {

std::string results_text(const std::string& case_name, const std::vector<suffuse::MeasuredValue>& values) {
  std::string text = "case,quantity,value\n";
  for (const auto& value : values)
    text += fmt::format("{},{},{}\n", case_name, value.quantity,
                        value.value ? fmt::format("{:.10g}", *value.value) : "");
  return text;
}

}  // namespace

void CommandReport::command(int narg, char** arg) {
  suffuse::ArgumentReader reader("report", narg, arg, 0);
  const std::string file = reader.word("file of expected values");
  const std::string case_name = reader.word("case");
  const std::string results = reader.accept("write") ? reader.word("file to write") : "";
  if (!reader.accept("values"))
    throw_user_error(
        {"report", "values", "missing", "be given", "report EXPECTED.csv CASE values NAME VALUE ..."});
  std::vector<suffuse::MeasuredValue> measured;
  while (!reader.done()) {
    const std::string name = reader.keyword();
    if (reader.accept("none"))
      measured.push_back({name, std::nullopt});
    else
      measured.push_back({name, reader.number(name)});
  }

  // Every rank reads, so that every rank throws.
  std::ifstream stream(file);
  if (!stream)
    throw_user_error({"report", "file", file, "be readable", "give its path from the folder of the run"});
  const auto expected = suffuse::read_expected_values(stream, file);
  const std::string table = fmt::format("\n{} against {}\n{}\n", case_name, file,
                                        suffuse::comparison_table(measured, expected, case_name));
  suffuse::tell(lmp, table);
  if (results.empty()) return;
  std::string earlier;
  suffuse::on_first_rank("report write", world, [&] {
    suffuse::require_writable(results, "report write");
    earlier = suffuse::keep_earlier(results, "report write").value_or("");
  });
  if (!earlier.empty())
    suffuse::tell(lmp, fmt::format("report write: note: {} of an earlier run is now {}\n", results, earlier));
  suffuse::write_text(results, "report write", results_text(case_name, measured), world);
}
