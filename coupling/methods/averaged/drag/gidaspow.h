#pragma once

#include <cmath>

namespace suffuse::coupling::drag {

/// Gidaspow 1994 (docs key: gidaspow1994): Ergun's pressure drop (docs key: ergun1952) below a porosity of
/// 0.8, Wen and Yu's (docs key: wenyu1966) above, with the jump between them that the model has.
struct Gidaspow {
  static constexpr const char* word = "gidaspow";
  static constexpr const char* source = "Ergun 1952, Wen and Yu 1966 above porosity 0.8";

  static double factor(double phi, double reynolds) {
    const double e = 1 - phi;
    if (e < 0.8) return (150 * phi + 1.75 * reynolds) / (18 * e * e);
    const double lone = reynolds < 1000 ? 1 + 0.15 * std::pow(reynolds, 0.687) : 0.44 * reynolds / 24;
    return lone * std::pow(e, -3.65);
  }
};

}  // namespace suffuse::coupling::drag
