#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace suffuse::testing {

/// K of a packing in tests/data/packing_drags.csv.
inline double reference_drag(const std::string& packing) {
  std::ifstream file(std::string(SUFFUSE_TEST_DATA) + "/packing_drags.csv");
  for (std::string line; std::getline(file, line);) {
    std::stringstream row(line);
    std::string name, drag;
    std::getline(row, name, ',');
    std::getline(row, drag, ',');
    if (name == packing) return std::stod(drag);
  }
  throw std::runtime_error("no " + packing + " in packing_drags.csv");
}

}  // namespace suffuse::testing
