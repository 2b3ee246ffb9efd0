#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace suffuse::micromechanics {

/// Share of the solids below the height of a bed: beyond it there are only the odd grains of the surface.
inline constexpr double kBedShare = 0.99;

/// A least-squares line y = intercept + slope x.
struct LineFit {
  double intercept = 0, slope = 0;
  double slope_error = 0;  ///< standard error of the slope from the scatter about the line
  double scatter = 0;      ///< root mean square distance of y from the line
  double mean_x = 0;
  std::size_t points = 0;

  double at(double x) const { return intercept + slope * x; }
  double root() const { return -intercept / slope; }  ///< where the line meets zero
  /// Standard error of root(), to first order in the scatter: what it would be in repeated runs if the
  /// distances from the line were independent.
  double root_error() const;
};

/// Of at least two points; none where all x are one.
std::optional<LineFit> fit_line(std::span<const double> x, std::span<const double> y);

/// A least-squares parabola.
struct ParabolaFit {
  double constant = 0, linear = 0, square = 0;
  double scatter = 0;  ///< as of the line

  double at(double x) const { return constant + x * (linear + x * square); }
};

/// Of at least three points; none where fewer than three x are distinct.
std::optional<ParabolaFit> fit_parabola(std::span<const double> x, std::span<const double> y);

/// A bed under upward flow at one time, or in the steady part of a held stage. Layers are equal, the first on
/// top.
struct FlowState {
  double time = 0;      ///< s
  double velocity = 0;  ///< superficial, upwards, m/s
  double centre = 0;    ///< height of the grains' centre of mass, m
  std::vector<double> gradient,
      stress;  ///< of the layers: local hydraulic gradient; vertical effective stress, Pa (empty: not known)
};

/// Mean of the layers' gradients: the gradient over the bed.
double bed_gradient(std::span<const double> layers);

/// What lifts layer `layer` (0 on top): the mean gradient of all that lies above its middle. The vertical
/// stress there is Σ_j (i_cr,j − i_j) γ_w h over the layers above and half of its own, so it is zero where
/// this mean reaches i_cr, whatever the layers' conductivities.
double lifting_gradient(std::span<const double> layers, std::size_t layer);

/// First and last index of a hold of the driving gradient.
using Hold = std::pair<std::size_t, std::size_t>;

/// Stretches of at least `least` samples over which the driving gradient does not change (by more than 1e-6
/// of its largest value).
std::vector<Hold> holds_of(std::span<const double> driving, std::size_t least = 3);

/// The means over the last half of each hold; the centre is that of its end.
std::vector<FlowState> held_states(std::span<const FlowState> samples, std::span<const Hold> holds);

struct FluidisationSettings {
  double window_low = 0.2,
         window_high = 0.8;   ///< part of the critical gradient over which the bed rests and lines are fitted
  double window_slack = 0;    ///< added on both sides; holds stand on the ends of the window
  double rise_share = 0.005;  ///< of the bed's height: more than this above the elastic rise, the bed moves
  /// Of the bed's height: least width of the band in which it rests. Hertzian contacts swell by
  /// 1 − (σ'/σ'_0)^(2/3), which at σ' = 0 is above the parabola through 0.2 to 0.8 of it by 0.12 of the whole
  /// swelling (some 1e-3 of the height for E = 5 MPa, less for stiffer grains), and grains shift a little
  /// before the bed lifts: together 3e-4 in the quick scene of input_scripts/03_fluidisation.
  double band_share = 5e-4;
};

/// Where a bed begins to move: it is sure to where its centre has risen by `rise_share` of the bed's height
/// above its elastic rise (a parabola through the window) and stays above; traced back from there to where
/// the rise left the band about it (the larger of `band_share` and four times the scatter).
struct OnsetOfMotion {
  double gradient = 0;         ///< over the bed, where the rise leaves the band, between the two states
  double last_at_rest = 0;     ///< gradient of the last state in the band
  double first_in_motion = 0;  ///< and of the first that is not
  double risen = 0;            ///< gradient where the rise is `rise_share`
  std::size_t state = 0;       ///< index of the first state in motion
};

/// A line of σ'/σ'_0 says where the stress vanishes if the stress follows it: to within this up to the onset
/// of motion, or as far as the run goes, and if it meets zero below kFarGradient times the largest gradient
/// of the run. Between walls with friction the stress is bent: they carry what the window would have falling.
inline constexpr double kBentStress = 0.1, kFarGradient = 1.5;

/// A layer's own numbers. The two gradients are where the line of its stress through the window meets zero,
/// over its own gradient (the axes of thesis Fig. 6.3) and over lifting_gradient(): see kBentStress.
struct LayerFluidisation {
  std::optional<LineFit> flow;              ///< velocity over its own gradient; the slope is k
  std::optional<LineFit> stress;            ///< σ'/σ'_0 over its own gradient
  std::optional<double> local, by_lifting;  ///< critical gradients
};

struct Fluidisation {
  LineFit flow;  ///< velocity over the gradient of the bed; the slope is the conductivity k, m/s
  /// σ'/σ'_0 of the lowest layer over lifting_gradient() there, nearly the gradient over the bed: the first
  /// layer to fail in the thesis (section 6.5.1), and where all grains' weight has been taken off.
  std::optional<LineFit> stress;
  std::optional<OnsetOfMotion> onset;
  std::vector<LayerFluidisation> layers;
  double largest_gradient = 0;  ///< over the bed

  /// Where that line of the lowest layer's stress meets zero, if it says so (kBentStress).
  const std::optional<double>& vanishes() const { return layers.back().by_lifting; }
};

/// Measures a run from states with rising gradients. `critical`: the gradient expected (Terzaghi's), which
/// sets the window; the states in it up to where its upper end is passed for good are fitted. `height` of the
/// bed, m. The first state is that at rest. Throws UserError where fewer than three states, or states over
/// less than a fifth of `critical`, are in the window.
Fluidisation measure_fluidisation(std::span<const FlowState> states, double critical, double height,
                                  const FluidisationSettings& settings = {});

/// The gradient over the bed at which a quantity falls below a level and stays there for `in_a_row` states
/// (straight between states), for the first time; none where it does not, or is below it from the start.
std::optional<double> gradient_at_fall(std::span<const double> gradient, std::span<const double> values,
                                       double level, std::size_t in_a_row = 1);

/// The curve of pressure drop over velocity of a bed that is lifted (thesis Fig. 3.8): while it is packed the
/// drop rises with the velocity, once it floats it is the weight of the grains in the fluid.
struct Lifting {
  LineFit packed;       ///< of drop over weight against velocity, through the window
  double velocity = 0;  ///< where that line meets the weight: the least velocity of fluidisation, m/s
  double largest = 0;   ///< drop over weight
  double floating = 0;  ///< mean of drop over weight from 1.3 times `velocity` on; 0 where none is as fast
};

/// `drop`: over the weight of the grains in the fluid on the same area, of rising `velocity` (m/s, upwards).
/// The line is fitted to the states until the drop has passed `high` for good, of those between `low` and
/// `high`. Throws UserError where fewer than three are.
Lifting measure_lifting(std::span<const double> velocity, std::span<const double> drop, double low = 0.2,
                        double high = 0.7);

}  // namespace suffuse::micromechanics
