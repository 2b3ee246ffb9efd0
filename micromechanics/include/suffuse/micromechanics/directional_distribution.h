#pragma once

#include <span>
#include <vector>

#include "suffuse/micromechanics/contact_network.h"
#include "suffuse/micromechanics/fabric.h"

namespace suffuse::micromechanics {

/// Contacts of a plane by the angle of their projected normal, in equal bins over 2π. Each contact enters
/// with its angle and the opposite one (thesis App. D); those perpendicular to the plane have none.
struct PlaneDistribution {
  std::vector<double> contacts;    ///< 2 N_c shared out over the bins
  std::vector<double> normal;      ///< Σ f_N, N; tension negative
  std::vector<double> tangential;  ///< Σ f_T·t in the plane, t = (−sin θ, cos θ), N: signed

  int bins() const { return static_cast<int>(contacts.size()); }
  double centre(int bin) const;  ///< rad
  double width() const;          ///< rad
  /// Density of the normals' angle E(θ), 1/rad; integral over 2π is 1.
  std::vector<double> contact_density() const;
  /// The same with each contact weighted by its normal force.
  std::vector<double> normal_force_density() const;
  /// Mean normal force of the contacts of each bin over f₀, its mean over all angles; 0 in empty bins.
  std::vector<double> mean_normal_force() const;
  /// Mean signed tangential force of each bin over the same f₀.
  std::vector<double> mean_tangential_force() const;
  /// Adds another packing's, with as many bins.
  void add(const PlaneDistribution& other);
};

/// `bins`: even, ≥ 4.
PlaneDistribution plane_distribution(const Packing& packing, Plane plane, int bins);

/// One harmonic of v(θ) = mean + scale Σ_k a_k cos k(θ − θ_k).
struct Harmonic {
  int order = 0;         ///< k, even
  double amplitude = 0;  ///< a_k ≥ 0, over `scale`
  double direction = 0;  ///< θ_k, rad, −π/k to π/k
};

/// A Fourier series with the even harmonics 2, 4, …: those a distribution has that is the same in opposite
/// directions (`rothenburgbathurst1989` stops at 2, the thesis's App. D too).
struct HarmonicFit {
  double mean = 0;
  double scale = 0;
  std::vector<Harmonic> harmonics;

  double operator()(double angle) const;
};

/// Least squares over equally spaced bin centres, up to and with `highest` (even, < number of bins / 2).
/// a_k is over the mean, so that E = (1/2π)[1 + a₂ cos 2(θ − θ₂) + …]. With 36 bins a₂ and θ₂ are those of
/// fit_rose.
HarmonicFit fit_harmonics(std::span<const double> values, int highest);

/// The same with a_k over 1: for a mean tangential force, whose own mean is 0.
HarmonicFit fit_harmonics_absolute(std::span<const double> values, int highest);

/// What equal bins of width 2π/bins do to a harmonic of order k: its amplitude is multiplied by
/// sin(kΔ/2)/(kΔ/2), 0.995 for k = 2 and 36 bins. Divide by it for the amplitude of the angles themselves.
double bin_attenuation(int order, int bins);

/// θ_t of f_t(θ) = −f₀ a_t sin 2(θ − θ_t) (`rothenburgbathurst1989`) for the second harmonic of
/// mean_tangential_force: θ₂ + π/4, brought to −π/2 .. π/2.
double tangential_direction(const Harmonic& second);

}  // namespace suffuse::micromechanics
