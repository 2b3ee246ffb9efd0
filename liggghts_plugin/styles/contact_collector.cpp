#include "contact_collector.h"

#include <Eigen/Geometry>  // cross products
#include <algorithm>
#include <cmath>

#include "atom.h"
#include "lammps.h"
#include "local_collector.h"
#include "pair_gran.h"

using namespace LAMMPS_NS;
using suffuse::Vec3;

namespace {

constexpr double kStretch = 1e-13;  // above the rounding of the limit, some 1e-16, below any result's digits
constexpr double kBeyondLimit = 1e6;   // of a grain's diameter: a spring so long is at its limit in any law
constexpr double kBeyondSpeed = 1e12;  // rad/s: so fast, a viscous friction is at its limit
/// A force within this share of the limit is at it; damping meets it so closely once in 10⁹ contacts.
constexpr double kAtLimit = 1e-9;

/// Where the tangential spring stands among a contact's history values; −1 if the law has none.
int spring_offset(PairGran& pair) {
  struct Open : PairGran {
    static int find(PairGran& pair, const char* name) {
      const auto& values = pair.*(&Open::history_arg);
      for (std::size_t k = 0; k < values.size(); ++k)
        if (values[k].name == name) return static_cast<int>(k);
      return -1;
    }
  };
  return Open::find(pair, "shearx");
}

Vec3 tangential_part(const Vec3& force, const Vec3& branch) {
  const Vec3 normal = branch.normalized();
  return force - force.dot(normal) * normal;
}

/// A unit vector in the plane of contact.
Vec3 some_tangent(const Vec3& branch) {
  int least = 0;
  branch.cwiseAbs().minCoeff(&least);
  return branch.cross(Vec3::Unit(least)).normalized();
}

}  // namespace

std::unique_ptr<ContactCollector> ContactCollector::create(LAMMPS* lmp) {
  return suffuse::make_local_collector(lmp, [&](int& first, char** words) {
    return std::unique_ptr<ContactCollector>(new ContactCollector(lmp, first, words));
  });
}

const std::vector<ContactCollector::Found>& ContactCollector::sweep(PairGran& pair, bool friction) {
  ComputePairGranLocal* previous = pair.cpl();
  if (previous != nullptr) pair.unregister_compute_pair_local(previous);
  int history_values = 0;
  pair.register_compute_pair_local(this, history_values);
  const int values = pair.is_history() ? pair.dnum() : 0;
  found_.clear();
  if (values > 0) evaluate(pair);
  save_springs(values);
  stretch_springs(values);
  evaluate(pair);
  result_ = found_;
  if (friction) measure_friction(pair, spring_offset(pair));
  restore_springs();
  pair.unregister_compute_pair_local(this);
  if (previous != nullptr) pair.register_compute_pair_local(previous, history_values);
  return result_;
}

void ContactCollector::evaluate(PairGran& pair) {
  found_.clear();
  pair.compute_pgl(0, 0);
}

void ContactCollector::add_pair(int i, int j, double fx, double fy, double fz, double, double, double,
                                double* history, const double* const) {
  const double* xi = atom->x[i];
  const double* xj = atom->x[j];
  Found found;
  found.i = i;
  found.j = j;
  found.branch = Vec3(xi[0] - xj[0], xi[1] - xj[1], xi[2] - xj[2]);
  found.force = Vec3(fx, fy, fz);
  found.history = history;
  found_.push_back(found);
}

void ContactCollector::save_springs(int values) {
  saved_values_ = values;
  saved_.clear();
  for (const Found& contact : found_)
    if (contact.history != nullptr) saved_.insert(saved_.end(), contact.history, contact.history + values);
}

void ContactCollector::restore_springs() {
  const double* saved = saved_.data();
  for (const Found& contact : result_) {
    if (contact.history == nullptr) continue;
    std::copy(saved, saved + saved_values_, contact.history);
    saved += saved_values_;
  }
}

void ContactCollector::stretch_springs(int values) {
  for (const Found& contact : found_)
    for (int k = 0; contact.history != nullptr && k < values; ++k) contact.history[k] *= 1 + kStretch;
}

/// The normal force that a law caps its spring with is not that of the contact: sjkr cohesion is added after
/// the cap, or before it with `tangential_reduce`, capillary forces likewise, and damping is added to the
/// tangential force where the spring is below its limit only. So the law is asked: far stretched springs
/// answer with the limit, springs of no length with what is added to them. Either way of stretching, so that
/// a viscous force beside the spring cancels.
void ContactCollector::measure_friction(PairGran& pair, int spring) {
  const bool has_spring = spring >= 0 && !result_.empty() && result_.front().history != nullptr;
  const auto with_springs = [&](double length) {
    set_springs(spring, length);
    return tangential_forces(pair);
  };
  std::vector<Vec3> forth, back, slack;
  if (has_spring) {
    forth = with_springs(kBeyondLimit);
    back = with_springs(-kBeyondLimit);
    slack = with_springs(0);
  } else {
    forth = tangential_forces_while_spinning(pair, kBeyondSpeed);
    back = tangential_forces_while_spinning(pair, -kBeyondSpeed);
  }
  for (std::size_t c = 0; c < result_.size(); ++c) {
    const double limit = (forth[c] - back[c]).norm() / 2;
    const Vec3 beside = (forth[c] + back[c]) / 2;
    const Vec3 tangential = tangential_part(result_[c].force, result_[c].branch);
    double friction = (tangential - beside).norm();
    const bool at_limit = std::abs(friction - limit) <= kAtLimit * limit;
    if (at_limit)
      friction = limit;
    else if (has_spring)
      friction = (tangential - slack[c]).norm();
    result_[c].friction_limit = limit;
    result_[c].spring_force = friction;
  }
}

void ContactCollector::set_springs(int spring, double length) {
  for (const Found& contact : result_) {
    const Vec3 value = length * contact.branch.norm() * some_tangent(contact.branch);
    std::copy(value.data(), value.data() + 3, contact.history + spring);
  }
}

std::vector<Vec3> ContactCollector::tangential_forces(PairGran& pair) {
  evaluate(pair);
  std::vector<Vec3> forces;
  for (const Found& contact : found_) forces.push_back(tangential_part(contact.force, contact.branch));
  return forces;
}

/// A law without a spring has a viscous friction. Spins reach its limit and leave the normal velocities.
std::vector<Vec3> ContactCollector::tangential_forces_while_spinning(PairGran& pair, double speed) {
  const Vec3 spin = speed * Vec3(0.5377, 0.6180, 0.5734).normalized();  // no crystal direction
  const auto all = static_cast<std::size_t>(atom->nlocal + atom->nghost);
  std::vector<Vec3> own(all);
  for (std::size_t i = 0; i < all; ++i) {
    double* omega = atom->omega[i];
    own[i] = Vec3(omega[0], omega[1], omega[2]);
    std::copy(spin.data(), spin.data() + 3, omega);
  }
  const std::vector<Vec3> forces = tangential_forces(pair);
  for (std::size_t i = 0; i < all; ++i) std::copy(own[i].data(), own[i].data() + 3, atom->omega[i]);
  return forces;
}
