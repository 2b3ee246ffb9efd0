#include "grading/grain_snapshot.h"

#include <fmt/format.h>

#include "contacts/contact_columns.h"
#include "contacts/dump_file.h"
#include "suffuse/common/error.h"

namespace suffuse::analysis {

namespace {

void read_rows(DumpFile& file, const DumpHeader& header, const std::string& path, const std::string& who,
               bool positions, GrainSnapshot& snapshot) {
  using namespace grain_place;
  const ColumnPlan plan = plan_grain_columns(header.columns, {}, who);
  const bool has_size = plan.has[radius] || plan.has[diameter];
  if (!has_size)
    throw_user_error(
        {who, path, "no column radius", "have the grains' radii", "add radius to its dump custom"});
  if (positions && !plan.has_vector(x))
    throw_user_error(
        {who, path, "no columns x y z", "have the grains' positions", "add x y z to its dump custom"});
  snapshot.step = header.step;
  snapshot.grains.clear();
  snapshot.box = {
      header.box_low, header.box_high, {header.periodic[0], header.periodic[1], header.periodic[2]}};
  file.rows(plan.place_of_column, count, [&](std::span<const double> row) {
    const double size = plan.has[radius] ? row[radius] : row[diameter] / 2;
    snapshot.grains.push_back({positions ? Vec3(row[x], row[y], row[z]) : Vec3::Zero(), size});
  });
}

}  // namespace

GrainSnapshot read_grain_snapshot(const std::string& path, const std::string& who, bool positions,
                                  std::optional<std::int64_t> step) {
  DumpFile file(path, who);
  DumpHeader header;
  GrainSnapshot snapshot;
  bool found = false;
  while (file.next(header)) {
    if (header.kind != DumpHeader::Kind::grains)
      throw_user_error(
          {who, path, "a dump of contacts", "be a dump of grains", "give the file of dump custom"});
    if (step && header.step != *step) continue;
    read_rows(file, header, path, who, positions, snapshot);
    found = true;
    if (step) break;
  }
  if (!found)
    throw_user_error({who, path, step ? fmt::format("no step {}", *step) : std::string("no snapshot"),
                      "hold the snapshot asked for", ""});
  if (snapshot.grains.empty())
    throw_user_error({who, path, fmt::format("no grains at step {}", snapshot.step), "hold grains", ""});
  return snapshot;
}

std::vector<double> diameters_of(const GrainSnapshot& snapshot) {
  std::vector<double> diameters;
  diameters.reserve(snapshot.grains.size());
  for (const Sphere& grain : snapshot.grains) diameters.push_back(2 * grain.radius);
  return diameters;
}

}  // namespace suffuse::analysis
