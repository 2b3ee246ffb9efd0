#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace suffuse::micromechanics {

/// A point of the cumulative curve: share of the mass (0 to 1) in grains up to `diameter` (m).
struct GradingPoint {
  double diameter = 0;
  double finer = 0;
};

/// Grains of one size and their share of the mass (0 to 1).
struct GradingClass {
  double diameter = 0;
  double mass = 0;
  bool operator==(const GradingClass&) const = default;
};

/// The almost horizontal part of a gap-graded curve.
struct GradingGap {
  double finer_diameter = 0;    ///< largest grain of the fine fraction, m
  double coarser_diameter = 0;  ///< smallest grain of the coarse fraction, m
  double finer = 0;             ///< fines content, share of the mass
  /// Between the ends of the classes; 0 for a grading from a curve. Without spreading the classes, so larger.
  double class_ratio = 0;
  double ratio() const { return coarser_diameter / finer_diameter; }
};

/// What counts as a gap. In a list of classes: a step to the next size by at least `class_ratio`, and at
/// least `class_spacing` times (in logarithms) as wide as the steps beside it. In the curve: a stretch whose
/// ends differ by at least `class_ratio` in size and by at most `curve_rise` in mass.
struct GapRule {
  double class_ratio = 1.5;
  double class_spacing = 3;
  double curve_rise = 0.02;
};

/// A particle size distribution by mass. Sizes in m, shares 0 to 1, interpolation straight over log d. A
/// curve whose first point is not at 0 says nothing of the grains below it: what lies there is undefined.
///
/// From classes, each class is spread over log d to half-way to its neighbours; at a gap and at the two ends
/// over as much as on its other side (a class without neighbours stays one size). So read, the thesis's bins
/// give back its own (H/F)min and D15/d85 of sample 8b (1.590, 2.81; Table 4.1).
class Grading {
 public:
  /// Classes in rising order of size. Throws UserError on fewer than one class, sizes or masses that are not
  /// positive and finite, unsorted or repeated sizes. The masses are normalised.
  static Grading from_classes(std::span<const GradingClass> classes, const GapRule& rule = {});
  /// Cumulative points, rising in size, not falling in mass, ending at 1 (within 0.5 %, then normalised).
  /// Where the first point is above 0 the curve ends there: see unknown_below(). Throws UserError otherwise.
  static Grading from_curve(std::span<const GradingPoint> points, const GapRule& rule = {});
  /// Spheres of one density, in any order (m). Sizes that agree to 1e-6 are one class;
  /// more than 200 sizes are gathered in 200 classes of equal mass.
  static Grading from_grains(std::span<const double> diameters, const GapRule& rule = {});

  /// d_xx, m: the smallest size up to which the share `finer` (0 to 1) of the mass lies. NaN below the end of
  /// the curve.
  double diameter_at(double finer) const;
  /// The largest such size: differs from diameter_at where the curve is flat.
  double diameter_above(double finer) const;
  /// Share of the mass in grains up to this size, and in grains below it (they differ where the curve jumps).
  /// NaN below the end of the curve.
  double finer_at(double diameter) const;
  double finer_below(double diameter) const;

  const std::vector<GradingPoint>& curve() const { return curve_; }
  /// The classes it was made of, normalised; none where it was made of a curve.
  const std::vector<GradingClass>& own_classes() const { return classes_; }
  /// The widest gap with between 1 and 99 % of the mass below it; none in a continuous grading.
  const std::optional<GradingGap>& gap() const { return gap_; }
  /// Share of the mass in grains below smallest(), of which the curve says nothing; 0 where it is known
  /// whole.
  double unknown_below() const { return unknown_below_; }
  double smallest() const { return curve_.front().diameter; }
  double largest() const { return curve_.back().diameter; }

  /// The classes it was made of if these are at most `most`; otherwise `most` classes of equal mass, each at
  /// the size of its middle. Throws UserError where the curve is not known whole.
  std::vector<GradingClass> classes(std::size_t most = 40) const;

 private:
  std::vector<GradingClass> classes_;
  std::vector<GradingPoint> curve_;
  std::optional<GradingGap> gap_;
  double unknown_below_ = 0;
};

/// "the curve ends at 0.074 mm with 33 % finer", for results that need more of it.
std::string curve_end(const Grading& grading);

/// Numbers that describe the curve; NaN where it is not known.
struct GradingIndices {
  double d5 = 0, d10 = 0, d15 = 0, d20 = 0, d30 = 0, d50 = 0, d60 = 0, d85 = 0, d90 = 0;  ///< m
  double uniformity = 0;                                                                  ///< C_u = d60/d10
  double curvature = 0;  ///< C_c = d30²/(d10 d60)
  double sauter = 0;     ///< 1/Σ(w_i/d_i), m: the size of equal surface per volume
};

GradingIndices grading_indices(const Grading& grading);

/// 1/Σ(w_i/d_i) of classes, m (Kovacs's effective diameter, thesis eq 2.6).
double effective_diameter(std::span<const GradingClass> classes);

/// A point of Kenney and Lau's shape curve (key: kenneylau1985): F of the mass up to `diameter`, H between it
/// and four times it.
struct ShapePoint {
  double diameter = 0;
  double finer = 0;     ///< F
  double interval = 0;  ///< H
};

/// The curve at all of its corners (between them H and F are straight over log d, so that every extreme of H,
/// and of H/F, is at one of them), rising in size, from the smallest grain, with F = 0 where the curve is
/// known whole, up to F = `finer_limit`, whose own point is the last.
std::vector<ShapePoint> shape_curve(const Grading& grading, double finer_limit);

/// Fine and coarse fraction of classes cut at a share of the mass, each normalised. A class that the cut
/// meets goes to both sides in part. `finer` strictly between 0 and 1.
std::pair<std::vector<GradingClass>, std::vector<GradingClass>> split_classes(
    std::span<const GradingClass> classes, double finer);

}  // namespace suffuse::micromechanics
