#include "contacts/contacts_command.h"

#include <fmt/format.h>

#include <memory>

#include "contacts/contact_measures.h"
#include "contacts/force_table.h"
#include "contacts/read_options.h"
#include "files/number_parser.h"
#include "files/output_options.h"
#include "files/record_table.h"
#include "suffuse/common/error.h"
#include "suffuse/common/progress.h"
#include "suffuse/micromechanics/slipping.h"

namespace suffuse::analysis {
namespace {

constexpr const char* kContacts = "contacts";
/// Below this size a series is read before anybody looks for a progress line.
constexpr std::int64_t kLongSeries = 50'000'000;

struct ContactsOptions {
  ReadOptions read;
  SplitOption split;
  OutputOptions outputs;
  std::string output, json, force_pdf, strong = "mean", axis = "z";
  std::optional<double> tolerance;
  MeasureSettings measures;
};

void read_strong(const std::string& text, MeasureSettings& measures) {
  if (text == "mean") {
    measures.strong = StrongThreshold::mean;
  } else if (text == "frozen") {
    measures.strong = StrongThreshold::frozen;
  } else {
    measures.strong = StrongThreshold::force;
    if (!parse_number(text, measures.strong_force) || !(measures.strong_force > 0))
      throw_user_error({kContacts, "--strong", text, "be mean, frozen or a force > 0 in N", ""});
  }
}

void check(ContactsOptions& options) {
  MeasureSettings& measures = options.measures;
  read_strong(options.strong, measures);
  measures.axis = axis_of(options.axis, kContacts);
  if (const auto& given = options.tolerance) {
    if (!(*given >= 0 && *given < 1))
      throw_user_error({kContacts, "--sliding-tolerance", fmt::format("{}", *given), "be >= 0 and < 1", ""});
    measures.sliding_tolerance = *given;
  }
  const auto in_range = [](bool fine, const char* option, double value, const char* rule) {
    if (!fine) throw_user_error({kContacts, option, fmt::format("{}", value), rule, ""});
  };
  in_range(measures.rattler_contacts >= 1, "--rattler-contacts", measures.rattler_contacts, "be >= 1");
  in_range(measures.force_bins.width > 0, "--force-bin", measures.force_bins.width, "be > 0");
  in_range(measures.force_bins.count >= 1 && measures.force_bins.count <= 100000, "--force-bins",
           measures.force_bins.count, "be 1 to 100000");
}

std::vector<ScreenTable::Column> screen_columns() {
  return {{"step", "step"},
          {"grains", "grains"},
          {"contacts", "contacts"},
          {"porosity", "porosity"},
          {"mean_stress_pa", "p' (Pa)"},
          {"coordination_number", "Z"},
          {"coordination_mechanical", "Z_mech"},
          {"alpha_pair_halves", "alpha (h)"},
          {"alpha_contact_point", "alpha (c)"},
          {"sliding_share", "sliding"},
          {"constraint_ratio", "R"},
          {"fabric_deviator", "fabric q"},
          {"strong_share", "strong"},
          {"rattler_share", "rattlers"}};
}

void tell_settings(const ContactsOptions& options, const Snapshot& first) {
  const auto& split = options.measures.split;
  if (const std::string warning = split ? warning_of_split(*split, first, kContacts, "--split") : "";
      !warning.empty())
    fmt::print("{}\n", warning);
  if (options.measures.split)
    fmt::print("fines: diameter below {:.6g} m", *options.measures.split);
  else
    fmt::print("no --split: all grains are coarse, no alpha");
  fmt::print("; friction {:.4g}; a contact slides where S >= 1 - {:.0e}\n", options.read.settings.friction,
             sliding_tolerance(options.measures, first));
  std::fflush(stdout);
}

void run(ContactsOptions& options) {
  check(options);
  options.outputs.require_new(kContacts, options.read.files);
  const std::unique_ptr<SnapshotSeries> series = options.read.open();
  std::optional<CsvWriter> csv, pdf;
  std::optional<JsonWriter> json;
  if (!options.output.empty()) csv.emplace(options.output, kContacts);
  if (!options.force_pdf.empty()) pdf.emplace(options.force_pdf, kContacts);
  if (!options.json.empty()) json.emplace(options.json, kContacts);
  ScreenTable table(screen_columns());
  const bool is_long = series->bytes() > kLongSeries;
  ProgressLine progress(is_long);
  std::optional<ContactMeasurer> measurer;
  Snapshot snapshot;
  std::int64_t snapshots = 0, above_limit = 0;
  while (series->next(snapshot)) {
    if (!measurer) {
      options.measures.split = options.split.value(snapshot.packing, kContacts);
      measurer.emplace(options.measures);
      tell_settings(options, snapshot);
    }
    const Record record = measurer->measure(snapshot);
    if (csv) csv->write(record);
    if (json) json->write(record);
    if (pdf) write_force_pdf(*pdf, snapshot.step, options.measures.force_bins, measurer->forces());
    table.add(record);
    above_limit +=
        micromechanics::contacts_above_limit(snapshot.packing, sliding_tolerance(options.measures, snapshot));
    ++snapshots;
    progress.update(series->done(),
                    [&] { return fmt::format("{} snapshots, step {}", snapshots, snapshot.step); });
  }
  if (is_long) progress.finish(fmt::format("{} snapshots", snapshots));
  if (csv) csv->commit();
  if (json) json->commit();
  if (pdf) pdf->commit();
  fmt::print("{}", table.text());
  if (const std::string notes = series->notes(); !notes.empty()) fmt::print("{}\n", notes);
  if (above_limit > 0)
    fmt::print(
        "{} contacts have more tangential force than friction: sliding ones that the dump evaluated again, "
        "damping, cohesion or another --friction. They count as sliding; the run knows better: dump compute "
        "slipping/index beside the contacts and say --column friction_limit=c_ID[7] spring_force=c_ID[8]\n",
        above_limit);
  if (options.split.text.empty() == false)
    fmt::print("alpha (h): by pair halves, the thesis's; alpha (c): by contact point\n");
}

}  // namespace

void add_contacts(CLI::App& app) {
  auto options = std::make_shared<ContactsOptions>();
  CLI::App* command = app.add_subcommand(
      kContacts,
      "Contact network of every snapshot: Z, alpha, sliding, constraint ratio, fabric, forces, rattlers");
  options->read.add_to(*command);
  options->split.add_to(*command);
  options->outputs.add(*command, "--output", options->output, "CSV file with all columns, a row a snapshot");
  options->outputs.add(*command, "--json", options->json, "the same as JSON");
  options->outputs.add(*command, "--force-pdf", options->force_pdf,
                       "CSV file with the force distribution of every snapshot");
  command
      ->add_option("--force-bin", options->measures.force_bins.width, "width of its bins, of the mean force")
      ->capture_default_str();
  command->add_option("--force-bins", options->measures.force_bins.count, "number of its bins")
      ->capture_default_str();
  command
      ->add_option(
          "--strong", options->strong,
          "threshold of strong contacts: mean of each snapshot, frozen (the first one's), or a force in N")
      ->capture_default_str();
  command->add_option("--axis", options->axis, "axis of the deviatoric stress: x, y or z")
      ->capture_default_str();
  command->add_option("--sliding-tolerance", options->tolerance,
                      "a contact slides where S >= 1 - T (default: 1e-6, for text of six digits 1e-5)");
  command
      ->add_option("--rattler-contacts", options->measures.rattler_contacts,
                   "grains with fewer contacts are rattlers (2 with friction, 4 without)")
      ->capture_default_str();
  command->callback([options] { run(*options); });
}

}  // namespace suffuse::analysis
