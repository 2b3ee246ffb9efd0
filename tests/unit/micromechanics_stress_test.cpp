#include <catch2/catch.hpp>

#include "hand_packings.h"
#include "suffuse/micromechanics/stress.h"
#include "suffuse/micromechanics/stress_reduction.h"

using namespace suffuse;
using namespace suffuse::micromechanics;
using namespace suffuse::micromechanics::testing;

namespace {

constexpr double kPressure = 200e3;  // Pa
constexpr double kRadius = 1e-3;     // m

/// Sodium-chloride lattice of coarse and fine grains, periodic, n even: coarse of radius R and fines of
/// radius r alternate and touch along the axes; the force differs by axis so that there is a deviator.
Packing rock_salt(int n, double coarse, double fine, const Vec3& force_by_axis) {
  Packing packing;
  const double a = coarse + fine;
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z)
        packing.grains.push_back(grain(static_cast<std::int64_t>(packing.grains.size()) + 1,
                                       (x + y + z) % 2 == 0 ? coarse : fine, a * Vec3(x, y, z)));
  packing.volume = std::pow(n * a, 3);
  add_periodic_contacts(
      packing, Vec3::Constant(n * a),
      [&](const Vec3& branch) -> Vec3 {
        const Vec3 normal = branch.normalized();
        return force_by_axis.cwiseProduct(normal);
      },
      0.3);
  return packing;
}

}  // namespace

TEST_CASE("contact forces of 4R²p in a simple cubic array carry the mean stress p") {
  // dem_reference_values.csv: "SC array p=200000 Pa, contact force / R^2, 8.0e5".
  const Packing packing = simple_cubic(3, kRadius, push(8.0e5 * kRadius * kRadius));
  const Mat3 stress = stress_times_volume(packing).matrix() / packing.volume;
  CHECK(mean_stress(stress) == Approx(kPressure).epsilon(1e-12));  // rounding of 81 terms
  CHECK((stress - kPressure * Mat3::Identity()).norm() < 1e-9 * kPressure);
}

TEST_CASE("contact forces of √2R²p in a face-centred cubic array carry the mean stress p") {
  // dem_reference_values.csv: "FCC array p=200000 Pa, contact force / R^2, 2.828427e5" (seven digits
  // printed).
  const Packing packing = face_centred_cubic(2, kRadius, push(2.828427e5 * kRadius * kRadius));
  const Mat3 stress = stress_times_volume(packing).matrix() / packing.volume;
  CHECK(mean_stress(stress) == Approx(kPressure).epsilon(3e-7));
  CHECK((stress - mean_stress(stress) * Mat3::Identity()).norm() < 1e-9 * kPressure);
}

TEST_CASE("stress is positive in compression and its first index is the branch's") {
  Packing packing;
  packing.grains = {grain(1, 1, Vec3(0, 0, 2)), grain(2, 1, Vec3(0, 0, 0))};
  packing.volume = 8;
  packing.contacts.push_back({0, 1, Vec3(0, 0, 2), Vec3(0.5, 0, 3), 0.3});
  const Mat3 stress = stress_times_volume(packing).matrix() / 8;
  CHECK(stress(2, 2) == Approx(0.75));
  CHECK(stress(2, 0) == Approx(0.125));
  CHECK(stress(0, 2) == 0);
}

TEST_CASE("the axial deviatoric stress is positive in compression along the axis, negative in extension") {
  Mat3 stress = Vec3(100, 100, 250).asDiagonal();
  CHECK(axial_deviatoric_stress(stress, 2) == Approx(150));
  stress = Vec3(100, 100, 40).asDiagonal();
  CHECK(axial_deviatoric_stress(stress, 2) == Approx(-60));
}

TEST_CASE("both ways of sharing a branch between two grains add up to the contact sum") {
  const Packing packing = rock_salt(4, 1.0, 0.4, Vec3(1, 2, 3));
  const Mat3 contacts = stress_times_volume(packing).matrix();
  for (const GrainArm arm : {GrainArm::contact_point, GrainArm::pair_halves}) {
    Mat3 grains = Mat3::Zero();
    for (const Mat3& stress : grain_stress_times_volume(packing, arm)) grains += stress;
    CHECK((grains - contacts).norm() < 1e-12 * contacts.norm());  // rounding
  }
}

TEST_CASE("a grain's arm ends at the contact point, or at half of the branch") {
  Packing packing;
  packing.grains = {grain(1, 3, Vec3(0, 0, 0)), grain(2, 1, Vec3(3.8, 0, 0))};
  packing.volume = 1;
  packing.contacts.push_back({0, 1, Vec3(-3.8, 0, 0), Vec3(-10, 0, 0), 0.3});  // overlap 0.2
  const auto point = grain_stress_times_volume(packing, GrainArm::contact_point);
  CHECK(point[0](0, 0) == Approx(29));
  CHECK(point[1](0, 0) == Approx(9));
  const auto halves = grain_stress_times_volume(packing, GrainArm::pair_halves);
  CHECK(halves[0](0, 0) == Approx(19));
  CHECK(halves[1](0, 0) == Approx(19));
}

TEST_CASE("alpha of a rock-salt lattice follows from the radii by either arm") {
  // Each grain has six contacts. By contact point Σ p_p V_p of a grain is 2 r F, by pair halves (R + r) F. So
  //   share of fines: r/(R + r), or 1/2;   solid share: r³/(R³ + r³);   alpha = share / solid share.
  const double coarse = 1.0, fine = 0.5;
  const double solid_share = std::pow(fine, 3) / (std::pow(coarse, 3) + std::pow(fine, 3));
  const Packing packing = rock_salt(4, coarse, fine, Vec3(1, 1, 1));
  const SizeSplit split{1.5};
  const StressReduction point =
      stress_reduction(stress_reduction_sums(packing, split, GrainArm::contact_point), packing.volume);
  CHECK(point.sufian == Approx(fine / (coarse + fine)));
  CHECK(point.shire == Approx(fine / (coarse + fine) / solid_share));
  CHECK(point.fines_solid_share == Approx(solid_share));
  const StressReduction halves =
      stress_reduction(stress_reduction_sums(packing, split, GrainArm::pair_halves), packing.volume);
  CHECK(halves.sufian == Approx(0.5));
  CHECK(halves.shire == Approx(0.5 / solid_share));
  // p' = F (R + r) 3 contacts / (3 (R + r)³)
  CHECK(halves.mean_stress == Approx(1 / std::pow(coarse + fine, 2)));
  CHECK(point.mean_stress == Approx(halves.mean_stress));
}

TEST_CASE("fines' share of the stress equals alpha times their share of the solids") {
  const Packing packing = rock_salt(4, 1.0, 0.45, Vec3(1, 2, 5));
  for (const GrainArm arm : {GrainArm::contact_point, GrainArm::pair_halves}) {
    const StressReduction result =
        stress_reduction(stress_reduction_sums(packing, {1.0}, arm), packing.volume);
    CHECK(result.fines_stress_share == Approx(result.shire * result.fines_solid_share).epsilon(1e-12));
    CHECK(result.fines_stress_share == Approx(result.sufian).epsilon(1e-12));
    CHECK(result.fines_mean_stress == Approx(result.shire * result.mean_stress).epsilon(1e-12));
  }
}

TEST_CASE("beta is undefined in an isotropic state and the fines' share of the deviator otherwise") {
  const double coarse = 1.0, fine = 0.5;
  const SizeSplit split{1.5};
  const auto beta = [&](const Vec3& force) {
    const Packing packing = rock_salt(4, coarse, fine, force);
    return stress_reduction(stress_reduction_sums(packing, split, GrainArm::contact_point), packing.volume)
        .beta;
  };
  CHECK_FALSE(beta(Vec3(1, 1, 1)).has_value());
  CHECK_FALSE(beta(Vec3(1, 1, 1.005)).has_value());  // noise of a state at rest
  CHECK(beta(Vec3(1, 1, 1.02)).has_value());
  REQUIRE(beta(Vec3(1, 1, 2)).has_value());
  CHECK(*beta(Vec3(1, 1, 2)) == Approx(fine / (coarse + fine)));
}

TEST_CASE("without fines or without contacts the stress reduction factors are zero") {
  const Packing packing = rock_salt(4, 1.0, 0.5, Vec3(1, 1, 2));
  const StressReduction no_fines =
      stress_reduction(stress_reduction_sums(packing, {}, GrainArm::contact_point), packing.volume);
  CHECK(no_fines.shire == 0);
  CHECK(no_fines.sufian == 0);
  Packing loose = packing;
  loose.contacts.clear();
  const StressReduction no_stress =
      stress_reduction(stress_reduction_sums(loose, {1.5}, GrainArm::contact_point), loose.volume);
  CHECK(no_stress.shire == 0);
  CHECK(no_stress.mean_stress == 0);
  CHECK_FALSE(no_stress.beta.has_value());
}

TEST_CASE("stress reduction sums of two and three ranks add up to those of one") {
  const Packing packing = rock_salt(4, 1.0, 0.4, Vec3(1, 2, 3));
  StressReductionSums whole = stress_reduction_sums(packing, {1.0}, GrainArm::contact_point);
  for (const int ranks : {2, 3}) {
    StressReductionSums total;
    for (const Packing& part : shared_out(packing, ranks))
      add_sums(total, stress_reduction_sums(part, {1.0}, GrainArm::contact_point));
    for (std::size_t i = 0; i < as_doubles(whole).size(); ++i)
      CHECK(as_doubles(total)[i] ==
            Approx(as_doubles(whole)[i]).epsilon(1e-13).margin(1e-13));  // order of the sum
  }
}
