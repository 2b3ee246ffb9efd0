#pragma once

#include <cmath>

namespace suffuse::coupling::drag {

/// Di Felice 1994 (docs key: difelice1994), thesis eqs 2.22 to 2.25: Dallavalle's drag of a lone sphere
/// times porosity^-chi. Dallavalle's lies 4 % below Stokes' at small Reynolds numbers.
struct DiFelice {
  static constexpr const char* word = "di_felice";
  static constexpr const char* source = "Di Felice 1994";

  static double factor(double phi, double reynolds) {
    // C_d Re/24, written so that it has its limit at Re = 0.
    const double root = 0.63 * std::sqrt(reynolds) + 4.8;
    const double off = reynolds > 0 ? 1.5 - std::log10(reynolds) : 1e3;
    const double chi = 3.7 - 0.65 * std::exp(-0.5 * off * off);
    return root * root / 24 * std::pow(1 - phi, -chi);
  }
};

}  // namespace suffuse::coupling::drag
