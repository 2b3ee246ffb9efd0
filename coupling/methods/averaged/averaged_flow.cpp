#include "suffuse/coupling/methods/averaged_flow.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "averaged/exact_sums.h"
#include "averaged/grain_drag.h"
#include "averaged/grain_shares.h"
#include "averaged/momentum_terms.h"
#include "averaged/pressure_equation.h"
#include "suffuse/common/error.h"
#include "suffuse/coupling/hydrodynamic_load.h"

namespace suffuse::coupling::averaged {

namespace {

constexpr double kLeastPorosity = 0.05;
/// Share of the stability limits of explicit inertia and viscosity that a sub-step takes.
constexpr double kSafety = 0.8;

std::array<bool, 3> periodic_axes(const WaterFaces& faces) {
  return {faces[0].kind == lbm::FaceKind::periodic, faces[2].kind == lbm::FaceKind::periodic,
          faces[4].kind == lbm::FaceKind::periodic};
}

class AveragedFlow final : public WaterMethod {
 public:
  explicit AveragedFlow(const AveragedFlowSetup& setup);

  void place(const GrainArrays& grains) override;
  void step(const GrainArrays& grains) override;
  const std::vector<Vec3>& forces() const override { return forces_; }
  const std::vector<double>& virtual_masses() const override { return virtual_masses_; }
  bool is_wet(std::size_t grain) const override { return grains_[grain].wet; }
  WaterCell at(const Index3& cell) const override;
  void set_faces(const WaterFaces& faces) override;
  void set_pressure_gradient(const Vec3& value) override { driving_ = value; }
  double largest_speed() const override;
  bool is_finite() const override;
  WaterState state() override {
    return {{"flux_x", &flux_[0]}, {"flux_y", &flux_[1]}, {"flux_z", &flux_[2]}, {"pressure", &pressure_}};
  }
  ConstWaterState state() const override {
    return {{"flux_x", &flux_[0]}, {"flux_y", &flux_[1]}, {"flux_z", &flux_[2]}, {"pressure", &pressure_}};
  }
  std::string summary() const override;
  std::size_t bytes() const override {
    return 100 * sizeof(double) * grid_.cell_count() + sizeof(PlacedGrain) * grains_.size();
  }

 private:
  double face_volume(std::size_t axis, const Index3& at) const {
    return (grid_.side(axis, at) == 0 ? 1 : 0.5) * cell_volume_;
  }
  bool is_given(std::size_t axis, const Index3& at) const {
    const int side = grid_.side(axis, at);
    return side != 0 && box_face(setup_.faces, axis, side).kind != lbm::FaceKind::pressure;
  }
  void read(const GrainArrays& grains);
  struct LargestTerms {
    double amount, carried;
  };
  /// What grains bring to the faces across an axis: of an amount, and of it times their velocity along the
  /// axis.
  void deposit_on_faces(std::size_t axis, double PlacedGrain::*amount, const LargestTerms& largest,
                        double carried_unit, std::vector<double>& amounts, std::vector<double>& carried);
  void deposit_volumes();
  void find_drag();
  void deposit_drag();
  int substeps() const;
  void advance(double time_step);
  void hand_over();
  template <class Values>
  double at_grain(const PlacedGrain& grain, std::size_t axis, const Values& values) const;
  void refresh_velocity();

  AveragedFlowSetup setup_;
  StaggeredGrid grid_;
  double cell_volume_, mu_;
  PressureEquation equation_;
  Vec3 driving_ = Vec3::Zero();
  long all_grains_ = 0;
  std::vector<PlacedGrain> grains_;
  std::vector<double> solid_, solid_over_diameter_, pressure_;  ///< cells
  FaceValues porosity_, solid_flux_, drag_, drag_velocity_;     ///< e, J, b, b_v
  FaceValues flux_, velocity_, stress_, conductance_;           ///< q, u, s, K
  FaceValues mean_velocity_, mean_stress_;                      ///< over the sub-steps
  std::vector<Vec3> forces_;
  std::vector<double> virtual_masses_;
};

AveragedFlow::AveragedFlow(const AveragedFlowSetup& setup)
    : setup_(setup),
      grid_(setup.cells, periodic_axes(setup.faces)),
      cell_volume_(std::pow(setup.spacing, 3)),
      mu_(setup.density * setup.viscosity),
      equation_(grid_, setup.spacing, setup.faces) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t faces = grid_.face_count(axis);
    porosity_[axis].assign(faces, 1);
    for (FaceValues* values : {&solid_flux_, &drag_, &drag_velocity_, &flux_, &velocity_, &stress_,
                               &conductance_, &mean_velocity_, &mean_stress_})
      (*values)[axis].assign(faces, 0);
  }
  for (std::vector<double>* values : {&solid_, &solid_over_diameter_, &pressure_})
    values->assign(grid_.cell_count(), 0);
  set_faces(setup.faces);
}

void AveragedFlow::set_faces(const WaterFaces& faces) {
  double in = 0, through = 0;
  bool closed = true;
  for (std::size_t f = 0; f < lbm::kFaces; ++f) {
    closed &= faces[f].kind != lbm::FaceKind::pressure;
    if (faces[f].kind != lbm::FaceKind::velocity) continue;
    const std::size_t a = f / 2;
    const double area = static_cast<double>(grid_.cell_count()) / grid_.cells()[a];
    const double flow = (f % 2 == 0 ? 1 : -1) * faces[f].velocity[static_cast<Eigen::Index>(a)] * area;
    in += flow;
    through += std::abs(flow);
  }
  if (closed && std::abs(in) > 1e-9 * through)
    throw_user_error({"lbm boundary", "velocity faces", "letting in more or less water than they let out",
                      "balance: water is incompressible here", "make one face a pressure face"});
  setup_.faces = faces;
}

void AveragedFlow::read(const GrainArrays& grains) {
  const auto owned = static_cast<std::size_t>(grains.owned);
  grains_.assign(owned, {});
  long wet = 0;
  for (std::size_t n = 0; n < owned; ++n) {
    PlacedGrain& g = grains_[n];
    g.wet = true;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      const double cells = grid_.cells()[a];
      double s = (grains.position[3 * n + a] - setup_.origin[axis]) / setup_.spacing;
      if (grid_.periodic(a)) s -= cells * std::floor(s / cells);
      g.wet &= s >= 0 && s <= cells;
      if (!g.wet) break;
      g.axes[a] = axis_shares(s, grid_.cells()[a], grid_.periodic(a));
      g.velocity[axis] = grains.velocity[3 * n + a];
    }
    g.diameter = 2 * grains.radius[n];
    g.volume = sphere_volume(grains.radius[n]);
    g.mass = grains.mass[n];
    wet += g.wet ? 1 : 0;
  }
  MPI_Allreduce(&wet, &all_grains_, 1, MPI_LONG, MPI_SUM, setup_.communicator);
}

void AveragedFlow::deposit_on_faces(std::size_t axis, double PlacedGrain::*amount,
                                    const LargestTerms& largest, double carried_unit,
                                    std::vector<double>& amounts, std::vector<double>& carried) {
  ExactSums plain(grid_.face_count(axis), largest.amount, all_grains_);
  ExactSums moving(grid_.face_count(axis), largest.carried, all_grains_);
  for (const PlacedGrain& g : grains_)
    if (g.wet)
      for_each_face_of(g, axis, grid_, [&](std::size_t face, double share) {
        plain.add(face, share * g.*amount);
        moving.add(face, share * g.*amount * g.velocity[static_cast<Eigen::Index>(axis)]);
      });
  plain.finish(setup_.communicator, 1, amounts);
  moving.finish(setup_.communicator, carried_unit, carried);
}

void AveragedFlow::deposit_volumes() {
  double largest[3] = {0, 0, 0};
  for (const PlacedGrain& g : grains_) {
    if (!g.wet) continue;
    largest[0] = std::max(largest[0], g.volume);
    largest[1] = std::max(largest[1], g.volume / g.diameter);
    largest[2] = std::max(largest[2], g.volume * g.velocity.cwiseAbs().maxCoeff());
  }
  MPI_Allreduce(MPI_IN_PLACE, largest, 3, MPI_DOUBLE, MPI_MAX, setup_.communicator);
  ExactSums solid(grid_.cell_count(), largest[0], all_grains_);
  ExactSums over_diameter(grid_.cell_count(), largest[1], all_grains_);
  for (const PlacedGrain& g : grains_)
    if (g.wet)
      for_each_cell_of(g, grid_, [&](std::size_t cell, double share) {
        solid.add(cell, share * g.volume);
        over_diameter.add(cell, share * g.volume / g.diameter);
      });
  solid.finish(setup_.communicator, 1 / cell_volume_, solid_);
  over_diameter.finish(setup_.communicator, 1 / cell_volume_, solid_over_diameter_);
  double least = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    deposit_on_faces(axis, &PlacedGrain::volume, {largest[0], largest[2]}, 1 / cell_volume_, porosity_[axis],
                     solid_flux_[axis]);
    grid_.for_each_face(axis, [&](const Index3& at, std::size_t n) {
      porosity_[axis][n] = 1 - porosity_[axis][n] / face_volume(axis, at);
      least = std::min(least, porosity_[axis][n]);
      if (grid_.side(axis, at) != 0) solid_flux_[axis][n] = 0;  // mirror images move the other way
    });
  }
  if (least < kLeastPorosity)
    throw_user_error({"lbm method averaged", "grains",
                      fmt::format("leaving {:.2g} of a cell to the water", least),
                      fmt::format("leave at least {:g}", kLeastPorosity),
                      "take a larger `lbm lattice spacing`: about three mean diameters"});
}

void AveragedFlow::refresh_velocity() {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t n = 0; n < flux_[axis].size(); ++n)
      velocity_[axis][n] = flux_[axis][n] / porosity_[axis][n];
}

template <class Values>
double AveragedFlow::at_grain(const PlacedGrain& grain, std::size_t axis, const Values& values) const {
  double sum = 0;
  for_each_face_of(grain, axis, grid_, [&](std::size_t face, double share) { sum += share * values[face]; });
  return sum;
}

/// z of every grain, from the water as the last step left it.
void AveragedFlow::find_drag() {
  for (PlacedGrain& g : grains_) {
    if (!g.wet) continue;
    double phi = 0, over_diameter = 0, own = 0;
    for_each_cell_of(g, grid_, [&](std::size_t cell, double share) {
      phi += share * solid_[cell];
      over_diameter += share * solid_over_diameter_[cell];
      own += share * share;
    });
    const double mean_diameter = setup_.closures.graded ? phi / over_diameter : g.diameter;
    own *= g.volume / cell_volume_;
    const double share = own_share(phi - own);
    phi = std::max(0., phi - share * own);
    Vec3 slip;
    for (std::size_t a = 0; a < 3; ++a)
      slip[static_cast<Eigen::Index>(a)] =
          at_grain(g, a, velocity_[a]) - g.velocity[static_cast<Eigen::Index>(a)];
    const double reynolds = (1 - phi) * slip.norm() * mean_diameter / setup_.viscosity;
    const double factor = graded_drag_factor(setup_.closures.drag, phi, reynolds, g.diameter / mean_diameter);
    const double drag = 3 * std::numbers::pi * mu_ * g.diameter * (1 - phi) * factor;
    g.drag = drag_of_mean_velocity(drag, share, mu_, setup_.spacing,
                                   slip.norm() * setup_.spacing / setup_.viscosity, drag * phi / g.volume);
  }
}

void AveragedFlow::deposit_drag() {
  double largest[2] = {0, 0};
  for (const PlacedGrain& g : grains_) {
    largest[0] = std::max(largest[0], g.drag);
    largest[1] = std::max(largest[1], g.drag * g.velocity.cwiseAbs().maxCoeff());
  }
  MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, setup_.communicator);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    deposit_on_faces(axis, &PlacedGrain::drag, {largest[0], largest[1]}, 1, drag_[axis],
                     drag_velocity_[axis]);
    grid_.for_each_face(axis, [&](const Index3& at, std::size_t n) {
      drag_[axis][n] /= face_volume(axis, at);
      drag_velocity_[axis][n] /= face_volume(axis, at);
    });
  }
}

int AveragedFlow::substeps() const {
  double rate = 6 * setup_.viscosity / (setup_.spacing * setup_.spacing);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double fastest = 0;
    for (const double u : velocity_[axis]) fastest = std::max(fastest, std::abs(u));
    rate += fastest / setup_.spacing;
  }
  constexpr double most = 1e6;
  return static_cast<int>(std::min(most, std::max(1., std::ceil(rate * setup_.time_step / kSafety))));
}

void AveragedFlow::advance(double time_step) {
  const double rho = setup_.density;
  const MomentumTerms terms{grid_, setup_.faces, setup_.spacing, mu_, velocity_, flux_};
  FaceValues next = flux_;
  for (std::size_t axis = 0; axis < 3; ++axis)
    grid_.for_each_face(axis, [&](const Index3& at, std::size_t n) {
      const double e = porosity_[axis][n];
      if (is_given(axis, at)) {
        const WaterFace& face = box_face(setup_.faces, axis, grid_.side(axis, at));
        next[axis][n] =
            face.kind == lbm::FaceKind::velocity ? face.velocity[static_cast<Eigen::Index>(axis)] : 0;
        conductance_[axis][n] = 0;
        return;
      }
      stress_[axis][n] = driving_[static_cast<Eigen::Index>(axis)] + terms.viscous(axis, at, n);
      const double momentum = rho * (flux_[axis][n] / time_step - terms.inertia(axis, at, n)) +
                              e * stress_[axis][n] + drag_velocity_[axis][n];
      const double resistance = rho * e / time_step + drag_[axis][n];
      next[axis][n] = e * momentum / resistance;
      conductance_[axis][n] = e * e / resistance;
    });
  equation_.solve(next, solid_flux_, conductance_, setup_.faces, pressure_);
  for (std::size_t axis = 0; axis < 3; ++axis)
    grid_.for_each_face(axis, [&](const Index3& at, std::size_t n) {
      if (!is_given(axis, at)) {
        const double gradient = equation_.gradient(axis, at, setup_.faces, pressure_);
        next[axis][n] -= conductance_[axis][n] * gradient;
        stress_[axis][n] -= gradient;
      }
      flux_[axis][n] = next[axis][n];
      velocity_[axis][n] = flux_[axis][n] / porosity_[axis][n];
      if (is_given(axis, at))  // what would drive the flux that is given
        stress_[axis][n] =
            (drag_[axis][n] * velocity_[axis][n] - drag_velocity_[axis][n]) / porosity_[axis][n];
    });
}

void AveragedFlow::hand_over() {
  forces_.assign(grains_.size(), Vec3::Zero());
  virtual_masses_.assign(grains_.size(), 0);
  for (std::size_t n = 0; n < grains_.size(); ++n) {
    const PlacedGrain& g = grains_[n];
    if (!g.wet) continue;
    double e = 0;
    for_each_cell_of(g, grid_, [&](std::size_t cell, double share) { e += share * (1 - solid_[cell]); });
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      forces_[n][axis] = g.drag * (at_grain(g, a, mean_velocity_[a]) - g.velocity[axis]) +
                         g.volume * at_grain(g, a, mean_stress_[a]);
    }
    virtual_masses_[n] = inertia_for_step(g, std::max(e, 0.2), setup_);
  }
}

void AveragedFlow::place(const GrainArrays& grains) {
  read(grains);
  deposit_volumes();
}

void AveragedFlow::step(const GrainArrays& grains) {
  place(grains);
  refresh_velocity();
  find_drag();
  deposit_drag();
  const int count = substeps();
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (FaceValues* values : {&mean_velocity_, &mean_stress_})
      std::fill((*values)[axis].begin(), (*values)[axis].end(), 0.);
  for (int k = 0; k < count; ++k) {
    advance(setup_.time_step / count);
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t n = 0; n < flux_[axis].size(); ++n) {
        mean_velocity_[axis][n] += velocity_[axis][n] / count;
        mean_stress_[axis][n] += stress_[axis][n] / count;
      }
  }
  hand_over();
}

WaterCell AveragedFlow::at(const Index3& cell) const {
  WaterCell water;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const Index3& face : grid_.faces_of(axis, cell)) {
      const std::size_t n = grid_.face(axis, face);
      water.solid_flux[static_cast<Eigen::Index>(axis)] += 0.5 * solid_flux_[axis][n];
      water.flux[static_cast<Eigen::Index>(axis)] += 0.5 * (flux_[axis][n] + solid_flux_[axis][n]);
    }
  water.solid_fraction = solid_[grid_.cell(cell)];
  water.pressure = pressure_[grid_.cell(cell)];
  return water;
}

double AveragedFlow::largest_speed() const {
  double squared = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double fastest = 0;
    for (const double u : velocity_[axis]) fastest = std::max(fastest, std::abs(u));
    squared += fastest * fastest;
  }
  return std::sqrt(squared);
}

bool AveragedFlow::is_finite() const {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double q : flux_[axis]) sum += 0 * q;
  for (const double p : pressure_) sum += 0 * p;
  return sum == 0;
}

std::string AveragedFlow::summary() const {
  std::string source;
  for (const DragLawEntry& entry : drag_laws())
    if (entry.law == setup_.closures.drag) source = entry.source;
  return fmt::format("averaged flow, drag {} ({}){}", name_of(setup_.closures.drag), source,
                     setup_.closures.graded ? ", weighted by size" : "");
}

}  // namespace

}  // namespace suffuse::coupling::averaged

namespace suffuse::coupling {

std::unique_ptr<WaterMethod> averaged_flow(const AveragedFlowSetup& setup) {
  return std::make_unique<averaged::AveragedFlow>(setup);
}

}  // namespace suffuse::coupling
