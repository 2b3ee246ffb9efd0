#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "suffuse/micromechanics/grading.h"

namespace suffuse::micromechanics {

/// Grains of one size in a sample.
struct SampleClass {
  double diameter = 0;  ///< m
  double mass = 0;      ///< share of the mass
  double grains = 0;    ///< how many; not rounded
};

/// So many spheres of one density with the mass fractions of a grading.
struct GrainSample {
  std::vector<SampleClass> classes;  ///< rising in size
  double split = 0;                  ///< m; fines are smaller
  double grains = 0, coarse = 0;     ///< numbers
  double fines_share = 0;            ///< of the mass
  double solids = 0;                 ///< volume of all grains, m³
};

/// The classes of a grading for a simulation, at most `most`: its own where it is made of so few; else, of a
/// curve, classes of equal mass at the size of their middle. A gap of the curve is the end of a class, so
/// that the fines content is kept. Throws UserError where the curve is not known whole (cut_below() makes it
/// so).
std::vector<GradingClass> sample_classes(const Grading& grading, std::size_t most = 20);

/// A grading without the grains below a size, m, and the share of the mass that this takes away. Throws
/// UserError where nothing, or no more than one size, is left, or the size is below the end of the curve.
struct CutGrading {
  Grading grading;
  double lost = 0;
};
CutGrading cut_below(const Grading& grading, double smallest);

/// n_i = N (m_i/d_i³)/Σ(m_j/d_j³): the numbers of grains that have these masses.
GrainSample grain_sample(std::span<const GradingClass> classes, double grains, double split);

/// Whole numbers of grains of each class that add up to the sample's: each rounded down, what is left to
/// those with the largest remainders.
std::vector<std::size_t> whole_numbers(const GrainSample& sample);

/// How many grains have so many coarse ones; infinite where none is coarse.
double grains_with_coarse(std::span<const GradingClass> classes, double coarse, double split);

/// How many grains have one of the rarest size: of numbers n_i ~ m_i/d_i^3, their sum over the least.
double grains_with_every_size(std::span<const GradingClass> classes);

/// Share of a box that spheres of this grading are placed in at random without contacts, from the largest to
/// the smallest. Grains larger than 1/2.7 of the largest fill at most 0.3534, below the saturation of equal
/// spheres, 0.38 (key: torquato2006); all grains at most 0.5049. Both are Appendix A's (5.8 mm for 20,000
/// grains).
double placing_solid_fraction(std::span<const GradingClass> classes);

/// Edge of the cube for that, m. Below 15,000 grains it is a tenth wider, as the largest grains are hard to
/// place in a box a few of them wide.
double placing_box_edge(const GrainSample& sample, double solid_fraction);

}  // namespace suffuse::micromechanics
