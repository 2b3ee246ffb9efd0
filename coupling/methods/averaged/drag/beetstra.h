#pragma once

#include <cmath>

namespace suffuse::coupling::drag {

/// Beetstra, van der Hoef and Kuipers 2007 (docs key: beetstra2007), from lattice-Boltzmann runs with
/// phi <= 0.6 and Re <= 1000; Carman's 180 in dense creeping flow, Stokes' drag of a lone sphere.
struct Beetstra {
  static constexpr const char* word = "beetstra";
  static constexpr const char* source = "Beetstra et al. 2007";

  static double factor(double phi, double reynolds) {
    const double e = 1 - phi;
    const double creeping = 10 * phi / (e * e) + e * e * (1 + 1.5 * std::sqrt(phi));
    if (reynolds <= 0) return creeping;
    const double rising = 1 / e + 3 * phi * e + 8.4 * std::pow(reynolds, -0.343);
    const double damping = 1 + std::pow(10., 3 * phi) * std::pow(reynolds, -(1 + 4 * phi) / 2);
    return creeping + 0.413 * reynolds / (24 * e * e) * rising / damping;
  }
};

}  // namespace suffuse::coupling::drag
