// suffuse-flow CASE.toml: a single-phase flow on any number of ranks (docs/lbm/suffuse-flow.md).
#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "suffuse/common/collective_text.h"
#include "suffuse/common/command_line_help.h"
#include "suffuse/common/count_text.h"
#include "suffuse/common/error.h"
#include "suffuse/common/hdf5_file.h"
#include "suffuse/common/progress.h"
#include "suffuse/common/provenance.h"
#include "suffuse/common/safe_file.h"
#include "suffuse/common/time_series_file.h"
#include "suffuse/lbm/checkpoint.h"
#include "suffuse/lbm/flow_case.h"
#include "suffuse/lbm/flow_words.h"
#include "suffuse/lbm/health.h"
#include "suffuse/lbm/run_loop.h"

namespace {

using namespace suffuse;
using namespace suffuse::lbm;
using Clock = std::chrono::steady_clock;

/// Exit code of a run that was to become steady and did not.
constexpr int kNotSteady = 3;
constexpr const char *kMonitor = "suffuse-flow [monitor]", *kOutput = "suffuse-flow [output]",
                     *kRestart = "suffuse-flow [restart]";

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// A running case: the fluid and what is due at which step.
class FlowRun final : private RunSteps {
 public:
  explicit FlowRun(const FlowCase& flow)
      : flow_(flow),
        units_(flow.units),
        fluid_(settings_of(flow, units_), Decomposition::balanced(MPI_COMM_WORLD, cells_of(flow, units_))),
        speaks_(fluid_.decomposition().rank() == 0) {
    if (const double steps = units_.time_to_lattice(flow_.time); steps > Units::kMostSteps)
      throw_user_error({"suffuse-flow", "time",
                        fmt::format("{:g} s, which are {:.3g} steps", flow_.time, steps),
                        fmt::format("be at most {:g} steps", Units::kMostSteps), "SI units"});
    require_followed_force();
    add_spheres();
    if (!flow_.restart_read.empty()) {
      const std::vector<bool> solids = local_solids();
      load_state(fluid_, flow_.restart_read, &units_);
      if (!flow_.spheres.empty()) require_same_solids(solids);
    }
    fluid_.set_force(force_at(flow_, units_, units_.time_to_si(static_cast<double>(fluid_.steps()))));
    for_each_cell(fluid_.decomposition().local_box(), [&](int x, int y, int z) {
      fluid_cells_ += fluid_.is_solid({x, y, z}) ? 0 : 1;
    });
    MPI_Allreduce(MPI_IN_PLACE, &fluid_cells_, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    if (fluid_cells_ == 0)
      throw_user_error({"suffuse-flow [solids]", "spheres", "all cells are solid",
                        "leave cells to the liquid", "the box is from 0 to size; SI units"});
  }

  /// Has the flow become steady, where it was to?
  enum class End { as_told, not_steady };

  End run() {
    tell_settings();
    open_files();
    first_ = fluid_.steps();
    const long steps = units_.steps_in(flow_.time);
    last_ = first_ + steps;
    check_every_ = std::max(10L, steps / 100);
    ProgressLine progress(speaks_);
    report(first_);
    progress.update(0, [this] { return details_; });
    write_due(first_);
    const RunEnd end = run_loop(
        *this, {first_, last_, check_every_, flow_.until_steady, std::max(2L, steps / 10)}, progress);
    progress.finish(details_);
    if (!flow_.restart_write.empty()) save();
    if (flow_.until_steady) tell_steadiness(end, fluid_.steps() - first_);
    tell_speed(fluid_.steps() - first_);
    return flow_.until_steady && !end.steady ? End::not_steady : End::as_told;
  }

 private:
  static FluidSettings settings_of(const FlowCase& flow, const Units& units) {
    FluidSettings settings;
    settings.collision = flow.collision;
    settings.collision.relaxation_time = units.relaxation_time();
    settings.precision = flow.precision;
    settings.faces = faces_at(flow, units, 0);
    check(faces_at(flow, units, 1e300), cells_of(flow, units));  // the values at the end of all ramps as well
    return settings;
  }

  /// Two steps a period at least: a faster swing would be seen at a few of its phases only.
  void require_followed_force() const {
    const double steps = flow_.frequency > 0 ? units_.time_to_lattice(1 / flow_.frequency) : 2;
    if (steps < 2)
      throw_user_error({"suffuse-flow [force]", "frequency",
                        fmt::format("{:g} Hz, a period of {:.3g} steps", flow_.frequency, steps),
                        "have two steps a period at least, better twenty", "use a smaller timestep"});
  }

  std::vector<bool> local_solids() const {
    std::vector<bool> solids;
    for_each_cell(fluid_.decomposition().local_box(), [&](int x, int y, int z) {
      solids.push_back(fluid_.is_solid({x, y, z}));
    });
    return solids;
  }

  /// A state keeps its own solids, and a liquid that flowed around others cannot go on around these.
  void require_same_solids(const std::vector<bool>& of_case) const {
    int differ = of_case == local_solids() ? 0 : 1;
    MPI_Allreduce(MPI_IN_PLACE, &differ, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    if (differ != 0)
      throw_user_error({"suffuse-flow [solids]", "spheres", "not those of " + flow_.restart_read,
                        "be the state's", "leave [solids] out to take the state's as they are"});
  }

  /// A sphere that holds no cell's centre would change nothing.
  void require_covering(const FlowSphere& sphere) const {
    Vec3 distance;
    for (int a = 0; a < 3; ++a) {
      const bool periodic = flow_.faces[static_cast<std::size_t>(2 * a)].kind == FaceKind::periodic;
      const double dx = units_.spacing(), x = sphere.centre[a] / dx;
      const double cell = std::floor(x);
      const double last = fluid_.decomposition().cells()[static_cast<std::size_t>(a)] - 1;
      distance[a] = dx * (x - 0.5 - (periodic ? cell : std::clamp(cell, 0., last)));
    }
    if (distance.norm() < sphere.radius) return;
    throw_user_error({"suffuse-flow [solids]", "spheres",
                      fmt::format("one of radius {:g} m at ({:g}, {:g}, {:g})", sphere.radius,
                                  sphere.centre[0], sphere.centre[1], sphere.centre[2]),
                      "hold the centre of a cell", "the box is from 0 to size; SI units"});
  }

  void add_spheres() {
    if (flow_.spheres.empty()) return;
    for (const FlowSphere& sphere : flow_.spheres) require_covering(sphere);
    const Vec3 size = flow_.size;
    fluid_.set_solids([&](const Index3& c) {
      const Vec3 centre = units_.spacing() * Vec3(c[0] + 0.5, c[1] + 0.5, c[2] + 0.5);
      const bool inside =
          std::any_of(flow_.spheres.begin(), flow_.spheres.end(), [&](const FlowSphere& sphere) {
            Vec3 d = centre - sphere.centre;
            for (int a = 0; a < 3; ++a)  // the nearest image across periodic faces
              if (flow_.faces[static_cast<std::size_t>(2 * a)].kind == FaceKind::periodic)
                d[a] -= size[a] * std::round(d[a] / size[a]);
            return d.squaredNorm() < sphere.radius * sphere.radius;
          });
      return inside ? std::uint8_t{1} : std::uint8_t{0};
    });
  }

  void advance(long, bool) override {
    const double time = units_.time_to_si(static_cast<double>(fluid_.steps()));
    const auto start = Clock::now();
    fluid_.set_faces(faces_at(flow_, units_, time));
    fluid_.step();
    step_seconds_ += seconds_since(start);
    fluid_.set_force(force_at(flow_, units_, time + units_.time_step()));
  }

  void check_due(long step) override {
    write_due(step - first_);
    if ((step - first_) % check_every_ == 0 || step == last_) report(step);
  }

  MeanMotion mean_motion() override { return {superficial_velocity(), Vec3::Zero()}; }
  std::string details() override { return details_; }

  void tell_settings() const {
    if (!speaks_) return;
    const Index3& n = fluid_.decomposition().cells();
    fmt::print("{} x {} x {} cells on {}, {} kernels, {}{}{}, {}\n", n[0], n[1], n[2],
               count_text(fluid_.decomposition().ranks(), "rank"), name_of(fluid_.instruction_set()),
               name_of(flow_.collision.collision_operator),
               flow_.collision.smagorinsky > 0 ? ", Smagorinsky" : "",
               flow_.collision.incompressible ? ", incompressible" : "",
               flow_.precision == Precision::double_precision ? "double" : "float");
    fmt::print("{}\n", units_.summary());
    for (const std::string& line : units_.warnings()) fmt::print("note: {}\n", line);
    std::fflush(stdout);
  }

  /// Before any time is spent. What an earlier run left under the names is kept under others.
  void open_files() {
    std::vector<std::string> fields;
    if (flow_.output) fields = {flow_.output->path, xdmf_beside(flow_.output->path)};
    on_first_rank("suffuse-flow", MPI_COMM_WORLD, [&] {
      if (!flow_.monitor_file.empty()) require_writable(flow_.monitor_file, kMonitor);
      for (const std::string& file : fields) require_writable(file, kOutput);
      if (flow_.restart_write.empty()) return;
      require_writable(flow_.restart_write, kRestart);
      require_replaceable(flow_.restart_write, kRestart);
    });
    if (!flow_.monitor_file.empty()) open_monitor();
    if (!flow_.output) return;
    output_.emplace(*flow_.output, units_);
    for (const std::string& file : fields)
      // There is nothing to go on from without a state: the earlier file is another run's.
      if (!flow_.output->append || flow_.restart_read.empty()) keep(file, kOutput);
  }

  void open_monitor() {
    std::string header = "time_s";
    for (const char* name : {"superficial_velocity_{}_m_per_s", "solid_force_{}_n"})
      for (const char axis : {'x', 'y', 'z'}) header += "," + fmt::format(fmt::runtime(name), axis);
    std::optional<double> continued_at;
    if (!flow_.restart_read.empty()) continued_at = units_.time_to_si(static_cast<double>(fluid_.steps()));
    std::optional<SeriesContinuation> continues;
    if (continued_at) continues = {*continued_at};
    monitor_.emplace(flow_.monitor_file, header + ",mass_kg", kMonitor, continues, MPI_COMM_WORLD);
    tell_earlier(flow_.monitor_file, monitor_->earlier());
  }

  void save() const {
    keep(flow_.restart_write, kRestart);
    save_state(fluid_, flow_.restart_write, &units_);
  }

  void keep(const std::string& file, const std::string& who) const {
    std::string earlier;
    on_first_rank(who, MPI_COMM_WORLD, [&] { earlier = keep_earlier_hdf5(file, who).value_or(""); });
    tell_earlier(file, earlier);
  }

  void tell_earlier(const std::string& file, const std::string& earlier) const {
    if (speaks_ && !earlier.empty()) fmt::print("note: {} of an earlier run is now {}\n", file, earlier);
  }

  /// Mean momentum over the whole box (solids at rest included), as a velocity.
  Vec3 superficial_velocity() const {
    const double volume = static_cast<double>(CellBox{{0, 0, 0}, fluid_.decomposition().cells()}.volume());
    return units_.velocity_to_si(Vec3(fluid_.momentum() / volume));
  }

  void write_due(long done) {
    const auto due = [&](double every) { return done % units_.steps_in(every) == 0; };
    const bool fields = output_ && due(flow_.output_every), row = monitor_ && due(flow_.monitor_every);
    if (fields || row) require_health();  // nothing is written of a flow that is lost
    if (fields) output_->write(fluid_);
    if (!row) return;
    const Vec3 u = superficial_velocity(), force = units_.force_to_si(fluid_.solid_force(1));
    const double cell_mass = units_.density() * std::pow(units_.spacing(), 3);
    const double mass = cell_mass * (fluid_cells_ + fluid_.mass_deviation());
    monitor_->add({units_.time_to_si(static_cast<double>(fluid_.steps())), u[0], u[1], u[2], force[0],
                   force[1], force[2], mass});
  }

  FluidExtremes require_health() const {
    const FluidExtremes extremes = fluid_.extremes();
    require_stable(extremes, units_, units_.time_to_si(static_cast<double>(fluid_.steps())), 1, "fluid");
    return extremes;
  }

  void report(long step) {
    const FluidExtremes extremes = require_health();
    const double cells = static_cast<double>(CellBox{{0, 0, 0}, fluid_.decomposition().cells()}.volume());
    details_ = progress_details(fmt::format("{:.4g} s", units_.time_to_si(static_cast<double>(step))), cells,
                                static_cast<double>(step - first_), step_seconds_, health_text(extremes));
  }

  void tell_steadiness(const RunEnd& end, long steps) const {
    if (!speaks_) return;
    fmt::print(
        "{}{}\n", steadiness_text(end.steady, units_.time_to_si(static_cast<double>(steps))),
        end.steady
            ? ""
            : fmt::format(": the mean velocity still changes by {:.2g} of itself in a tenth of the run; "
                          "give [run] time more",
                          end.change));
  }

  void tell_speed(long steps) {
    double bare = 1e300;
    for (int n = 0; n < 5; ++n) {
      MPI_Barrier(MPI_COMM_WORLD);
      const auto start = Clock::now();
      fluid_.bare_update();
      double mine = seconds_since(start), slowest = 0;
      MPI_Allreduce(&mine, &slowest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
      bare = std::min(bare, slowest);
    }
    double step = step_seconds_ / static_cast<double>(std::max(1L, steps)), slowest = 0;
    MPI_Allreduce(&step, &slowest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    if (!speaks_) return;
    const double cells = static_cast<double>(CellBox{{0, 0, 0}, fluid_.decomposition().cells()}.volume());
    fmt::print(
        "{} steps, {:.1f} MLUPS, {:.0f} % of the memory's {:.1f} (bare in-place update, measured now)\n",
        steps, cells / slowest * 1e-6, 100 * bare / slowest, cells / bare * 1e-6);
  }

  FlowCase flow_;
  Units units_;
  Fluid fluid_;
  bool speaks_;
  std::optional<FieldOutput> output_;
  std::optional<TimeSeriesFile> monitor_;
  long first_ = 0, last_ = 0;  ///< steps made before the run, and when it has ended
  long check_every_ = 1;
  std::string details_;
  double fluid_cells_ = 0, step_seconds_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  CLI::App app(
      "Single-phase flow by lattice Boltzmann: reads one TOML file, runs on any number of MPI ranks.",
      "suffuse-flow");
  std::string path;
  app.add_option("case", path, "case file (docs/lbm/suffuse-flow.md)")->required();
  app.set_version_flag("--version", SUFFUSE_VERSION);
  const auto print_words = [rank] {  // for scripts/reference_tables
    if (rank == 0) fmt::print("{}", flow_words_text());
    throw CLI::Success();
  };
  app.add_flag_callback("--words", print_words)->group("");
  int status = 0;
  try {
    app.parse(argc, argv);
    set_provenance({SUFFUSE_VERSION, path});
    if (FlowRun(read_flow_case(path)).run() == FlowRun::End::not_steady) status = kNotSteady;
    require_printed_output();
  } catch (const CLI::ParseError& error) {
    status = error.get_exit_code() == 0 ? 0 : 1;
    if (rank == 0 && status == 0) app.exit(error);  // --help, --version
    if (rank == 0 && status != 0) fmt::print(stderr, "suffuse-flow: {}\n", explain(app, error));
  } catch (const UserError& error) {  // on all ranks alike
    if (rank == 0) fmt::print(stderr, "\nsuffuse-flow: {}\n", error.what());
    status = dynamic_cast<const LostRun*>(&error) != nullptr ? kLostRunExitCode : 1;
  } catch (const std::exception& failure) {  // maybe on this rank alone
    const std::string refusal = refusal_of_the_machine(failure);
    fmt::print(
        stderr, "\nsuffuse-flow: {}\n",
        refusal.empty() ? fmt::format("internal error on rank {}: {}", rank, failure.what()) : refusal);
    MPI_Abort(MPI_COMM_WORLD, refusal.empty() ? 2 : 1);
  }
  if (Hdf5File::left_open()) {
    std::fflush(nullptr);
    MPI_Barrier(MPI_COMM_WORLD);
    std::_Exit(status);
  }
  MPI_Finalize();
  return status;
}
