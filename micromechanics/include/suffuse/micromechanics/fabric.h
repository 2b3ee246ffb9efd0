#pragma once

#include <array>

#include "suffuse/micromechanics/contact_network.h"
#include "suffuse/micromechanics/sums.h"

namespace suffuse::micromechanics {

inline constexpr int kOrientationBins = 36;  ///< over 2π (thesis App. D)

/// The planes on which contact normals are projected, in the order of the histograms.
enum class Plane { xy = 0, xz = 1, yz = 2 };
/// The two axes of each.
inline constexpr std::array<std::array<int, 2>, 3> kPlaneAxes{{{0, 1}, {0, 2}, {1, 2}}};

struct OrientationHistogram {
  std::array<double, kOrientationBins> counts{};
};

/// What one rank adds to the fabric: contacts, Σ n n, and for each plane the angles of the projected normals.
/// Each contact enters with its angle and the opposite one, so a histogram holds 2N_c less those whose normal
/// is perpendicular to the plane (they have no angle).
struct FabricSums {
  double contacts = 0;
  TensorSum normals;
  std::array<OrientationHistogram, 3> planes{};
};

FabricSums fabric_sums(const Packing& packing);

/// φ_ij = (1/N_c) Σ n_i n_j (Satake 1982); trace 1. Zero without contacts.
Mat3 fabric_tensor(const FabricSums& sums);

/// Invariant deviatoric fabric √(3/2 φ':φ'), 0 (isotropic) to 1 (all normals parallel); equals |φ_aa − φ_bb|
/// in an axisymmetric state.
double deviatoric_fabric(const Mat3& fabric);

/// Centre of a bin, rad: (bin + ½) 2π/36.
double bin_centre(int bin);

/// Probability density of the angle, 1/rad, integral over 2π equal to 1; zeros where the histogram is empty.
std::array<double, kOrientationBins> orientation_density(const OrientationHistogram& histogram);

/// E(θ) = (1/2π)[1 + a cos 2(θ − θ_A)] (Rothenburg & Bathurst 1989; thesis App. D with its misprints mended).
struct RoseFit {
  double anisotropy = 0;  ///< a ≥ 0
  double direction = 0;   ///< θ_A, the preferred direction, rad, −π/2 to π/2

  double density(double angle) const;
};

/// Least squares over the 36 bin centres: c₁, c₂ of E − 1/2π = c₁ cos 2θ + c₂ sin 2θ, then θ_A = ½ atan2(c₂,
/// c₁) and a = 2π √(c₁² + c₂²), which is the appendix's 2π c₁/cos 2θ_A without its 0/0. Both 0 for an empty
/// histogram.
RoseFit fit_rose(const OrientationHistogram& histogram);

}  // namespace suffuse::micromechanics
