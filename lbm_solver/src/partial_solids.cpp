#include "suffuse/lbm/partial_solids.h"

#include <fmt/format.h>

#include <algorithm>

#include "suffuse/common/error.h"

namespace suffuse::lbm {

std::string name_of(SolidOperator solid_operator) {
  return facts_of(solid_operator).word;
}

std::vector<std::pair<std::string, SolidOperator>> solid_words() {
  std::vector<std::pair<std::string, SolidOperator>> words;
  for (const SolidFacts& facts : kSolidOperators) words.emplace_back(facts.word, facts.solid_operator);
  return words;
}

std::string name_of(SolidWeighting weighting) {
  switch (weighting) {
    case SolidWeighting::fraction:
      return "fraction";
    case SolidWeighting::noble_torczynski:
      return "noble_torczynski";
    case SolidWeighting::viscosity_independent:
      return "viscosity_independent";
  }
  return "unknown";
}

void check(const PartialSolidSettings& settings) {
  if (settings.weighting != SolidWeighting::viscosity_independent && settings.own_coefficients)
    throw_user_error({"fluid solids", "coefficient", "given", "come with weighting viscosity_independent",
                      "the other weightings have none"});
  if (!settings.own_coefficients && !(settings.coefficient > 0))
    throw_user_error({"fluid solids", "coefficient", fmt::format("{:g}", settings.coefficient), "be > 0",
                      "`auto` takes the calibrated one"});
}

double solid_weight(const PartialSolidSettings& settings, const PartialSolidCell& cell,
                    double relaxation_time) {
  if (!(cell.fraction > 0)) return 0;
  const double t = relaxation_time - 0.5, fraction = std::min(cell.fraction, 1.);
  switch (settings.weighting) {
    case SolidWeighting::fraction:
      return fraction;
    case SolidWeighting::noble_torczynski:
      return fraction * t / (1 - fraction + t);
    case SolidWeighting::viscosity_independent:
      break;
  }
  const double strength = settings.own_coefficients ? cell.strength : settings.coefficient * cell.strength;
  return strength * t / (1 - fraction + kLeastOpenShare * std::max(1., cell.fraction) + strength * t);
}

double mean_share(const PartialSolidSettings& settings, const PartialSolidCell& cell,
                  double relaxation_time) {
  return 0.5 * facts_of(settings.solid_operator).share * solid_weight(settings, cell, relaxation_time);
}

HeldTerms held_terms(const PartialSolidSettings& settings, double relaxation_time) {
  const double t = relaxation_time - 0.5;
  const double part = 1 / facts_of(settings.solid_operator).share;
  switch (settings.weighting) {
    case SolidWeighting::fraction:
      return {-1, 0, part};
    case SolidWeighting::noble_torczynski:
      return {-1, part / t, part};
    case SolidWeighting::viscosity_independent:
      break;
  }
  const double slope = part / (t * (settings.own_coefficients ? 1 : settings.coefficient));
  return {part - 1, slope, slope * kLeastOpenShare};
}

}  // namespace suffuse::lbm
