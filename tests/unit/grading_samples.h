#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "suffuse/micromechanics/grading.h"

namespace suffuse::micromechanics::testing {

/// The thesis's gradings, read from input_scripts/gradings (SUFFUSE_GRADINGS), without the program's own
/// reader.
inline Grading grading_file(const std::string& name) {
  std::ifstream file(std::string(SUFFUSE_GRADINGS) + "/" + name + ".csv");
  std::vector<GradingClass> classes;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#' || line[0] == 'd') continue;
    const auto comma = line.find(',');
    classes.push_back({std::stod(line.substr(0, comma)), std::stod(line.substr(comma + 1))});
  }
  return Grading::from_classes(classes);
}

inline Grading appendix(const std::string& letter) {
  return grading_file("appendix_" + letter);
}

/// W = (d/largest)^power down to smallest, in enough points for 1e-3 of W.
inline Grading power_law(double smallest, double largest, double power) {
  std::vector<GradingPoint> points;
  constexpr int steps = 400;
  for (int i = 0; i <= steps; ++i) {
    const double d = smallest * std::pow(largest / smallest, static_cast<double>(i) / steps);
    points.push_back({d, std::pow(d / largest, power)});
  }
  return Grading::from_curve(points);
}

}  // namespace suffuse::micromechanics::testing
