#include "fix_lubrication.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "pair_gran.h"
#include "region.h"
#include "style_support.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/sphere.h"
#include "update.h"

using namespace LAMMPS_NS;
using suffuse::throw_user_error;
using suffuse::Vec3;
using suffuse::lubrication::Body;
using suffuse::lubrication::PairLoads;

namespace {

constexpr const char* kLubrication = "fix lubrication";
constexpr const char* kLubricationKeywords = "viscosity, outer, inner, density, every, region, torque, walls";

Vec3 vec(const double* values) {
  return Vec3(values[0], values[1], values[2]);
}

constexpr const char* kPlaneWords[] = {"xplane", "yplane", "zplane"};

/// LIGGGHTS's words for its own primitive walls: xplane 0.0 zplane 0.01 ...
void read_walls(suffuse::ArgumentReader& reader, std::vector<FixLubrication::Plane>& walls) {
  const std::size_t before = walls.size();
  bool more = true;
  while (more) {
    more = false;
    for (int axis = 0; axis < 3; ++axis) {
      if (!reader.accept(kPlaneWords[axis])) continue;
      walls.push_back({axis, reader.number(kPlaneWords[axis])});
      more = true;
    }
  }
  if (walls.size() == before)
    throw_user_error({kLubrication, "walls", reader.word("walls"),
                      "be xplane X, yplane Y or zplane Z, one or several",
                      "e.g. `walls zplane 0 zplane 0.05`; leave `walls` away where there are none"});
}

/// Of grains, m; 0 if there are none.
struct Radii {
  double smallest, largest;
};

/// Of the grains that are there and of those that fixes will insert. Collective.
Radii radii_of(LAMMPS* lmp) {
  const Atom* atom = lmp->atom;
  constexpr double kNone = std::numeric_limits<double>::max();
  double ends[2] = {kNone, 0};  // the largest as its negative
  const auto count = [&ends](double smallest, double largest) {
    ends[0] = std::min(ends[0], smallest);
    ends[1] = std::min(ends[1], -largest);
  };
  for (int i = 0; i < atom->nlocal; ++i) count(atom->radius[i], atom->radius[i]);
  for (int f = 0; f < lmp->modify->nfix; ++f)
    for (int type = 1; type <= atom->ntypes; ++type)
      if (const double inserted = lmp->modify->fix[f]->min_rad(type); inserted > 0)
        count(inserted, std::max(inserted, lmp->modify->fix[f]->max_rad(type)));
  MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_DOUBLE, MPI_MIN, lmp->world);
  return {ends[0] == kNone ? 0 : ends[0], -ends[1]};
}

bool read_yes_or_no(suffuse::ArgumentReader& reader, const char* what) {
  const std::string word = reader.word(what);
  if (word != "yes" && word != "no") throw_user_error({kLubrication, what, word, "be yes or no", ""});
  return word == "yes";
}

}  // namespace

FixLubrication::FixLubrication(LAMMPS* lmp_in, int narg, char** arg) : Fix(lmp_in, narg, arg) {
  suffuse::ArgumentReader reader(kLubrication, narg, arg, 3);
  suffuse::require_si_and_three_dimensions(lmp, kLubrication);
  read(reader);
  require_complete();
  if (atom->radius_flag == 0 || atom->torque_flag == 0)
    throw_user_error(
        {kLubrication, "atom_style", atom->atom_style, "be spheres", "write `atom_style granular`"});
  const Radii radii = radii_of(lmp);
  if (radii.smallest == 0)
    throw_user_error({kLubrication, "grains", "none", "be there, or come from an insertion",
                      "write this line after that which makes the grains"});
  if (set_.film.outer > radii.largest)
    throw_user_error({kLubrication, "outer", fmt::format("{:g}", set_.film.outer),
                      fmt::format("be a gap narrower than a grain's radius, {:g} at most", radii.largest),
                      "it is in metres: 2/3 of a cell of the lattice"});
  // Neighbour lists then hold every pair that can come within `outer` before the next list.
  neighbor->register_contact_dist_factor(required_distance_factor(radii.smallest));
  vector_flag = 1;
  size_vector = 6;
  global_freq = 1;
  extvector = 0;
  comm_forward = 1;
}

void FixLubrication::read(suffuse::ArgumentReader& reader) {
  while (!reader.done()) {
    if (reader.keyword("viscosity"))
      set_.film.viscosity = reader.positive("viscosity");
    else if (reader.keyword("outer"))
      set_.film.outer = reader.positive("outer");
    else if (reader.keyword("inner"))
      set_.film.inner = reader.positive("inner");
    else if (reader.keyword("density"))
      set_.density = reader.positive("density");
    else if (reader.keyword("every"))
      set_.every = static_cast<int>(std::min<std::int64_t>(reader.positive_integer("every"), 1000000));
    else if (reader.keyword("region"))
      set_.region = reader.word("ID of a region");
    else if (reader.keyword("torque"))
      set_.torque = read_yes_or_no(reader, "torque");
    else if (reader.keyword("walls"))
      read_walls(reader, set_.walls);
    else
      reader.unknown(reader.word("keyword"), kLubricationKeywords);
  }
}

void FixLubrication::require_complete() const {
  const struct {
    const char* name;
    double value;
    const char* remedy;
  } needed[] = {
      {"viscosity", set_.film.viscosity, "give the fluid's dynamic viscosity in Pa s, e.g. 1e-3"},
      {"outer", set_.film.outer, "give the gap in m from which on the lattice resolves it: 2/3 of a cell"},
      {"inner", set_.film.inner, "give the grains' roughness in m, e.g. a thousandth of their radius"}};
  for (const auto& [name, value, remedy] : needed)
    if (value == 0) throw_user_error({kLubrication, name, "nothing", "be given", remedy});
  if (set_.film.inner >= set_.film.outer)
    throw_user_error({kLubrication, "inner", fmt::format("{:g}", set_.film.inner),
                      fmt::format("be smaller than outer = {:g}", set_.film.outer),
                      "inner is the grains' roughness, outer 2/3 of a cell"});
}

std::vector<std::string> FixLubrication::words(const std::string& id, const std::string& group,
                                               const Settings& settings) {
  const auto text = [](double value) { return fmt::format("{}", value); };
  std::vector<std::string> words{id,
                                 group,
                                 "lubrication",
                                 "viscosity",
                                 text(settings.film.viscosity),
                                 "outer",
                                 text(settings.film.outer),
                                 "inner",
                                 text(settings.film.inner),
                                 "every",
                                 std::to_string(settings.every),
                                 "torque",
                                 settings.torque ? "yes" : "no"};
  if (settings.density > 0) words.insert(words.end(), {"density", text(settings.density)});
  if (!settings.region.empty()) words.insert(words.end(), {"region", settings.region});
  if (!settings.walls.empty()) words.push_back("walls");
  for (const Plane& wall : settings.walls) {
    words.push_back(kPlaneWords[wall.axis]);
    words.push_back(text(wall.at));
  }
  return words;
}

/// LIGGGHTS lists pairs closer than factor × (r_i + r_j) + skin, and lists anew when a grain has moved by
/// half the skin: so (factor − 1) × 2 r_min must reach `outer`.
double FixLubrication::required_distance_factor(double smallest_radius) const {
  return 1 + set_.film.outer / (2 * smallest_radius);
}

int FixLubrication::setmask() {
  return FixConst::POST_FORCE;
}

void FixLubrication::post_create() {
  suffuse::act_before_constraints(lmp, this);
}

/// A pair between two fixes would have its film twice, and more damping than its mass stands.
void FixLubrication::require_films_once() const {
  for (int k = 0; k < modify->nfix; ++k) {
    const auto* other = dynamic_cast<const FixLubrication*>(modify->fix[k]);
    if (other == nullptr || other == this) continue;
    int shared = 0;
    for (int i = 0; i < atom->nlocal; ++i)
      if ((atom->mask[i] & groupbit) != 0 && (atom->mask[i] & other->groupbit) != 0) shared = 1;
    MPI_Allreduce(MPI_IN_PLACE, &shared, 1, MPI_INT, MPI_MAX, world);
    if (shared != 0)
      throw_user_error({kLubrication, "group", fmt::format("of {} and of {}", other->id, id),
                        "have no grain in common", "write one line for both, or `unfix` the other"});
  }
}

/// A plane that no grain in the box can touch is a mistake of sign or unit.
void FixLubrication::require_walls_within_reach() const {
  const double reach = radii_of(lmp).largest + set_.film.outer;
  for (const Plane& wall : set_.walls) {
    const double low = domain->boxlo[wall.axis], high = domain->boxhi[wall.axis];
    if (wall.at < low - reach || wall.at > high + reach)
      throw_user_error({kLubrication, "walls", fmt::format("{} {:g}", kPlaneWords[wall.axis], wall.at),
                        fmt::format("lie in the box, {:g} to {:g}", low, high), "coordinates are in metres"});
  }
}

void FixLubrication::find_region() {
  region_ = nullptr;
  if (set_.region.empty()) return;
  const int index = domain->find_region(set_.region.data());
  if (index < 0)
    throw_user_error(
        {kLubrication, "region", set_.region, "exist", "write `region ID ... units box` before"});
  region_ = domain->regions[index];
}

/// Is the film at this point of the box, or of an image of it, in the fluid?
bool FixLubrication::holds(Vec3 point) const {
  if (region_ == nullptr) return true;
  domain->remap(point.data());
  return region_->match(point.data()) != 0;
}

void FixLubrication::init() {
  suffuse::require_single_spheres(lmp, kLubrication);
  pair_ = &suffuse::require_granular_pair_style(lmp, kLubrication);
  // These lists leave the distance factor out.
  if (force->newton_pair != 0)
    throw_user_error(
        {kLubrication, "newton", "on", "be off", "write `newton off` at the start of the script"});
  if (neighbor->style == 2)
    throw_user_error({kLubrication, "neighbor style", "multi", "be bin or nsq", "write `neighbor SKIN bin`"});
  for (const Plane& wall : set_.walls)
    if (domain->periodicity[wall.axis] != 0)
      throw_user_error({kLubrication, "walls", fmt::format("{} {:g}", kPlaneWords[wall.axis], wall.at),
                        "not lie across a periodic axis: films would form on one side alone",
                        "write `boundary` with f along this axis, or leave the wall out"});
  require_films_once();
  require_walls_within_reach();
  find_region();
  const double smallest = radii_of(lmp).smallest;
  if (smallest > 0 && neighbor->contactDistanceFactor < required_distance_factor(smallest) * (1 - 1e-9))
    throw_user_error({kLubrication, "smallest radius", fmt::format("{:g}", smallest),
                      "not be below what it was when the fix was defined, or pairs would be missed",
                      "write this line after the insertion of the smallest grains"});
  since_run_ = {};
}

void FixLubrication::setup(int) {
  count_films();
  age_ = set_.every;
  post_force(0);
}

template <class Visitor>
void FixLubrication::for_each_pair(double range, Visitor&& visit) const {
  const NeighList* list = pair_->list;
  double* const* x = atom->x;
  const double* radius = atom->radius;
  const int* mask = atom->mask;
  for (int ii = 0; ii < list->inum; ++ii) {
    const int i = list->ilist[ii];
    if ((mask[i] & groupbit) == 0) continue;
    const int* neighbours = list->firstneigh[i];
    for (int jj = 0; jj < list->numneigh[i]; ++jj) {
      const int j = neighbours[jj] & NEIGHMASK;
      if ((mask[j] & groupbit) == 0) continue;
      const double dx = x[j][0] - x[i][0], dy = x[j][1] - x[i][1], dz = x[j][2] - x[i][2];
      const double touching = radius[i] + radius[j], squared = dx * dx + dy * dy + dz * dz;
      if (squared >= (touching + range) * (touching + range)) continue;
      const double distance = std::sqrt(squared);
      if (distance == 0) continue;
      visit(i, j, Vec3(dx / distance, dy / distance, dz / distance), distance - touching);
    }
  }
}

template <class Visitor>
void FixLubrication::for_each_wall(double range, Visitor&& visit) const {
  for (const Plane& wall : set_.walls) {
    for (int i = 0; i < atom->nlocal; ++i) {
      if ((atom->mask[i] & groupbit) == 0) continue;
      const double offset = wall.at - atom->x[i][wall.axis], gap = std::abs(offset) - atom->radius[i];
      if (gap < range) visit(i, std::copysign(1., offset) * Vec3::Unit(wall.axis), gap);
    }
  }
}

void FixLubrication::count_films() {
  // A pair that is farther away cannot come within `outer` before the next list.
  const double range = set_.film.outer + neighbor->skin;
  films_.assign(static_cast<std::size_t>(atom->nlocal + atom->nghost), 0);
  for_each_pair(range, [&](int i, int j, const Vec3&, double) {
    ++films_[static_cast<std::size_t>(i)];
    if (j < atom->nlocal) ++films_[static_cast<std::size_t>(j)];
  });
  for_each_wall(range, [&](int i, const Vec3&, double) { ++films_[static_cast<std::size_t>(i)]; });
  comm->forward_comm_fix(this);
  shares_.resize(films_.size());
  for (std::size_t i = 0; i < films_.size(); ++i) {
    const double inverse_mass = std::max(1., films_[i]) / atom->rmass[i];
    shares_[i] = {inverse_mass, inverse_mass / suffuse::micromechanics::sphere_inertia(1, atom->radius[i])};
  }
}

Body FixLubrication::body(int i) const {
  const Share& share = shares_[static_cast<std::size_t>(i)];
  return {atom->radius[i], share.inverse_mass, share.inverse_moment, vec(atom->v[i]), vec(atom->omega[i])};
}

void FixLubrication::post_force(int) {
  const double start = MPI_Wtime();
  add_held();
  seconds_ += MPI_Wtime() - start;
}

void FixLubrication::add_held() {
  if (neighbor->ago == 0) {
    count_films();
    age_ = set_.every;  // grains may have another index
  }
  if (age_ >= set_.every) evaluate();
  ++age_;
  for (int i = 0; i < atom->nlocal; ++i) {
    if ((atom->mask[i] & groupbit) == 0) continue;
    const double* load = held_.data() + 6 * i;
    for (int a = 0; a < 3; ++a) {
      atom->f[i][a] += load[a];
      if (set_.torque) atom->torque[i][a] += load[3 + a];
    }
  }
}

void FixLubrication::evaluate() {
  now_ = {};
  age_ = 0;
  held_.assign(static_cast<std::size_t>(6 * atom->nlocal), 0);
  add_pairs();
  add_walls();
  since_run_.films += now_.films;
  since_run_.bounded += now_.bounded;
}

void FixLubrication::add(int i, const Vec3& f, const Vec3& torque) {
  double* load = held_.data() + 6 * i;
  for (int a = 0; a < 3; ++a) {
    load[a] += f[a];
    load[3 + a] += torque[a];
  }
}

void FixLubrication::add_pairs() {
  for_each_pair(set_.film.outer, [&](int i, int j, const Vec3& normal, double gap) {
    const Body first = body(i), second = body(j);
    if (!holds(vec(atom->x[i]) + (first.radius + gap / 2) * normal)) return;
    const PairLoads loads = film_loads(set_.film, first, second, normal, gap, set_.every * update->dt);
    const bool owned = j < atom->nlocal;  // otherwise the owner of j lists the pair as well
    add(i, loads.force_on_first, loads.torque_on_first);
    if (owned) add(j, -loads.force_on_first, loads.torque_on_second);
    tally(loads, (second.velocity - first.velocity).dot(normal), gap, owned ? 1 : 0.5);
  });
}

void FixLubrication::add_walls() {
  for_each_wall(set_.film.outer, [&](int i, const Vec3& normal, double gap) {
    const Body grain = body(i);
    if (!holds(vec(atom->x[i]))) return;
    Body plane;
    plane.radius = std::numeric_limits<double>::infinity();
    const PairLoads loads = film_loads(set_.film, grain, plane, normal, gap, set_.every * update->dt);
    add(i, loads.force_on_first, loads.torque_on_first);
    tally(loads, -grain.velocity.dot(normal), gap, 1);
  });
}

void FixLubrication::tally(const PairLoads& loads, double approach, double gap, double weight) {
  now_.films += weight;
  now_.bounded += loads.bounded ? weight : 0;
  now_.power += weight * loads.power;
  now_.largest_force = std::max(now_.largest_force, loads.force_on_first.norm());
  const double width = std::max(gap, set_.film.inner);
  now_.largest_reynolds =
      std::max(now_.largest_reynolds, set_.density * std::abs(approach) * width / set_.film.viscosity);
}

/// Films; largest force (N); share bounded, now and since the run began; power (W); largest Reynolds number.
double FixLubrication::compute_vector(int n) {
  double sums[5] = {now_.films, now_.bounded, since_run_.films, since_run_.bounded, now_.power};
  double largest[2] = {now_.largest_force, now_.largest_reynolds};
  MPI_Allreduce(MPI_IN_PLACE, sums, 5, MPI_DOUBLE, MPI_SUM, world);
  MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, world);
  const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 0; };
  const double values[] = {sums[0], largest[0], share(sums[1], sums[0]), share(sums[3], sums[2]),
                           sums[4], largest[1]};
  return values[n];
}

double FixLubrication::memory_usage() {
  return static_cast<double>(films_.capacity()) * (7 * sizeof(double) + sizeof(Share));
}

int FixLubrication::pack_comm(int n, int* list, double* buffer, int, int*) {
  for (int k = 0; k < n; ++k) buffer[k] = films_[static_cast<std::size_t>(list[k])];
  return 1;
}

void FixLubrication::unpack_comm(int n, int first, double* buffer) {
  std::copy_n(buffer, n, films_.begin() + first);
}
