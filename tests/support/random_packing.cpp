#include "random_packing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

namespace suffuse::coupling {

namespace {

struct Pair {
  std::size_t first, second;
};

Vec3 nearest_image(Vec3 d, const PackingRequest& request) {
  for (int a = 0; a < 3; ++a)
    if (request.periodic[static_cast<std::size_t>(a)])
      d[a] -= request.box[a] * std::round(d[a] / request.box[a]);
  return d;
}

/// Pairs nearer than the sum of their radii and `margin`, by way of bins as wide as that at least.
std::vector<Pair> near_pairs(const PackingRequest& request, const std::vector<Vec3>& x, double margin) {
  const double reach = 2 * *std::max_element(request.radii.begin(), request.radii.end()) + margin;
  std::array<int, 3> bins{};
  for (int a = 0; a < 3; ++a)
    bins[static_cast<std::size_t>(a)] = std::max(1, static_cast<int>(request.box[a] / reach));
  const auto bin_of = [&](std::size_t n, int a) {
    const int count = bins[static_cast<std::size_t>(a)];
    return std::clamp(static_cast<int>(std::floor(x[n][a] / request.box[a] * count)), 0, count - 1);
  };
  std::vector<std::vector<std::size_t>> members(static_cast<std::size_t>(bins[0] * bins[1] * bins[2]));
  const auto place = [&](int i, int j, int k) {
    return static_cast<std::size_t>((k * bins[1] + j) * bins[0] + i);
  };
  for (std::size_t n = 0; n < x.size(); ++n)
    members[place(bin_of(n, 0), bin_of(n, 1), bin_of(n, 2))].push_back(n);
  std::vector<Pair> pairs;
  std::array<std::vector<int>, 3> around;
  for (std::size_t n = 0; n < x.size(); ++n) {
    for (int a = 0; a < 3; ++a) {
      std::vector<int>& list = around[static_cast<std::size_t>(a)];
      list.clear();
      const int count = bins[static_cast<std::size_t>(a)];
      for (int s = -1; s <= 1; ++s) list.push_back(((bin_of(n, a) + s) % count + count) % count);
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    for (const int k : around[2])
      for (const int j : around[1])
        for (const int i : around[0])
          for (const std::size_t m : members[place(i, j, k)])
            if (m > n &&
                nearest_image(x[m] - x[n], request).norm() < request.radii[n] + request.radii[m] + margin)
              pairs.push_back({n, m});
  }
  return pairs;
}

/// Pushes overlapping spheres apart until no overlap exceeds a share of the smaller radius, or so many times.
/// Returns the largest overlap left, over the smaller radius.
double push_apart(const PackingRequest& request, double scale, double allowed, int sweeps,
                  std::vector<Vec3>& x) {
  const double smallest = *std::min_element(request.radii.begin(), request.radii.end());
  const double margin = 0.3 * smallest;
  std::vector<Pair> pairs;
  double worst = 0, travelled = margin;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    if (2 * travelled >= margin) {
      pairs = near_pairs(request, x, margin);
      travelled = 0;
    }
    worst = 0;
    double longest = 0;
    std::vector<Vec3> moved(x.size(), Vec3::Zero());
    for (const Pair& p : pairs) {
      const double ra = scale * request.radii[p.first], rb = scale * request.radii[p.second];
      const Vec3 d = nearest_image(x[p.second] - x[p.first], request);
      const double distance = std::max(d.norm(), 1e-9 * smallest), overlap = ra + rb - distance;
      if (overlap <= 0) continue;
      worst = std::max(worst, overlap / std::min(ra, rb));
      const double share = rb / (ra + rb);
      x[p.first] -= share * overlap / distance * d;
      x[p.second] += (1 - share) * overlap / distance * d;
      moved[p.first] -= share * overlap / distance * d;
      moved[p.second] += (1 - share) * overlap / distance * d;
    }
    for (std::size_t n = 0; n < x.size(); ++n) {
      const double r = scale * request.radii[n];
      for (int a = 0; a < 3; ++a) {
        if (request.periodic[static_cast<std::size_t>(a)]) {
          x[n][a] -= request.box[a] * std::floor(x[n][a] / request.box[a]);
          continue;
        }
        const double inside = std::clamp(x[n][a], r, request.box[a] - r);
        worst = std::max(worst, std::abs(inside - x[n][a]) / r);
        moved[n][a] += inside - x[n][a];
        x[n][a] = inside;
      }
      longest = std::max(longest, moved[n].norm());
    }
    travelled += longest;
    if (worst <= allowed) break;
  }
  return worst;
}

/// What growing leaves at full size, over the radius: spheres are then a little too large, so that none
/// overlaps.
constexpr double kClearance = 1e-4;
constexpr int kSweeps = 300;

/// Moves each sphere by a random step where that leaves no overlap, again and again: what pushing apart left
/// in contact comes free, and the packing is one of hard spheres in thermal motion.
void shake(const PackingRequest& request, int sweeps, std::mt19937_64& random, std::vector<Vec3>& x) {
  const std::vector<double>& r = request.radii;
  const double smallest = *std::min_element(r.begin(), r.end()), margin = 0.8 * smallest;
  double step = 0.1 * smallest, travelled = margin;
  std::vector<std::vector<std::size_t>> neighbours(x.size());
  const auto free = [&](std::size_t n, const Vec3& at) {
    for (int a = 0; a < 3; ++a)
      if (!request.periodic[static_cast<std::size_t>(a)] && (at[a] < r[n] || at[a] > request.box[a] - r[n]))
        return false;
    return std::all_of(neighbours[n].begin(), neighbours[n].end(), [&](std::size_t m) {
      return nearest_image(x[m] - at, request).norm() >= r[n] + r[m];
    });
  };
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    if (2 * (travelled + std::sqrt(3.) * step) > margin) {
      for (auto& list : neighbours) list.clear();
      for (const Pair& p : near_pairs(request, x, margin)) {
        neighbours[p.first].push_back(p.second);
        neighbours[p.second].push_back(p.first);
      }
      travelled = 0;
    }
    std::size_t accepted = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
      const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };
      const Vec3 at = x[n] + step * Vec3(uniform(), uniform(), uniform());
      if (!free(n, at)) continue;
      x[n] = at;
      ++accepted;
    }
    travelled += std::sqrt(3.) * step;
    step = std::min(accepted * 2 > x.size() ? 1.1 * step : step / 1.1, 0.2 * smallest);
  }
  for (Vec3& at : x)
    for (int a = 0; a < 3; ++a)
      if (request.periodic[static_cast<std::size_t>(a)])
        at[a] -= request.box[a] * std::floor(at[a] / request.box[a]);
}

bool grow(const PackingRequest& request, std::vector<Vec3>& x) {
  constexpr int stages = 40;
  for (int stage = 1; stage <= stages; ++stage) {
    const double filled = static_cast<double>(stage) / stages;
    push_apart(request, std::cbrt(filled), 1e-3, 200, x);
  }
  push_apart(request, 1 + kClearance, 0.9 * kClearance, 40000, x);
  return smallest_gap(request, x) >= 0;
}

}  // namespace

std::vector<Vec3> random_packing(const PackingRequest& request) {
  constexpr std::uint64_t attempts = 20;
  for (std::uint64_t attempt = 0; attempt < attempts; ++attempt) {
    std::mt19937_64 random(request.seed + 1000003 * attempt);
    const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    std::vector<Vec3> x;
    for (std::size_t n = 0; n < request.radii.size(); ++n)
      x.push_back(request.box.cwiseProduct(Vec3(uniform(), uniform(), uniform())));
    if (!grow(request, x)) continue;
    shake(request, kSweeps, random, x);
    return x;
  }
  throw std::runtime_error("random_packing: the spheres find no place; ask for a lower solid fraction");
}

double smallest_gap(const PackingRequest& request, const std::vector<Vec3>& centres) {
  double least = 1e300;
  const std::vector<double>& r = request.radii;
  for (const Pair& p : near_pairs(request, centres, *std::max_element(r.begin(), r.end()))) {
    const double distance = nearest_image(centres[p.second] - centres[p.first], request).norm();
    least = std::min(least, (distance - r[p.first] - r[p.second]) / std::min(r[p.first], r[p.second]));
  }
  for (std::size_t n = 0; n < centres.size(); ++n)
    for (int a = 0; a < 3; ++a) {
      if (request.periodic[static_cast<std::size_t>(a)]) {
        least = std::min(least, (request.box[a] - 2 * r[n]) / r[n]);  // its own image
        continue;
      }
      least = std::min({least, centres[n][a] / r[n] - 1, (request.box[a] - centres[n][a]) / r[n] - 1});
    }
  return least;
}

double sauter_diameter(const std::vector<double>& radii) {
  double squares = 0, cubes = 0;
  for (const double r : radii) {
    squares += r * r;
    cubes += r * r * r;
  }
  return 2 * cubes / squares;
}

double volume_of(const std::vector<double>& radii) {
  double sum = 0;
  for (const double r : radii) sum += 4. / 3 * std::numbers::pi * r * r * r;
  return sum;
}

std::vector<double> spread_radii(int count, double spread) {
  std::vector<double> radii;
  for (int n = 0; n < count; ++n) radii.push_back(1 + spread * (2 * (n + 0.5) / count - 1));
  std::mt19937_64 random(7);
  for (std::size_t n = radii.size(); n > 1; --n) std::swap(radii[n - 1], radii[random() % n]);
  return radii;
}

std::vector<double> appendix_c_radii() {
  constexpr double classes[] = {0.239,  0.2202, 0.2049, 0.1957, 0.1919, 0.1894, 0.1857,
                                0.1815, 0.1773, 0.1745, 0.1722, 0.1694, 0.1672, 0.165,
                                0.1629, 0.1602, 0.1561, 0.151,  0.1438, 0.1333};
  std::vector<double> radii;
  for (const double r : classes)
    radii.insert(radii.end(), static_cast<std::size_t>(std::lround(std::pow(classes[0] / r, 3))), r);
  const double mean = sauter_diameter(radii) / 2;
  for (double& r : radii) r /= mean;
  return radii;
}

std::vector<double> grading_radii(const std::string& path, int count) {
  std::ifstream file(path);
  std::vector<std::pair<double, double>> classes;  // radius, number of grains
  double total = 0, largest = 0;
  for (std::string line; std::getline(file, line);) {
    double diameter = 0, share = 0;
    if (std::sscanf(line.c_str(), "%lf,%lf", &diameter, &share) != 2) continue;
    classes.emplace_back(diameter / 2, share / std::pow(diameter, 3));
    total += classes.back().second;
    largest = std::max(largest, diameter / 2);
  }
  if (classes.empty()) throw std::runtime_error("no grading in " + path);
  std::vector<double> radii;
  double finer = 0;
  for (const auto& [radius, number] : classes) {
    finer += number / total;
    while (static_cast<double>(radii.size()) + 0.5 < count * finer) radii.push_back(radius / largest);
  }
  return radii;
}

std::vector<double> gap_graded_radii(int coarse, double ratio, double fines_share) {
  const double each = 1 / (ratio * ratio * ratio);
  const auto fines = static_cast<std::size_t>(std::lround(coarse * fines_share / (1 - fines_share) / each));
  std::vector<double> radii(static_cast<std::size_t>(coarse), 1.);
  radii.insert(radii.end(), fines, 1 / ratio);
  return radii;
}

}  // namespace suffuse::coupling
