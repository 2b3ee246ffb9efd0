#pragma once

#include <string>

#include "styles/style_support.h"
#include "suffuse/common/linear_algebra.h"

namespace suffuse::coupling {

/// A number in a script, or `v_name`: an equal-style variable that is evaluated whenever it is needed.
class ScriptValue {
 public:
  ScriptValue(double number = 0) : number_(number) {}

  /// The next word. A UserError if it is neither a finite number nor a variable that exists.
  static ScriptValue read(ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp, const std::string& what);

  bool changes() const { return !variable_.empty(); }
  bool is_zero() const { return variable_.empty() && number_ == 0; }

  /// A UserError if the variable is gone or its value is not finite. Collective.
  double now(LAMMPS_NS::LAMMPS* lmp) const;

 private:
  double number_ = 0;
  std::string variable_;
};

struct ScriptVector {
  ScriptValue x, y, z;
  static ScriptVector read(ArgumentReader& reader, LAMMPS_NS::LAMMPS* lmp, const std::string& what);
  bool changes() const { return x.changes() || y.changes() || z.changes(); }
  bool is_zero() const { return x.is_zero() && y.is_zero() && z.is_zero(); }
  Vec3 now(LAMMPS_NS::LAMMPS* lmp) const { return {x.now(lmp), y.now(lmp), z.now(lmp)}; }
};

}  // namespace suffuse::coupling
