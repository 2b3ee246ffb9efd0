#include "link_wise_stokes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace suffuse::coupling {

namespace {

constexpr int kDirections = 19, kLanes = 8;
/// Opposite ones side by side: 1 and 2, 3 and 4, ...
constexpr int kC[kDirections][3] = {{0, 0, 0},  {1, 0, 0},   {-1, 0, 0},  {0, 1, 0},   {0, -1, 0},
                                    {0, 0, 1},  {0, 0, -1},  {1, 1, 0},   {-1, -1, 0}, {1, -1, 0},
                                    {-1, 1, 0}, {1, 0, 1},   {-1, 0, -1}, {1, 0, -1},  {-1, 0, 1},
                                    {0, 1, 1},  {0, -1, -1}, {0, 1, -1},  {0, -1, 1}};
constexpr double kRelaxation = 1.4, kMagic = 3. / 16;

double weight_of(int q) {
  return q == 0 ? 1. / 3 : q < 7 ? 1. / 18 : 1. / 36;
}

int opposite(int q) {
  return q == 0 ? 0 : q % 2 == 1 ? q + 1 : q - 1;
}

struct Link {
  std::uint32_t cell;    ///< x
  int q;                 ///< leaves x through a sphere
  std::size_t upstream;  ///< place of f~_q(x - c_q)
  double share;          ///< (1 - 2d)/(1 + 2d)
};

class Stokes {
 public:
  Stokes(const Packing& packing, int edge, double offset, LinkRule rule) : edge_(edge) {
    for (std::size_t n = 0; n < packing.radii.size(); ++n) {
      centres_.push_back(edge * packing.centres[n] + Vec3(offset, 0.37 * offset, 0.71 * offset));
      radii_.push_back(edge * packing.radii[n]);
    }
    mark_solids();
    connect(rule);
  }

  void step(double gradient) {
    for (std::size_t n = 0; n < links_.size(); ++n) {
      const Link& l = links_[n];
      corrections_[n] = l.share * (post_[l.upstream] - post_[place(l.cell, opposite(l.q))]);
    }
    std::size_t link = 0;
    momentum_ = 0;
    for (std::uint32_t first = 0; first < padded_; first += kLanes) {
      double f[kDirections][kLanes];
      for (int q = 0; q < kDirections; ++q)
        for (int lane = 0; lane < kLanes; ++lane)
          f[q][lane] = post_[source_[place(first + static_cast<std::uint32_t>(lane), q)]];
      for (; link < links_.size() && links_[link].cell < first + kLanes; ++link)
        f[opposite(links_[link].q)][links_[link].cell - first] += corrections_[link];
      collide(f, gradient);
      for (int q = 0; q < kDirections; ++q)
        for (int lane = 0; lane < kLanes; ++lane)
          next_[place(first + static_cast<std::uint32_t>(lane), q)] = f[q][lane];
    }
    post_.swap(next_);
  }

  /// Mean over the whole box, spheres included.
  double flux() const { return momentum_ / std::pow(edge_, 3); }
  double viscosity() const { return (kRelaxation - 0.5) / 3; }

 private:
  std::size_t place(std::uint32_t cell, int q) const {
    return (static_cast<std::size_t>(cell / kLanes) * kDirections + static_cast<std::size_t>(q)) * kLanes +
           cell % kLanes;
  }

  std::size_t site(int x, int y, int z) const {
    const auto wrapped = [&](int i) { return static_cast<std::size_t>(((i % edge_) + edge_) % edge_); };
    return (wrapped(z) * static_cast<std::size_t>(edge_) + wrapped(y)) * static_cast<std::size_t>(edge_) +
           wrapped(x);
  }

  void mark_solids() {
    owner_.assign(static_cast<std::size_t>(edge_) * edge_ * edge_, -1);
    for (std::size_t n = 0; n < radii_.size(); ++n) {
      const Vec3 lo = centres_[n] - Vec3::Constant(radii_[n] + 1),
                 hi = centres_[n] + Vec3::Constant(radii_[n] + 1);
      for (int z = static_cast<int>(std::floor(lo[2])); z <= hi[2]; ++z)
        for (int y = static_cast<int>(std::floor(lo[1])); y <= hi[1]; ++y)
          for (int x = static_cast<int>(std::floor(lo[0])); x <= hi[0]; ++x)
            if ((Vec3(x + 0.5, y + 0.5, z + 0.5) - centres_[n]).norm() < radii_[n])
              owner_[site(x, y, z)] = static_cast<int>(n);
    }
  }

  /// Distance from a cell's centre along c_q to the sphere, over |c_q|.
  double cut(const Vec3& x, int q, std::size_t sphere) const {
    Vec3 d = x - centres_[sphere];
    for (int a = 0; a < 3; ++a) d[a] -= edge_ * std::round(d[a] / edge_);
    const Vec3 c(kC[q][0], kC[q][1], kC[q][2]);
    const double b = d.dot(c), cc = c.squaredNorm(), rest = d.squaredNorm() - radii_[sphere] * radii_[sphere];
    return (-b - std::sqrt(std::max(0., b * b - cc * rest))) / cc;
  }

  void connect(LinkRule rule) {
    std::vector<std::uint32_t> number(owner_.size());
    std::uint32_t count = 0;
    for (std::size_t n = 0; n < owner_.size(); ++n)
      if (owner_[n] < 0) number[n] = count++;
    padded_ = (count + kLanes - 1) / kLanes * kLanes;
    post_.assign(static_cast<std::size_t>(padded_) * kDirections, 0);
    next_ = post_;
    source_.resize(post_.size());
    live_.assign(padded_, 0);
    for (std::uint32_t cell = count; cell < padded_; ++cell)
      for (int q = 0; q < kDirections; ++q)
        source_[place(cell, q)] = static_cast<std::uint32_t>(place(cell, q));
    for (int z = 0; z < edge_; ++z)
      for (int y = 0; y < edge_; ++y)
        for (int x = 0; x < edge_; ++x)
          if (owner_[site(x, y, z)] < 0) connect_cell({x, y, z}, number, rule);
    corrections_.resize(links_.size());
  }

  void connect_cell(const std::array<int, 3>& at, const std::vector<std::uint32_t>& number, LinkRule rule) {
    const auto next = [&](int q) { return site(at[0] + kC[q][0], at[1] + kC[q][1], at[2] + kC[q][2]); };
    const std::uint32_t cell = number[site(at[0], at[1], at[2])];
    live_[cell] = 1;
    for (int q = 0; q < kDirections; ++q) {
      const int back = opposite(q);
      const std::size_t ahead = next(q), behind = next(back);
      // What arrives in direction `back` came from ahead.
      source_[place(cell, back)] =
          static_cast<std::uint32_t>(owner_[ahead] < 0 ? place(number[ahead], back) : place(cell, q));
      if (owner_[ahead] < 0 || owner_[behind] >= 0 || rule == LinkRule::halfway) continue;
      const double d =
          cut(Vec3(at[0] + 0.5, at[1] + 0.5, at[2] + 0.5), q, static_cast<std::size_t>(owner_[ahead]));
      links_.push_back({cell, q, place(number[behind], q), (1 - 2 * d) / (1 + 2 * d)});
    }
  }

  /// The pull along x, half of it before and half after as in Guo's scheme.
  void collide(double (&f)[kDirections][kLanes], double gradient) {
    constexpr double even = 1 / kRelaxation, odd_time = 0.5 + kMagic / (kRelaxation - 0.5),
                     odd = 1 / odd_time;
    double density[kLanes] = {}, flow[3][kLanes] = {};
    for (int q = 0; q < kDirections; ++q)
      for (int lane = 0; lane < kLanes; ++lane) {
        density[lane] += f[q][lane];
        for (int a = 0; a < 3; ++a) flow[a][lane] += kC[q][a] * f[q][lane];
      }
    for (int lane = 0; lane < kLanes; ++lane) {
      flow[0][lane] += 0.5 * gradient;
      momentum_ += flow[0][lane] * live_[momentum_cell_ + static_cast<std::size_t>(lane)];
    }
    momentum_cell_ = momentum_cell_ + kLanes == padded_ ? 0 : momentum_cell_ + kLanes;
    for (int lane = 0; lane < kLanes; ++lane)
      f[0][lane] -= even * (f[0][lane] - weight_of(0) * density[lane]);
    for (int q = 1; q < kDirections; q += 2) {
      const double w = weight_of(q), pull = 3 * w * kC[q][0] * gradient * (1 - 0.5 * odd);
      for (int lane = 0; lane < kLanes; ++lane) {
        const double sum = 0.5 * (f[q][lane] + f[q + 1][lane]),
                     difference = 0.5 * (f[q][lane] - f[q + 1][lane]);
        const double along = kC[q][0] * flow[0][lane] + kC[q][1] * flow[1][lane] + kC[q][2] * flow[2][lane];
        const double e = even * (sum - w * density[lane]), o = odd * (difference - 3 * w * along) - pull;
        f[q][lane] -= e + o;
        f[q + 1][lane] -= e - o;
      }
    }
  }

  int edge_;
  std::vector<Vec3> centres_;
  std::vector<double> radii_;
  std::vector<int> owner_;
  std::uint32_t padded_ = 0;
  std::vector<double> post_, next_, corrections_;
  std::vector<std::uint32_t> source_;
  std::vector<unsigned char> live_;
  std::vector<Link> links_;
  double momentum_ = 0;
  std::size_t momentum_cell_ = 0;
};

}  // namespace

DragResult link_wise_drag(const Packing& packing, double diameter, LinkRule rule, double offset) {
  DragResult result;
  const double sauter = sauter_diameter(packing.radii);
  result.cells = static_cast<int>(std::lround(diameter / sauter));
  result.diameter = sauter * result.cells;
  result.phi = volume_of(packing.radii);
  Stokes stokes(packing, result.cells, offset, rule);
  constexpr double gradient = 1e-6;
  constexpr int interval = 50;
  double before = 0, flux = 0;
  int settled = 0;
  do {
    for (int n = 0; n < interval; ++n) stokes.step(gradient);
    result.steps += interval;
    before = flux;
    flux = stokes.flux();
    settled = std::abs(flux - before) < 2e-6 * std::abs(flux) ? settled + 1 : 0;
  } while (settled < 2 && std::isfinite(flux) && result.steps < 100000);
  result.drag = gradient * result.diameter * result.diameter / (18 * result.phi * stokes.viscosity() * flux);
  return result;
}

}  // namespace suffuse::coupling
