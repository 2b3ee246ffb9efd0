// What chapter 5 reads off the curves of a shear test.
#include <algorithm>
#include <catch2/catch.hpp>

#include "suffuse/common/error.h"
#include "suffuse/micromechanics/shear_response.h"

using namespace suffuse::micromechanics;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double kStep = 1e-4;

/// q/p' rises to 1.2 at 3 % and falls linearly to 0.9 at 15 %; dilation to 6 % at 8 %; alpha 1.6 until 1
/// %, 1.4 at the peak, 0.4 at the end; Z from 5 to 0.8 at 10 %, then 0.9; Z_fc in proportion.
ShearSeries by_hand() {
  const auto line = [](double x, double x0, double y0, double x1, double y1) {
    return y0 + (y1 - y0) * std::min(1.0, std::max(0.0, (x - x0) / (x1 - x0)));
  };
  ShearSeries series;
  for (int k = 0; k <= 1500; ++k) {
    const double e = k * kStep;
    series.axial_strain.push_back(e);
    series.mean_stress.push_back(200e3);
    series.deviator.push_back(200e3 * (e < 0.03 ? line(e, 0, 0, 0.03, 1.2) : line(e, 0.03, 1.2, 0.15, 0.9)));
    series.volumetric_strain.push_back(-line(e, 0, 0, 0.08, 0.06));
    series.void_ratio.push_back(0.3 + line(e, 0, 0, 0.08, 0.06));
    const double z = e < 0.1 ? line(e, 0, 5, 0.1, 0.8) : line(e, 0.1, 0.8, 0.15, 0.9);
    series.coordination.push_back(z);
    series.fine_coordination.push_back(1.1 * z);
    series.coarse_coordination.push_back(2 * z);
    series.stress_reduction.push_back(e < 0.03 ? line(e, 0.01, 1.6, 0.03, 1.4)
                                               : line(e, 0.03, 1.4, 0.15, 0.4));
    series.sliding_share.push_back(e < 0.01 ? line(e, 0, 0, 0.01, 0.3) : line(e, 0.01, 0.3, 0.05, 0.1));
  }
  return series;
}

}  // namespace

TEST_CASE("what chapter 5 reads off its curves, from curves by hand") {
  const ShearResponse r = shear_response(by_hand());
  // A mean over 0.002 of strain rounds the tip of a peak by a quarter of it times the slopes' mean: 4e-2
  // of 1.2.
  CHECK_THAT(*r.peak_ratio, WithinRel(1.2, 0.02));
  CHECK_THAT(r.peak_deviator, WithinRel(240e3, 0.02));
  CHECK_THAT(*r.strain_at_peak, WithinAbs(0.03, 0.001));
  CHECK_THAT(*r.end_ratio, WithinRel(0.9, 1e-12));
  CHECK_THAT(*r.end_volumetric, WithinRel(-0.06, 1e-12));
  CHECK_THAT(*r.strain_of_constant_volume, WithinAbs(0.95 * 0.08, 2 * kStep));
  CHECK(*r.initial_void_ratio == 0.3);
  CHECK(*r.coordination_start == 5);
  CHECK_THAT(*r.coordination_drop, WithinAbs(1 - 0.8 / 5, 0.005));
  CHECK_THAT(*r.coarse_end, WithinRel(1.8, 1e-12));
  CHECK_THAT(*r.sliding_most, WithinRel(0.3, 0.05));
  CHECK_THAT(*r.strain_of_most_sliding, WithinAbs(0.01, 0.001));
  REQUIRE(r.stages);
  CHECK(r.stages->start == 1.6);
  // 2 % of 1.6 are lost at 0.01 + 0.032/10.
  CHECK_THAT(r.stages->strain_first, WithinAbs(0.0132, 2 * kStep));
  CHECK_THAT(*r.stages->ratio_first, WithinRel(1.2 * 0.0132 / 0.03, 0.02));
  CHECK_THAT(r.stages->at_peak, WithinRel(1.4, 0.01));
  CHECK_THAT(r.stages->end, WithinRel(0.4, 1e-12));
}

TEST_CASE("fabrics and the way to instability") {
  const ShearResponse r = shear_response(by_hand());
  // Z_fc = 1 at Z = 0.909, strain 0.0974; alpha = 0.5 at 0.138, where Z_fc is back to 0.88 * 1.1 < 1.
  REQUIRE(r.fabrics.size() == 3);
  CHECK(r.fabrics[0].fabric == FabricCase::overfilled);
  CHECK(r.fabrics[1].fabric == FabricCase::overstressed_fines);
  CHECK_THAT(r.fabrics[1].axial_strain, WithinAbs((5 - 1 / 1.1) / 42, 3 * kStep));
  CHECK(r.fabrics[2].fabric == FabricCase::loose_fines);
  CHECK_THAT(r.fabrics[2].axial_strain, WithinAbs(0.138, 2 * kStep));
  REQUIRE(r.strain_unstable);
  CHECK_THAT(*r.strain_unstable, WithinAbs(4.0 / 42, 2 * kStep));  // Z = 1
}

TEST_CASE("a volume that never stands still and a sample that stays stable have no such strain") {
  ShearSeries series = by_hand();
  for (std::size_t k = 0; k < series.axial_strain.size(); ++k) {
    series.volumetric_strain[k] = -0.5 * series.axial_strain[k];
    series.coordination[k] = 4;
    series.stress_reduction[k] = 1;
  }
  const ShearResponse r = shear_response(series);
  CHECK(!r.strain_of_constant_volume);
  CHECK(!r.strain_unstable);
  CHECK_THAT(r.stages->after_first, WithinRel(1.0, 1e-12));  // constant to the peak
  CHECK_THAT(r.stages->strain_first, WithinAbs(*r.strain_at_peak, 1e-12));
}

TEST_CASE("without a stress or contacts there is no ratio of them") {
  ShearSeries series = by_hand();
  for (std::size_t k = 0; k < 100; ++k) series.mean_stress[k] = series.deviator[k] = 0;
  for (std::size_t k = 1400; k <= 1500; ++k) series.mean_stress[k] = series.deviator[k] = 0;
  for (double& z : series.coordination) z = 0;
  const ShearResponse part = shear_response(series);
  CHECK_THAT(*part.peak_ratio, WithinRel(1.2, 0.02));
  CHECK_THAT(*part.strain_at_peak, WithinAbs(0.03, 0.001));
  CHECK(!part.end_ratio);
  CHECK(*part.coordination_start == 0);
  CHECK(!part.coordination_drop);
  REQUIRE(part.stages);
  CHECK(part.stages->ratio_first);
  for (double& p : series.mean_stress) p = 0;
  const ShearResponse none = shear_response(series);
  CHECK(!none.peak_ratio);
  CHECK(!none.strain_at_peak);
  CHECK(!none.stages);
}

TEST_CASE("columns that are not there stay undefined; series that are no shear test are refused") {
  ShearSeries series = by_hand();
  series.coordination.clear();
  series.stress_reduction.clear();
  series.sliding_share.clear();
  const ShearResponse r = shear_response(series);
  CHECK(!r.coordination_start);
  CHECK(!r.stages);
  CHECK(r.fabrics.empty());
  CHECK(!r.sliding_most);
  series.axial_strain[700] = series.axial_strain[600];
  CHECK_THROWS_WITH(shear_response(series), Contains("grow from sample to sample"));
  series = by_hand();
  series.coordination.pop_back();
  CHECK_THROWS_WITH(shear_response(series), Contains("one length"));
  CHECK_THROWS_WITH(shear_response({{0, 1}, {1, 1}, {0, 0}, {}, {}, {}, {}, {}, {}, {}}),
                    Contains("three or more"));
  CHECK_THROWS_WITH(shear_response({{0, 1e-4, 2e-4}, {1, 1, 1}, {0, 0, 0}, {}, {}, {}, {}, {}, {}, {}}),
                    Contains("past the window"));
}
