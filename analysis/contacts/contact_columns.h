#pragma once

#include <map>
#include <string>
#include <vector>

namespace suffuse::analysis {

/// What a contact is read from, in the order of a row's values.
namespace contact_place {
enum Place {
  x1,
  y1,
  z1,
  x2,
  y2,
  z2,
  id1,
  id2,
  fx,
  fy,
  fz,
  fnx,
  fny,
  fnz,
  ftx,
  fty,
  ftz,
  delta,
  friction,
  friction_limit,
  spring_force,
  count
};
}
/// The same of a grain.
namespace grain_place {
enum Place { id, radius, diameter, x, y, z, count };
}

/// Where each column of a file goes, and which quantities are there.
struct ColumnPlan {
  std::vector<int> place_of_column;  ///< −1: not read
  std::vector<bool> has;             ///< for each place

  bool has_vector(int first) const;
};

/// Names of the values of LIGGGHTS's `compute pair/gran/local` with these words, in the order in which it
/// gives them whatever the order of the words: pos, vel, id, force, force_normal, force_tangential, torque, …
/// A value that is not used here has an empty name. Throws UserError on an unknown word.
std::vector<std::string> names_of_pair_values(const std::vector<std::string>& words, const std::string& who);

/// Our names of a contact's and of a grain's quantities; no name is both's.
std::vector<std::string> known_columns();

/// Plans for the columns of a dump. `renamed`: our name → the file's. Columns that are no quantity's are left
/// out. Throws UserError (`who` first) where a renamed column is not there.
ColumnPlan plan_contact_columns(const std::vector<std::string>& columns,
                                const std::vector<std::string>& words,
                                const std::map<std::string, std::string>& renamed, const std::string& who);
ColumnPlan plan_grain_columns(const std::vector<std::string>& columns,
                              const std::map<std::string, std::string>& renamed, const std::string& who);

}  // namespace suffuse::analysis
