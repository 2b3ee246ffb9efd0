// What a monitor can be asked for: one row of kKinds each, from which reading, help and docs/reference/lbm.md
// follow.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../liggghts/script_references.h"
#include "monitor.h"
#include "suffuse/common/error.h"
#include "suffuse/lbm/health.h"
#include "suffuse/micromechanics/fluidisation.h"

namespace suffuse::coupling {

namespace {

using LAMMPS_NS::LAMMPS;

std::string axis_name(int axis) {
  return std::string(1, static_cast<char>('x' + axis));
}

std::vector<std::string> vector_columns(const std::string& name, const std::string& unit) {
  std::vector<std::string> columns;
  for (int a = 0; a < 3; ++a) columns.push_back(fmt::format("{}_{}_{}", name, axis_name(a), unit));
  return columns;
}

void append_vector(std::vector<double>& row, const Vec3& vector) {
  row.insert(row.end(), vector.data(), vector.data() + 3);
}

/// Heights of the layers' ends above the fluid's low corner, from the top layer down (thesis section 6.3).
struct LayerEnds {
  double low, high;
};
std::vector<LayerEnds> layer_ends(const LayerRequest& layers, double fluid_low) {
  std::vector<LayerEnds> ends;
  const double thickness = (layers.high - layers.low) / layers.count;
  for (int k = 0; k < layers.count; ++k) {
    const double high = layers.high - k * thickness - fluid_low;
    ends.push_back({high - thickness, high});
  }
  return ends;
}

std::vector<std::string> layer_columns(const std::string& name, int count, const std::string& unit) {
  std::vector<std::string> columns;
  for (int k = 1; k <= count; ++k) columns.push_back(fmt::format("{}_{}{}", name, k, unit));
  return columns;
}

double gradient_between(Sample& sample, double low, double high) {
  const Vec3& driven = sample.scene.simulation.settings().pressure_gradient;
  return hydraulic_gradient(sample.planes(), low, high, driven[sample.axis], sample.specific_weight());
}

/// Layers lie in the fluid and are no thinner than its cells.
void check_layers(const MonitorRequest& monitor, const CoupledSimulation& simulation) {
  const double spacing = simulation.units().spacing(), low = simulation.origin()[monitor.axis],
               high = low +
                      spacing *
                          simulation.fluid().decomposition().cells()[static_cast<std::size_t>(monitor.axis)],
               rounding = 0.5 * spacing;
  const LayerRequest& layers = monitor.layers;
  const std::string who = "lbm monitor " + monitor.id;
  if (layers.low < low - rounding || layers.high > high + rounding)
    throw_user_error(
        {who, "layers", fmt::format("{:g} {:g}", layers.low, layers.high),
         fmt::format("lie in the fluid, {:g} to {:g} m along {}", low, high, axis_name(monitor.axis)), ""});
  if (layers.high - layers.low < 0.999 * layers.count * spacing)
    throw_user_error(
        {who, "layers",
         fmt::format("{} of {:g} m each", layers.count, (layers.high - layers.low) / layers.count),
         fmt::format("be at least a cell, {:g} m, thick", spacing), "ask for fewer"});
}

Quantity layer_quantity(const std::string& word, const MonitorRequest& monitor, double fluid_low) {
  const std::vector<LayerEnds> ends = layer_ends(monitor.layers, fluid_low);
  const auto plane = [](const PlaneSums& planes, double height) {
    return static_cast<std::size_t>(
        std::clamp(std::round(height / planes.spacing), 0., static_cast<double>(planes.planes())));
  };
  if (word == "layer_gradient")
    return {layer_columns("hydraulic_gradient_layer", monitor.layers.count, ""),
            [ends](Sample& sample, std::vector<double>& row) {
              for (const LayerEnds& e : ends) row.push_back(gradient_between(sample, e.low, e.high));
            }};
  if (word == "layer_porosity")
    return {layer_columns("porosity_layer", monitor.layers.count, ""),
            [ends, plane](Sample& sample, std::vector<double>& row) {
              const PlaneSums& planes = sample.planes();
              for (const LayerEnds& e : ends)
                row.push_back(planes.porosity(plane(planes, e.low), plane(planes, e.high)));
            }};
  return {layer_columns("pressure_layer", monitor.layers.count, "_pa"),
          [ends](Sample& sample, std::vector<double>& row) {
            for (const LayerEnds& e : ends)
              row.push_back(sample.planes().pressure_at(0.5 * (e.low + e.high)));
          }};
}

/// Height below which this share of the solids' volume lies, m above the first plane's low side.
double solid_height(const PlaneSums& planes, double share) {
  double all = 0, sum = 0;
  for (std::size_t i = 0; i < planes.planes(); ++i) all += planes.solid_share(i);
  if (all <= 0) return 0;
  for (std::size_t i = 0; i < planes.planes(); ++i) {
    const double here = planes.solid_share(i);
    if (sum + here >= share * all)
      return planes.spacing * (static_cast<double>(i) + (here > 0 ? (share * all - sum) / here : 0));
    sum += here;
  }
  return planes.spacing * static_cast<double>(planes.planes());
}

double centre_of_solids(const PlaneSums& planes) {
  double all = 0, moment = 0;
  for (std::size_t i = 0; i < planes.planes(); ++i) {
    const double here = planes.solid_share(i);
    all += here;
    moment += here * planes.spacing * (static_cast<double>(i) + 0.5);
  }
  return all > 0 ? moment / all : 0;
}

Quantity bed_quantity(int axis) {
  return {{"bed_height_m", "bed_porosity", "centre_of_grains_" + axis_name(axis) + "_m"},
          [](Sample& sample, std::vector<double>& row) {
            const PlaneSums& planes = sample.planes();
            const double height = solid_height(planes, micromechanics::kBedShare);
            double solid = 0;
            for (std::size_t i = 0; i < planes.planes(); ++i) solid += planes.spacing * planes.solid_share(i);
            row.push_back(height);
            row.push_back(height > 0 ? 1 - micromechanics::kBedShare * solid / planes.room_below(height) : 1);
            row.push_back(centre_of_solids(planes));
          }};
}

/// Mass of the fluid, what all populations hold beyond rest (conserved but for the faces), and its change
/// less what came in through the faces across the axis, by the trapezoidal rule over the samples.
Quantity mass_quantity() {
  enum { first, last_time, last_inflow, came_in, size };
  auto state = std::make_shared<std::vector<double>>();
  return {{"fluid_mass_kg", "mass_change_kg", "mass_balance_kg"},
          [state](Sample& sample, std::vector<double>& row) {
            const PlaneSums& planes = sample.planes();
            const lbm::Units& units = sample.scene.simulation.units();
            const lbm::Index3& cells = sample.scene.simulation.fluid().decomposition().cells();
            const double area = std::pow(units.spacing(), 2) * cells[0] * cells[1] * cells[2] /
                                static_cast<double>(planes.planes());
            // Walls and symmetry let nothing in, and what leaves through a periodic face comes in by the
            // other.
            const lbm::FluidSettings& settings = sample.scene.simulation.fluid().settings();
            const auto through = [&](int side, std::size_t plane) {
              const lbm::FaceKind kind =
                  settings.faces[static_cast<std::size_t>(2 * sample.axis + side)].kind;
              const bool open = kind == lbm::FaceKind::velocity || kind == lbm::FaceKind::pressure;
              // Water under pressure is denser; `incompressible` and the averaged flow move it at the
              // reference density.
              const double denser =
                  settings.collision.incompressible || sample.scene.simulation.method() != nullptr
                      ? 1
                      : units.pressure_to_density_lattice(planes.pressure[plane]);
              return open ? units.density() * denser * planes.flux[plane][sample.axis] : 0;
            };
            const double inflow = area * (through(0, 0) - through(1, planes.planes() - 1));
            const double time = sample.scene.simulation.time_si();
            if (state->size() != size) *state = {planes.stored_mass, time, inflow, 0};
            std::vector<double>& s = *state;
            s[came_in] += 0.5 * (time - s[last_time]) * (inflow + s[last_inflow]);
            s[last_time] = time;
            s[last_inflow] = inflow;
            const double change = planes.stored_mass - s[first];
            row.insert(row.end(), {planes.fluid_mass, change, change - s[came_in]});
          },
          state};
}

Quantity discharge_quantity(int axis) {
  const std::string name = "discharge_" + axis_name(axis);
  return {{name + "lo_m3_per_s", name + "hi_m3_per_s"}, [](Sample& sample, std::vector<double>& row) {
            const PlaneSums& planes = sample.planes();
            const lbm::Index3& cells = sample.scene.simulation.fluid().decomposition().cells();
            const double area = std::pow(planes.spacing, 2) * cells[0] * cells[1] * cells[2] /
                                static_cast<double>(planes.planes());
            row.push_back(area * planes.flux.front()[sample.axis]);
            row.push_back(area * planes.flux.back()[sample.axis]);
          }};
}

std::vector<std::string> class_columns(const std::string& word, const std::vector<double>& bounds,
                                       const std::string& unit) {
  std::vector<std::string> columns;
  for (std::size_t k = 0; k <= bounds.size(); ++k) {
    std::string name = word;
    if (k > 0) name += fmt::format("_from_{:g}_m", bounds[k - 1]);
    if (k < bounds.size()) name += fmt::format("_below_{:g}_m", bounds[k]);
    columns.push_back(name + unit);
  }
  return columns;
}

Quantity grains_left_quantity(const QuantityRequest& request, Sample& now) {
  const auto& bounds = request.numbers;
  const std::vector<std::string> columns = class_columns(request.word, bounds, "");
  const auto first = std::make_shared<std::vector<double>>(now.scene.port.grains_by_size(bounds));
  return {columns,
          [bounds, first](Sample& sample, std::vector<double>& row) {
            const std::vector<double> left = sample.scene.port.grains_by_size(bounds);
            for (std::size_t k = 0; k < left.size(); ++k) row.push_back((*first)[k] - left[k]);
          },
          first};
}

/// What has gone, or has come to lie beyond a height, since the first sample.
Quantity eroded_mass_quantity(const QuantityRequest& request, int axis, Sample& now) {
  const auto& bounds = request.numbers;
  const double above = request.above.value_or(std::numeric_limits<double>::infinity());
  const auto first = std::make_shared<std::vector<double>>(now.scene.port.mass_by_size(bounds, axis, above));
  return {class_columns(request.word, bounds, "_kg"),
          [bounds, axis, above, first](Sample& sample, std::vector<double>& row) {
            const std::vector<double> left = sample.scene.port.mass_by_size(bounds, axis, above);
            for (std::size_t k = 0; k < left.size(); ++k) row.push_back((*first)[k] - left[k]);
          },
          first};
}

Quantity mean_force_quantity(const QuantityRequest& request, LAMMPS* lmp) {
  const int bit = group_bit(lmp, request.group);
  if (bit == 0)
    throw_user_error({"lbm monitor", "mean_force", request.group, "name a group that exists",
                      "write `group " + request.group + " ...` before"});
  return {vector_columns("mean_force_" + request.group, "n"),
          [bit](Sample& sample, std::vector<double>& row) {
            sample.scene.simulation.refresh_loads();
            append_vector(row, sample.scene.port.mean_load(bit));
          }};
}

Quantity reference_quantity(const QuantityRequest& request, LAMMPS* lmp) {
  const std::vector<std::string> references = expanded_references(lmp, request.word);
  const bool numbered = references.size() != 1 || request.word.find("[*]") != std::string::npos;
  std::vector<std::string> columns;
  for (std::size_t k = 0; k < references.size(); ++k) {
    if (request.name.empty())
      columns.push_back((request.relative ? "relative_" : "") + references[k]);
    else
      columns.push_back(numbered ? fmt::format("{}_{}", request.name, k + 1) : request.name);
  }
  auto first = std::make_shared<std::vector<double>>();
  return {columns,
          [references, first, relative = request.relative](Sample& sample, std::vector<double>& row) {
            std::vector<double> values;
            for (const std::string& reference : references)
              values.push_back(value_of_reference(sample.scene.lmp, reference));
            if (relative && first->empty()) {
              for (std::size_t k = 0; k < values.size(); ++k)
                if (values[k] == 0)
                  throw_user_error({"lbm monitor", "relative " + references[k], "0 at the first sample",
                                    "be another value: samples are divided by it",
                                    "drop `relative`, or start the monitor later"});
              *first = values;
            }
            for (std::size_t k = 0; k < values.size(); ++k)
              row.push_back(relative ? values[k] / (*first)[k] : values[k]);
          },
          first};
}

Quantity velocity_quantity(const QuantityRequest& request, const MonitorRequest&, Sample&) {
  return {vector_columns(request.word, "m_per_s"), [](Sample& sample, std::vector<double>& row) {
            append_vector(row, sample.planes().superficial_velocity());
          }};
}

Quantity gradient_quantity(const QuantityRequest& request, const MonitorRequest& monitor, Sample&) {
  return {
      {request.word + "_" + axis_name(monitor.axis)}, [](Sample& sample, std::vector<double>& row) {
        const PlaneSums& planes = sample.planes();
        row.push_back(gradient_between(sample, planes.spacing * static_cast<double>(planes.first_with_room()),
                                       planes.spacing * static_cast<double>(planes.end_of_room())));
      }};
}

Quantity checked_layer_quantity(const QuantityRequest& request, const MonitorRequest& monitor, Sample& now) {
  check_layers(monitor, now.scene.simulation);
  return layer_quantity(request.word, monitor, now.scene.simulation.origin()[monitor.axis]);
}

Quantity force_quantity(const QuantityRequest& request, const MonitorRequest&, Sample&) {
  return {vector_columns(request.word, "n"),
          [](Sample& sample, std::vector<double>& row) { append_vector(row, sample.grains().load); }};
}

Quantity energy_quantity() {
  return {{"fluid_kinetic_energy_j", "grains_kinetic_energy_j"},
          [](Sample& sample, std::vector<double>& row) {
            row.push_back(sample.planes().fluid_kinetic_energy);
            row.push_back(sample.grains().kinetic_energy);
          }};
}

Quantity number_quantity() {
  return {{"grains"}, [](Sample& sample, std::vector<double>& row) {
            row.push_back(static_cast<double>(sample.grains().grains));
          }};
}

Quantity extremes_quantity() {
  return {{"largest_mach", "smallest_density_lattice", "largest_density_lattice"},
          [](Sample& sample, std::vector<double>& row) {
            const lbm::FluidExtremes& e = sample.planes().extremes;
            row.insert(row.end(), {lbm::mach_of(e), e.smallest_density, e.largest_density});
          }};
}

void read_group(ArgumentReader& reader, QuantityRequest& quantity) {
  quantity.group = reader.word("group of mean_force");
}

void read_diameters(ArgumentReader& reader, QuantityRequest& quantity) {
  while (reader.next_is_number()) quantity.numbers.push_back(reader.positive("diameter of " + quantity.word));
  if (!std::is_sorted(quantity.numbers.begin(), quantity.numbers.end()))
    throw_user_error({reader.who(), quantity.word, "diameters out of order", "rise", "sort them"});
}

void read_height_and_diameters(ArgumentReader& reader, QuantityRequest& quantity) {
  if (reader.accept("above")) quantity.above = reader.number("height of " + quantity.word);
  read_diameters(reader, quantity);
}

using Q = const QuantityRequest&;
using M = const MonitorRequest&;

// clang-format off
const QuantityKind kKinds[] = {
    {{"superficial_velocity", "", "m/s", "", "", "Darcy velocity over the whole box but for what lies behind walls: flux of fluid and grains less that of the grains"},
     nullptr, velocity_quantity},
    {{"hydraulic_gradient", "", "", "", "", "−Δp/(ρ g L) along the axis over the box, or the part of it with room for water, plus the driving `pressure_gradient`"},
     nullptr, gradient_quantity},
    {{"layer_gradient", "", "", "", "", "the same over each of the `layers`, layer 1 on top; they lie in the fluid and are a cell thick at least"},
     nullptr, checked_layer_quantity, true},
    {{"layer_porosity", "", "", "", "", "of each layer; what lies behind walls is no part of it"},
     nullptr, checked_layer_quantity, true},
    {{"layer_pressure", "", "Pa", "", "", "at each layer's middle, mean over the fluid only"},
     nullptr, checked_layer_quantity, true},
    {{"bed", "", "m", "", "", "height below which 99 % of the solids lie, porosity up to there, centre of the solids"},
     nullptr, [](Q, M monitor, Sample&) { return bed_quantity(monitor.axis); }},
    {{"solid_force", "", "N", "", "", "sum of the fluid's force on grains"},
     nullptr, force_quantity},
    {{"mean_force", "GROUP", "N", "", "", "mean of the fluid's force over a group"},
     read_group, [](Q request, M, Sample& now) { return mean_force_quantity(request, now.scene.lmp); }},
    {{"mass", "", "kg", "", "", "fluid mass; change of all mass in the lattice; that less what velocity and pressure faces across the axis let in (trapezoidal over the samples): 0 in a closed box, to round-off"},
     nullptr, [](Q, M, Sample&) { return mass_quantity(); }},
    {{"discharge", "", "m³/s", "", "", "volume flux through the first and last plane of cells"},
     nullptr, [](Q, M monitor, Sample&) { return discharge_quantity(monitor.axis); }},
    {{"kinetic_energy", "", "J", "", "", "of the fluid and of the grains"},
     nullptr, [](Q, M, Sample&) { return energy_quantity(); }},
    {{"grains", "", "", "", "", "how many there are"},
     nullptr, [](Q, M, Sample&) { return number_quantity(); }},
    {{"grains_left", "D ...", "m", "", "", "how many fewer there are than at the start, by diameter classes; what is inserted meanwhile counts against it"},
     read_diameters, [](Q request, M, Sample& now) { return grains_left_quantity(request, now); }},
    {{"eroded_mass", "[above H] D ...", "kg, m", "", "", "mass of the grains that have gone since the start, or with `above` have come to lie beyond that coordinate along the axis, by diameter classes: all, or below the first D, between it and the second, ... above the last. A grain that falls back is no longer eroded; what is inserted below counts against it"},
     read_height_and_diameters, [](Q request, M monitor, Sample& now) { return eroded_mass_quantity(request, monitor.axis, now); }},
    {{"extremes", "", "", "", "", "largest Mach number, smallest and largest density (lattice units)"},
     nullptr, [](Q, M, Sample&) { return extremes_quantity(); }},
};
// clang-format on

}  // namespace

const std::vector<QuantityKind>& quantity_kinds() {
  static const std::vector<QuantityKind> kinds(std::begin(kKinds), std::end(kKinds));
  return kinds;
}

const QuantityKind* find_quantity(const std::string& word) {
  for (const QuantityKind& kind : quantity_kinds())
    if (kind.facts.word == word) return &kind;
  return nullptr;
}

Quantity make_quantity(const QuantityRequest& request, const MonitorRequest& monitor, Sample& now) {
  const QuantityKind* kind = find_quantity(request.word);
  return kind != nullptr ? kind->make(request, monitor, now) : reference_quantity(request, now.scene.lmp);
}

}  // namespace suffuse::coupling
