#include "suffuse/lbm/collision_settings.h"

#include <fmt/format.h>

#include <cmath>

#include "suffuse/common/error.h"

namespace suffuse::lbm {

void check(const CollisionSettings& settings) {
  if (!(settings.relaxation_time > 0.5 && std::isfinite(settings.relaxation_time)))
    throw_user_error({"fluid", "relaxation_time", fmt::format("{}", settings.relaxation_time), "be > 0.5",
                      "raise the viscosity or the time step"});
  if (!(settings.magic >= 1e-4 && settings.magic <= 100))
    throw_user_error({"fluid", "magic", fmt::format("{}", settings.magic), "be 1e-4 to 100",
                      "0.1875 keeps walls in place, 0.25 is the most stable"});
  if (!(settings.smagorinsky >= 0 && settings.smagorinsky < 1))
    throw_user_error({"fluid", "smagorinsky", fmt::format("{}", settings.smagorinsky), "lie in [0, 1)",
                      "usual values are 0.1 to 0.2"});
}

std::string name_of(CollisionOperator collision_operator) {
  return facts_of(collision_operator).word;
}

std::vector<std::pair<std::string, CollisionOperator>> collision_words() {
  std::vector<std::pair<std::string, CollisionOperator>> words;
  for (const CollisionFacts& facts : kCollisionOperators)
    words.emplace_back(facts.word, facts.collision_operator);
  return words;
}

std::string words_with_magic() {
  std::string words;
  for (const CollisionFacts& facts : kCollisionOperators)
    if (facts.odd_rate == OddRate::magic) words += (words.empty() ? "" : " or ") + std::string(facts.word);
  return words;
}

}  // namespace suffuse::lbm
