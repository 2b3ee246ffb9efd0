#pragma once

#include <optional>
#include <vector>

namespace suffuse::analysis {

/// A number with the name of its column, unit included; none where it is not defined (a share of nothing, β
/// of an isotropic state, fines without a split).
struct Entry {
  const char* name = "";
  std::optional<double> value;
  bool scripts_take_none = false;  ///< as a variable of a script: `none` instead of a refusal
};
using Record = std::vector<Entry>;

/// The number of a column, none if it is not defined or not there.
std::optional<double> value_of(const Record& record, const char* name);

}  // namespace suffuse::analysis
