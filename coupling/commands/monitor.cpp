#include "monitor.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "../liggghts/instance.h"
#include "lbm_request.h"
#include "styles/style_support.h"
#include "suffuse/common/error.h"

namespace suffuse::coupling {

const PlaneSums& Sample::planes() {
  if (!planes_) planes_ = plane_sums(mapped_, axis);
  return *planes_;
}

const LiggghtsPort::Summary& Sample::grains() {
  if (!grains_) {
    scene.simulation.refresh_loads();
    grains_ = scene.port.summary();
  }
  return *grains_;
}

double Sample::specific_weight() const {
  const double given = scene.simulation.settings().gravity.norm();
  return scene.simulation.units().density() * (given > 0 ? given : 9.81);
}

Monitor::Monitor(const MonitorRequest& request, const Scene& scene, const MappedScene& mapped,
                 std::optional<SeriesContinuation> continues, const MonitorReferences& references)
    : request_(request), every_(scene.simulation.units().steps_in(request.every)) {
  Sample now(scene, mapped, request.axis);
  for (const QuantityRequest& quantity : request.quantities)
    quantities_.push_back(make_quantity(quantity, request, now));
  for (Quantity& quantity : quantities_)
    if (const auto saved = references.find(key(quantity)); quantity.reference && saved != references.end())
      *quantity.reference = saved->second;
  refuse_repeated_columns();
  open(scene, continues);
}

void Monitor::refuse_repeated_columns() const {
  std::set<std::string> names;
  for (const Quantity& quantity : quantities_)
    for (const std::string& column : quantity.columns)
      if (!names.insert(column).second)
        throw_user_error({"lbm monitor " + request_.id, "column", column + " twice", "be there once",
                          "drop one of the quantities, or name it with `as`"});
}

std::string Monitor::key(const Quantity& quantity) const {
  return fmt::format("{}: {}", request_.id, fmt::join(quantity.columns, ","));
}

void Monitor::add_references(MonitorReferences& references) const {
  for (const Quantity& quantity : quantities_)
    if (quantity.reference && !quantity.reference->empty()) references[key(quantity)] = *quantity.reference;
}

void Monitor::open(const Scene& scene, std::optional<SeriesContinuation> continues) {
  std::string header = "time_s";
  for (const Quantity& quantity : quantities_)
    for (const std::string& column : quantity.columns) header += "," + column;
  const std::string who = "lbm monitor " + request_.id;
  file_.emplace(request_.file, header, who, continues, communicator_of(scene.lmp));
  if (file_->last_time() >= scene.simulation.time_si() * (1 - 1e-9))
    last_step_ = scene.simulation.fluid().steps();  // its row is there
  if (!file_->earlier().empty())
    tell(scene.lmp,
         fmt::format("{}: note: {} of an earlier run is now {}\n", who, request_.file, file_->earlier()));
}

void Monitor::write(const Scene& scene, const MappedScene& mapped, const std::optional<PlaneSums>& planes) {
  const CoupledSimulation& simulation = scene.simulation;
  if (simulation.fluid().steps() == last_step_) return;
  last_step_ = simulation.fluid().steps();
  Sample sample(scene, mapped, request_.axis);
  if (planes && planes->axis == request_.axis) sample.set_planes(*planes);
  std::vector<double> values{simulation.time_si()};
  forget_values(scene.lmp);
  for (const Quantity& quantity : quantities_) quantity.append(sample, values);
  file_->add(values);
}

}  // namespace suffuse::coupling
