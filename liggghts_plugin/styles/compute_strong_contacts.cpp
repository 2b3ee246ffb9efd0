#include "compute_strong_contacts.h"

#include "fix_compute_reference.h"
#include "lammps.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/strong_contacts.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace suffuse::micromechanics;

int LAMMPS_NS::read_axis(suffuse::ArgumentReader& reader) {
  const std::string given = reader.word("axis");
  if (given == "x") return 0;
  if (given == "y") return 1;
  if (given == "z") return 2;
  suffuse::throw_user_error({reader.who(), "axis", given, "be x, y or z", ""});
}

ComputeStrongContacts::ComputeStrongContacts(LAMMPS* lmp_in, int& iarg, int narg, char** arg)
    : ContactCompute(lmp_in, iarg, narg, arg) {
  suffuse::ArgumentReader reader(who(), narg, arg, iarg);
  while (!reader.done()) {
    const std::string key = reader.keyword();
    if (key == "axis") {
      axis_ = read_axis(reader);
    } else if (key == "threshold") {
      if (reader.accept("mean")) {
        kind_ = Threshold::mean;
      } else if (reader.accept("frozen")) {
        kind_ = Threshold::frozen;
      } else if (reader.next_is_number()) {
        kind_ = Threshold::given;
        threshold_ = reader.positive("threshold");
      } else {
        suffuse::throw_user_error({who(), "threshold",
                                   reader.word("threshold (mean, frozen or a force in N)"),
                                   "be mean, frozen or a force in N", ""});
      }
    } else {
      reader.unknown(key, "threshold, axis");
    }
  }
  declare_vector(6);
  if (kind_ == Threshold::frozen) keep_threshold();
}

ComputeStrongContacts::~ComputeStrongContacts() {
  FixComputeReference::forget(lmp, *this);
}

void ComputeStrongContacts::keep_threshold() {
  const auto values = [this] {
    return threshold_ > 0 ? std::vector<double>{threshold_} : std::vector<double>{};
  };
  if (const auto restored = FixComputeReference::keep_for(lmp, *this, values)) threshold_ = restored->at(0);
}

void ComputeStrongContacts::compute_vector() {
  invoked_vector = update->ntimestep;
  const Packing& sample = packing();
  const NormalForceSums forces = over_ranks(normal_force_sums(sample));
  const double mean = mean_normal_force(forces);
  // Frozen at the first state that has contacts.
  if (kind_ == Threshold::mean || (kind_ == Threshold::frozen && threshold_ == 0)) threshold_ = mean;
  const StrongContacts strong = strong_contacts(over_ranks(strong_sums(sample, threshold_)), axis_);
  values_ = {strong.share,   threshold_, mean, strong.mean_stress_share, strong.deviator_share.value_or(0),
             forces.contacts};
  vector = values_.data();
}
