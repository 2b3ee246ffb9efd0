#pragma once

#include <vector>

#include "suffuse/micromechanics/contact_network.h"

namespace suffuse::micromechanics {

/// The unit sphere cut into cells of one area: a cap at each pole and collars of nearly square cells between
/// them (`leopardi2006`). z is the polar axis; the azimuth runs from x towards y.
class SphericalGrid {
 public:
  /// `cells`: about how many (≥ 6); the rule of the collars decides the exact number.
  explicit SphericalGrid(int cells);

  struct Cell {
    double z_low = -1, z_high = 1;             ///< cosine of the polar angle
    double azimuth_low = 0, azimuth_high = 0;  ///< rad, 0 to 2π
    Vec3 centre() const;                       ///< unit vector
  };

  int size() const { return static_cast<int>(cells_.size()); }
  const Cell& cell(int which) const { return cells_[static_cast<std::size_t>(which)]; }
  /// Solid angle of each cell, 4π/size(), sr.
  double solid_angle() const;
  /// The cell that holds a direction (any length but 0).
  int find(const Vec3& direction) const;

 private:
  std::vector<Cell> cells_;
  std::vector<double> edges_;       ///< z of the collars' upper edges, falling from 1 to −1
  std::vector<int> first_, count_;  ///< of each collar
};

/// Contact normals over the sphere; each contact enters with both directions.
struct SphericalDistribution {
  std::vector<double> contacts;  ///< one value a cell
  std::vector<double> normal;    ///< Σ f_N, N; tension negative

  /// Adds another packing's, on the same grid.
  void add(const SphericalDistribution& other);
};

SphericalDistribution spherical_distribution(const Packing& packing, const SphericalGrid& grid);

/// Values over their sum and the cell's solid angle: a density, 1/sr, whose integral over the sphere is 1.
std::vector<double> spherical_density(const std::vector<double>& values, const SphericalGrid& grid);

/// Second-order fit E(n) = (1/4π)(1 + n·D n) with D = 15/2 (φ − 1/3) of the fabric tensor φ (`kanatani1984`),
/// 1/sr. Also of force-weighted normals, with their own φ.
double second_order_density(const Mat3& fabric, const Vec3& direction);

/// Σ f_N n n over contacts, N; over its trace it is the fabric of the force-weighted normals.
Mat3 normal_force_moment(const Packing& packing);

}  // namespace suffuse::micromechanics
