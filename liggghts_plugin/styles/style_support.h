#pragma once

// Shared by our LIGGGHTS styles: reading of arguments with errors that say how to mend them, and the few
// LIGGGHTS look-ups that several styles need.

#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string>
#include <string_view>

namespace LAMMPS_NS {
class Fix;
class LAMMPS;
class PairGran;
}  // namespace LAMMPS_NS

namespace suffuse {

/// Reads a style's words from left to right. Every problem is a UserError that names the style.
class ArgumentReader {
 public:
  /// `who` names the style in messages, e.g. "compute coordination"; `first` is the index of the first word
  /// to read.
  ArgumentReader(std::string who, int narg, char** arg, int first);

  bool done() const { return next_ >= narg_; }

  /// The next word, a keyword; `purpose` says what was expected, for the message.
  std::string word(std::string_view purpose);

  /// True, and the word is consumed, if the next word is `expected`.
  bool accept(std::string_view expected);

  /// The same for a word that a line may have once: a UserError at the second time.
  bool keyword(std::string_view expected);

  /// The next word, a keyword that a line may have once.
  std::string keyword();

  /// True if the next word reads as a number.
  bool next_is_number() const;

  double number(std::string_view what);
  double positive(std::string_view what);
  std::int64_t positive_integer(std::string_view what);

  /// Throws for a word that no keyword matches. `known` lists the keywords for the remedy.
  [[noreturn]] void unknown(std::string_view given, std::string_view known) const;

  const std::string& who() const { return who_; }

 private:
  std::string who_;
  void take_once(const std::string& word);

  int narg_;
  char** arg_;
  int next_;
  std::set<std::string, std::less<>> taken_;
};

/// Text for the person who runs the script, as it stands: on the screen and in the log, once for all ranks.
void tell(LAMMPS_NS::LAMMPS* lmp, std::string_view text);

/// Does a fix of this style set forces, or hold them to a plane or a mean, rather than add to them? `freeze`,
/// `setforce` and their like: they must act after all that add.
bool constrains_forces(std::string_view style);

/// Moves a fix of ours that adds forces before the first fix that constrains them, wherever the script has
/// their lines. Between runs.
void act_before_constraints(LAMMPS_NS::LAMMPS* lmp, const LAMMPS_NS::Fix* fix);

/// Throws unless the group has grains on some rank. Collective.
void require_grains_in_group(LAMMPS_NS::LAMMPS* lmp, std::string_view who, int igroup);

/// Throws unless a granular pair style is defined; returns it.
LAMMPS_NS::PairGran& require_granular_pair_style(LAMMPS_NS::LAMMPS* lmp, std::string_view who);

/// LAMMPS::init, after which fixes that are defined further down still find what a restart file that was read
/// holds for them: LIGGGHTS forgets what no fix has claimed by then.
void init_keeping_restart_records(LAMMPS_NS::LAMMPS* lmp);

/// Throws unless the box is periodic on all faces and orthogonal.
void require_periodic_box(LAMMPS_NS::LAMMPS* lmp, std::string_view who);

/// Throws unless the script has `units si`, as our formulas and defaults are SI's, and three dimensions: in
/// two LIGGGHTS's stresses are forces a length and its grains may be discs.
void require_si_and_three_dimensions(LAMMPS_NS::LAMMPS* lmp, std::string_view who);

/// Throws where a fix of the script makes clumps of spheres: what `who` computes is that of single spheres.
void require_single_spheres(LAMMPS_NS::LAMMPS* lmp, std::string_view who);

/// Does any pair of types have a coefficient of friction above 0? Not where the script defines none.
bool grains_have_friction(LAMMPS_NS::LAMMPS* lmp);

/// Sum over ranks, in place.
void sum_over_ranks(LAMMPS_NS::LAMMPS* lmp, std::span<double> values);

/// Sizes and masses of all grains of a group, with their true densities: LIGGGHTS's `density`, which `fix
/// density/scaling` leaves alone, and not its `rmass`. Collective.
struct GrainStatistics {
  std::int64_t count = 0;
  double solid_volume = 0;          ///< m³
  double mean_density = 0;          ///< kg/m³
  double smallest_radius = 0;       ///< m
  double largest_radius = 0;        ///< m
  double number_mean_diameter = 0;  ///< m
  double mass_mean_diameter = 0;    ///< Σ m d / Σ m, m
};
GrainStatistics grain_statistics(LAMMPS_NS::LAMMPS* lmp, int groupbit);

}  // namespace suffuse
