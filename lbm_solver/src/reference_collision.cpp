#include <Eigen/LU>
#include <array>
#include <cmath>

#include "lattice_vectors.h"
#include "suffuse/lbm/reference_fluid.h"

namespace suffuse::lbm {

namespace {

using CellPopulations = std::array<double, 19>;

/// Thesis eq 3.25 in lattice units.
double equilibrium(int i, double density, const Vec3& u) {
  const double cu = velocity_of(i).dot(u);
  return kWeight[i] * density * (1 + 3 * cu + 4.5 * cu * cu - 1.5 * u.squaredNorm());
}

/// Guo's source before the factors (1 - rate/2).
double guo(int i, const Vec3& u, const Vec3& force) {
  const Vec3 c = velocity_of(i);
  return kWeight[i] * (3 * (c - u) + 9 * c.dot(u) * c).dot(force);
}

double eddy_time(const CollisionSettings& settings, const Mat3& stress, double density) {
  const double tau = settings.relaxation_time, c = settings.smagorinsky;
  return 0.5 * (tau + std::sqrt(tau * tau + 18 * std::sqrt(2.) * c * c * stress.norm() / density));
}

CellPopulations two_rates(const CellPopulations& f, const CollisionSettings& settings, double density,
                          const Vec3& u, const Vec3& force) {
  double tau = settings.relaxation_time;
  if (settings.smagorinsky > 0) {
    Mat3 stress = 0.5 * (u * force.transpose() + force * u.transpose());
    for (int i = 0; i < kDirections; ++i)
      stress += (f[static_cast<std::size_t>(i)] - equilibrium(i, density, u)) * velocity_of(i) *
                velocity_of(i).transpose();
    tau = eddy_time(settings, stress, density);
  }
  const double even_rate = 1 / tau;
  const double odd_rate = settings.collision_operator == CollisionOperator::bgk
                              ? even_rate
                              : 1 / (0.5 + settings.magic / (1 / even_rate - 0.5));
  CellPopulations result = f;
  for (int i = 0; i < kDirections; ++i) {
    const int o = opposite(i);
    const double fi = f[static_cast<std::size_t>(i)], fo = f[static_cast<std::size_t>(o)];
    const double ei = equilibrium(i, density, u), eo = equilibrium(o, density, u);
    const double si = guo(i, u, force), so = guo(o, u, force);
    result[static_cast<std::size_t>(i)] +=
        -even_rate * ((fi + fo) / 2 - (ei + eo) / 2) - odd_rate * ((fi - fo) / 2 - (ei - eo) / 2) +
        (1 - even_rate / 2) * (si + so) / 2 + (1 - odd_rate / 2) * (si - so) / 2;
  }
  return result;
}

/// Powers of each moment: order 0, three of order 1, six of order 2, six of order 3, three of order 4.
constexpr int kPowers[kDirections][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 0, 0},
                                         {0, 2, 0}, {0, 0, 2}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1},
                                         {1, 2, 0}, {1, 0, 2}, {2, 1, 0}, {0, 1, 2}, {2, 0, 1},
                                         {0, 2, 1}, {2, 2, 0}, {2, 0, 2}, {0, 2, 2}};

using Matrix = Eigen::Matrix<double, kDirections, kDirections>;
using Vector = Eigen::Matrix<double, kDirections, 1>;

/// From populations to moments about a velocity.
Matrix moments_about(const Vec3& u) {
  Matrix transform;
  for (int m = 0; m < kDirections; ++m)
    for (int i = 0; i < kDirections; ++i) {
      transform(m, i) = 1;
      for (int a = 0; a < 3; ++a) transform(m, i) *= std::pow(kVelocity[i][a] - u[a], kPowers[m][a]);
    }
  return transform;
}

/// Even moments about the velocity relax at the viscosity's rate, odd ones at TRT's other one.
CellPopulations comoving_rates(const CellPopulations& f, const CollisionSettings& settings, double density,
                               const Vec3& u, const Vec3& force) {
  // Equilibrium and source of thesis eq 3.25 and Guo, with fourth moments that do not know the third axis.
  Vector equilibrium_vector, source;
  Mat3 stress = 0.5 * (u * force.transpose() + force * u.transpose());
  for (int i = 0; i < kDirections; ++i) {
    equilibrium_vector[i] = equilibrium(i, density, u);
    source[i] = guo(i, u, force);
    stress += (f[static_cast<std::size_t>(i)] - equilibrium_vector[i]) * velocity_of(i) *
              velocity_of(i).transpose();
  }
  const Eigen::FullPivLU<Matrix> lattice(moments_about(Vec3::Zero()));
  Vector moments = Vector::Zero(), sources = Vector::Zero();
  for (int m = 16; m < 19; ++m) {
    int other = 0;
    for (int a = 0; a < 3; ++a)
      if (kPowers[m][a] == 0) other = a;
    moments[m] = density * u[other] * u[other] / 6;
    sources[m] = u[other] * force[other] / 3;
  }
  equilibrium_vector += lattice.solve(moments);
  source += lattice.solve(sources);

  double tau = settings.relaxation_time;
  if (settings.smagorinsky > 0) tau = eddy_time(settings, stress, density);
  const double even_rate = 1 / tau, odd_rate = 1 / (0.5 + settings.magic / (tau - 0.5));
  const Matrix transform = moments_about(u);
  Vector away = transform * (Eigen::Map<const Vector>(f.data()) + 0.5 * source - equilibrium_vector);
  for (int m = 0; m < kDirections; ++m)
    away[m] *= 1 - ((kPowers[m][0] + kPowers[m][1] + kPowers[m][2]) % 2 == 0 ? even_rate : odd_rate);
  CellPopulations result;
  Eigen::Map<Vector>(result.data()) = equilibrium_vector + 0.5 * source + transform.fullPivLu().solve(away);
  return result;
}

/// Central moments after a collision, but for those of fourth order.
Vector relaxed_moments(const CellPopulations& f, const CollisionSettings& settings, double density,
                       const Vec3& u, const Vec3& force) {
  Vector k = moments_about(u) * Eigen::Map<const Vector>(f.data());

  Mat3 stress;
  stress << k[4], k[7], k[8], k[7], k[5], k[9], k[8], k[9], k[6];
  stress -= density / 3 * Mat3::Identity();
  double tau = settings.relaxation_time;
  if (settings.smagorinsky > 0) tau = eddy_time(settings, stress, density);
  const Mat3 trace = stress.trace() / 3 * Mat3::Identity();
  const Mat3 relaxed = density / 3 * Mat3::Identity() + (1 - 1 / tau) * (stress - trace);

  for (int a = 0; a < 3; ++a) {
    k[1 + a] += force[a];
    k[4 + a] = relaxed(a, a);
  }
  k[7] = relaxed(0, 1);
  k[8] = relaxed(0, 2);
  k[9] = relaxed(1, 2);
  for (int m = 10; m < 16;
       ++m) {  // third order: equilibrium 0, source F/3 with the factor (1 - rate/2), rate 1
    int odd_axis = 0;
    for (int a = 0; a < 3; ++a)
      if (kPowers[m][a] == 1) odd_axis = a;
    k[m] = 0.5 * force[odd_axis] / 3;
  }
  return k;
}

CellPopulations populations_of(const Vector& moments, const Vec3& u) {
  CellPopulations result;
  Eigen::Map<Vector>(result.data()) = moments_about(u).fullPivLu().solve(moments);
  return result;
}

CellPopulations central_moments(const CellPopulations& f, const CollisionSettings& settings, double density,
                                const Vec3& u, const Vec3& force) {
  Vector k = relaxed_moments(f, settings, density, u, force);
  for (int m = 16; m < 19; ++m) k[m] = density / 9;
  return populations_of(k, u);
}

/// Fourth moments of a Gaussian with these second ones: fourth cumulants are zero.
CellPopulations cumulants(const CellPopulations& f, const CollisionSettings& settings, double density,
                          const Vec3& u, const Vec3& force) {
  Vector k = relaxed_moments(f, settings, density, u, force);
  k[16] = (k[4] * k[5] + 2 * k[7] * k[7]) / density;
  k[17] = (k[4] * k[6] + 2 * k[8] * k[8]) / density;
  k[18] = (k[5] * k[6] + 2 * k[9] * k[9]) / density;
  return populations_of(k, u);
}

}  // namespace

CellPopulations reference_collision(const CellPopulations& populations, const CollisionSettings& settings,
                                    const Vec3& force) {
  double density = 0;
  Vec3 momentum = 0.5 * force;
  for (int i = 0; i < kDirections; ++i) {
    density += populations[static_cast<std::size_t>(i)];
    momentum += populations[static_cast<std::size_t>(i)] * velocity_of(i);
  }
  // He & Luo: w_i (rho - 1) does not collide, the rest does so at density one.
  const double carried = settings.incompressible ? density - 1 : 0;
  CellPopulations f = populations;
  for (int i = 0; i < kDirections; ++i) f[static_cast<std::size_t>(i)] -= kWeight[i] * carried;
  density -= carried;
  const Vec3 u = momentum / density;
  switch (settings.collision_operator) {
#define SUFFUSE_ORACLE(word, law, ...)       \
  case CollisionOperator::word:              \
    f = law(f, settings, density, u, force); \
    break;
    SUFFUSE_COLLISION_OPERATORS(SUFFUSE_ORACLE)
#undef SUFFUSE_ORACLE
  }
  for (int i = 0; i < kDirections; ++i) f[static_cast<std::size_t>(i)] += kWeight[i] * carried;
  return f;
}

namespace {

/// Omega_solid of SC1 to SC3, as printed.
double solid_operator(SolidOperator which, const CellPopulations& f, int i, double density, const Vec3& u,
                      const Vec3& us, double even_rate, double odd_rate) {
  const int o = opposite(i);
  const double fi = f[static_cast<std::size_t>(i)], fo = f[static_cast<std::size_t>(o)];
  switch (which) {
    case SolidOperator::sc1:
      return fo - fi + equilibrium(i, density, us) - equilibrium(o, density, u);
    case SolidOperator::sc3:
      return fo - fi + equilibrium(i, density, us) - equilibrium(o, density, us);
    default:
      break;
  }
  const double even = (fi + fo) / 2 - (equilibrium(i, density, u) + equilibrium(o, density, u)) / 2;
  const double odd = (fi - fo) / 2 - (equilibrium(i, density, u) - equilibrium(o, density, u)) / 2;
  return equilibrium(i, density, us) - fi + (1 - even_rate) * even + (1 - odd_rate) * odd;
}

}  // namespace

PartialCollision reference_partial_collision(const CellPopulations& populations,
                                             const CollisionSettings& settings, const Vec3& force,
                                             const PartialSolidSettings& partial,
                                             const PartialSolidCell& solids) {
  if (!(solids.strength > 0)) return {reference_collision(populations, settings, force), Vec3::Zero()};
  const double weight = solid_weight(partial, solids, settings.relaxation_time);
  const Vec3 us = solids.momentum / solids.strength;
  double density = 0;
  Vec3 j = Vec3::Zero();
  for (int i = 0; i < kDirections; ++i) {
    density += populations[static_cast<std::size_t>(i)];
    j += populations[static_cast<std::size_t>(i)] * velocity_of(i);
  }
  const double inertial = settings.incompressible ? 1 : density;
  if (partial.solid_operator == SolidOperator::force) {
    const Vec3 exchange = 2 * weight * (j + 0.5 * force - inertial * us);
    return {reference_collision(populations, settings, force - exchange), exchange};
  }
  const CellPopulations fluid = reference_collision(populations, settings, force);
  CellPopulations f = populations;
  for (int i = 0; i < kDirections; ++i) f[static_cast<std::size_t>(i)] -= kWeight[i] * (density - inertial);
  const double even_rate = 1 / settings.relaxation_time;
  const double odd_rate = settings.collision_operator == CollisionOperator::bgk
                              ? even_rate
                              : 1 / (0.5 + settings.magic / (settings.relaxation_time - 0.5));
  const Vec3 u = (j + 0.5 * force) / inertial;
  PartialCollision result{populations, weight * force};
  for (int i = 0; i < kDirections; ++i) {
    const auto n = static_cast<std::size_t>(i);
    const double omega = solid_operator(partial.solid_operator, f, i, inertial, u, us, even_rate, odd_rate);
    result.populations[n] += (1 - weight) * (fluid[n] - populations[n]) + weight * omega;
    result.exchange -= weight * omega * velocity_of(i);
  }
  return result;
}

}  // namespace suffuse::lbm
