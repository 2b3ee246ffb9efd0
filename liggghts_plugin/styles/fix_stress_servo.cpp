#include "fix_stress_servo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "comm.h"
#include "compute.h"
#include "domain.h"
#include "early_stop.h"
#include "fix_contact_sampler.h"
#include "modify.h"
#include "output.h"
#include "pair_law.h"
#include "restart_record.h"
#include "servo_box.h"
#include "signal_handling.h"
#include "suffuse/common/error.h"
#include "update.h"

using namespace LAMMPS_NS;
using suffuse::throw_user_error;
using suffuse::Vec3;
namespace servo = suffuse::servo;

namespace {

/// Controller time constant in control intervals: long against the local rearrangement that follows a strain
/// step.
constexpr double kRelaxationIntervals = 10;
/// Relaxation time of lateral stresses over the sample's inertial time d √(ρ/P), at most: a collapse takes
/// about one.
constexpr double kRelaxation = 0.5;
/// The thesis calls a sample static after 20,000 steps (chapter 4) of 0.0994 of the smallest grain's Rayleigh
/// time (Appendix A): a time of so many Rayleigh times, whatever the step or the contact stiffness.
constexpr double kStaticRayleighTimes = 20000 * 0.0994;
/// Share of the target below which a sample with friction may be compressed faster: it remembers its way.
constexpr double kFrictionalApproach = 0.01;
constexpr int kSamplesPerWindow = 20;

std::string who() {
  return "fix stress/servo";
}

}  // namespace

FixStressServo::FixStressServo(LAMMPS* lmp_in, int narg, char** arg) : Fix(lmp_in, narg, arg) {
  suffuse::ArgumentReader reader(who(), narg, arg, 3);
  suffuse::require_si_and_three_dimensions(lmp, reader.who());
  suffuse::require_periodic_box(lmp, reader.who());
  if (igroup != 0)
    throw_user_error(
        {reader.who(), "group", arg[1], "be all", "a periodic box deforms with all of its grains"});
  arguments_ = suffuse::read_servo_arguments(reader);

  scalar_flag = 1;
  vector_flag = 1;
  size_vector = 20;
  global_freq = 1;
  extscalar = 0;
  extvector = 0;
  restart_global = 1;
  box_change_size = 1;
  restart_pbc = 1;
}

FixStressServo::~FixStressServo() {
  if (modify->find_compute(pressure_id_.data()) >= 0) modify->delete_compute(pressure_id_.data());
}

void FixStressServo::post_create() {
  pressure_id_ = std::string(id) + "_virial";
  std::string everyone = "all", style_name = "pressure", temperature = "thermo_temp", what = "virial";
  char* words[] = {pressure_id_.data(), everyone.data(), style_name.data(), temperature.data(), what.data()};
  modify->add_compute(5, words);
  sampler_ = &FixContactSampler::of(lmp);
}

int FixStressServo::setmask() {
  return FixConst::END_OF_STEP;
}

void FixStressServo::init() {
  suffuse::require_single_spheres(lmp, who());
  suffuse::require_periodic_box(lmp, who());
  suffuse::require_granular_pair_style(lmp, who());
  suffuse::require_grains_in_group(lmp, who(), igroup);
  int servos = 0;
  for (int i = 0; i < modify->nfix; ++i) {
    if (std::strcmp(modify->fix[i]->style, "deform") == 0)
      throw_user_error({who(), "fix", modify->fix[i]->id, "not deform the box as well",
                        "unfix it: the servo moves the box"});
    if (std::strncmp(modify->fix[i]->style, "wall/", 5) == 0)
      throw_user_error({who(), "fix", modify->fix[i]->id,
                        "not stand in the periodic box that the servo deforms",
                        "unfix the wall: the stress is that of the whole box"});
    if (std::strcmp(modify->fix[i]->style, style) == 0) ++servos;
  }
  if (servos > 1)
    throw_user_error(
        {who(), "servos", std::to_string(servos), "be one at a time", "unfix the first before the next"});

  pressure_ = modify->compute[modify->find_compute(pressure_id_.data())];
  pressure_->addstep(update->ntimestep);  // so that the virial is there at setup
  take_grains(grains_now());
  if (!arguments_.approach_given)
    arguments_.settings.approach_share = suffuse::grains_have_friction(lmp) ? kFrictionalApproach : 1;
}

/// Sums of the same grains in another order stay as they were. Other grains are another sample, which has yet
/// to be static.
void FixStressServo::take_grains(const suffuse::ServoGrains& grains) {
  if (suffuse::differ_by_rounding(memory_.grains, grains)) return;
  memory_.grains = grains;
  memory_.window = {};
}

suffuse::ServoGrains FixStressServo::grains_now() const {
  const auto statistics = suffuse::grain_statistics(lmp, groupbit);
  suffuse::ServoGrains grains;
  grains.count = static_cast<double>(statistics.count);
  grains.density = statistics.mean_density;
  grains.solid_volume = statistics.solid_volume;
  grains.diameter = arguments_.diameter;
  if (arguments_.diameter_kind == suffuse::MeanDiameter::mass)
    grains.diameter = statistics.mass_mean_diameter;
  if (arguments_.diameter_kind == suffuse::MeanDiameter::number)
    grains.diameter = statistics.number_mean_diameter;
  return grains;
}

void FixStressServo::set_static_window() {
  if (arguments_.window_steps > 0) {
    window_ = static_cast<double>(arguments_.window_steps) * update->dt;
  } else {
    const auto law = suffuse::PairLaw::of(lmp, who());
    window_ = kStaticRayleighTimes * suffuse::critical_grain(lmp, law, 1).time;
  }
  const double steps = window_ / update->dt / kSamplesPerWindow;
  network_every_ = std::max<bigint>(1, static_cast<bigint>(steps) / arguments_.every) * arguments_.every;
  choose_interval();
}

void FixStressServo::reset_dt() {
  set_static_window();
}

void FixStressServo::setup(int) {
  set_static_window();  // by now fixes further down have scaled their masses
  const bool counted_anew = seen_step_ >= 0 && (seen_step_ != update->ntimestep || seen_dt_ != update->dt);
  if (counted_anew || memory_.window.start > static_cast<double>(update->ntimestep) * update->dt)
    memory_.window = {};
  sampler_->setup(0);
  measure_stress();
  measure_network();
  stop_step_ = -1;
  if (!restored_ && memory_.state.reference_lengths.isZero()) {
    memory_.state.reference_lengths = lengths();
    control();  // the box moves from the first step on
  }
  restored_ = false;
  progress_.begin(standing(), MPI_Wtime());
  schedule();
}

/// Asks for the virial at the next control step and for contacts at the next sample of the network.
void FixStressServo::schedule() {
  const bigint step = update->ntimestep;
  pressure_->addstep((step / interval_ + 1) * interval_);
  sampler_->request((step / network_every_ + 1) * network_every_);
}

void FixStressServo::measure_stress() {
  pressure_->compute_vector();
  memory_.stress = Vec3(pressure_->vector[0], pressure_->vector[1], pressure_->vector[2]);
  memory_.shear = Vec3(pressure_->vector[3], pressure_->vector[4], pressure_->vector[5]);
}

void FixStressServo::measure_network() {
  memory_.network = suffuse::measure_network(lmp, *sampler_, groupbit);
  memory_.is_static = servo::sample_static(
      memory_.window, arguments_.settings,
      {static_cast<double>(update->ntimestep) * update->dt, servo::mean_stress(memory_.stress),
       memory_.network.coordination, memory_.network.unbalanced},
      window_);
}

/// A divisor of `every`, so that every sample of the network is a control step.
void FixStressServo::choose_interval() {
  interval_ = arguments_.every;
  if (arguments_.every_given) return;
  const double inertial_time = inertial_size() / std::sqrt(std::max(arguments_.settings.target, 1.0));
  interval_ = servo::control_interval(arguments_.settings, arguments_.every,
                                      kRelaxation * inertial_time / (kRelaxationIntervals * update->dt));
}

/// A lost sample may well have the target's stress. Grains that an insertion adds are taken up.
void FixStressServo::check_sample() {
  if (memory_.network.grains > memory_.grains.count) take_grains(grains_now());
  suffuse::require_sound_sample(who(), {memory_.stress.allFinite() && memory_.shear.allFinite(), void_ratio(),
                                        memory_.grains.count, &memory_.network});
}

void FixStressServo::end_of_step() {
  const bigint step = update->ntimestep;
  seen_step_ = step;
  seen_dt_ = update->dt;
  if (step % interval_ == 0) {
    measure_stress();
    if (step % network_every_ == 0) measure_network();
    check_sample();
    control();
    schedule();
    report_progress();
  }
  suffuse::deform_box(lmp, memory_.state.rate);
  if (step == stop_step_) {
    suffuse::EarlyStop::requested = true;
    SignalHandler::request_quit = true;
  }
}

void FixStressServo::control() {
  servo::Measurement m;
  m.interval = static_cast<double>(interval_) * update->dt;
  m.stress = memory_.stress;
  m.lengths = lengths();
  m.bulk_stiffness = memory_.network.bulk_stiffness;
  m.inertial_size = inertial_size();
  m.relaxation_time = kRelaxationIntervals * m.interval;
  m.is_static = memory_.is_static && memory_.state.phase == servo::Phase::holding;
  const servo::Phase before = memory_.state.phase;
  memory_.state = servo::control(arguments_.settings, memory_.state, m);
  if (memory_.state.phase == servo::Phase::done && before != servo::Phase::done) {
    suffuse::tell(lmp, suffuse::describe_end(id, arguments_.settings.stop, standing()));
    announce_stop();
  }
  if (rate_note_given_ || memory_.state.phase != servo::Phase::holding) return;
  const double quasi_static = servo::axial_rate_limit(arguments_.settings, memory_.state, m);
  if (arguments_.settings.axial_rate <= quasi_static) return;
  rate_note_given_ = true;
  suffuse::tell(
      lmp,
      fmt::format("fix stress/servo {}: axial rate {:g} 1/s limited to {:.4g} 1/s by inertial_number {:g}\n",
                  id, arguments_.settings.axial_rate, quasi_static, arguments_.settings.inertial_number));
}

/// The run ends after the next step, so that its last thermo line can be announced to LIGGGHTS in time.
void FixStressServo::announce_stop() {
  if (!suffuse::EarlyStop::supported) return;
  stop_step_ = update->ntimestep + 1;
  if (stop_step_ >= update->laststep) {
    stop_step_ = -1;
    return;
  }
  update->laststep = stop_step_;
  update->nsteps = static_cast<int>(stop_step_ - update->firststep);  // the number that LIGGGHTS reports
  output->next = output->next_thermo = stop_step_;
  modify->addstep_compute_all(stop_step_);
}

double FixStressServo::void_ratio() const {
  return domain->xprd * domain->yprd * domain->zprd / memory_.grains.solid_volume - 1;
}

double FixStressServo::inertial_number() const {
  const double p = servo::mean_stress(memory_.stress);
  const double target = std::max(arguments_.settings.target, memory_.state.largest_stress);
  const double reference = p > 0.01 * target && p > 0 ? p : std::max(target, 1.0);
  return memory_.state.rate.cwiseAbs().maxCoeff() * inertial_size() / std::sqrt(reference);
}

double FixStressServo::inertial_size() const {
  return memory_.grains.diameter * std::sqrt(memory_.grains.density);
}

Vec3 FixStressServo::lengths() const {
  return {domain->xprd, domain->yprd, domain->zprd};
}

suffuse::ServoStanding FixStressServo::standing() const {
  const double waited = static_cast<double>(update->ntimestep) * update->dt - memory_.window.start;
  return {update->ntimestep,
          update->laststep,
          memory_.state.phase,
          servo::mean_stress(memory_.stress),
          servo::deviatoric_stress(memory_.stress, arguments_.settings.axis),
          void_ratio(),
          memory_.network.coordination,
          servo::axial_strain(memory_.state, lengths(), arguments_.settings.axis),
          inertial_number(),
          memory_.network.unbalanced,
          (window_ - waited) / update->dt};
}

double FixStressServo::compute_scalar() {
  return servo::mean_stress(memory_.stress);
}

double FixStressServo::compute_vector(int n) {
  switch (n) {
    case 0:
      return servo::mean_stress(memory_.stress);
    case 1:
      return servo::deviatoric_stress(memory_.stress, arguments_.settings.axis);
    case 2:
      return void_ratio();
    case 3:
      return servo::axial_strain(memory_.state, lengths(), arguments_.settings.axis);
    case 4:
      return servo::volumetric_strain(memory_.state, lengths());
    case 5:
      return inertial_number();
    case 6:
    case 7:
    case 8:
      return memory_.state.rate[n - 6];
    case 9:
      return static_cast<double>(memory_.state.phase);
    case 10:
      return memory_.network.unbalanced;
    case 11:
      return 0.5 * static_cast<double>(memory_.state.reversals);
    case 12:
    case 13:
    case 14:
      return memory_.stress[n - 12];
    case 15:
    case 16:
    case 17:
      return memory_.shear[n - 15];
    case 18:
      return memory_.state.peak_deviator;
    default:
      return memory_.state.strain_at_peak;
  }
}

void FixStressServo::report_progress() {
  if (comm->me != 0 || screen == nullptr) return;
  const std::string line =
      progress_.line(id, arguments_.settings, standing(), MPI_Wtime(), arguments_.progress_every);
  if (line.empty()) return;
  fmt::print(screen, "{}", line);
  std::fflush(screen);
}

/// Names the path and its target: a restart file's state is taken up only by the fix that wrote it.
std::string FixStressServo::signature() const {
  return fmt::format("{} {:.9g} {} {:g} {:.9g} {:.9g}", static_cast<int>(arguments_.settings.path),
                     arguments_.settings.target, arguments_.settings.axis, arguments_.settings.direction,
                     arguments_.settings.deviator_low, arguments_.settings.deviator_high);
}

void FixStressServo::write_restart(FILE* file) {
  if (comm->me != 0) return;
  suffuse::write_record(file, {suffuse::kServoMemoryVersion, signature(), suffuse::packed(memory_)});
}

void FixStressServo::restart(char* buffer) {
  const suffuse::RestartRecord record =
      suffuse::read_record(buffer, suffuse::kServoMemoryVersion, suffuse::packed({}).size(),
                           fmt::format("fix stress/servo {}", id));
  if (record.text != signature()) {
    if (comm->me == 0 && screen != nullptr)
      fmt::print(screen,
                 "fix stress/servo {}: the restart file holds another stress path; starting this one anew\n",
                 id);
    return;
  }
  memory_ = suffuse::unpacked(record.values);
  if (memory_.state.phase == servo::Phase::done)
    memory_.state.phase = servo::Phase::holding;  // to an end further on
  restored_ = true;
}
