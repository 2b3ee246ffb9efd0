#include "command_report.h"

#include <fmt/format.h>

#include <fstream>
#include <string>
#include <vector>

#include "comm.h"
#include "kernels/expected_values.h"
#include "style_support.h"
#include "suffuse/common/error.h"

using namespace LAMMPS_NS;
using suffuse::throw_user_error;

namespace {

void write_results(const std::string& file, const std::string& case_name,
                   const std::vector<suffuse::MeasuredValue>& values) {
  std::ofstream out(file);
  out << "case,quantity,value\n";
  for (const auto& value : values)
    out << fmt::format("{},{},{:.10g}\n", case_name, value.quantity, value.value);
  out.close();
  if (!out) throw_user_error({"report", "write", file, "be writable", "check the folder"});
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
    const std::string name = reader.word("name of a quantity");
    measured.push_back({name, reader.number(name)});
  }

  // Every rank reads, so that every rank throws.
  std::ifstream stream(file);
  if (!stream)
    throw_user_error({"report", "file", file, "be readable", "give its path from the folder of the run"});
  const auto expected = suffuse::read_expected_values(stream, file);
  if (comm->me != 0) return;
  const std::string table = fmt::format("\n{} against {}\n{}\n", case_name, file,
                                        suffuse::comparison_table(measured, expected, case_name));
  suffuse::tell(lmp, table);
  if (!results.empty()) write_results(results, case_name, measured);
}
