#pragma once

#include <cmath>

namespace suffuse::coupling::drag {

/// Tang, Peters, Kuipers, Kriebitzsch and van der Hoef 2015 (docs key: tang2015), from immersed-boundary runs
/// with phi <= 0.6 and Re <= 1000; the creeping part is Beetstra's.
struct Tang {
  static constexpr const char* word = "tang";
  static constexpr const char* source = "Tang et al. 2015";

  static double factor(double phi, double reynolds) {
    const double e = 1 - phi, e4 = e * e * e * e;
    const double creeping = 10 * phi / (e * e) + e * e * (1 + 1.5 * std::sqrt(phi));
    if (reynolds <= 0) return creeping;
    return creeping + reynolds * (0.11 * phi * (1 + phi) - 0.00456 / e4 +
                                  (0.169 * e + 0.0644 / e4) * std::pow(reynolds, -0.343));
  }
};

}  // namespace suffuse::coupling::drag
