#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "grading_samples.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/constriction_criteria.h"
#include "suffuse/micromechanics/internal_stability.h"

using namespace suffuse::micromechanics;
using namespace suffuse::micromechanics::testing;

namespace {

using Points = std::vector<GradingPoint>;

/// Straight over log d, from `smallest` (m) over `decades`.
Grading straight(double smallest, double decades) {
  return Grading::from_curve(Points{{smallest, 0}, {smallest * std::pow(10, decades), 1}});
}

/// Fines 0.1 to 0.2 mm, `share` of the mass; coarse from 0.2 mm × `ratio` to four times it.
Grading gapped(double share, double ratio) {
  const double coarse = 0.2e-3 * ratio;
  return Grading::from_curve(Points{{1e-4, 0}, {2e-4, share}, {coarse, share}, {4 * coarse, 1}});
}

}  // namespace

TEST_CASE("USACE: more than half sand is stable") {
  // 1 to 16 mm straight over log d: finer than 4.75 mm ln 4.75/ln 16 = 0.562 of it.
  const CriterionResult sandy = usace(Grading::from_curve(Points{{1e-3, 0}, {16e-3, 1}}));
  CHECK(sandy.value == Approx(std::log(4.75) / std::log(16)));
  CHECK(sandy.verdict == Verdict::stable);
  CHECK(usace(Grading::from_curve(Points{{2e-3, 0}, {32e-3, 1}})).verdict == Verdict::unstable);
  CHECK(usace(straight(1e-4, 1)).verdict == Verdict::not_applicable);  // no gravel
}

TEST_CASE("Istomina: the coefficient of uniformity, both ends of the transition included") {
  // C_u = 10^(decades/2)
  CHECK(istomina(straight(1e-4, 1.9)).verdict == Verdict::stable);
  CHECK(istomina(straight(1e-4, 2.3)).verdict == Verdict::transitional);
  CHECK(istomina(straight(1e-4, 2.7)).verdict == Verdict::unstable);
  CHECK(istomina(straight(1e-4, 2)).value == Approx(10));
  StabilityLimits strict;
  strict.istomina_stable = 5;
  CHECK(istomina(straight(1e-4, 1.9), strict).verdict == Verdict::transitional);
}

TEST_CASE("Lubochkov: a power law d^k has chi^(k - 0.6) at every size") {
  // In the interior; the curve's own smallest size has W > 0 below nothing, so start well below.
  const Grading fuller = power_law(1e-7, 1e-2, 0.5);
  // Straight pieces of 400 over five decades: 1e-3 of the increments.
  CHECK(lubochkov(fuller).value == Approx(std::pow(2, -0.1)).epsilon(2e-3));
  CHECK(lubochkov(fuller).verdict == Verdict::stable);
  StabilityLimits wide;
  wide.lubochkov_chi = 5;
  CHECK(lubochkov(fuller, wide).value == Approx(std::pow(5, -0.1)).epsilon(5e-3));
  CHECK(lubochkov(power_law(1e-7, 1e-2, 0.8)).verdict == Verdict::unstable);
  CHECK(lubochkov(gapped(0.3, 5)).verdict == Verdict::unstable);
  CHECK(lubochkov(straight(1e-4, 0.5)).verdict == Verdict::not_applicable);
}

TEST_CASE("Kezdi and Sherard: of a straight line, every split gives 10^(decades (0.15 + 0.85 F - 0.85 F))") {
  const CriterionResult on_line = kezdi(straight(1e-4, 4));
  CHECK(on_line.value == Approx(std::pow(10, 4 * 0.15)));  // 3.98
  CHECK(on_line.verdict == Verdict::stable);
  CHECK(kezdi(straight(1e-4, 4.2)).verdict == Verdict::unstable);    // 4.27
  CHECK(sherard(straight(1e-4, 4.2)).verdict == Verdict::stable);    // below 5
  CHECK(sherard(straight(1e-4, 4.9)).verdict == Verdict::unstable);  // 5.43
}

TEST_CASE("Kezdi: beside a gap the coarse side is at its upper end and the fine side below it") {
  // Worst split: 15 % of the coarse part starts the gap's far end, F = (0.3 − 0.15)/0.85; 0.85F = 0.15 is
  // half-way up the fines, 0.1 × 2^0.5 mm; the far end 0.6 mm.
  const SplitMaximum split = maximum_split_ratio(gapped(0.3, 3));
  CHECK(split.ratio == Approx(0.6 / (0.1 * std::sqrt(2.0))));
  CHECK(split.finer == Approx(0.15 / 0.85));
}

TEST_CASE("Kezdi: a coarse end is judged up to the split that leaves nothing but its largest grain") {
  // 90 % from 0.1 to 0.2 mm, the rest up to 1 mm: D15 of the coarse part rises to 1 mm as the split nears the
  // end, while d85 of the fine part stays below 0.1 × 2^(0.85/0.9) mm.
  const Grading tail = Grading::from_curve(Points{{1e-4, 0}, {2e-4, 0.9}, {1e-3, 1}});
  const SplitMaximum split = maximum_split_ratio(tail);
  CHECK(split.ratio == Approx(10 / std::pow(2, 0.85 / 0.9)));  // 5.20
  CHECK(split.finer == 1);
  CHECK(kezdi(tail).verdict == Verdict::unstable);
  CHECK_THAT(kezdi(tail).note, Catch::Contains("split at just below 100 %"));
  // No split of a fine net of them has more, and those near the end tend to it.
  double near_the_end = 0, most = 0;
  for (int k = 0; k < 10000; ++k) {
    const double f = k / 10000.0;
    near_the_end = tail.diameter_above(f + 0.15 * (1 - f)) / tail.diameter_at(0.85 * f);
    most = std::max(most, near_the_end);
  }
  CHECK(most <= split.ratio);
  CHECK(near_the_end == Approx(split.ratio).epsilon(2e-3));  // 1e-4 of the mass: 1.4e-3 of ln 5 in D15
  // The same on a curve of which the finest half is not known.
  const Grading open = Grading::from_curve(Points{{1.5e-4, 0.5}, {2e-4, 0.9}, {1e-3, 1}});
  CHECK(maximum_split_ratio(open).ratio == Approx(1e-3 / open.diameter_at(0.85)));
  CHECK(sherard(open).verdict == Verdict::unstable);
  // Of one that is known above 85 % alone nothing can be said.
  CHECK(maximum_split_ratio(Grading::from_curve(Points{{1e-4, 0.9}, {1e-3, 1}})).ratio == 0);
}

TEST_CASE("Kezdi: a fine end is judged from the first split of which both sizes are known") {
  // From the smallest grain on: D15 of all over it, 10^(1 × 0.15/0.2), larger than what follows.
  const Grading fine_end = Grading::from_curve(Points{{1e-4, 0}, {1e-3, 0.2}, {2e-3, 1}});
  CHECK(maximum_split_ratio(fine_end).ratio == Approx(std::pow(10, 0.15 / 0.2)));
  CHECK(maximum_split_ratio(fine_end).finer == 0);
  // Cut at 5 %, the first split whose d85 is known is at 0.05/0.85; its D15 lies at 0.2 of the mass exactly.
  const Grading cut = Grading::from_curve(Points{{fine_end.diameter_at(0.05), 0.05}, {1e-3, 0.2}, {2e-3, 1}});
  const double f = 0.05 / 0.85;
  CHECK(maximum_split_ratio(cut).ratio == Approx(cut.diameter_above(0.15 + 0.85 * f) / cut.smallest()));
  CHECK(maximum_split_ratio(cut).finer == Approx(f));
  CHECK_THROWS_WITH(maximum_split_ratio(fine_end, 5), Catch::Contains("not per cent"));
}

TEST_CASE("Kenney and Lau: the minimum over F of H/F") {
  // Straight over two decades: H = ln 4/ln 100 = 0.301, F up to 0.20 (C_u = 10): 1.505
  const CriterionResult wide = kenney_lau(straight(1e-4, 2));
  CHECK(wide.value == Approx(std::log10(4) / 2 / 0.20));
  CHECK(wide.verdict == Verdict::stable);
  CHECK(kenney_lau(straight(1e-4, 3.1)).verdict == Verdict::unstable);  // 0.194/0.2
  // Narrow (C_u = 10^0.45 = 2.8): F up to 0.30, 4d beyond the grading, H = 1 − F.
  const ShapeMinimum narrow = minimum_shape_ratio(straight(1e-4, 0.9));
  CHECK(narrow.finer_limit == 0.30);
  CHECK(narrow.ratio == Approx(std::log10(4) / 0.9 / 0.3).epsilon(1e-6));
  // Gap of five: nothing between d and 4d.
  CHECK(kenney_lau(gapped(0.2, 5)).value == Approx(0).margin(1e-12));
  CHECK(kenney_lau(gapped(0.2, 5)).verdict == Verdict::unstable);
}

TEST_CASE("Chapuis: the least secant slope per log cycle") {
  const CriterionResult line = chapuis_kezdi(straight(1e-4, 4));
  CHECK(line.value == Approx(0.25));  // one over the decades, whatever the secant
  CHECK(line.verdict == Verdict::stable);
  CHECK(chapuis_kezdi(straight(1e-4, 4.1)).verdict == Verdict::unstable);  // 0.2439 < 0.15/log 4 = 0.2491
  CHECK(chapuis_kenney_lau(straight(1e-4, 2)).value == Approx(0.5));
  CHECK(chapuis_kenney_lau(straight(1e-4, 3.1)).verdict == Verdict::unstable);
  CHECK(chapuis_kezdi(straight(1e-4, 0.3)).verdict == Verdict::stable);  // all within a factor of four
}

TEST_CASE("slopes are judged from the smallest grain on") {
  // Next to nothing from 0.1 to 0.5 mm, all the rest from there to 2 mm: H at 0.1 mm is 0.01 ln 4/ln 5, and
  // rises to 1 at 0.5 mm.
  const Grading flat = Grading::from_curve(Points{{1e-4, 0}, {5e-4, 0.01}, {2e-3, 1}});
  const double least = 0.01 * std::log(4) / std::log(5);
  CHECK(li_fannin(flat).value == Approx(least / 0.15));
  CHECK(li_fannin(flat).verdict == Verdict::unstable);
  CHECK(chapuis_kezdi(flat).value == Approx(least / std::log10(4)));
  CHECK(chapuis_kezdi(flat).verdict == Verdict::unstable);
  CHECK_THAT(chapuis_kezdi(flat).note, Catch::Contains("from 0.1 mm to"));
  // Kenney and Lau's H/F has no end at F = 0, and is judged where there are finer grains.
  CHECK(std::isfinite(minimum_shape_ratio(flat).ratio));
  CHECK(minimum_shape_ratio(flat).finer > 0);
  const auto points = shape_curve(flat, 0.2);
  CHECK(points.front().finer == 0);
  CHECK(points.front().interval == Approx(least));
}

TEST_CASE("Li and Fannin: the less strict line is judged at its corner as well") {
  // From 4^0 to 4^1 mm, F = 0.1 + 0.12 x and H = 0.12 + 0.06 x: H/F falls from 1.2 as far as the corner of
  // the line at F = 0.15, where H is 0.145; from there on H over 0.15 rises, to 1.13 at F = 0.2.
  const Grading curve =
      Grading::from_curve(Points{{0.25e-3, 0}, {1e-3, 0.10}, {4e-3, 0.22}, {16e-3, 0.40}, {64e-3, 1}});
  CHECK_THAT(li_fannin(curve).note, Catch::Contains("H/min(0.15, F): unstable"));
}

TEST_CASE("Burenkova: between both lines, and what the misprint would say") {
  // Straight: h' = 10^(0.3 D), log h'' = 0.75 D. D = 1: 1.995 within 1.57 and 2.395.
  const CriterionResult inside = burenkova(straight(1e-4, 1));
  CHECK(inside.value == Approx(std::pow(10, 0.3)));
  CHECK(inside.verdict == Verdict::stable);
  CHECK(burenkova(straight(1e-4, 2)).verdict == Verdict::unstable);  // 3.98 above 3.79
  // A steep coarse end: h' = 1.2, h'' = 10: below 1.76, above the printed 0.76.
  const CriterionResult below = burenkova(
      Grading::from_curve(Points{{1e-4, 0}, {2e-4, 0.15}, {2e-3 / 1.2, 0.6}, {2e-3, 0.9}, {3e-3, 1}}));
  CHECK(below.verdict == Verdict::unstable);
  CHECK_THAT(below.note, Catch::Contains("lacks + 1") && Catch::Contains("0.760: stable"));
}

TEST_CASE("Honjo and Liu: gap ratio and fines content") {
  CHECK(honjo(gapped(0.2, 4)).verdict == Verdict::stable);
  CHECK(honjo(gapped(0.2, 4.1)).verdict == Verdict::unstable);
  CHECK(honjo(straight(1e-4, 2)).verdict == Verdict::not_applicable);
  CHECK(liu(gapped(0.2, 4)).verdict == Verdict::unstable);
  CHECK(liu(gapped(0.25, 4)).verdict == Verdict::transitional);
  CHECK(liu(gapped(0.35, 4)).verdict == Verdict::transitional);
  CHECK(liu(gapped(0.4, 4)).verdict == Verdict::stable);
  // Continuous: finer than √(d70 d10), on a straight line at the mean of 0.70 and 0.10.
  CHECK(liu(straight(1e-4, 2)).value == Approx(0.4));
}

TEST_CASE("Li and Fannin: the stricter line, and the note with the other reading") {
  // Straight, H = 0.602/D. D = 3.5: H = 0.172 beats 0.15 at small F but not F = 0.2.
  const CriterionResult strict = li_fannin(straight(1e-4, 3.5));
  CHECK(strict.value == Approx(std::log10(4) / 3.5 / 0.2));
  CHECK(strict.verdict == Verdict::unstable);
  CHECK_THAT(strict.note, Catch::Contains("H/min(0.15, F): stable"));
  CHECK(li_fannin(straight(1e-4, 2)).verdict == Verdict::stable);
}

TEST_CASE("Wan and Fell: logistic form and slopes") {
  const CriterionResult clean = wan_fell_probability(straight(1e-4, 1));
  // h' = 10^0.3, log h'' = 0.75, no silt
  const double z = 3.875 * 0.75 - 3.591 * std::pow(10, 0.3) + 2.436;
  CHECK(clean.value == Approx(std::exp(z) / (1 + std::exp(z))));
  const CriterionResult silty = wan_fell_probability(straight(1e-5, 3));
  const double z_silty = 2.378 * 2.25 - 3.648 * std::pow(10, 0.9) + 3.701;
  CHECK(silty.value == Approx(std::exp(z_silty) / (1 + std::exp(z_silty))));
  // Slopes of a straight line: 30/(0.3 D) = 100/D and 15/(0.15 D) = 100/D.
  CHECK(wan_fell_slopes(straight(1e-5, 2)).value == Approx(50));
  CHECK(wan_fell_slopes(straight(1e-5, 2)).verdict == Verdict::stable);
  // Steep coarse end (30/log 1.2 = 379), flat fines (15/log 10 = 15): unstable.
  CHECK(wan_fell_slopes(Grading::from_curve(Points{
                            {0.5e-5, 0}, {1e-5, 0.05}, {1e-4, 0.2}, {1e-3, 0.6}, {1.2e-3, 0.9}, {1.5e-3, 1}}))
            .verdict == Verdict::unstable);
}

TEST_CASE("the thesis's Table 4.1: 8b from the bins of Appendix A") {
  const Grading sample = appendix("A");
  CHECK(minimum_shape_ratio(sample).ratio == Approx(1.590).margin(5e-4));  // printed to three decimals
  CHECK(minimum_shape_ratio(sample).finer == Approx(0.30));
  // Printed 2.810; ours 2.819: the bins carry three digits, and half a class (6 %) is the resolution of the
  // ends.
  CHECK(maximum_split_ratio(sample).ratio == Approx(2.810).epsilon(0.005));
}

TEST_CASE("the thesis's Table 4.1: 11a from the bins of Appendix B") {
  const Grading sample = appendix("B");
  CHECK(minimum_shape_ratio(sample).ratio == 0);  // printed 0
  // Printed 6.620. The bins of Appendix B are unevenly spaced, 15 % at the smallest size, and half of that is
  // the resolution of the ends; ours 6.92.
  CHECK(maximum_split_ratio(sample).ratio == Approx(6.620).epsilon(0.075));
}

TEST_CASE("every criterion has a limit, a verdict, and a source in the bibliography") {
  std::ifstream file(SUFFUSE_REFERENCES);
  const std::string bibliography{std::istreambuf_iterator<char>(file), {}};
  ConstrictionOptions with_porosity;
  with_porosity.porosity = 0.3;
  auto results = grading_criteria(appendix("A"));
  CHECK(results.size() == 14);
  for (const CriterionResult& more :
       constriction_criteria(analyse_constrictions(appendix("A"), with_porosity), with_porosity))
    results.push_back(more);
  CHECK(results.size() == 14 + 8);
  for (const CriterionResult& result : results) {
    CHECK_THAT(bibliography, Catch::Contains("{" + result.source + ","));
    CHECK_FALSE(result.limit.empty());
    CHECK((result.verdict == Verdict::not_applicable) == std::isnan(result.value));
  }
}

TEST_CASE("criteria that need what lies below the end of a curve do not apply, and say where it ends") {
  // 33 % finer than the last sieve: no d30, no F = 20 %. d60 and d90 are known: from them alone nothing
  // follows.
  const Grading cut = Grading::from_curve(Points{{0.074e-3, 0.33},
                                                 {0.149e-3, 0.35},
                                                 {0.25e-3, 0.42},
                                                 {0.42e-3, 0.51},
                                                 {0.84e-3, 0.59},
                                                 {2e-3, 0.77},
                                                 {2.38e-3, 0.90},
                                                 {4.76e-3, 1}});
  for (const auto criterion : {istomina, kenney_lau, chapuis_kenney_lau, burenkova, liu, li_fannin,
                               wan_fell_probability, wan_fell_slopes}) {
    const CriterionResult result = criterion(cut, {});
    INFO(result.criterion);
    CHECK(std::isnan(result.value));
    CHECK(result.verdict == Verdict::not_applicable);
    CHECK_THAT(result.note, Catch::Contains("the curve ends at 0.074 mm with 33 % finer"));
  }
  // Unstable in the known part is unstable: D15c/d85f = 4.77 at the split at 38.8 %, whose d85f is the last
  // sieve.
  CHECK(kezdi(cut).verdict == Verdict::unstable);
  CHECK(kezdi(cut).value == Approx(4.774).epsilon(1e-3));
  // Stable there is not known to be stable.
  CHECK(sherard(cut).verdict == Verdict::not_applicable);
  CHECK_THAT(sherard(cut).note, Catch::Contains("what is known gives 4.774"));
  CHECK_THROWS_AS(analyse_constrictions(cut, {}), suffuse::UserError);
}

TEST_CASE("a curve that ends with little below it is searched as far as it goes") {
  // Straight over two decades, but for its lowest 3 %.
  const auto at = [](double finer) { return 1e-4 * std::pow(100, finer); };
  const Grading whole = straight(1e-4, 2);
  const Grading ended = Grading::from_curve(Points{{at(0.03), 0.03}, {1e-2, 1}});
  const CriterionResult result = kenney_lau(ended);
  CHECK(result.verdict == kenney_lau(whole).verdict);
  CHECK(result.value == Approx(kenney_lau(whole).value));
  CHECK_THAT(result.note, Catch::Contains("searched as far as the curve ends"));
  CHECK(istomina(ended).value == Approx(istomina(whole).value));
  StabilityLimits strict;
  strict.unknown_fines = 0.02;
  CHECK(kenney_lau(ended, strict).verdict == Verdict::not_applicable);
}
