#pragma once

#include <string>
#include <vector>

namespace suffuse::coupling {

/// Closures for the drag of the averaged water on a sphere; one header each in methods/averaged/drag.
enum class DragLaw { beetstra, di_felice, gidaspow, tang };

struct DragLawEntry {
  DragLaw law;
  std::string word;    ///< in scripts
  std::string source;  ///< for the manifest
};
/// All of them: what a script may ask for.
const std::vector<DragLawEntry>& drag_laws();
std::string name_of(DragLaw law);

/// F = F_d/(3 pi mu d U) of equal spheres, U = porosity |u - v| the superficial slip and F_d the drag without
/// the force of the pressure gradient. F is 1 for a lone sphere in creeping flow. `solid_fraction` in [0, 1);
/// above 0.75, which no packing reaches, the value at 0.75 holds. `reynolds` = rho U d/mu, any value >= 0.
double drag_factor(DragLaw law, double solid_fraction, double reynolds);

/// The same for a sphere among others of other sizes, `size_ratio` = d over the Sauter mean of all; Reynolds
/// number with that mean. What neighbours add to the drag is weighted with
///
///   (e y + phi y^2 + 0.064 e y^3)/(1 + 0.064 e),   e = 1 - phi
///
/// (docs key: beetstra2007, eq for y; van der Hoef's key: vanderhoef2005). The published weight multiplies
/// all of F and is not divided: then neither equal spheres nor a lone sphere have their own drag back. In
/// beds (phi > 0.4) the two differ by less than 5 %.
double graded_drag_factor(DragLaw law, double solid_fraction, double mean_reynolds, double size_ratio);

}  // namespace suffuse::coupling
