#ifdef FIX_CLASS

// clang-format off
FixStyle(loading/platen, FixLoadingPlaten)
// clang-format on

#else

#ifndef SUFFUSE_FIX_LOADING_PLATEN_H
#define SUFFUSE_FIX_LOADING_PLATEN_H

#include <optional>
#include <string>
#include <vector>

#include "fix.h"
#include "laws/platen.h"

namespace suffuse {
class ArgumentReader;
}

namespace LAMMPS_NS {

/// `fix ID group loading/platen upper|lower xplane|yplane|zplane POSITION stress P | fixed [opening D]
/// [collect L] [classes D1 D2 ...] [speed V] [mass M] [damping Z] [area A] [type T]`: a rigid, smooth,
/// perforated plate that loads the grains of the group. Reference page: docs/reference/fix_loading_platen.md;
/// physics: laws/platen.h.
///
/// Grains that have passed by `collect` are moved out of the box just before LIGGGHTS hands grains to their
/// ranks, which drops them: contact histories and other fixes see the same grains until then, in whatever
/// order the fixes stand.
class FixLoadingPlaten : public Fix {
 public:
  FixLoadingPlaten(LAMMPS* lmp, int narg, char** arg);

  int setmask() override;
  void post_create() override;
  void init() override;
  void setup(int) override;
  void initial_integrate(int) override;
  void pre_exchange() override;
  void post_force(int) override;
  int modify_param(int narg, char** arg) override;
  double compute_scalar() override;
  double compute_vector(int n) override;
  double compute_array(int row, int column) override;
  void write_restart(FILE* file) override;
  void restart(char* buffer) override;

 private:
  bool read_changeable(suffuse::ArgumentReader& reader);
  void read_construction(suffuse::ArgumentReader& reader);
  void check_words() const;
  void connect_materials();
  void take_drive();
  double area() const;
  /// How far a point along the axis lies beyond the platen, m; negative on the sample's side.
  double beyond(double coordinate) const { return outward_ * (coordinate - motion_.position); }
  bool holds(double radius) const { return 2 * radius >= opening_; }
  void press();

  int axis_ = 2;
  double outward_ = 1;
  std::optional<double> stress_;                              // Pa; none: the platen is fixed
  bool loading_given_ = false;                                // in the line that is read
  double opening_ = 0;                                        // m
  double collect_ = 0;                                        // m; 0: grains that pass stay in the box
  double given_speed_ = 0, given_mass_ = 0, given_area_ = 0;  // 0: chosen here
  double restored_mass_ = 0;                                  // of a restart file, for the first run
  int type_ = 1;

  suffuse::platen::Motion motion_;
  suffuse::platen::Drive drive_;
  suffuse::platen::Reaction reaction_;  // of all contacts, all ranks
  double contacts_ = 0;
  double reference_ = 0;                              // position that settlement counts from, m
  std::vector<suffuse::platen::Material> materials_;  // by type of grain
  suffuse::platen::SizeTally passed_;                 // all ranks
};

}  // namespace LAMMPS_NS

#endif
#endif
