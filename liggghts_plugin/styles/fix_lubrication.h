#ifdef FIX_CLASS

// clang-format off
FixStyle(lubrication, FixLubrication)
// clang-format on

#else

#ifndef SUFFUSE_FIX_LUBRICATION_H
#define SUFFUSE_FIX_LUBRICATION_H

#include <string>
#include <vector>

#include "fix.h"
#include "laws/lubrication.h"

namespace suffuse {
class ArgumentReader;
}

namespace LAMMPS_NS {

class PairGran;
class Region;

/// fix ID group lubrication viscosity MU outer H inner H [density RHO] [every N] [region ID] [torque yes|no]
/// [walls xplane X ...]: adds the forces of the viscous films between grains of the group, and between them
/// and planes at rest, whose gap is smaller than `outer`. Reference page: docs/reference/fix_lubrication.md;
/// physics: laws/lubrication.h.
class FixLubrication : public Fix {
 public:
  FixLubrication(LAMMPS* lmp, int narg, char** arg);

  /// A wall at rest.
  struct Plane {
    int axis;   // its normal, 0..2
    double at;  // coordinate, m
  };

  /// What its line says.
  struct Settings {
    suffuse::lubrication::Film film;
    double density = 0;  // of the fluid, kg/m^3, for the Reynolds number; 0: none
    int every = 1;
    std::string region;  // films lie in it; empty: everywhere
    bool torque = true;
    std::vector<Plane> walls;
  };
  /// The words of a `fix` line, after `fix`, for who adds this fix from a program.
  static std::vector<std::string> words(const std::string& id, const std::string& group,
                                        const Settings& settings);

  int setmask() override;
  void post_create() override;
  void init() override;
  void setup(int) override;
  void post_force(int) override;
  double compute_vector(int n) override;
  double memory_usage() override;

  /// Wall time of this rank in this fix, s.
  double seconds() const { return seconds_; }

  int pack_comm(int n, int* list, double* buffer, int pbc_flag, int* pbc) override;
  void unpack_comm(int n, int first, double* buffer) override;

 private:
  /// Of this rank; a pair across ranks counts half on each of them.
  struct Tally {
    double films = 0, bounded = 0, power = 0, largest_force = 0, largest_reynolds = 0;
  };

  void read(suffuse::ArgumentReader& reader);
  void require_complete() const;
  void require_walls_within_reach() const;
  void find_region();
  bool holds(suffuse::Vec3 point) const;
  double required_distance_factor(double smallest_radius) const;
  void require_films_once() const;
  void count_films();
  void add(int i, const suffuse::Vec3& force, const suffuse::Vec3& torque);
  void evaluate();
  void add_pairs();
  void add_held();
  void add_walls();
  void tally(const suffuse::lubrication::PairLoads& loads, double approach, double gap, double weight);
  suffuse::lubrication::Body body(int i) const;

  /// Calls visit(i, j, unit vector from i to j, gap) for the pairs of the list whose gap is below `range`,
  /// and likewise visit(i, unit vector to the plane, gap).
  template <class Visitor>
  void for_each_pair(double range, Visitor&& visit) const;
  template <class Visitor>
  void for_each_wall(double range, Visitor&& visit) const;

  Settings set_;
  PairGran* pair_ = nullptr;
  Region* region_ = nullptr;
  std::vector<double> films_;  // an upper bound of the films of each grain until the next neighbour list
  struct Share {
    double inverse_mass, inverse_moment;  // of a film's share of its grain
  };
  std::vector<Share> shares_;  // of owned and ghost grains, from films_
  std::vector<double> held_;   // force and torque of each owned grain
  int age_ = 0;                // steps that they have been added
  Tally now_, since_run_;
  double seconds_ = 0;
};

}  // namespace LAMMPS_NS

#endif
#endif
