#include "fix_stress_servo.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "atom.h"
#include "comm.h"
#include "compute.h"
#include "domain.h"
#include "early_stop.h"
#include "fix_contact_sampler.h"
#include "modify.h"
#include "output.h"
#include "pair_law.h"
#include "signal_handling.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/bulk_stiffness.h"
#include "update.h"

using namespace LAMMPS_NS;
using suffuse::throw_user_error;
using suffuse::Vec3;
namespace servo = suffuse::servo;
namespace mm = suffuse::micromechanics;

namespace {

/// Controller time constant in control intervals: long against the local rearrangement that follows a strain
/// step.
constexpr double kRelaxationIntervals = 10;
/// The thesis calls a sample static after 20,000 steps (chapter 4) of 0.0994 of the smallest grain's Rayleigh
/// time (Appendix A): a time of so many Rayleigh times, whatever the step or the contact stiffness.
constexpr double kStaticRayleighTimes = 20000 * 0.0994;
constexpr int kSamplesPerWindow = 20;
constexpr std::size_t kSignatureSize = 96;

}  // namespace

FixStressServo::FixStressServo(LAMMPS* lmp_in, int narg, char** arg) : Fix(lmp_in, narg, arg) {
  suffuse::ArgumentReader reader("fix stress/servo", narg, arg, 3);
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
  const std::string who = "fix stress/servo";
  suffuse::require_periodic_box(lmp, who);
  suffuse::require_granular_pair_style(lmp, who);
  suffuse::require_grains_in_group(lmp, who, igroup);
  int servos = 0;
  for (int i = 0; i < modify->nfix; ++i) {
    if (std::strcmp(modify->fix[i]->style, "deform") == 0)
      throw_user_error({who, "fix", modify->fix[i]->id, "not deform the box as well",
                        "unfix it: the servo moves the box"});
    if (std::strcmp(modify->fix[i]->style, style) == 0) ++servos;
  }
  if (servos > 1)
    throw_user_error(
        {who, "servos", std::to_string(servos), "be one at a time", "unfix the first before the next"});

  pressure_ = modify->compute[modify->find_compute(pressure_id_.data())];
  pressure_->addstep(update->ntimestep);  // so that the virial is there at setup
  const auto grains = suffuse::grain_statistics(lmp, groupbit);
  density_ = grains.mean_density;
  solid_volume_ = grains.solid_volume;
  diameter_ = arguments_.diameter;
  if (arguments_.diameter_kind == suffuse::MeanDiameter::kMass) diameter_ = grains.mass_mean_diameter;
  if (arguments_.diameter_kind == suffuse::MeanDiameter::kNumber) diameter_ = grains.number_mean_diameter;
  set_static_window();
}

void FixStressServo::set_static_window() {
  if (arguments_.window_steps > 0) {
    window_ = static_cast<double>(arguments_.window_steps) * update->dt;
  } else {
    const auto law = suffuse::PairLaw::of(lmp, "fix stress/servo");
    window_ = kStaticRayleighTimes * suffuse::critical_grain(lmp, law, 1).time;
  }
  const double steps = window_ / update->dt / kSamplesPerWindow;
  network_every_ = std::max<bigint>(1, static_cast<bigint>(steps) / arguments_.every) * arguments_.every;
}

void FixStressServo::reset_dt() {
  set_static_window();
}

void FixStressServo::setup(int) {
  sampler_->setup(0);
  if (pressure_->invoked_vector != update->ntimestep) measure_stress();
  measure_network();
  if (!restored_ && state_.reference_lengths.isZero())
    state_.reference_lengths = Vec3(domain->xprd, domain->yprd, domain->zprd);
  restored_ = false;
  stop_step_ = -1;
  last_progress_ = MPI_Wtime();
  last_progress_step_ = update->ntimestep;
  last_progress_stress_ = servo::mean_stress(stress_);
  last_progress_strain_ = std::abs(
      servo::axial_strain(state_, Vec3(domain->xprd, domain->yprd, domain->zprd), arguments_.settings.axis));
  schedule();
}

/// Asks for the virial at the next control step and for contacts at the next sample of the network.
void FixStressServo::schedule() {
  const bigint step = update->ntimestep;
  pressure_->addstep((step / arguments_.every + 1) * arguments_.every);
  sampler_->request((step / network_every_ + 1) * network_every_);
}

void FixStressServo::measure_stress() {
  pressure_->compute_vector();
  stress_ = Vec3(pressure_->vector[0], pressure_->vector[1], pressure_->vector[2]);
  shear_ = Vec3(pressure_->vector[3], pressure_->vector[4], pressure_->vector[5]);
}

void FixStressServo::measure_network() {
  const auto& packing = sampler_->packing(groupbit);
  const double exponent = sampler_->force_exponent();
  // grains, contacts, Σ k_n l², Σ |f|, Σ |resultant|
  std::array<double, 5> sums{};
  sums[0] = static_cast<double>(packing.grains.size());
  std::vector<double> normal_stiffness;
  std::vector<Vec3> resultant(packing.grains.size(), Vec3::Zero());
  for (const auto& contact : packing.contacts) {
    const auto first = static_cast<std::size_t>(contact.first);
    const double depth = mm::overlap(packing, contact);
    normal_stiffness.push_back(exponent * mm::normal_force(contact) / depth);  // of f ~ depth^exponent
    resultant[first] += contact.force;
    if (mm::owns_second(contact)) resultant[static_cast<std::size_t>(contact.second)] -= contact.force;
    if (!mm::is_counted(packing, contact)) continue;
    sums[1] += 1;
    sums[3] += contact.force.norm();
  }
  sums[2] = mm::stiffness_length_sum(packing, normal_stiffness);
  for (const Vec3& net_force : resultant) sums[4] += net_force.norm();
  suffuse::sum_over_ranks(lmp, sums);
  coordination_ = 2 * sums[1] / sums[0];
  bulk_stiffness_ = mm::voigt_bulk_modulus(sums[2], packing.volume);
  unbalanced_ = sums[3] > 0 ? (sums[4] / sums[0]) / (sums[3] / sums[1]) : 0;
  is_static_ = servo::sample_static(static_window_, static_cast<double>(update->ntimestep) * update->dt,
                                    servo::mean_stress(stress_), coordination_, window_,
                                    arguments_.settings.tolerance);
}

void FixStressServo::end_of_step() {
  const bigint step = update->ntimestep;
  if (step % arguments_.every == 0) {
    measure_stress();
    if (step % network_every_ == 0) measure_network();
    control();
    schedule();
    report_progress();
  }
  deform();
  if (step == stop_step_) {
    suffuse::EarlyStop::requested = true;
    SignalHandler::request_quit = true;
  }
}

double FixStressServo::inertial_time() const {
  double reference = arguments_.settings.target;
  if (arguments_.settings.path == servo::Path::kConstantVolume)
    reference = std::max(servo::mean_stress(stress_), 1e-3 * bulk_stiffness_);
  return diameter_ * std::sqrt(density_ / std::max(reference, 1.0));
}

void FixStressServo::control() {
  servo::Measurement m;
  m.interval = static_cast<double>(arguments_.every) * update->dt;
  m.stress = stress_;
  m.lengths = Vec3(domain->xprd, domain->yprd, domain->zprd);
  m.bulk_stiffness = bulk_stiffness_;
  m.inertial_time = inertial_time();
  m.relaxation_time = kRelaxationIntervals * m.interval;
  m.is_static = is_static_ && state_.phase == servo::Phase::kHolding;
  const servo::Phase before = state_.phase;
  state_ = servo::control(arguments_.settings, state_, m);
  if (state_.phase == servo::Phase::kDone && before != servo::Phase::kDone) announce_stop();

  const double quasi_static = arguments_.settings.inertial_number / m.inertial_time;
  if (!rate_note_given_ && arguments_.settings.axial_rate > quasi_static &&
      state_.phase == servo::Phase::kHolding) {
    rate_note_given_ = true;
    if (comm->me == 0 && screen != nullptr)
      fmt::print(screen,
                 "fix stress/servo {}: axial rate {:g} 1/s limited to {:.4g} 1/s by inertial_number {:g}\n",
                 id, arguments_.settings.axial_rate, quasi_static, arguments_.settings.inertial_number);
  }
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

void FixStressServo::deform() {
  if (state_.rate.isZero()) return;
  double scale[3], centre[3];
  for (int d = 0; d < 3; ++d) {
    scale[d] = std::exp(-state_.rate[d] * update->dt);
    centre[d] = 0.5 * (domain->boxlo[d] + domain->boxhi[d]);
    const double half = 0.5 * (domain->boxhi[d] - domain->boxlo[d]) * scale[d];
    domain->boxlo[d] = centre[d] - half;
    domain->boxhi[d] = centre[d] + half;
  }
  double** x = atom->x;
  for (int i = 0; i < atom->nlocal; ++i)
    for (int d = 0; d < 3; ++d) x[i][d] = centre[d] + (x[i][d] - centre[d]) * scale[d];
  domain->set_global_box();
  domain->set_local_box();
}

double FixStressServo::void_ratio() const {
  return domain->xprd * domain->yprd * domain->zprd / solid_volume_ - 1;
}

double FixStressServo::inertial_number() const {
  const double p = servo::mean_stress(stress_);
  const double reference =
      p > 0.01 * arguments_.settings.target && p > 0 ? p : std::max(arguments_.settings.target, 1.0);
  return state_.rate.cwiseAbs().maxCoeff() * diameter_ * std::sqrt(density_ / reference);
}

double FixStressServo::compute_scalar() {
  return servo::mean_stress(stress_);
}

double FixStressServo::compute_vector(int n) {
  const Vec3 lengths(domain->xprd, domain->yprd, domain->zprd);
  switch (n) {
    case 0:
      return servo::mean_stress(stress_);
    case 1:
      return servo::deviatoric_stress(stress_, arguments_.settings.axis);
    case 2:
      return void_ratio();
    case 3:
      return servo::axial_strain(state_, lengths, arguments_.settings.axis);
    case 4:
      return servo::volumetric_strain(state_, lengths);
    case 5:
      return inertial_number();
    case 6:
    case 7:
    case 8:
      return state_.rate[n - 6];
    case 9:
      return static_cast<double>(state_.phase);
    case 10:
      return unbalanced_;
    case 11:
      return 0.5 * static_cast<double>(state_.reversals);
    case 12:
    case 13:
    case 14:
      return stress_[n - 12];
    case 15:
    case 16:
    case 17:
      return shear_[n - 15];
    case 18:
      return state_.peak_deviator;
    default:
      return state_.strain_at_peak;
  }
}

/// Wall-clock minutes until the stop condition, extrapolated from the last progress line; negative if nothing
/// tells.
double FixStressServo::minutes_left(double strain, double since_last) const {
  const double steps = static_cast<double>(update->ntimestep - last_progress_step_);
  if (steps <= 0) return -1;
  const double seconds_per_step = since_last / steps;
  const double by_run = seconds_per_step * static_cast<double>(update->laststep - update->ntimestep);
  double by_goal = by_run;
  if (state_.phase == servo::Phase::kApproaching) {
    const double gained = servo::mean_stress(stress_) - last_progress_stress_;
    if (gained <= 0) return -1;
    by_goal = since_last * (arguments_.settings.target - servo::mean_stress(stress_)) / gained;
  } else if (arguments_.settings.stop == servo::Stop::kAxialStrain) {
    const double gained = std::abs(strain) - last_progress_strain_;
    if (gained <= 0) return -1;
    by_goal = since_last * (arguments_.settings.stop_value - std::abs(strain)) / gained;
  } else if (arguments_.settings.stop == servo::Stop::kStatic) {
    const double waited = static_cast<double>(update->ntimestep) * update->dt - static_window_.start;
    by_goal = seconds_per_step * (window_ - waited) / update->dt;
  }
  return std::max(0.0, std::min(by_goal, by_run)) / 60;
}

void FixStressServo::report_progress() {
  if (arguments_.progress_every <= 0 || comm->me != 0 || screen == nullptr) return;
  const double since_last = MPI_Wtime() - last_progress_;
  if (since_last < arguments_.progress_every) return;

  static constexpr std::array<const char*, 3> kPhases{"approaching", "holding", "done"};
  const double strain =
      servo::axial_strain(state_, Vec3(domain->xprd, domain->yprd, domain->zprd), arguments_.settings.axis);
  const double minutes = minutes_left(strain, since_last);
  fmt::print(
      screen,
      "fix stress/servo {}: step {}  {}  p' {:.4g} kPa  q {:.4g} kPa  e {:.4f}  Z {:.3f}  axial strain "
      "{:.3f} %  I {:.2g}  left {}\n",
      id, update->ntimestep, kPhases[static_cast<std::size_t>(state_.phase)],
      servo::mean_stress(stress_) / 1e3, servo::deviatoric_stress(stress_, arguments_.settings.axis) / 1e3,
      void_ratio(), coordination_, 100 * strain, inertial_number(),
      minutes < 0 ? "unknown" : fmt::format("{:.1f} min", minutes));
  std::fflush(screen);
  last_progress_ += since_last;
  last_progress_step_ = update->ntimestep;
  last_progress_stress_ = servo::mean_stress(stress_);
  last_progress_strain_ = std::abs(strain);
}

/// Names the path and its target: a restart file's state is taken up only by the fix that wrote it.
std::string FixStressServo::signature() const {
  return fmt::format("{} {:.9g} {} {:g} {:.9g} {:.9g}", static_cast<int>(arguments_.settings.path),
                     arguments_.settings.target, arguments_.settings.axis, arguments_.settings.direction,
                     arguments_.settings.deviator_low, arguments_.settings.deviator_high);
}

std::vector<double> FixStressServo::pack() const {
  std::vector<double> values;
  for (const Vec3& v :
       {state_.rate, state_.bias, state_.last_stress, state_.reference_lengths, stress_, shear_})
    values.insert(values.end(), v.data(), v.data() + 3);
  const auto& w = static_window_;
  for (const double value : {state_.axial_ramp, state_.axial_direction, static_cast<double>(state_.reversals),
                             state_.peak_deviator, state_.strain_at_peak, static_cast<double>(state_.phase),
                             w.start, w.stress_low, w.stress_high, w.coordination_low, w.coordination_high,
                             coordination_, bulk_stiffness_, unbalanced_, is_static_ ? 1.0 : 0.0})
    values.push_back(value);
  return values;
}

/// The inverse of pack().
void FixStressServo::unpack(const double* values) {
  for (Vec3* v :
       {&state_.rate, &state_.bias, &state_.last_stress, &state_.reference_lengths, &stress_, &shear_}) {
    *v = Vec3(values[0], values[1], values[2]);
    values += 3;
  }
  state_.axial_ramp = *values++;
  state_.axial_direction = *values++;
  state_.reversals = static_cast<std::int64_t>(*values++);
  state_.peak_deviator = *values++;
  state_.strain_at_peak = *values++;
  state_.phase = static_cast<servo::Phase>(static_cast<int>(*values++));
  auto& w = static_window_;
  for (double* value : {&w.start, &w.stress_low, &w.stress_high, &w.coordination_low, &w.coordination_high,
                        &coordination_, &bulk_stiffness_, &unbalanced_})
    *value = *values++;
  is_static_ = *values != 0;
}

void FixStressServo::write_restart(FILE* file) {
  if (comm->me != 0) return;
  std::string name = signature();
  name.resize(kSignatureSize, '\0');
  const std::vector<double> values = pack();
  const int size = static_cast<int>(kSignatureSize + values.size() * sizeof(double));
  fwrite(&size, sizeof(int), 1, file);
  fwrite(name.data(), 1, kSignatureSize, file);
  fwrite(values.data(), sizeof(double), values.size(), file);
}

void FixStressServo::restart(char* buffer) {
  if (signature() != std::string(buffer, strnlen(buffer, kSignatureSize))) {
    if (comm->me == 0 && screen != nullptr)
      fmt::print(screen,
                 "fix stress/servo {}: the restart file holds another stress path; starting this one anew\n",
                 id);
    return;
  }
  std::vector<double> values(pack().size());
  std::memcpy(values.data(), buffer + kSignatureSize, values.size() * sizeof(double));
  unpack(values.data());
  restored_ = true;
}
