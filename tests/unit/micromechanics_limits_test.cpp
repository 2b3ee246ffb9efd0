#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "hand_packings.h"
#include "suffuse/micromechanics/bulk_stiffness.h"
#include "suffuse/micromechanics/dem_time_step.h"
#include "suffuse/micromechanics/hertz_contact.h"
#include "suffuse/micromechanics/inertial_number.h"
#include "suffuse/micromechanics/mean_diameter.h"

using namespace suffuse;
using namespace suffuse::micromechanics;
using namespace suffuse::micromechanics::testing;

namespace {

/// The thesis's material in grains of this radius.
GrainMaterial quartz(double radius) {
  return {70e9, 0.3, 2650, 2 * radius};
}

HertzPair pair_of(double radius) {
  return {effective_modulus(quartz(radius)), radius / 2};
}

/// Of Hertz's law, without the overlap: dF/dδ = (6 E*² R* F)^(1/3).
double stiffness_under(const HertzPair& pair, double force) {
  return std::cbrt(6 * pair.effective_modulus * pair.effective_modulus * pair.effective_radius * force);
}

}  // namespace

TEST_CASE("the inertial number of the thesis's limit follows eq 3.17") {
  // ε̇ = 0.11/s, d = 1 mm, ρ = 2650, p' = 200 kPa: 0.11 × 1e-3 × √0.01325
  CHECK(inertial_number({-0.11, 1e-3, 2650, 200e3}) == Approx(0.11 * 1e-3 * 0.11510864433));
  CHECK(inertial_number({1, 1e-3, 2650, 0}) == 0);
  CHECK(inertial_number({1, 1e-3, 2650, -5}) == 0);
}

TEST_CASE("Rayleigh times match the reference values for three radii") {
  // dem_reference_values.csv, printed to seven digits
  CHECK(rayleigh_time(quartz(0.0001333)) == Approx(1.419548e-07).epsilon(3e-4));  // radius rounded there
  CHECK(rayleigh_time(quartz(0.0005)) == Approx(5.324637e-07).epsilon(1e-6));
  CHECK(rayleigh_time(quartz(0.001)) == Approx(1.064927e-06).epsilon(1e-6));
}

TEST_CASE("a linear contact lasts half a period of its spring") {
  // Two grains of 1 g: m* = 0.5 g; k = 1 kN/m: π √(5e-4/1e3)
  CHECK(contact_duration(5e-4, 1e3) == Approx(std::numbers::pi * 7.0710678e-4).epsilon(1e-7));
  // Eq 3.4's 0.22 √(m/k) is 0.0990 of it for two like grains.
  CHECK(kPackingFactor * std::sqrt(1e-3 / 1e3) / contact_duration(5e-4, 1e3) == Approx(0.0990).epsilon(1e-3));
}

TEST_CASE("the spring of `model hooke` stores an impact's energy at Hertz's largest overlap") {
  // Hertz: ½ m* V² = (8/15) E* √R* δ^2.5, so δ = (15 m* V²/(16 E* √R*))^0.4; ½ k δ² of LIGGGHTS's k is the
  // same.
  const HookeContact contact{3e8, 2.5e-4, 1e-6, 0.7};
  const double energy = 0.5 * 1e-6 * 0.7 * 0.7;
  const double overlap = std::pow(15. / 8 * energy / (3e8 * std::sqrt(2.5e-4)), 0.4);
  CHECK(0.5 * hooke_stiffness(contact) * overlap * overlap == Approx(energy).epsilon(1e-12));
}

TEST_CASE("a scaled density lifts a grain's own limit to the reference, and no other grain's") {
  // Rayleigh time ~ d √ρ: a third of the size needs nine times the density.
  const double factor = density_factor(rayleigh_time(quartz(1e-4)), rayleigh_time(quartz(3e-4)), 0.5);
  CHECK(factor == Approx(9));
  GrainMaterial scaled = quartz(1e-4);
  scaled.density *= factor;
  CHECK(rayleigh_time(scaled) == Approx(rayleigh_time(quartz(3e-4))).epsilon(1e-12));
  CHECK(density_factor(2e-7, 1e-7, 0.5) == 1);
  CHECK(density_factor(1e-7, 1e-7, 0.4) == 1);
}

TEST_CASE("Hertz force and stiffness match the reference values") {
  // dem_reference_values.csv: two spheres of 0.5 mm, 8.108404e-4 N at 1e-8 m; of 1 mm, 3.626189e-2 N at 1e-7
  // m.
  CHECK(hertz_force(pair_of(0.0005), 1e-8) == Approx(8.108404e-04).epsilon(1e-6));
  CHECK(hertz_force(pair_of(0.001), 1e-7) == Approx(3.626189e-02).epsilon(1e-6));
  // K = dF/dδ = 3F/(2δ)
  CHECK(hertz_stiffness_at(pair_of(0.001), 1e-7) == Approx(1.5 * 3.626189e-02 / 1e-7).epsilon(1e-6));
}

TEST_CASE(
    "the stiffness number of quartz at 200 kPa is about 3300, and falls by 10^(2/3) for a tenth of the "
    "stiffness") {
  // (3.846154e10 / 2e5)^(2/3), E* from dem_reference_values.csv
  CHECK(effective_modulus(quartz(1e-3)) == Approx(3.846154e10).epsilon(1e-6));
  CHECK(stiffness_number(quartz(1e-3), 200e3) == Approx(std::pow(192307.7, 2.0 / 3)).epsilon(1e-6));
  CHECK(stiffness_number({7e9, 0.3, 2650, 2e-3}, 200e3) ==
        Approx(stiffness_number(quartz(1e-3), 200e3) / std::pow(10, 2.0 / 3)));
}

TEST_CASE("the Voigt bound is the bulk modulus of a face-centred cubic array") {
  // dem_reference_values.csv: "FCC array p=200000 Pa, bulk modulus, 5.085109e8, independent of friction".
  // Contacts at their undeformed distance there too, so only the printed digits limit the agreement.
  const double radius = 1e-3;
  const double force = std::sqrt(2.0) * radius * radius * 200e3;
  const Packing packing = face_centred_cubic(2, radius, push(force));
  const std::vector<double> stiffness(packing.contacts.size(), stiffness_under(pair_of(radius), force));
  CHECK(voigt_bulk_modulus(stiffness_length_sum(packing, stiffness), packing.volume) ==
        Approx(5.085109e8).epsilon(2e-7));
}

TEST_CASE("the Voigt bound is a third of the axial stiffness of a simple cubic array") {
  // dem_reference_values.csv: C11 = 7.627663e8 at 200 kPa; K = (C11 + 2 C12)/3 with C12 = 0.
  const double radius = 1e-3;
  const double force = 4 * radius * radius * 200e3;
  const Packing packing = simple_cubic(3, radius, push(force));
  const std::vector<double> stiffness(packing.contacts.size(), stiffness_under(pair_of(radius), force));
  CHECK(voigt_bulk_modulus(stiffness_length_sum(packing, stiffness), packing.volume) ==
        Approx(7.627663e8 / 3).epsilon(2e-7));
}

TEST_CASE("mean diameters by number, by mass and at half of the mass") {
  Packing packing;
  for (int i = 0; i < 8; ++i) packing.grains.push_back(grain(i + 1, 0.5, Vec3::Zero()));
  packing.grains.push_back(grain(9, 1, Vec3::Zero()));
  const DiameterSums sums = diameter_sums(packing);
  CHECK(mean_diameter(sums, MeanDiameter::number) == Approx(10.0 / 9));
  CHECK(mean_diameter(sums, MeanDiameter::mass) == Approx(1.5));  // eight of 1 weigh as much as one of 2
  std::vector<double> diameters{2, 1, 1, 1, 1, 1, 1, 1, 1};
  CHECK(diameter_finer_than(diameters, 0.5) == 1);
  CHECK(diameter_finer_than(diameters, 0.51) == 2);
  CHECK(diameter_finer_than(diameters, 0.85) == 2);
  CHECK(diameter_finer_than({}, 0.5) == 0);
  CHECK(mean_diameter(DiameterSums{}, MeanDiameter::number) == 0);
}
