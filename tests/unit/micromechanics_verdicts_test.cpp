// The thesis's boundaries at the scale of grains, and the names of limits.
#include <catch2/catch.hpp>
#include <set>
#include <string_view>

#include "suffuse/micromechanics/constriction_criteria.h"
#include "suffuse/micromechanics/microscale_verdicts.h"

using namespace suffuse::micromechanics;

TEST_CASE("chapter 4's boundary has two wordings which part where one number alone is low") {
  const auto either = [](double z, double alpha) {
    return microscale_verdict(z, alpha, BoundaryWording::either);
  };
  const auto both = [](double z, double alpha) {
    return microscale_verdict(z, alpha, BoundaryWording::both);
  };
  CHECK(either(3.06, 1.116) == Verdict::stable);  // A(20 %) before shearing (section 5.3.6)
  CHECK(both(3.06, 1.116) == Verdict::stable);
  CHECK(either(0.9, 1.116) == Verdict::unstable);  // and after it
  CHECK(both(0.9, 1.116) == Verdict::stable);
  CHECK(either(1.5, 0.4) == Verdict::unstable);
  CHECK(both(1.5, 0.4) == Verdict::stable);
  CHECK(either(0.3, 0.1) == Verdict::unstable);
  CHECK(both(0.3, 0.1) == Verdict::unstable);
  CHECK(both(1, 0.5) == Verdict::unstable);  // the limits themselves are unstable: <=
  CHECK(either(1, 0.6) == Verdict::unstable);
}

TEST_CASE("chapter 5's cases of fabric are the thesis's own examples") {
  // Section 5.3.7: A(20 %) goes from III to IV, B(20 %) from II to I.
  CHECK(std::string_view(to_string(fabric_case(2, 1.1))) == "III");
  CHECK(std::string_view(to_string(fabric_case(0.8, 0.7))) == "IV");
  CHECK(std::string_view(to_string(fabric_case(1.2, 0.4))) == "II");
  CHECK(std::string_view(to_string(fabric_case(0.8, 0.4))) == "I");
  const MicroscaleLimits other{0.7, 0.3};
  CHECK(fabric_case(0.8, 0.4, other) == FabricCase::overfilled);
}

TEST_CASE("Shire's zones are below 25 %, up to 35 % and above") {
  CHECK(fines_zone(0.2499) == FinesZone::underfilled);
  CHECK(fines_zone(0.25) == FinesZone::transitional);
  CHECK(fines_zone(0.35) == FinesZone::transitional);
  CHECK(fines_zone(0.3501) == FinesZone::overfilled);
}

TEST_CASE("every limit has a name of its own, so that --limit is never ambiguous") {
  std::set<std::string_view> names;
  for (const auto& one : limit_names()) CHECK(names.insert(one.name).second);
  for (const auto& one : constriction_limit_names()) CHECK(names.insert(one.name).second);
  // All members have a name: a struct of doubles is as large as its members.
  CHECK(limit_names().size() * sizeof(double) == sizeof(StabilityLimits));
  CHECK(constriction_limit_names().size() * sizeof(double) == sizeof(ConstrictionLimits));
}
