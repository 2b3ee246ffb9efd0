#pragma once

#include <mpi.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "suffuse/common/linear_algebra.h"
#include "suffuse/coupling/hydrodynamic_load.h"
#include "suffuse/coupling/particle_port.h"

namespace suffuse::coupling {

/// Spheres without a discrete-element code: held, moved at given velocities, or free to follow the fluid's
/// load, gravity and, where they have one, a spring to where they began. Every rank holds and owns all of
/// them. Images across periodic faces are made.
class PrescribedGrains final : public ParticlePort {
 public:
  struct Grain {
    Vec3 position, velocity = Vec3::Zero(), angular_velocity = Vec3::Zero();
    double radius = 0, density = 2650;
    int id = 0;  ///< 0: given when it comes in
  };

  PrescribedGrains(std::vector<Grain> grains, const Vec3& box, const std::array<bool, 3>& periodic,
                   double step, MPI_Comm communicator = MPI_COMM_WORLD)
      : box_(box), periodic_(periodic), step_(step), communicator_(communicator), list(std::move(grains)) {
    load_.assign(6 * list.size(), 0);
    records_.assign(list.size(), {});
    for (Grain& grain : list) {
      grain.id = ++last_id_;
      anchors_.push_back(grain.position);
    }
  }

  void insert(Grain grain) {
    grain.id = ++last_id_;
    list.push_back(grain);
    load_.resize(6 * list.size(), 0);
    records_.resize(list.size());
    anchors_.push_back(grain.position);
  }
  void erase(std::size_t n) {
    const auto cut = [n](auto& values, int each) {
      const auto from = values.begin() + static_cast<std::ptrdiff_t>(n) * each;
      values.erase(from, from + each);
    };
    cut(load_, 6);
    cut(records_, 1);
    cut(anchors_, 1);
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(n));
  }

  void refresh() override {
    position_.clear();
    velocity_.clear();
    spin_.clear();
    radius_.clear();
    mass_.clear();
    id_.clear();
    owner_.clear();
    for (std::size_t n = 0; n < list.size(); ++n) add(n, list[n].position);
    for (std::size_t n = 0; n < list.size(); ++n)
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j)
          for (int k = -1; k <= 1; ++k) {
            if ((i == 0 && j == 0 && k == 0) || (i != 0 && !periodic_[0]) || (j != 0 && !periodic_[1]) ||
                (k != 0 && !periodic_[2]))
              continue;
            const Vec3 image = list[n].position + Vec3(i * box_[0], j * box_[1], k * box_[2]);
            bool near = true;
            for (int a = 0; a < 3; ++a)
              near &= image[a] > -2 * list[n].radius && image[a] < box_[a] + 2 * list[n].radius;
            if (near) add(n, image);
          }
    arrays_.owned = static_cast<int>(list.size());
    arrays_.total = static_cast<int>(radius_.size());
    arrays_.position = position_.data();
    arrays_.velocity = velocity_.data();
    arrays_.angular_velocity = spin_.data();
    arrays_.radius = radius_.data();
    arrays_.mass = mass_.data();
    arrays_.id = id_.data();
  }
  GrainArrays grains() const override { return arrays_; }

  /// Every rank owns all grains here, so sums go to all.
  void sum_over_copies(std::vector<GrainSums>& sums) override {
    constexpr std::size_t each = sizeof(GrainSums) / sizeof(double);
    std::vector<double> mine(each * list.size(), 0);
    auto* const all = reinterpret_cast<double*>(sums.data());
    for (std::size_t n = 0; n < owner_.size(); ++n)
      for (std::size_t v = 0; v < each; ++v) mine[each * owner_[n] + v] += all[each * n + v];
    MPI_Allreduce(mine.data(), all, static_cast<int>(mine.size()), MPI_DOUBLE, MPI_SUM, communicator_);
  }

  GrainMemory memory() override { return {load_.data(), records_.data()}; }
  bool reads_loads(int) override { return mobile; }
  double time_step() const override { return step_; }

  void advance(int substeps) override {
    if (!mobile) return;
    for (std::size_t n = 0; n < list.size(); ++n) {
      Grain& g = list[n];
      if (free)
        follow(n, substeps);
      else
        g.position += substeps * step_ * g.velocity;
      for (int a = 0; a < 3; ++a)
        if (periodic_[static_cast<std::size_t>(a)])
          g.position[a] -= box_[a] * std::floor(g.position[a] / box_[a]);
    }
  }

  Vec3 force_on(std::size_t n) const { return Eigen::Map<const Vec3>(load_.data() + 6 * n); }
  Vec3 torque_on(std::size_t n) const { return Eigen::Map<const Vec3>(load_.data() + 6 * n + 3); }

  /// From where a grain began, m. Grains on springs do not cross periodic faces.
  Vec3 displacement_of(std::size_t n) const { return list[n].position - anchors_[n]; }

 private:
  /// Its load, gravity and spring, and the drag of its record (virtual_mass.h).
  void follow(std::size_t n, int steps) {
    Grain& g = list[n];
    GrainRecord& record = records_[n];
    const auto at = [](double* values) { return Eigen::Map<Vec3>(values); };
    const double mass = g.density * sphere_volume(g.radius),
                 inertia = micromechanics::sphere_inertia(mass, g.radius);
    // Implicit at the middle of a step.
    const auto push = [step = step_](Vec3& velocity, double m, const Vec3& force, double drag,
                                     const Vec3& towards, Eigen::Map<Vec3> withheld) {
      const Vec3 mean = (m * velocity + 0.5 * step * (force + drag * towards)) / (m + 0.5 * step * drag);
      withheld += step * drag * (mean - towards);
      velocity = 2 * mean - velocity;
      return mean;
    };
    for (int k = 0; k < steps; ++k) {
      const Vec3 held = spring.stiffness * displacement_of(n) + spring.damping * g.velocity;
      const Vec3 mean =
          push(g.velocity, mass, force_on(n) + mass * gravity + at(record.returned_force) - held,
               record.virtual_drag, at(record.velocity), at(record.withheld_impulse));
      g.position += step_ * (spring.stiffness > 0 ? g.velocity : mean);
      push(g.angular_velocity, inertia, torque_on(n) + at(record.returned_torque), record.virtual_spin_drag,
           at(record.angular_velocity), at(record.withheld_spin));
    }
  }

  void add(std::size_t n, const Vec3& position) {
    const Grain& g = list[n];
    for (int a = 0; a < 3; ++a) {
      position_.push_back(position[a]);
      velocity_.push_back(g.velocity[a]);
      spin_.push_back(g.angular_velocity[a]);
    }
    radius_.push_back(g.radius);
    mass_.push_back(g.density * sphere_volume(g.radius));
    id_.push_back(g.id);
    owner_.push_back(n);
  }

  Vec3 box_;
  std::array<bool, 3> periodic_;
  double step_;
  MPI_Comm communicator_;
  int last_id_ = 0;
  std::vector<double> position_, velocity_, spin_, radius_, mass_, load_;
  std::vector<GrainRecord> records_;
  GrainArrays arrays_;
  std::vector<int> id_;
  std::vector<std::size_t> owner_;
  std::vector<Vec3> anchors_;

 public:
  std::vector<Grain> list;
  bool mobile = false;  ///< moved at their velocities
  bool free = false;    ///< with `mobile`: driven by the fluid and gravity
  Vec3 gravity = Vec3::Zero();
  struct {
    double stiffness = 0, damping = 0;  ///< N/m, N s/m
  } spring;                             ///< of every grain that is free
};

}  // namespace suffuse::coupling
