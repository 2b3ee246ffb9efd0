// What `lbm accuracy` chooses for packings that nothing was fitted to: the target is met, and not at a price
// that a sweep of the resolution undercuts by much. References: tests/data/packing_drags.csv,
// bed_drags.csv.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "drag_of_packings.h"
#include "packing_reference.h"
#include "suffuse/coupling/accuracy_choice.h"
#include "user_error_message.h"

using namespace suffuse;
using namespace suffuse::coupling;

namespace {

double sauter(const Packing& packing) {
  double volume = 0, surface = 0;
  for (const double r : packing.radii) volume += 2 * r * r * r, surface += r * r;
  return volume / surface;
}

/// Below which a quarter of the surface lies.
double fine_diameter(const Packing& packing) {
  std::vector<double> radii = packing.radii;
  std::sort(radii.begin(), radii.end());
  const double all = std::inner_product(radii.begin(), radii.end(), radii.begin(), 0.);
  double below = 0;
  for (const double r : radii)
    if ((below += r * r) >= 0.25 * all) return 2 * r;
  return 2 * radii.back();
}

/// A packing in a cube of 1 mm.
AccuracyScene scene_of(const Packing& packing) {
  AccuracyScene scene;
  scene.size = Vec3::Constant(1e-3);
  scene.counted_diameter = 1e-3 * counted_diameter(fine_diameter(packing), sauter(packing));
  scene.solid_fraction = volume_of(packing.radii);
  scene.velocity = 1e-4;
  scene.pressure_range = 1;
  return scene;
}

/// Of the permeability.
double error_at(const std::string& name, const Packing& packing, double spacing) {
  DragRun run;
  double sum = 0;
  for (const double offset : {0.3, 0.8}) {
    run.offset = offset;
    sum += drag_of(packing, 1e-3 * sauter(packing) / spacing, run).drag / 2;
  }
  return std::abs(testing::reference_drag(name) / sum - 1);
}

/// The cheapest of a sweep from which on every finer lattice keeps to the accuracy, too.
double least_cost(const std::string& name, const Packing& packing, const AccuracyWish& wish,
                  const AccuracyScene& scene, const AccuracyChoice& chosen) {
  double least = chosen.cost;
  for (double cells = chosen.cells; cells > 2; cells -= 0.1) {
    const AccuracyChoice other = choice_with_cells(cells, wish, scene);
    if (other.cost == least) continue;
    if (error_at(name, packing, other.spacing) > wish.share) break;
    least = std::min(least, other.cost);
  }
  return least;
}

}  // namespace

TEST_CASE("The accuracy asked for is met by small packings that nothing was fitted to") {
  const std::string name = GENERATE("random:0.4:64:31", "random:0.58:64:31", "spread:0.58:64:31:0.4");
  const double accuracy = GENERATE(0.1, 0.05, 0.03);
  const Packing packing = make_packing(name);
  const AccuracyChoice choice = choose_for_accuracy({accuracy}, scene_of(packing));
  CAPTURE(name, accuracy, choice.cells, choice.relaxation_time);
  CHECK(error_at(name, packing, choice.spacing) < accuracy);
}

TEST_CASE("The accuracy asked for is met by beds that nothing was fitted to, without paying for much more",
          "[.long]") {
  const AccuracyWish wish{GENERATE(0.1, 0.05, 0.03)};
  double price = 1e9;
  for (const char* name : {"random:0.48:300:61", "random:0.6:300:62", "spread:0.57:300:63:0.4"}) {
    const Packing packing = make_packing(name);
    const AccuracyScene scene = scene_of(packing);
    const AccuracyChoice choice = choose_for_accuracy(wish, scene);
    CAPTURE(name, wish.share, choice.cells, choice.relaxation_time);
    CHECK(error_at(name, packing, choice.spacing) < wish.share);
    price = std::min(price, choice.cost / least_cost(name, packing, wish, scene, choice));
  }
  // Over the least that serves all three. Below five cells a bed's error may be of either sign, and some beds
  // are right by luck at two and a half: a choice that knows the mean of many pays for the others. That is
  // 1.7, 2.3 and 2.5.
  CAPTURE(wish.share, price);
  CHECK(price <= 3);
}
