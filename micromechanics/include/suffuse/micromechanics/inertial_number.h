#pragma once

namespace suffuse::micromechanics {

/// What the inertial number is made of.
struct InertialState {
  double strain_rate = 0;  ///< any sign, 1/s
  double diameter = 0;     ///< m; say which mean
  double density = 0;      ///< of the solid, kg/m³
  double pressure = 0;     ///< mean effective stress p', Pa
};

/// Inertial number I = |ε̇| d √(ρ/p') (da Cruz et al. 2005; thesis eq 3.17), dimensionless. Below 7.9e-5 a
/// compression is quasi-static (Perez et al. 2016). 0 where the pressure is not positive: no contacts, no
/// inertial number.
double inertial_number(const InertialState& state);

}  // namespace suffuse::micromechanics
