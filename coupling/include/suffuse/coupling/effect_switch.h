#pragma once

#include <limits>
#include <string>
#include <vector>

#include "suffuse/coupling/settings.h"

namespace suffuse::coupling {

/// A dimensionless number switches at `limit` when it rises and at `release` when it falls (release < limit),
/// so that a number which trembles about its limit does not.
struct Hysteresis {
  double limit = 0, release = 0;

  /// Is `value` above, after a look at which it was (`was_above`), or was not? Not a number counts as no
  /// change.
  bool is_above(bool was_above, double value) const { return was_above ? !(value < release) : value > limit; }
};

/// One number that an effect was decided by.
struct EffectNumber {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::string name;      ///< "u dx/nu"; empty where no number decides
  double value = kNone;  ///< at the last look
  Hysteresis bounds;
  std::string source;         ///< whose value it is, or why it matters
  bool on_when_above = true;  ///< else the effect is off above the limit
  bool above = false;
};

/// What is known of one effect: asked, decided, by which number, since when.
struct EffectState {
  std::string name;
  Switch asked = Switch::automatic;
  bool on = false;
  EffectNumber number;                      ///< that decided; with an empty name `reason` says why
  std::string reason;                       ///< in words, where no number decides
  std::vector<bool> above;                  ///< memory of the numbers that decide together, in their order
  double changed_at = EffectNumber::kNone;  ///< s, the last change during the run; not a number: never
  int changes = 0;

  /// For the manifest and for the line that tells of a change: "u dx/nu = 11.2 (fastest water), on above 30,
  /// off below 5".
  std::string text() const;

  /// What a saved state keeps, and its taking up. A UserError with `who` where the record is none of these.
  std::vector<double> record() const;
  void restore(const std::vector<double>& record, const std::string& who);

  /// Decides by several numbers: on if each of them says so. The first that says no, or else the first, is
  /// kept as the one that decided.
  void decide(std::vector<EffectNumber> numbers);
  /// Decides without a number.
  void decide(bool is_on, const std::string& why);
};

}  // namespace suffuse::coupling
