#include "script_value.h"

#include <fmt/format.h>

#include <cmath>

#include "input.h"
#include "lammps.h"
#include "suffuse/common/error.h"
#include "variable.h"

namespace suffuse::coupling {

namespace {

int variable_index(LAMMPS_NS::LAMMPS* lmp, const std::string& name) {
  std::string copy = name;
  const int index = lmp->input->variable->find(copy.data());
  if (index < 0 || lmp->input->variable->equalstyle(index) == 0)
    throw_user_error({"lbm", "v_" + name, index < 0 ? "no such variable" : "not equal-style",
                      "name an equal-style variable",
                      fmt::format("write `variable {} equal ...` before", name)});
  return index;
}

}  // namespace

ScriptValue ScriptValue::read(ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp, const std::string& what) {
  if (reader.done() || reader.next_is_number()) return ScriptValue(reader.number(what));
  const std::string word = reader.word(what);
  if (!word.starts_with("v_") || word.size() == 2)
    throw_user_error({reader.who(), what, word, "be a number or v_NAME", "write it in SI units, e.g. 200e3"});
  ScriptValue value;
  value.variable_ = word.substr(2);
  variable_index(lmp, value.variable_);
  return value;
}

double ScriptValue::now(LAMMPS_NS::LAMMPS* lmp) const {
  if (variable_.empty()) return number_;
  const double value = lmp->input->variable->compute_equal(variable_index(lmp, variable_));
  if (!std::isfinite(value))
    throw_user_error({"lbm", "v_" + variable_, fmt::format("{}", value), "be a finite number", ""});
  return value;
}

ScriptVector ScriptVector::read(ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp, const std::string& what) {
  ScriptVector vector;
  vector.x = ScriptValue::read(reader, lmp, what + " x");
  vector.y = ScriptValue::read(reader, lmp, what + " y");
  vector.z = ScriptValue::read(reader, lmp, what + " z");
  return vector;
}

}  // namespace suffuse::coupling
