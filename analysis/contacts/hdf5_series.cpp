#include "contacts/hdf5_series.h"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unordered_map>

#include "contacts/packing_builder.h"
#include "files/number_parser.h"
#include "suffuse/common/error.h"
#include "suffuse/common/grain_series_names.h"

namespace suffuse::analysis {

namespace names = grain_series;

using micromechanics::Contact;
using micromechanics::Grain;
using micromechanics::Packing;

struct Hdf5Series::File {
  hid_t id = -1;

  ~File() {
    if (id >= 0) H5Fclose(id);
  }

  /// Every group on the way must exist before the last name may be asked for.
  bool has(const std::string& name) const {
    for (std::size_t slash = name.find('/', 1); slash != std::string::npos; slash = name.find('/', slash + 1))
      if (H5Lexists(id, name.substr(0, slash).c_str(), H5P_DEFAULT) <= 0) return false;
    return H5Lexists(id, name.c_str(), H5P_DEFAULT) > 0;
  }
};

bool Hdf5Series::is_hdf5(const std::string& path) {
  H5Eset_auto(H5E_DEFAULT, nullptr, nullptr);
  return H5Fis_hdf5(path.c_str()) > 0;
}

Hdf5Series::Hdf5Series(std::string path, ReadSettings settings)
    : path_(std::move(path)), settings_(std::move(settings)), file_(std::make_unique<File>()) {
  H5Eset_auto(H5E_DEFAULT, nullptr, nullptr);  // what went wrong is thrown, not printed
  file_->id = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_->id < 0) complain("it cannot be opened", "is the run that writes it over, and the file whole?");
  bytes_ = static_cast<std::int64_t>(std::filesystem::file_size(path_));
  H5G_info_t info;
  if (H5Gget_info(file_->id, &info) < 0) complain("it cannot be listed", "is the file whole?");
  std::vector<std::pair<std::int64_t, std::string>> steps;
  for (hsize_t n = 0; n < info.nlinks; ++n) {
    char name[256] = {};
    H5Lget_name_by_idx(file_->id, ".", H5_INDEX_NAME, H5_ITER_INC, n, name, sizeof name, H5P_DEFAULT);
    const std::string_view text(name);
    std::int64_t step = 0;
    if (!text.starts_with(names::kStep) ||
        !parse_integer(text.substr(std::string_view(names::kStep).size()), step))
      continue;
    const std::string group = fmt::format("/{}", text);
    if (file_->has(group + "/" + names::kGrains) && file_->has(group + "/" + names::kContacts))
      steps.emplace_back(step, group);
    else
      ++left_out_;
  }
  if (steps.empty())
    complain("no group step_N has both grains and contacts",
             "ask for both in the script: `lbm output ... contacts` (read FILE_grains.h5)");
  std::sort(steps.begin(), steps.end());
  for (const auto& [step, group] : steps) groups_.push_back(group);
}

Hdf5Series::~Hdf5Series() = default;

void Hdf5Series::complain(const std::string& problem, const std::string& remedy) const {
  throw UserError(fmt::format("{}: {}{}: {}; {}", settings_.who, path_, group_, problem, remedy));
}

double Hdf5Series::done() const {
  return static_cast<double>(next_) / static_cast<double>(groups_.size());
}

std::string Hdf5Series::notes() const {
  return both_notes(
      left_out_ > 0 ? fmt::format("left out: {} snapshots without contacts", left_out_) : std::string(),
      sample_.note());
}

std::vector<double> Hdf5Series::numbers(const std::string& dataset, std::size_t columns) const {
  const std::string name = group_ + "/" + dataset;
  if (!file_->has(name)) complain("has no " + dataset, "see the layout in docs/analysis/suffuse-analyse.md");
  const hid_t id = H5Dopen(file_->id, name.c_str(), H5P_DEFAULT);
  if (id < 0) complain(dataset + " is no array", "is the file whole?");
  const hid_t space = H5Dget_space(id);
  hsize_t extents[2] = {0, 1};
  const int dimensions = H5Sget_simple_extent_ndims(space);
  const bool right_shape = dimensions == (columns == 1 ? 1 : 2) &&
                           H5Sget_simple_extent_dims(space, extents, nullptr) >= 0 && extents[1] == columns;
  // An array can claim any extent; what it may fill is bounded by what is stored (plausible_rows).
  const auto stored =
      std::min(static_cast<std::int64_t>(H5Dget_storage_size(id)), static_cast<std::int64_t>(bytes_));
  const bool is_there =
      extents[0] < (hsize_t{1} << 48) &&
      plausible_rows(static_cast<std::int64_t>(extents[0]), stored, columns, true, 1) == extents[0];
  std::vector<double> values(right_shape && is_there ? extents[0] * columns : 0);
  const herr_t status =
      values.empty() ? 0 : H5Dread(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  H5Sclose(space);
  H5Dclose(id);
  if (!right_shape)
    complain(fmt::format("{} has not {} numbers a row", dataset, columns),
             "see the layout in docs/analysis/suffuse-analyse.md");
  if (!is_there)
    complain(fmt::format("{} claims {} rows, but {} bytes of it are stored", dataset, extents[0], stored),
             "is the file whole?");
  if (status < 0) complain(dataset + " cannot be read", "is the file whole?");
  for (const double value : values)
    if (!std::isfinite(value))
      complain(fmt::format("{} holds {}", dataset, value),
               "the run itself went wrong here: leave this snapshot out");
  return values;
}

bool Hdf5Series::next(Snapshot& snapshot) {
  if (next_ == groups_.size()) return false;
  group_ = groups_[next_++];
  parse_integer(std::string_view(group_).substr(1 + std::string_view(names::kStep).size()), snapshot.step);
  snapshot.time.reset();
  if (H5Aexists_by_name(file_->id, group_.c_str(), names::kTime, H5P_DEFAULT) > 0) {
    double time = 0;
    const hid_t attribute =
        H5Aopen_by_name(file_->id, group_.c_str(), names::kTime, H5P_DEFAULT, H5P_DEFAULT);
    if (H5Aread(attribute, H5T_NATIVE_DOUBLE, &time) >= 0) snapshot.time = time;
    H5Aclose(attribute);
  }
  snapshot.six_digits = false;
  snapshot.packing = {};
  const std::array<bool, 3> periodic = read_box(snapshot.packing);
  Vec3 period = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis)
    if (periodic[static_cast<std::size_t>(axis)])
      period[axis] = snapshot.packing.box_high[axis] - snapshot.packing.box_low[axis];
  read_grains(snapshot.packing);
  sample_.set_volume(snapshot.packing, periodic);
  const std::string problem = problem_of_grains(snapshot.packing);
  if (!problem.empty()) complain(problem, "lengths are in metres");
  read_contacts(snapshot.packing, period);
  if (const std::string wrong = problem_of_contacts(snapshot.packing, period); !wrong.empty())
    complain(wrong, "the file is damaged");
  sample_.restrict_to_region(snapshot);
  return true;
}

std::array<bool, 3> Hdf5Series::read_box(Packing& packing) const {
  if (file_->has(group_ + "/" + names::kBox)) {
    const std::vector<double> box = numbers(names::kBox, 3);
    if (box.size() != 6) complain("box has not two corners", "write the low and the high one");
    packing.box_low = Vec3(box[0], box[1], box[2]);
    packing.box_high = Vec3(box[3], box[4], box[5]);
    if ((packing.box_high - packing.box_low).minCoeff() <= 0)
      complain("the corners of the box do not rise", "write the low corner first");
  } else if (settings_.volume || settings_.region || settings_.bed) {
    packing.box_high = Vec3::Constant(std::numeric_limits<double>::infinity());
  } else {
    complain("has no box", "give the volume of the sample: --volume M3, --bed or --region");
  }
  if (!file_->has(group_ + "/" + names::kPeriodic)) return {};
  const std::vector<double> periodic = numbers(names::kPeriodic, 1);
  if (periodic.size() != 3) complain("periodic has not three values", "write 0 or 1 for x, y, z");
  return {periodic[0] != 0, periodic[1] != 0, periodic[2] != 0};
}

std::int64_t Hdf5Series::identifier_of(double value) const {
  if (const auto id = identifier(value)) return *id;
  complain(fmt::format("{} is no identifier of a grain", value), "identifiers are whole numbers >= 1");
}

void Hdf5Series::read_grains(Packing& packing) const {
  const std::vector<double> id = numbers(names::in(names::kGrains, names::kId), 1),
                            radius = numbers(names::in(names::kGrains, names::kRadius), 1),
                            position = numbers(names::in(names::kGrains, names::kPosition), 3);
  if (radius.size() != id.size() || position.size() != 3 * id.size())
    complain("the arrays of the grains have different lengths", "is the file whole?");
  for (std::size_t i = 0; i < id.size(); ++i)
    packing.grains.push_back(
        {identifier_of(id[i]), radius[i], Vec3(position[3 * i], position[3 * i + 1], position[3 * i + 2])});
}

void Hdf5Series::read_contacts(Packing& packing, const Vec3& period) const {
  const std::vector<double> ids = numbers(names::in(names::kContacts, names::kIds), 2),
                            force = numbers(names::in(names::kContacts, names::kForce), 3);
  std::vector<double> branch, friction, limit, spring;
  if (file_->has(group_ + "/" + names::in(names::kContacts, names::kBranch)))
    branch = numbers(names::in(names::kContacts, names::kBranch), 3);
  if (file_->has(group_ + "/" + names::in(names::kContacts, names::kFriction)))
    friction = numbers(names::in(names::kContacts, names::kFriction), 1);
  if (file_->has(group_ + "/" + names::in(names::kContacts, names::kFrictionLimit)))
    limit = numbers(names::in(names::kContacts, names::kFrictionLimit), 1);
  if (file_->has(group_ + "/" + names::in(names::kContacts, names::kSpringForce)))
    spring = numbers(names::in(names::kContacts, names::kSpringForce), 1);
  const std::size_t count = ids.size() / 2;
  if (force.size() != 3 * count || (!branch.empty() && branch.size() != 3 * count) ||
      (!friction.empty() && friction.size() != count) || (!limit.empty() && limit.size() != count) ||
      (!spring.empty() && spring.size() != count))
    complain("the arrays of the contacts have different lengths", "is the file whole?");
  std::unordered_map<std::int64_t, int> index;
  for (std::size_t i = 0; i < packing.grains.size(); ++i)
    if (!index.emplace(packing.grains[i].id, static_cast<int>(i)).second)
      complain(fmt::format("grain {} is there twice", packing.grains[i].id), "is the file whole?");
  const auto grain = [&](double id) {
    const auto found = index.find(identifier_of(id));
    if (found == index.end())
      complain(fmt::format("a contact names grain {}, which is not there", id), "write all grains");
    return found->second;
  };
  packing.contacts.reserve(count);
  for (std::size_t c = 0; c < count; ++c) {
    Contact contact;
    contact.first = grain(ids[2 * c]);
    contact.second = grain(ids[2 * c + 1]);
    const Grain& first = packing.grains[static_cast<std::size_t>(contact.first)];
    const Grain& second = packing.grains[static_cast<std::size_t>(contact.second)];
    contact.friction = friction.empty() ? settings_.friction : friction[c];
    if (!limit.empty()) contact.friction_limit = limit[c];
    if (!spring.empty()) contact.spring_force = spring[c];
    RawContact raw;
    raw.separation = branch.empty() ? Vec3(first.position - second.position)
                                    : Vec3(branch[3 * c], branch[3 * c + 1], branch[3 * c + 2]);
    raw.force = Vec3(force[3 * c], force[3 * c + 1], force[3 * c + 2]);
    const std::string problem = set_branch_and_force(
        raw, first.radius + second.radius, branch.empty() ? period : Vec3(Vec3::Zero()), false, contact);
    if (!problem.empty())
      complain(fmt::format("contact of grains {} and {}: {}", first.id, second.id, problem),
               "lengths are in metres");
    packing.contacts.push_back(contact);
  }
}

}  // namespace suffuse::analysis
