#include "compute_broken_contacts.h"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>

#include "comm.h"
#include "fix_compute_reference.h"
#include "lammps.h"
#include "pair_exchange.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/error.h"
#include "suffuse/common/safe_file.h"
#include "update.h"

using namespace LAMMPS_NS;
using namespace suffuse::micromechanics;

ComputeBrokenContacts::ComputeBrokenContacts(LAMMPS* lmp_in, int& iarg, int narg, char** arg)
    : ContactCompute(lmp_in, iarg, narg, arg) {
  suffuse::ArgumentReader reader(who(), narg, arg, iarg);
  while (!reader.done()) {
    const std::string key = reader.keyword();
    if (key != "reference") reader.unknown(key, "reference");
    const std::string kind = reader.word("reference");
    if (kind == "step")
      reference_step_ = reader.positive_integer("reference step");
    else if (kind == "file")
      file_ = reader.word("reference file");
    else if (kind != "first")
      suffuse::throw_user_error({who(), "reference", kind, "be first, step N or file NAME", ""});
  }
  declare_vector(6);
  if (file_.empty()) keep_reference();
}

ComputeBrokenContacts::~ComputeBrokenContacts() {
  FixComputeReference::forget(lmp, *this);
}

void ComputeBrokenContacts::keep_reference() {
  const auto restored = FixComputeReference::keep_for(lmp, *this, [this] { return reference_values(); });
  if (!restored) return;
  has_reference_ = true;
  Pairs pairs;
  for (std::size_t n = 0; comm->me == 0 && n + 1 < restored->size(); n += 2)
    pairs.push_back(
        {static_cast<std::int64_t>((*restored)[n]), static_cast<std::int64_t>((*restored)[n + 1])});
  reference_ = suffuse::share_out_by_hash(pairs, world);
}

/// Grain numbers are far below 2^53.
std::vector<double> ComputeBrokenContacts::reference_values() const {
  std::vector<double> values;
  if (!has_reference_) return values;
  for (const GrainPair& pair : suffuse::gather_pairs(reference_, world)) {
    values.push_back(static_cast<double>(pair.low));
    values.push_back(static_cast<double>(pair.high));
  }
  return values;
}

void ComputeBrokenContacts::compute_vector() {
  invoked_vector = update->ntimestep;
  const Packing& sample = packing();
  const Pairs current = suffuse::share_out_by_hash(contact_pairs(sample), world);
  const CoordinationSums sums = over_ranks(coordination_sums(sample, {}));
  // An empty state is no reference: contacts may form later.
  if (!has_reference_ && sums.contacts > 0 && update->ntimestep >= reference_step_) take_reference(current);
  const BrokenSums counts = over_ranks(has_reference_ ? broken_sums(reference_, current) : BrokenSums{});
  const BrokenContacts broken = broken_contacts(counts);
  values_ = {broken.net,       broken.gross,  broken.formed,
             counts.reference, sums.contacts, coordination(sums, sample.volume).stable_share};
  vector = values_.data();
}

void ComputeBrokenContacts::take_reference(const Pairs& current) {
  has_reference_ = true;
  if (!file_.empty() && read_reference_file()) return;
  reference_ = current;
  if (!file_.empty()) write_reference_file();
}

bool ComputeBrokenContacts::read_reference_file() {
  Pairs pairs;
  int found = 0, readable = 1;
  if (comm->me == 0) {
    std::ifstream in(file_);
    found = in.is_open();
    std::string header;
    if (found) std::getline(in, header);
    std::size_t expected = 0;
    const bool counted = std::sscanf(header.c_str(), "# %zu contacts", &expected) == 1;
    GrainPair pair;
    while (found && in >> pair.low >> pair.high) pairs.push_back(pair);
    if (found) readable = in.eof() && !pairs.empty() && (!counted || pairs.size() == expected);
  }
  MPI_Bcast(&found, 1, MPI_INT, 0, world);
  MPI_Bcast(&readable, 1, MPI_INT, 0, world);
  if (!readable)
    suffuse::throw_user_error({who(), "reference file", file_,
                               "hold one header line and two grain numbers a line, as many as it says",
                               "delete it to take the reference anew"});
  if (found) reference_ = suffuse::share_out_by_hash(pairs, world);
  return found != 0;
}

void ComputeBrokenContacts::write_reference_file() const {
  const Pairs pairs = suffuse::gather_pairs(reference_, world);
  const std::string who = std::string("compute ") + style;
  suffuse::on_first_rank(who, world, [&] {
    suffuse::SafeFile out(file_, who);
    out.write(
        fmt::format("# {} contacts at step {}, the two grains' numbers\n", pairs.size(), update->ntimestep));
    for (const GrainPair& pair : pairs) out.write(fmt::format("{} {}\n", pair.low, pair.high));
    out.commit();
  });
}
