#pragma once

#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace suffuse {

/// One line of an expected.csv: what a source gives for a quantity of a case.
struct ExpectedValue {
  std::string case_name;
  std::string quantity;
  double value = 0;
  double tolerance = 0;  ///< absolute; 0 if the source states none
  std::string unit;
  std::string source;
};

/// Reads an expected.csv: comment lines start with '#', then the header
/// `case,quantity,value,tolerance,unit,source`, then one line a value (empty tolerance: none stated).
/// Throws UserError, naming the line, if the header or a number is wrong. `name` is for messages.
std::vector<ExpectedValue> read_expected_values(std::istream& file, const std::string& name);

struct MeasuredValue {
  std::string quantity;
  std::optional<double> value;  ///< none where the run has no such value
};

/// A table with one row for each measured quantity: measured, expected, the difference that is allowed and
/// whether it is kept, difference in %, source. What the file gives for the case `any` holds for every case
/// for which it does not give the quantity. Quantities that the file does not give for the case appear
/// without an expectation, and those without a tolerance are not judged. One that has no value keeps no
/// tolerance.
std::string comparison_table(const std::vector<MeasuredValue>& measured,
                             const std::vector<ExpectedValue>& expected, std::string_view case_name);

}  // namespace suffuse
