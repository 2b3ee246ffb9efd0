#include "contacts/dump_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contacts/packing_builder.h"
#include "files/number_parser.h"
#include "suffuse/common/error.h"

namespace suffuse::analysis {
namespace {

using micromechanics::Contact;
using micromechanics::Grain;
using micromechanics::Packing;

/// Identifiers above this many times the number of grains (and above a floor) are no identifiers.
constexpr double kLargestIdPerGrain = 1000;
constexpr double kLargestIdFloor = 1e7;

Vec3 vector_at(std::span<const double> row, int first) {
  const auto at = static_cast<std::size_t>(first);
  return {row[at], row[at + 1], row[at + 2]};
}

/// Whether six digits hold a number.
bool is_short(double value) {
  double again = 0;
  return parse_number(fmt::format("{:.6g}", value), again) && again == value;
}

/// Contacts that are looked at to tell how many digits a dump has.
constexpr std::size_t kSampleOfDigits = 30;

std::size_t rows_to_expect(DumpChain& chain) {
  const TextInput& input = chain.file().input();
  return plausible_rows(chain.header().rows, input.bytes(), chain.header().columns.size(),
                        input.is_compressed());
}

Vec3 period_of(const DumpHeader& header) {
  Vec3 period = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis)
    if (header.periodic[axis]) period[axis] = header.box_high[axis] - header.box_low[axis];
  return period;
}

}  // namespace

DumpChain::DumpChain(std::vector<std::string> files, std::string who)
    : files_(files.begin(), files.end()), who_(std::move(who)) {}

bool DumpChain::next() {
  const std::int64_t before = header_.step;
  for (;;) {
    if (file_ != nullptr && file_->next(header_)) break;
    if (file_ != nullptr) bytes_of_past_files_ += file_->input().bytes();
    file_.reset();
    if (files_.empty()) return false;
    file_ = std::make_unique<DumpFile>(files_.front(), who_);
    files_.pop_front();
  }
  if (started_ && header_.step <= before)
    file_->complain(fmt::format("step {} comes after step {}", header_.step, before),
                    "give each run by itself, and each snapshot once");
  started_ = true;
  return true;
}

std::int64_t DumpChain::bytes_read() const {
  return bytes_of_past_files_ + (file_ != nullptr ? file_->input().bytes_read() : 0);
}

DumpSeries::DumpSeries(std::vector<std::string> grain_files, std::vector<std::string> contact_files,
                       ReadSettings settings, std::int64_t bytes)
    : settings_(std::move(settings)),
      grains_(std::move(grain_files), settings_.who),
      contacts_(std::move(contact_files), settings_.who),
      bytes_(bytes) {}

double DumpSeries::done() const {
  const auto read = static_cast<double>(grains_.bytes_read() + contacts_.bytes_read());
  return bytes_ > 0 ? std::min(1.0, read / static_cast<double>(bytes_)) : 1;
}

std::string DumpSeries::notes() const {
  std::string left_out;
  if (alone_grains_ + alone_contacts_ > 0)
    left_out = fmt::format(
        "left out: {} snapshots of grains without contacts of the same step, {} of contacts without grains",
        alone_grains_, alone_contacts_);
  return both_notes(left_out, sample_.note());
}

bool DumpSeries::find_common_step() {
  bool have_grains = grains_.next(), have_contacts = contacts_.next();
  while (have_grains && have_contacts && grains_.header().step != contacts_.header().step) {
    if (grains_.header().step < contacts_.header().step) {
      ++alone_grains_;
      have_grains = grains_.next();
    } else {
      ++alone_contacts_;
      have_contacts = contacts_.next();
    }
  }
  if (have_grains && have_contacts) return true;
  for (; have_grains; have_grains = grains_.next()) ++alone_grains_;
  for (; have_contacts; have_contacts = contacts_.next()) ++alone_contacts_;
  return false;
}

bool DumpSeries::next(Snapshot& snapshot) {
  if (!find_common_step()) {
    if (pairs_ == 0)
      throw UserError(
          fmt::format("{}: no step has both grains and contacts ({} snapshots of grains, {} of contacts); "
                      "dump both every N steps",
                      settings_.who, alone_grains_, alone_contacts_));
    return false;
  }
  ++pairs_;
  snapshot.step = grains_.header().step;
  snapshot.time.reset();
  read_grains(snapshot.packing);
  read_contacts(snapshot);
  if (const std::string problem = problem_of_contacts(snapshot.packing, period_of(contacts_.header()));
      !problem.empty())
    contacts_.file().complain(fmt::format("at step {} {}", snapshot.step, problem), "the file is damaged");
  sample_.restrict_to_region(snapshot);
  return true;
}

void DumpSeries::read_grains(Packing& packing) {
  const DumpHeader& header = grains_.header();
  const ColumnPlan plan = plan_grain_columns(header.columns, settings_.columns, settings_.who);
  using namespace grain_place;
  if (!plan.has[id]) grains_.file().complain("the grains have no column id", "dump id radius x y z …");
  if (!plan.has[radius] && !plan.has[diameter])
    grains_.file().complain("the grains have no column radius",
                            "dump id radius x y z …, or name it: --column radius=…");
  grains_have_positions_ = plan.has_vector(x);
  packing.grains.clear();
  packing.grains.reserve(rows_to_expect(grains_));
  packing.box_low = header.box_low;
  packing.box_high = header.box_high;
  double largest = 0;
  grains_.file().rows(plan.place_of_column, grain_place::count, [&](std::span<const double> row) {
    if (!identifier(row[id]))
      grains_.file().complain(fmt::format("id = {} is no identifier of a grain", row[id]),
                              "is the column right?");
    largest = std::max(largest, row[id]);
    packing.grains.push_back({static_cast<std::int64_t>(row[id]),
                              plan.has[radius] ? row[radius] : row[diameter] / 2,
                              grains_have_positions_ ? vector_at(row, x) : Vec3(Vec3::Zero())});
  });
  sample_.set_volume(packing, {header.periodic[0], header.periodic[1], header.periodic[2]});
  const std::string problem = problem_of_grains(packing);
  if (!problem.empty())
    grains_.file().complain(fmt::format("at step {} {}", header.step, problem), "lengths are in metres");
  if (largest > std::max(kLargestIdFloor, kLargestIdPerGrain * static_cast<double>(packing.grains.size())))
    grains_.file().complain(fmt::format("id = {} is no identifier of a grain", largest),
                            "is the column right?");
  index_of_id_.assign(static_cast<std::size_t>(largest) + 1, -1);
  for (std::size_t i = 0; i < packing.grains.size(); ++i) {
    int& index = index_of_id_[static_cast<std::size_t>(packing.grains[i].id)];
    if (index >= 0)
      grains_.file().complain(
          fmt::format("at step {} grain {} is there twice", header.step, packing.grains[i].id),
          "the file is damaged");
    index = static_cast<int>(i);
  }
}

int DumpSeries::grain_of(double id) {
  if (!identifier(id))
    contacts_.file().complain(
        fmt::format("{} stands where a grain's identifier is expected", id),
        "say which words the script's compute pair/gran/local has: --pair-values pos id force …");
  const int index =
      id < static_cast<double>(index_of_id_.size()) ? index_of_id_[static_cast<std::size_t>(id)] : -1;
  if (index < 0)
    contacts_.file().complain(
        fmt::format("the contact names grain {}, which the grains of step {} do not have", id,
                    contacts_.header().step),
        "do both dumps belong to one run and have all grains?");
  return index;
}

Contact DumpSeries::contact_of(std::span<const double> row, const ColumnPlan& plan, const Packing& packing) {
  using namespace contact_place;
  Contact contact;
  contact.first = grain_of(row[id1]);
  contact.second = grain_of(row[id2]);
  const Grain& first = packing.grains[static_cast<std::size_t>(contact.first)];
  const Grain& second = packing.grains[static_cast<std::size_t>(contact.second)];
  contact.friction = plan.has[friction] ? row[friction] : settings_.friction;
  if (plan.has[friction_limit]) contact.friction_limit = row[friction_limit];
  if (plan.has[spring_force]) contact.spring_force = row[spring_force];
  RawContact raw;
  raw.separation = plan.has_vector(x1) && plan.has_vector(x2) ? Vec3(vector_at(row, x1) - vector_at(row, x2))
                                                              : Vec3(first.position - second.position);
  if (plan.has_vector(fx)) raw.force = vector_at(row, fx);
  if (plan.has_vector(fnx)) raw.normal_force = vector_at(row, fnx);
  if (plan.has_vector(ftx)) raw.tangential_force = vector_at(row, ftx);
  if (plan.has[delta]) raw.overlap = row[delta];
  const std::string problem =
      set_branch_and_force(raw, first.radius + second.radius, period_of(contacts_.header()), true, contact);
  if (!problem.empty())
    contacts_.file().complain(fmt::format("contact of grains {} and {}: {}", first.id, second.id, problem),
                              "are the units those of the grains, and the columns right (--pair-values)?");
  return contact;
}

void DumpSeries::read_contacts(Snapshot& snapshot) {
  using namespace contact_place;
  const DumpHeader& header = contacts_.header();
  const ColumnPlan plan =
      plan_contact_columns(header.columns, settings_.contact_words, settings_.columns, settings_.who);
  const auto need = [&](bool there, const char* what) {
    if (!there)
      contacts_.file().complain(
          fmt::format("the contacts have no {}", what),
          "dump compute pair/gran/local pos id force force_normal force_tangential, say its words "
          "with --pair-values, or name columns with --column");
  };
  need(plan.has[id1] && plan.has[id2], "identifiers of the two grains");
  need(plan.has_vector(fx) || (plan.has_vector(fnx) && plan.has_vector(ftx)), "force");
  need((plan.has_vector(x1) && plan.has_vector(x2)) || grains_have_positions_, "positions");
  snapshot.six_digits = true;
  snapshot.packing.contacts.clear();
  snapshot.packing.contacts.reserve(rows_to_expect(contacts_));
  contacts_.file().rows(plan.place_of_column, contact_place::count, [&](std::span<const double> row) {
    snapshot.packing.contacts.push_back(contact_of(row, plan, snapshot.packing));
    if (snapshot.packing.contacts.size() <= kSampleOfDigits)
      snapshot.six_digits = snapshot.six_digits && is_short(row[plan.has[fx] ? fx : fnx]);
  });
}

}  // namespace suffuse::analysis
