#pragma once

#include <string>
#include <vector>

#include "suffuse/micromechanics/directional_distribution.h"

namespace suffuse::analysis {

/// A distribution over the bins and its fit.
struct Rose {
  const char* name;
  const char* unit;
  std::vector<double> values;
  micromechanics::HarmonicFit fit;
};

/// Contacts, force-weighted contacts, and the mean normal and tangential force over the angle, with fits up
/// to `order`.
std::vector<Rose> roses_of(const micromechanics::PlaneDistribution& plane, int order);

/// All of them as CSV, a row a bin.
void write_rose(const std::string& path, const micromechanics::PlaneDistribution& plane,
                const std::vector<Rose>& roses, const std::string& who);

}  // namespace suffuse::analysis
