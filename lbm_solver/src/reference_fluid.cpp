#include "suffuse/lbm/reference_fluid.h"

#include "lattice_vectors.h"

namespace suffuse::lbm {

ReferenceFluid::ReferenceFluid(const FluidSettings& settings, const Index3& cells)
    : settings_(settings), cells_(cells) {
  check(settings.collision);
  check(settings.faces, cells);
  const std::size_t total = CellBox{{0, 0, 0}, cells}.volume();
  CellPopulations rest;
  for (int i = 0; i < kDirections; ++i) rest[static_cast<std::size_t>(i)] = kWeight[i];
  before_.assign(total, rest);
  after_ = before_;
  labels_.assign(total, 0);
  solids_.assign(total, {});
  exchange_.assign(total, Vec3::Zero());
  solid_forces_.fill(Vec3::Zero());
}

std::size_t ReferenceFluid::index(const Index3& cell) const {
  return static_cast<std::size_t>(cell[0] + cells_[0] * (cell[1] + cells_[1] * cell[2]));
}

void ReferenceFluid::set_solids(const std::function<std::uint8_t(const Index3& cell)>& label_of) {
  for_each_cell({{0, 0, 0}, cells_}, [&](int x, int y, int z) {
    labels_[index({x, y, z})] = label_of({x, y, z});
  });
}

double ReferenceFluid::population(int direction, const Index3& cell) const {
  return before_[index(cell)][static_cast<std::size_t>(direction)] - kWeight[direction];
}

void ReferenceFluid::set_population(int direction, const Index3& cell, double value) {
  before_[index(cell)][static_cast<std::size_t>(direction)] = value + kWeight[direction];
}

FluidPoint ReferenceFluid::at(const Index3& cell) const {
  if (labels_[index(cell)] != 0) return {};
  double density = 0;
  Vec3 momentum = 0.5 * force_;
  for (int i = 0; i < kDirections; ++i) {
    const double f = before_[index(cell)][static_cast<std::size_t>(i)];
    density += f;
    momentum += f * velocity_of(i);
  }
  const Vec3 velocity = settings_.collision.incompressible ? momentum : Vec3(momentum / density);
  const PartialSolidCell& solids = solids_[index(cell)];
  if (!partial_ || !(solids.strength > 0)) return {density, velocity};
  const double weight = mean_share(*partial_, solids, settings_.collision.relaxation_time);
  return {density, (1 - weight) * velocity + weight * solids.momentum / solids.strength};
}

Vec3 ReferenceFluid::solid_force(std::uint8_t label) const {
  return solid_forces_[label];
}

FluidPoint ReferenceFluid::after_collision(const Index3& cell) const {
  double density = 0;
  Vec3 momentum = -0.5 * force_;
  for (int i = 0; i < kDirections; ++i) {
    density += after_[index(cell)][static_cast<std::size_t>(i)];
    momentum += after_[index(cell)][static_cast<std::size_t>(i)] * velocity_of(i);
  }
  return {density, settings_.collision.incompressible ? momentum : Vec3(momentum / density)};
}

double ReferenceFluid::lost_at_edges(const Index3& cell, int straight) const {
  const Vec3 outward = velocity_of(straight);
  double lost = 0;
  for (int i = 1; i < kDirections && outward.squaredNorm() == 1; ++i) {
    const Vec3 across = velocity_of(i) - outward;  // of a diagonal link: along the face
    if (across.squaredNorm() != 1 || velocity_of(i).squaredNorm() != 2) continue;
    const FaceCondition *own = nullptr, *side = nullptr;
    for (int a = 0; a < 3; ++a) {
      const auto at = static_cast<std::size_t>(a);
      const int next = cell[at] + kVelocity[i][a];
      if (next >= 0 && next < cells_[at]) continue;
      const FaceCondition& met = settings_.faces[static_cast<std::size_t>(face_at(a, next > 0))];
      (outward[a] != 0 ? own : side) = &met;
    }
    if (own == nullptr || side == nullptr || own->kind != FaceKind::velocity || own->velocity.isZero(0))
      continue;
    if (side->kind == FaceKind::no_slip) lost += 6 * kWeight[i] * outward.dot(own->velocity);
    if (side->kind == FaceKind::velocity)
      lost += 3 * kWeight[i] * outward.dot(own->velocity - side->velocity);
  }
  return lost;
}

double ReferenceFluid::entering(const Index3& cell, int direction) {
  Index3 source, crossed{0, 0, 0};
  for (std::size_t a = 0; a < 3; ++a) {
    source[a] = cell[a] - kVelocity[direction][a];
    if (source[a] < 0) crossed[a] = -1;
    if (source[a] >= cells_[a]) crossed[a] = 1;
  }
  const int out = opposite(direction);
  const double left = after_[index(cell)][static_cast<std::size_t>(out)];
  const LinkRule rule = link_rule(settings_.faces, crossed);
  const FaceCondition& one = settings_.faces[static_cast<std::size_t>(rule.face)];
  const FaceCondition& two = settings_.faces[static_cast<std::size_t>(rule.other)];
  if (rule.action == LinkRule::Action::bounce) {
    if (one.kind == FaceKind::no_slip) return left;
    const Vec3 wall = (one.velocity + two.velocity) / 2;
    const double density = settings_.collision.incompressible ? 1 : after_collision(cell).density;
    return left - density * (6 * kWeight[out] * velocity_of(out).dot(wall) + lost_at_edges(cell, out));
  }
  if (rule.action == LinkRule::Action::anti_bounce) {
    const double density = (one.density + two.density) / 2;
    const double inertial = settings_.collision.incompressible ? 1 : density;
    const Vec3 u = after_collision(cell).velocity;
    const double cu = velocity_of(direction).dot(u);
    return -left + 2 * kWeight[out] * (density + inertial * (4.5 * cu * cu - 1.5 * u.squaredNorm()));
  }
  int from = direction;
  for (int a = 0; a < 3; ++a) {
    const auto at = static_cast<std::size_t>(a);
    if (crossed[at] == 0) continue;
    const FaceKind kind = settings_.faces[static_cast<std::size_t>(face_at(a, crossed[at] > 0))].kind;
    if (kind == FaceKind::free_slip || kind == FaceKind::pressure) {
      source[at] = cell[at];
      if (kind == FaceKind::free_slip) from = reflected(from, a);
    } else {
      source[at] = (source[at] + cells_[at]) % cells_[at];
    }
  }
  const std::uint8_t label = labels_[index(source)];
  if (label == 0 && rule.action == LinkRule::Action::extend) {
    const FluidPoint inside = after_collision(source);
    const double cu = velocity_of(from).dot(inside.velocity);
    const double shape = settings_.collision.incompressible
                             ? 1
                             : 1 + 3 * cu + 4.5 * cu * cu - 1.5 * inside.velocity.squaredNorm();
    return after_[index(source)][static_cast<std::size_t>(from)] +
           2 * (one.density - inside.density) * kWeight[from] * shape;
  }
  if (label == 0) return after_[index(source)][static_cast<std::size_t>(from)];
  solid_forces_[label] += 2 * (left - kWeight[out]) * velocity_of(out);
  return left;
}

void ReferenceFluid::step() {
  solid_forces_.fill(Vec3::Zero());
  for (std::size_t n = 0; n < before_.size(); ++n) {
    if (labels_[n] != 0) continue;
    if (!partial_) {
      after_[n] = reference_collision(before_[n], settings_.collision, force_);
      continue;
    }
    const PartialCollision collision =
        reference_partial_collision(before_[n], settings_.collision, force_, *partial_, solids_[n]);
    after_[n] = collision.populations;
    exchange_[n] = collision.exchange;
  }
  for_each_cell({{0, 0, 0}, cells_}, [&](int x, int y, int z) {
    if (labels_[index({x, y, z})] != 0) return;
    for (int i = 0; i < kDirections; ++i)
      before_[index({x, y, z})][static_cast<std::size_t>(i)] = entering({x, y, z}, i);
  });
}

}  // namespace suffuse::lbm
