#include "contacts/read_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "contacts/contact_columns.h"
#include "contacts/contact_measures.h"
#include "contacts/dump_file.h"
#include "files/number_parser.h"
#include "suffuse/common/error.h"

namespace suffuse::analysis {

void ReadOptions::add_to(CLI::App& command) {
  add_to(command, "files");
  command.get_option("files")->required();
}

void ReadOptions::add_to(CLI::App& command, const std::string& files_option) {
  settings.who = command.get_name();
  CLI::Option* sample = command.add_option(
      files_option, files,
      "LIGGGHTS dumps of the grains (dump custom) and of the contacts (dump local of compute "
      "pair/gran/local), text or gzip, in any order, patterns too; or one of our HDF5 files");
  command
      .add_option("--pair-values", pair_values,
                  "words of the script's compute pair/gran/local, if not guessed rightly: \"pos id force …\"")
      ->needs(sample);
  command
      .add_option("--column", renamed, "OURS=THEIRS: the column of a quantity, e.g. radius=c_r or id1=c_p[7]")
      ->take_all()
      ->needs(sample);
  command.add_option("--friction", settings.friction, "coefficient of friction of the contacts")
      ->capture_default_str()
      ->needs(sample);
  command.add_option("--volume", volume, "volume of the sample, m³, where it is not the box")->needs(sample);
  command
      .add_flag("--bed", settings.bed,
                "the sample is the upright box that just holds the grains, not the simulation box")
      ->needs(sample);
  command
      .add_option("--region", region,
                  "the sample lies between these bounds, m: XLO XHI YLO YHI ZLO ZHI; only its grains count")
      ->expected(6)
      ->needs(sample);
}

std::unique_ptr<SnapshotSeries> ReadOptions::open() {
  const std::vector<std::string> known = known_columns();
  for (const std::string& text : renamed) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw_user_error({settings.who, "--column", text, "be OURS=THEIRS", "for example radius=c_r"});
    const std::string ours = text.substr(0, equals);
    if (std::find(known.begin(), known.end(), ours) == known.end())
      throw_user_error({settings.who, "--column", ours, fmt::format("be one of {}", fmt::join(known, ", ")),
                        "OURS=THEIRS: our name of the quantity stands first"});
    if (!settings.columns.emplace(ours, text.substr(equals + 1)).second)
      throw_user_error({settings.who, "--column", ours + " twice", "be given once", ""});
  }
  for (const std::string_view word : words_of(pair_values)) settings.contact_words.emplace_back(word);
  if (!(settings.friction >= 0))
    throw_user_error({settings.who, "--friction", fmt::format("{}", settings.friction), "be >= 0", ""});
  if (volume && !(*volume > 0))
    throw_user_error({settings.who, "--volume", fmt::format("{}", *volume), "be > 0", "in m³"});
  settings.volume = volume;
  if (!region.empty()) {
    settings.region =
        micromechanics::Box{{region[0], region[2], region[4]}, {region[1], region[3], region[5]}};
    if ((settings.region->high - settings.region->low).minCoeff() <= 0)
      throw_user_error({settings.who, "--region", fmt::format("{}", fmt::join(region, " ")),
                        "rise from low to high along x, y and z", ""});
  }
  if (int{volume.has_value()} + int{settings.bed} + int{!region.empty()} > 1)
    throw_user_error(
        {settings.who, "sample", "more than one", "be given by one of --volume, --bed, --region", ""});
  return open_series(files, settings);
}

void SplitOption::add_to(CLI::App& command) {
  command.add_option("--split", text,
                     "fines are the grains of a smaller diameter, m; gap: in the widest gap of the sizes; "
                     "20%: the finest of 20 % of the mass");
}

std::optional<double> SplitOption::value(const micromechanics::Packing& packing,
                                         const std::string& who) const {
  if (text.empty()) return std::nullopt;
  if (text == "gap") return split_in_the_gap(packing, who);
  double percent = 0, diameter = 0;
  if (text.back() == '%' && parse_number(text.substr(0, text.size() - 1), percent) && percent > 0 &&
      percent < 100)
    return split_at_finer(packing, percent / 100, who);
  if (!parse_number(text, diameter) || !(diameter > 0))
    throw_user_error({who, "--split", text, "be a diameter > 0 in m, gap, or a share of the mass such as 20%",
                      "for example 0.3e-3"});
  return diameter;
}

int axis_of(const std::string& text, const std::string& who) {
  if (text == "x") return 0;
  if (text == "y") return 1;
  if (text == "z") return 2;
  throw_user_error({who, "--axis", text, "be x, y or z", ""});
}

}  // namespace suffuse::analysis
