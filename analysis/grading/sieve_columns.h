#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace suffuse::analysis {

/// What a column of sizes holds: a length, an ASTM sieve's number (E11), or Krumbein's phi = -log2 of d in
/// mm.
enum class SizeKind { diameter, sieve_number, phi };

/// What a column of amounts holds, by rising trust: grains of one size each (mass_fraction, mass_kg), what
/// stays on each sieve, what stays on it and on all above, what passes it.
enum class AmountKind { of_class, retained, coarser, finer };

/// The columns of a grading in a table, told from their names.
struct SieveColumns {
  std::size_t size = 0, amount = 0;
  SizeKind size_kind = SizeKind::diameter;
  AmountKind amount_kind = AmountKind::finer;
  double to_diameter = 1;       ///< of a length in the table, to the diameter in m
  std::optional<double> whole;  ///< what stands for all of the mass: 100 (per cent), 1 (shares); none: a mass
  bool whole_by_largest = false;  ///< the name does not tell: 100 or 1, as the largest size has it
};

/// Names are read as words, in any case, order and punctuation: "Sieve size (mm)", `sieve_mm`, `opening_um`,
/// `diameter_m`, `radius_m`; `sieve_no`, "ASTM No."; `phi`; and "% passing", `percent_finer`,
/// `mass_retained_g`, "Cumulative % retained", `mass_fraction`, `mass_kg`; `in` is the inch where it stands
/// last or in brackets, not in "size in m". Of several sizes a length counts,
/// then a number; of several amounts what passes, then coarser, then retained. Throws UserError (`who` first)
/// where there is none, two of one kind, or a length without its unit.
SieveColumns sieve_columns(const std::vector<std::string>& names, const std::string& path,
                           const std::string& who);

/// Opening of an ASTM E11 sieve, m: "No. 200", "#200", "200", "3/8 in", "1 1/2\"" ; none for others.
std::optional<double> astm_sieve_opening(std::string_view name);
/// Whether a size (m) is the opening of such a sieve, to 0.5 %.
bool is_sieve_opening(double diameter);

/// Whether a size's cell stands for what passes all sieves: pan, receiver, bottom, "<0.063", 0.
bool is_pan(std::string_view cell);

}  // namespace suffuse::analysis
