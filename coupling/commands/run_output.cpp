#include "run_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <vector>

#include "../liggghts/grains_file.h"
#include "../liggghts/instance.h"
#include "saved_set.h"
#include "styles/style_support.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/error.h"
#include "suffuse/common/hdf5_file.h"
#include "suffuse/common/paths.h"
#include "suffuse/common/safe_file.h"
#include "suffuse/lbm/checkpoint.h"

namespace suffuse::coupling {

namespace {

/// Before the run spends any time. What an earlier run left under the names is kept under others, unless it
/// goes on. Collective.
void open_files_of(const OutputRequest& request, const std::function<bool(const std::string&)>& goes_on,
                   LAMMPS_NS::LAMMPS* lmp) {
  const std::string who = "lbm output " + request.id;
  std::string notes;
  on_first_rank(who, communicator_of(lmp), [&] {
    for (const std::string& file : files_of(request)) {
      require_writable(file, who);
      if (goes_on(file)) continue;
      if (const auto earlier = keep_earlier_hdf5(file, who))
        notes += fmt::format("{}: note: {} of an earlier run is now {}\n", who, file, *earlier);
    }
  });
  if (!notes.empty()) tell(lmp, notes);
}

bool exists_for_all(const std::string& file, MPI_Comm communicator) {
  int rank = 0, exists = 0;
  MPI_Comm_rank(communicator, &rank);
  if (rank == 0) exists = is_there(file) ? 1 : 0;
  MPI_Bcast(&exists, 1, MPI_INT, 0, communicator);
  return exists != 0;
}

/// Before the name of a quantity among the monitors' references.
constexpr const char* kWarnedMark = "warned of: ";
/// LIGGGHTS's step in a saved state of the water.
constexpr const char* kGrainsStep = "liggghts_step";

std::string grains_file(const std::string& file) {
  const std::filesystem::path path(file);
  return (path.parent_path() / (path.stem().string() + "_grains" + path.extension().string())).string();
}

}  // namespace

void write_checkpoint(LAMMPS_NS::LAMMPS* lmp, const CoupledSimulation& simulation,
                      const MonitorReferences& references, const std::string& file) {
  const std::string who = "lbm restart write";
  const NewSet set = begin_set(file, who, communicator_of(lmp));
  lbm::save_state(simulation.fluid(), set.fluid);
  {
    Hdf5File state(set.fluid, Hdf5File::Mode::append, communicator_of(lmp));
    state.reserve(sizeof(float) *
                  lbm::CellBox{{0, 0, 0}, simulation.fluid().decomposition().cells()}.volume());
    state.set_attribute("/", kGrainsStep, step_of(lmp));
    save_settings(state, simulation);
    save_references(state, references, communicator_of(lmp));
    save_pore_coefficients(state, simulation);
    save_walls(state, simulation);
    save_method(state, simulation);
    state.close();
  }
  write_grains_file(lmp, set.grains, who);
  finish_set(file, who, communicator_of(lmp));
}

namespace {
std::int64_t saved_step(LAMMPS_NS::LAMMPS* lmp, const std::string& file) {
  return Hdf5File(file, Hdf5File::Mode::read, communicator_of(lmp)).integer_attribute("/", kGrainsStep);
}
}  // namespace

bool grains_are_of(LAMMPS_NS::LAMMPS* lmp, const std::string& file) {
  return saved_step(lmp, file) == step_of(lmp);
}

void require_grains_of(LAMMPS_NS::LAMMPS* lmp, const std::string& file) {
  const std::int64_t saved = saved_step(lmp, file);
  if (saved != step_of(lmp))
    throw_user_error(
        {"lbm restart", "read " + file, fmt::format("water of LIGGGHTS's step {}", saved),
         fmt::format("meet grains of that step, not of step {}", step_of(lmp)),
         "read_restart the grains of the same state: FILE.grains with FILE, FILE.1/grains with FILE.1"});
}

bool RunOutput::was_written(const std::string& file) const {
  return written_.contains(one_name_of(file));
}

void RunOutput::prepare(const LbmRequest& settings, const Scene& scene, const MappedScene& mapped,
                        bool took_up_state) {
  prepare_monitors(settings, scene, mapped, took_up_state);
  prepare_fields(settings, scene, took_up_state);
  checkpoint_ = settings.checkpoint;
  if (checkpoint_) require_free_for_sets(checkpoint_->file, "lbm restart write", communicator_of(scene.lmp));
  checkpoint_every_ = checkpoint_ ? scene.simulation.units().steps_in(checkpoint_->every) : 0;
}

void RunOutput::prepare_monitors(const LbmRequest& settings, const Scene& scene, const MappedScene& mapped,
                                 bool took_up_state) {
  std::erase_if(monitors_, [&](const auto& open) {
    const bool stays = std::any_of(settings.monitors.begin(), settings.monitors.end(),
                                   [&](const MonitorRequest& m) { return m == open->request(); });
    if (!stays) open->add_references(closed_);
    return !stays;
  });
  for (const MonitorRequest& request : settings.monitors) {
    if (std::any_of(monitors_.begin(), monitors_.end(),
                    [&](const auto& open) { return open->request().id == request.id; }))
      continue;
    const bool same_run = was_written(request.file);
    std::optional<SeriesContinuation> continues;
    if (same_run || took_up_state) continues = {scene.simulation.time_si(), same_run};
    monitors_.push_back(
        std::make_unique<Monitor>(request, scene, mapped, continues, same_run ? closed_ : references_));
    written_.insert(one_name_of(request.file));
    // Another monitor of this name, later, begins with its own samples.
    std::erase_if(references_, [&](const auto& entry) { return entry.first.starts_with(request.id + ": "); });
  }
}

void RunOutput::prepare_fields(const LbmRequest& settings, const Scene& scene, bool took_up_state) {
  std::erase_if(fields_, [&](const auto& open) {
    return std::none_of(settings.outputs.begin(), settings.outputs.end(),
                        [&](const OutputRequest& o) { return o == open->request; });
  });
  for (const OutputRequest& request : settings.outputs)
    if (std::none_of(fields_.begin(), fields_.end(),
                     [&](const auto& open) { return open->request.id == request.id; }))
      fields_.push_back(open_fields(request, scene, took_up_state));
}

std::unique_ptr<RunOutput::Fields> RunOutput::open_fields(const OutputRequest& request, const Scene& scene,
                                                          bool took_up_state) {
  CoupledSimulation& simulation = scene.simulation;
  const auto goes_on = [&](const std::string& file) { return took_up_state || was_written(file); };
  if (simulation.method() != nullptr &&
      std::count(request.fields.begin(), request.fields.end(), lbm::Field::density) > 0)
    throw_user_error({"lbm output " + request.id, "density", "asked for",
                      "not be a field of the averaged flow, whose density is constant", "take pressure"});
  const bool appends = goes_on(request.file);
  const bool has_first =
      appends && !was_written(request.file) && exists_for_all(request.file, communicator_of(scene.lmp));
  open_files_of(request, goes_on, scene.lmp);
  lbm::FieldOutputSettings fields;
  fields.path = request.file;
  fields.fields = request.fields;
  fields.origin = simulation.origin();
  fields.append = appends;
  fields.solid_fraction = [&simulation](const lbm::Index3& cell) { return simulation.solid_fraction(cell); };
  if (simulation.method() != nullptr)
    fields.for_each_point = [&simulation](const lbm::Fluid::PointVisitor& visit) {
      simulation.for_each_point(visit);
    };
  auto made = std::make_unique<Fields>(Fields{request,
                                              simulation.units().steps_in(request.every),
                                              -1,
                                              has_first,
                                              lbm::FieldOutput(fields, simulation.units()),
                                              {}});
  if (request.grains) made->grains.emplace(grains_file(request.file), goes_on(grains_file(request.file)));
  for (const std::string& file : files_of(request)) written_.insert(one_name_of(file));
  return made;
}

bool RunOutput::wants_values(long step) const {
  return std::any_of(monitors_.begin(), monitors_.end(),
                     [&](const auto& monitor) { return step % monitor->every() == 0; });
}

bool RunOutput::wants_contacts(long step) const {
  return std::any_of(fields_.begin(), fields_.end(), [&](const auto& fields) {
    return fields->request.contacts && step % fields->every == 0;
  });
}

bool RunOutput::due(long step) const {
  return wants_values(step) || (checkpoint_every_ > 0 && step % checkpoint_every_ == 0) ||
         std::any_of(fields_.begin(), fields_.end(),
                     [&](const auto& fields) { return step % fields->every == 0; });
}

void RunOutput::write(const Scene& scene) {
  CoupledSimulation& simulation = scene.simulation;
  const long step = simulation.fluid().steps();
  if (saves(step)) (void)save(scene);
  const MappedScene mapped = simulation.map();  // cells as the grains are now
  for (const auto& monitor : monitors_)
    if (step % monitor->every() == 0) monitor->write(scene, mapped, sample_);
  for (const auto& fields : fields_) {
    const bool first = fields->last_step < 0 && !fields->has_first;
    if ((step % fields->every != 0 && !first) || fields->last_step == step) continue;
    fields->last_step = step;
    fields->fluid.write(simulation.fluid());
    if (!fields->grains) continue;
    write_grains(*fields, scene);
  }
  started_ = true;
}

void RunOutput::write_grains(Fields& fields, const Scene& scene) {
  LiggghtsPort& port = scene.port;
  CoupledSimulation& simulation = scene.simulation;
  simulation.refresh_loads();
  GrainSnapshot snapshot;
  snapshot.step = simulation.fluid().steps();
  snapshot.time = simulation.time_si();
  if (fields.request.contacts) snapshot.network = &port.contacts();
  snapshot.grains = port.grains();
  snapshot.memory = port.memory();
  snapshot.box_low = port.box_low();
  snapshot.box_high = port.box_high();
  snapshot.periodic = port.periodic();
  fields.grains->write(snapshot, simulation.fluid().decomposition().communicator());
}

/// Before anything else is written at this instant, so that a run which takes the state up writes the same.
std::optional<std::string> RunOutput::save(const Scene& scene) {
  if (!checkpoint_) return {};
  CoupledSimulation& simulation = scene.simulation;
  simulation.refresh_loads();  // the grains' memory is saved with them
  scene.port.set_up_again();
  write_checkpoint(scene.lmp, simulation, references(), checkpoint_->file);
  (void)simulation.map_anew();
  sample_.reset();  // of cells as they were
  last_state_ = fmt::format("{} (fluid step {})", checkpoint_->file, simulation.fluid().steps());
  return checkpoint_->file;
}

const PlaneSums* RunOutput::sample_now(long step, CoupledSimulation& simulation) {
  sample_.reset();
  const auto due = std::find_if(monitors_.begin(), monitors_.end(),
                                [&](const auto& monitor) { return step % monitor->every() == 0; });
  if (due == monitors_.end() || saves(step)) return nullptr;
  sample_ = plane_sums(simulation.map(), (*due)->request().axis);
  return &*sample_;
}

/// What a guard has warned of travels with the monitors' references, under a name that no monitor has.
void RunOutput::set_references(MonitorReferences references) {
  constexpr std::string_view mark = kWarnedMark;
  std::erase_if(references, [&](const auto& entry) {
    if (!entry.first.starts_with(mark)) return false;
    warned_.insert(entry.first.substr(mark.size()));
    return true;
  });
  references_ = std::move(references);
}

bool RunOutput::saves(long step) const {
  return checkpoint_every_ > 0 && started_ && step % checkpoint_every_ == 0;
}

MonitorReferences RunOutput::references() const {
  MonitorReferences all = effects_;
  for (const std::string& name : warned_) all[kWarnedMark + name] = {1};
  for (const auto& monitor : monitors_) monitor->add_references(all);
  return all;
}

}  // namespace suffuse::coupling
