// Drag on arrays of spheres against Zick & Homsy (docs key: zickhomsy1982), and on random packings against
// converged runs, with the settings that a user gets by default.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

#include "drag_of_packings.h"

using namespace suffuse;
using namespace suffuse::coupling;

namespace {

/// K of the table: lattice sc or fcc, solid fraction c.
double zick_homsy(const std::string& lattice, double c) {
  std::ifstream file(std::string(SUFFUSE_TEST_DATA) + "/zick_homsy_1982.csv");
  for (std::string line; std::getline(file, line);) {
    std::stringstream row(line);
    std::string name, fraction, chi, table, computed;
    std::getline(row, name, ',');
    std::getline(row, fraction, ',');
    std::getline(row, chi, ',');
    std::getline(row, table, ',');
    std::getline(row, computed, ',');
    if (name != lattice || std::abs(std::stod(fraction) - c) > 1e-4) continue;
    return std::stod(table.empty() ? computed : table);
  }
  throw std::runtime_error("no such row in zick_homsy_1982.csv");
}

double error_percent(const std::string& lattice, double c, double diameter, const DragRun& run) {
  const bool face_centred = lattice == "FCC";
  const DragResult r = drag_of(array_packing(c, face_centred), diameter, run);
  return 100 * (r.drag / zick_homsy(lattice, c) - 1);
}

}  // namespace

namespace {

struct Array {
  std::string lattice;
  double c;
};

}  // namespace

TEST_CASE("Drag on arrays up to c = 0.45 is that of Zick & Homsy within 10 and 3 % at 5 and 10 cells") {
  const Array array = GENERATE(Array{"SC", 0.064}, Array{"SC", 0.216}, Array{"SC", 0.45}, Array{"FCC", 0.216},
                               Array{"FCC", 0.343}, Array{"FCC", 0.45});
  DragRun run;
  INFO(array.lattice << " " << array.c);
  for (const double offset : {0.3, 0.8}) {
    run.offset = offset;
    CHECK(std::abs(error_percent(array.lattice, array.c, 5, run)) < 10);
    CHECK(std::abs(error_percent(array.lattice, array.c, 10, run)) < 3);
  }
}

TEST_CASE("Drag on dense arrays is that of Zick & Homsy within 1.5 % at 20 cells") {
  DragRun run;
  run.offset = 0.8;
  CHECK(std::abs(error_percent("SC", 0.45, 20, run)) < 1.5);
}

TEST_CASE("Drag on arrays up to c = 0.45 is that of Zick & Homsy within 1.5 % at 20 cells", "[.long]") {
  const Array array = GENERATE(Array{"SC", 0.064}, Array{"SC", 0.216}, Array{"FCC", 0.216},
                               Array{"FCC", 0.343}, Array{"FCC", 0.45});
  DragRun run;
  run.offset = 0.8;
  INFO(array.lattice << " " << array.c);
  CHECK(std::abs(error_percent(array.lattice, array.c, 20, run)) < 1.5);
}

TEST_CASE("Dense arrays: touching simple cubic and c = 0.6 face-centred within 10 % at 5 cells, 4 % at 10") {
  DragRun run;
  CHECK(std::abs(error_percent("SC", 0.5236, 5, run)) < 10);
  CHECK(std::abs(error_percent("SC", 0.5236, 10, run)) < 4);
  CHECK(std::abs(error_percent("FCC", 0.6, 5, run)) < 10);
  CHECK(std::abs(error_percent("FCC", 0.6, 10, run)) < 4);
}

TEST_CASE("Drag does not change with the relaxation time") {
  // By construction: sigma/nu of each cell and, with TRT's magic number, the solution in between depend on
  // the geometry alone; what is left is the convergence criterion, 1e-4.
  DragRun run;
  const Packing packing = array_packing(0.343, true);
  run.relaxation_time = 1;
  const double at_one = drag_of(packing, 5, run).drag;
  for (const double tau : {0.51, 0.6, 1.5}) {
    run.relaxation_time = tau;
    CHECK(drag_of(packing, 5, run).drag == Approx(at_one).epsilon(1e-3));
  }
}
