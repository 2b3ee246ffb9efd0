#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace suffuse::testing {

/// K of a packing in tests/data/packing_drags.csv, or of a bed of 300 spheres in bed_drags.csv (this lattice
/// at twelve cells a Sauter diameter).
inline double reference_drag(const std::string& packing) {
  for (const char* table : {"/packing_drags.csv", "/bed_drags.csv"}) {
    std::ifstream file(SUFFUSE_TEST_DATA + std::string(table));
    for (std::string line; std::getline(file, line);) {
      std::stringstream row(line);
      std::string name, drag;
      std::getline(row, name, ',');
      std::getline(row, drag, ',');
      if (name == packing) return std::stod(drag);
    }
  }
  throw std::runtime_error("no " + packing + " in packing_drags.csv and bed_drags.csv");
}

}  // namespace suffuse::testing
