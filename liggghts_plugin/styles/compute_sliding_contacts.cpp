#include "compute_sliding_contacts.h"

#include "lammps.h"
#include "suffuse/common/error.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace suffuse::micromechanics;

bool LAMMPS_NS::read_sliding_rule(const std::string& key, suffuse::ArgumentReader& reader,
                                  SlidingRule& rule) {
  if (key == "appendix") {
    rule = SlidingRule::appendix();
    return true;
  }
  if (key != "tolerance") return false;
  rule.tolerance = reader.number("tolerance");
  if (rule.tolerance < 0 || rule.tolerance >= 1)
    suffuse::throw_user_error({reader.who(), "tolerance", std::to_string(rule.tolerance), "be >= 0 and < 1",
                               "the default 1e-6 covers rounding"});
  return true;
}

SlidingRule LAMMPS_NS::read_sliding_words(suffuse::ArgumentReader& reader) {
  SlidingRule rule;
  while (!reader.done()) {
    const std::string key = reader.keyword();
    if (!read_sliding_rule(key, reader, rule)) reader.unknown(key, "tolerance, appendix");
  }
  return rule;
}

ComputeSlidingContacts::ComputeSlidingContacts(LAMMPS* lmp_in, int& iarg, int narg, char** arg)
    : ContactCompute(lmp_in, iarg, narg, arg) {
  suffuse::ArgumentReader reader(who(), narg, arg, iarg);
  rule_ = read_sliding_words(reader);
  need_friction();
  declare_vector(4);
}

void ComputeSlidingContacts::compute_vector() {
  invoked_vector = update->ntimestep;
  const SlidingSums sums = over_ranks(sliding_sums(packing(), rule_));
  const Sliding result = sliding(sums);
  values_ = {result.share, sums.contacts, result.mean_slipping_index, result.mean_mobilised_friction};
  vector = values_.data();
}
