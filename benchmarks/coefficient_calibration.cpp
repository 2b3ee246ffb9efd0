// Permeability of held spheres in Stokes flow against the coefficient of the viscosity-independent weighting:
// arrays, random packings, equal and graded, at chosen resolutions. One CSV row a run.
//
//   coefficient_calibration --packing random:0.4:16:1 --diameter 5,8 --coefficient 2,4,8
//   coefficient_calibration --packing sc:0.45,fcc:0.6 --diameter 5,10,20 --coefficient auto --operator sc3
//
// Packings: sc:PHI, fcc:PHI, random:PHI:COUNT:SEED, spread:PHI:COUNT:SEED:SPREAD, appendix_c:PHI:SEED,
// gap:PHI:COARSE:SEED:RATIO:FINES_SHARE, grading:PHI:COUNT:FILE:SEED, pair:PHI:GAP, dump:FILE (grains of a
// cube). A box is periodic and a whole number of cells; the diameter that fits it best is taken and printed.
// K is the drag on a sphere over 6 pi mu a U with the Sauter radius, U the superficial velocity:
// permeability/d^2 = 1/(18 phi K).
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <sstream>
#include <string>
#include <vector>

#include "drag_of_packings.h"
#include "link_wise_stokes.h"

namespace {

using namespace suffuse;
using namespace suffuse::coupling;

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

template <class T>
std::vector<T> listed(const std::string& text, T (*read)(const std::string&)) {
  std::vector<T> values;
  for (const std::string& word : split(text, ',')) values.push_back(read(word));
  return values;
}

double read_number(const std::string& word) {
  return word == "auto" ? 0. : std::stod(word);
}

DragResult run_one(const std::string& method, const Packing& packing, double diameter, const DragRun& run) {
  if (method == "interpolated") return link_wise_drag(packing, diameter, LinkRule::interpolated, run.offset);
  if (method == "halfway") return link_wise_drag(packing, diameter, LinkRule::halfway, run.offset);
  return drag_of(packing, diameter, run);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Drag of held spheres against the coefficient of the solid weighting");
  std::string packings = "sc:0.45", diameters = "5", coefficients = "auto", taus = "1", offsets = "0.3",
              solid_operator = "force", weighting = "viscosity_independent", fraction = "exact",
              collision = "trt", law;
  DragRun run;
  bool header = true;
  double speed = 0, flow = 0.002;
  app.add_option("--packing", packings, "comma-separated, see the top of this program's source");
  app.add_option("--diameter", diameters, "Sauter, in cells");
  app.add_option("--coefficient", coefficients, "numbers or auto");
  app.add_option("--relaxation-time", taus);
  app.add_option("--offset", offsets, "of the packing from the lattice, cells");
  app.add_option("--operator", solid_operator,
                 "force, sc1, sc2, sc3; interpolated or halfway: link-wise, another method");
  app.add_option("--weighting", weighting, "fraction, noble_torczynski, viscosity_independent");
  app.add_option("--fraction", fraction, "exact, linear, subcells");
  app.add_option("--collision", collision, "see `lbm collision`");
  app.add_option("--magic", run.magic, "of trt");
  app.add_option("--law", law,
                 "constant,single,crowded,narrow,tight,reach,swept of the automatic coefficient");
  app.add_flag("--movable", run.movable, "coefficients cut as those of grains that may move");
  app.add_option("--water", run.water, "empty layers above and below along z, in box lengths");
  app.add_flag("--through", run.through, "flow along z instead of x");
  app.add_option("--speed", speed, "moves packing and fluid, along x, cells a step: another set of columns");
  app.add_flag("--oblique", run.oblique, "with --speed: motion along (1, 1, 1)");
  app.add_option("--flow", flow, "with --speed: superficial velocity past the packing, cells a step");
  app.add_flag("--single", run.single, "single precision");
  app.add_flag("--header,!--no-header", header, "first row with names");
  CLI11_PARSE(app, argc, argv);
  MPI_Init(&argc, &argv);
  for (const lbm::SolidFacts& facts : lbm::kSolidOperators)
    if (solid_operator == facts.word) run.solid_operator = facts.solid_operator;
  for (const auto w : {lbm::SolidWeighting::fraction, lbm::SolidWeighting::noble_torczynski})
    if (weighting == lbm::name_of(w)) run.weighting = w;
  if (fraction == "linear") run.fraction = FractionMethod::linear;
  if (fraction == "subcells") run.fraction = FractionMethod::subcells;
  if (!law.empty()) {
    const std::vector<double> terms = listed(law, read_number);
    run.law = CoefficientLaw{
        {terms.at(0), terms.at(1), terms.at(2), terms.at(3), terms.at(4), terms.at(5), terms.at(6)}};
  }
  for (const lbm::CollisionFacts& facts : lbm::kCollisionOperators)
    if (collision == facts.word) run.collision = facts.collision_operator;
  if (header && speed > 0)
    std::printf(
        "packing,diameter_cells,relaxation_time,operator,weighting,collision,fraction,coefficient,speed,"
        "stable,held_K,moving_K,force_noise\n");
  else if (header)
    std::printf(
        "packing,phi,diameter_cells,box_cells,relaxation_time,operator,weighting,fraction,offset,"
        "coefficient,crowding,drag_K,steps\n");
  for (const std::string& name : split(packings, ',')) {
    const Packing packing = make_packing(name);
    for (const double diameter : listed(diameters, read_number))
      for (const double tau : listed(taus, read_number))
        for (const double offset : listed(offsets, read_number))
          for (const double k : listed(coefficients, read_number)) {
            run.relaxation_time = tau;
            run.offset = offset;
            run.coefficient = k;
            if (speed > 0) {
              const MovingResult m = moving_drag_of(packing, diameter, run, speed, flow);
              std::printf("%s,%g,%g,%s,%s,%s,%s,%s,%g,%d,%.5f,%.5f,%.4f\n", name.c_str(), diameter, tau,
                          solid_operator.c_str(), weighting.c_str(), collision.c_str(), fraction.c_str(),
                          k > 0 ? std::to_string(k).c_str() : "auto", speed, m.stable ? 1 : 0, m.held, m.drag,
                          m.noise);
              std::fflush(stdout);
              continue;
            }
            const DragResult r = run_one(solid_operator, packing, diameter, run);
            std::printf("%s,%.5f,%.4f,%d,%g,%s,%s,%s,%g,%s,%.4f,%.5f,%ld\n", name.c_str(), r.phi, r.diameter,
                        r.cells, tau, solid_operator.c_str(), weighting.c_str(), fraction.c_str(), offset,
                        k > 0 ? std::to_string(k).c_str() : "auto", r.crowding, r.drag, r.steps);
            std::fflush(stdout);
          }
  }
  MPI_Finalize();
  return 0;
}
