#include "monitor.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "comm.h"
#include "lammps.h"
#include "lbm_settings.h"
#include "modify.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/error.h"

namespace suffuse::coupling {

const PlaneSums& Sample::planes() {
  if (!planes_) planes_ = plane_sums(simulation, axis);
  return *planes_;
}

const LiggghtsPort::Summary& Sample::grains() {
  if (!grains_) {
    simulation.refresh_loads();
    grains_ = port.summary();
  }
  return *grains_;
}

double Sample::specific_weight() const {
  const double given = simulation.settings().gravity.norm();
  return simulation.units().density() * (given > 0 ? given : 9.81);
}

Monitor::Monitor(const MonitorRequest& request, LAMMPS_NS::LAMMPS* lmp, LiggghtsPort& port,
                 CoupledSimulation& simulation, std::optional<double> continue_after,
                 const MonitorReferences& references)
    : request_(request), every_(steps_in(request.every, simulation.units())), speaks_(lmp->comm->me == 0) {
  Sample now(lmp, port, simulation, request.axis);
  for (const QuantityRequest& quantity : request.quantities)
    quantities_.push_back(make_quantity(quantity, request, now));
  for (Quantity& quantity : quantities_)
    if (const auto saved = references.find(key(quantity)); quantity.reference && saved != references.end())
      *quantity.reference = saved->second;
  open(continue_after, lmp->world);
}

std::string Monitor::key(const Quantity& quantity) const {
  return fmt::format("{}: {}", request_.id, fmt::join(quantity.columns, ","));
}

void Monitor::add_references(MonitorReferences& references) const {
  for (const Quantity& quantity : quantities_)
    if (quantity.reference && !quantity.reference->empty()) references[key(quantity)] = *quantity.reference;
}

void Monitor::open(std::optional<double> continue_after, MPI_Comm communicator) {
  int failed = 0;
  if (speaks_) {
    std::string header = "time_s";
    for (const Quantity& quantity : quantities_)
      for (const std::string& column : quantity.columns) header += "," + column;
    std::vector<std::string> kept{header};
    if (continue_after) {
      std::ifstream old(request_.file);
      std::string line;
      if (std::getline(old, line) && line == header)
        while (std::getline(old, line))
          if (std::strtod(line.c_str(), nullptr) < *continue_after * (1 - 1e-9)) kept.push_back(line);
    }
    file_.open(request_.file, std::ios::trunc);
    for (const std::string& line : kept) file_ << line << '\n';
    failed = file_.flush() ? 0 : 1;
  }
  MPI_Bcast(&failed, 1, MPI_INT, 0, communicator);
  if (failed != 0)
    throw_user_error(
        {"lbm monitor " + request_.id, "file", request_.file, "be writable", "check its folder"});
}

void Monitor::write(LAMMPS_NS::LAMMPS* lmp, LiggghtsPort& port, CoupledSimulation& simulation) {
  if (simulation.fluid().steps() == last_step_) return;
  last_step_ = simulation.fluid().steps();
  Sample sample(lmp, port, simulation, request_.axis);
  std::vector<double> values{simulation.time_si()};
  lmp->modify->clearstep_compute();  // values of other steps are not those of this one
  for (const Quantity& quantity : quantities_) quantity.append(sample, values);
  const std::string who = "lbm monitor " + request_.id;
  on_first_rank(who, lmp->world, [&] {
    std::string line;
    for (const double value : values) line += fmt::format("{}{}", line.empty() ? "" : ",", value);
    const auto whole = static_cast<std::uintmax_t>(file_.tellp());
    file_ << line << std::endl;
    if (file_) return;
    file_.close();
    std::filesystem::resize_file(request_.file, whole);  // no half row
    throw_user_error({who, "file", request_.file, "take what is written", "is the disk full?"});
  });
}

}  // namespace suffuse::coupling
