// Closures of the averaged flow: limits, and values worked out by hand from the published formulas.
#include <catch2/catch.hpp>
#include <cmath>

#include "suffuse/coupling/methods/drag_laws.h"

using namespace suffuse::coupling;

TEST_CASE("A lone sphere in creeping flow has Stokes' drag") {
  CHECK(drag_factor(DragLaw::beetstra, 0, 0) == Approx(1));
  CHECK(drag_factor(DragLaw::tang, 0, 0) == Approx(1));
  CHECK(drag_factor(DragLaw::gidaspow, 0, 0) == Approx(1));
  // Dallavalle's 4.8^2/24: 4 % below.
  CHECK(drag_factor(DragLaw::di_felice, 0, 0) == Approx(0.96));
  for (const DragLawEntry& entry : drag_laws())
    CHECK(drag_factor(entry.law, 0, 1e-9) == Approx(drag_factor(entry.law, 0, 0)).epsilon(1e-3));
}

TEST_CASE("A lone sphere at higher Reynolds numbers has the standard drag") {
  // Schiller and Naumann's fit of the standard drag curve; the laws for beds were fitted to other data, and
  // lie up to 18 % higher.
  for (const double reynolds : {0.1, 1., 10., 100.}) {
    const double standard = 1 + 0.15 * std::pow(reynolds, 0.687);
    for (const DragLawEntry& entry : drag_laws())
      CHECK(drag_factor(entry.law, 0, reynolds) == Approx(standard).epsilon(0.18));
  }
}

TEST_CASE("In a dense bed creeping flow obeys Carman's or Ergun's equation") {
  const double phi = 0.62, e = 1 - phi;
  const double carman = 180 * phi / (18 * e * e), ergun = 150 * phi / (18 * e * e);
  CHECK(drag_factor(DragLaw::gidaspow, phi, 0) == Approx(ergun));
  CHECK(drag_factor(DragLaw::beetstra, phi, 0) == Approx(carman).epsilon(0.01));
  CHECK(drag_factor(DragLaw::tang, phi, 0) == Approx(carman).epsilon(0.01));
  // Richardson and Zaki's exponent 4.7 continued to a packing lies below either.
  CHECK(drag_factor(DragLaw::di_felice, phi, 0) == Approx(0.96 * std::pow(e, -3.7)));
  // Inertia of Ergun's equation: 1.75/18 Re/e^2.
  CHECK(drag_factor(DragLaw::gidaspow, phi, 100) - ergun == Approx(1.75 * 100 / (18 * e * e)));
}

TEST_CASE("Closures have the published values") {
  // By hand from the formulas as printed, phi = 0.5, Re = 100.
  // Beetstra: 20 + 0.25 (1 + 1.06066) + 41.3/6 (2 + 0.75 + 8.4 0.206063)/(1 + 31.6228 1e-3)
  const double power = std::pow(100., -0.343);
  CHECK(power == Approx(0.206063).epsilon(1e-5));
  CHECK(drag_factor(DragLaw::beetstra, 0.5, 100) ==
        Approx(20.515165 + 6.883333 * (2.75 + 1.730929) / 1.0316228).epsilon(1e-6));
  // Tang: 20.515165 + 100 (0.11 0.75 - 0.07296 + (0.0845 + 1.0304) 0.206063)
  CHECK(drag_factor(DragLaw::tang, 0.5, 100) ==
        Approx(20.515165 + 100 * (0.0825 - 0.07296 + 1.1149 * 0.206063)).epsilon(1e-6));
  // Di Felice: C_d = (0.63 + 0.48)^2 = 1.2321, chi = 3.7 - 0.65 exp(-0.125) = 3.126379
  CHECK(drag_factor(DragLaw::di_felice, 0.5, 100) ==
        Approx(1.2321 * 100 / 24 * std::pow(2., 3.126379)).epsilon(1e-5));
  // The two fits of direct simulations agree within what their authors state, 10 %.
  CHECK(drag_factor(DragLaw::tang, 0.5, 100) ==
        Approx(drag_factor(DragLaw::beetstra, 0.5, 100)).epsilon(0.15));
}

TEST_CASE("Unequal spheres share the drag by their size") {
  for (const DragLawEntry& entry : drag_laws())
    for (const double phi : {0., 0.2, 0.6})
      CHECK(graded_drag_factor(entry.law, phi, 1, 1) == Approx(drag_factor(entry.law, phi, 1)));
  // A lone sphere knows no mean size.
  CHECK(graded_drag_factor(DragLaw::beetstra, 0, 1, 3) == Approx(drag_factor(DragLaw::beetstra, 0, 3)));
  // Two sizes of equal volume, y = 2/3 and 2 (Sauter mean 1 of d = 0.75 and ... ): what all of them receive
  // is what equal spheres of the Sauter size would: sum of x F/y^2 = F, to 4 % of the term 0.064.
  const double y1 = 2. / 3, y2 = 2, phi = 0.6;  // x/y adds up to 1: 0.5/y1 + 0.5/y2 = 1
  const auto graded = [&](double y) { return graded_drag_factor(DragLaw::beetstra, phi, 0, y) / (y * y); };
  CHECK(0.5 * graded(y1) + 0.5 * graded(y2) == Approx(drag_factor(DragLaw::beetstra, phi, 0)).epsilon(0.04));
  // As published to 5 % in a bed.
  const double published =
      (0.4 * y2 + 0.6 * y2 * y2 + 0.064 * 0.4 * 8) * drag_factor(DragLaw::beetstra, phi, 0);
  CHECK(graded_drag_factor(DragLaw::beetstra, phi, 0, y2) == Approx(published).epsilon(0.05));
}
