#pragma once

#include <set>
#include <string>

#include "declared_words.h"
#include "lbm_request.h"

namespace suffuse::coupling {

using D = Declare<LbmRequest>;
using Line = Command<LbmRequest>;
using Given = std::set<std::string>;

inline const Options<bool> kYesNo{{"yes", true}, {"no", false}};

/// A value of a word that a saved state keeps: ten digits tell two scripts apart, not two ways to round.
inline std::string digits(double value) {
  return fmt::format("{:.10g}", value);
}

}  // namespace suffuse::coupling
