#include "script_references.h"

#include <fmt/format.h>

#include "compute.h"
#include "fix.h"
#include "group.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "suffuse/common/error.h"
#include "variable.h"

namespace suffuse::coupling {

std::vector<std::string> expanded_references(LAMMPS_NS::LAMMPS* lmp, const std::string& reference) {
  const std::size_t bracket = reference.find('[');
  std::string id = reference.substr(2, bracket == std::string::npos ? bracket : bracket - 2);
  int rows = 0, values = 0;
  bool exists = false;
  if (reference[0] == 'c') {
    const int n = lmp->modify->find_compute(id.data());
    exists = n >= 0;
    if (exists) {
      rows = lmp->modify->compute[n]->size_array_rows;
      values = lmp->modify->compute[n]->size_vector;
    }
  } else if (reference[0] == 'f') {
    const int n = lmp->modify->find_fix(id.data());
    exists = n >= 0;
    if (exists) {
      rows = lmp->modify->fix[n]->size_array_rows;
      values = lmp->modify->fix[n]->size_vector;
    }
  } else {
    const int n = lmp->input->variable->find(id.data());
    exists = n >= 0 && lmp->input->variable->equalstyle(n) != 0;
  }
  if (!exists)
    throw_user_error({"lbm monitor", "reference", reference,
                      "name a compute, fix or equal-style variable that exists",
                      "define it before the first lbm run"});
  const std::size_t star = reference.find("[*]");
  if (star == std::string::npos) return {reference};
  const bool array = reference.find('[', star + 1) != std::string::npos;
  std::vector<std::string> all;
  for (int k = 1; k <= (array ? rows : values); ++k)
    all.push_back(reference.substr(0, star) + fmt::format("[{}]", k) + reference.substr(star + 3));
  if (all.empty())
    throw_user_error({"lbm monitor", "reference", reference, "have rows or values for [*]",
                      "c_ID[*] takes a vector's values, c_ID[*][k] column k of an array"});
  return all;
}

double value_of_reference(LAMMPS_NS::LAMMPS* lmp, const std::string& reference) {
  std::string formula = reference;
  return lmp->input->variable->compute_equal(formula.data());
}

int group_bit(LAMMPS_NS::LAMMPS* lmp, const std::string& group) {
  std::string name = group;
  const int number = lmp->group->find(name.data());
  return number < 0 ? 0 : lmp->group->bitmask[number];
}

}  // namespace suffuse::coupling
