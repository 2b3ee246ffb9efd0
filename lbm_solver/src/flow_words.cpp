#include "suffuse/lbm/flow_words.h"

#include <fmt/format.h>

#include "suffuse/lbm/field_output.h"
#include "suffuse/lbm/units.h"

namespace suffuse::lbm {

namespace {

template <class Meaning>
std::string joined(const std::vector<std::pair<std::string, Meaning>>& words) {
  std::vector<std::string> all;
  for (const auto& [word, meaning] : words) all.push_back(word);
  return fmt::format("{}", fmt::join(all, "|"));
}

template <class Meaning>
std::string word_of(const std::vector<std::pair<std::string, Meaning>>& words, Meaning value) {
  for (const auto& [word, meaning] : words)
    if (meaning == value) return word;
  return "";
}

FlowTable lattice_table() {
  const CollisionSettings collision;
  return {"lattice",
          "cells and steps: two of spacing, relaxation_time, timestep and mach, the others follow",
          {{"size", "[X, Y, Z]", "m", "> 0", "", "of the box: a whole number of cells along each axis"},
           facts_of(kSpacingWord, ""),
           facts_of(kRelaxationTimeWord, ""),
           facts_of(kTimestepWord, ""),
           facts_of(kMachWord, ""),
           facts_of(kMaxVelocityWord, ""),
           facts_of(kPressureDifferenceWord, ""),
           {"precision", joined(precision_words()), "", "",
            word_of(precision_words(), Precision::double_precision), kPrecisionMeaning},
           {"collision", joined(collision_words()), "", "", name_of(collision.collision_operator),
            "as of `lbm collision`"},
           facts_of(kMagicWord, fmt::format("{:g}", collision.magic)),
           facts_of(kSmagorinskyWord, "0"),
           {"incompressible", "true|false", "", "", "false", kIncompressibleMeaning}}};
}

std::vector<WordFacts> face_words() {
  std::vector<WordFacts> words;
  for (std::size_t f = 0; f < kFaces; ++f)
    words.push_back(
        {name_of(static_cast<Face>(f)), joined(face_kind_words()), "", "", name_of(FaceKind::periodic),
         "`velocity` and `pressure` as a table with a value: `{ kind = \"pressure\", value = 0.1 }`"});
  return words;
}

FlowTable output_table() {
  std::vector<std::string> fields, standard;
  for (const FieldFacts& facts : kFields) fields.emplace_back(facts.word);
  for (const Field field : FieldOutputSettings{}.fields) standard.emplace_back(facts_of(field).word);
  return {
      "output",
      "fields, HDF5; ParaView opens the `.xdmf` beside it",
      {{"file", "\"FILE.h5\"", "", "", "", "must be given"},
       facts_of(kEveryWord, "the run's time"),
       {"fields", fmt::format("[{}, ...]", fmt::join(fields, "|")), "", "",
        fmt::format("{}", fmt::join(standard, ", ")), "each once"},
       {"append", "true|false", "", "", "false", "keep the earlier snapshots of a run that is continued"}}};
}

}  // namespace

const std::vector<FlowTable>& flow_tables() {
  static const std::vector<FlowTable> tables{
      {"fluid",
       "the liquid",
       {facts_of(kDensityWord, fmt::format("{:g}", UnitsRequest{}.density)),
        facts_of(kViscosityWord, fmt::format("{:g}", UnitsRequest{}.viscosity))}},
      lattice_table(),
      {"boundary", "what happens at the box's faces", face_words()},
      {"boundary.FACE",
       "a face with a value",
       {{"kind", joined(face_kind_words()), "", "", "", "must be given"},
        {"value", "[X, Y, Z]|P", "m/s, Pa", "", "", "a velocity's, or a pressure above the reference"},
        facts_of(kRampWord, "0")}},
      {"force",
       "what drives the flow beside its faces",
       {{"acceleration", "[X, Y, Z]", "m/s²", "", "[0, 0, 0]", "of the liquid"},
        {"pressure_gradient", "[X, Y, Z]", "Pa/m", "", "[0, 0, 0]", "along the flow"},
        facts_of(kFrequencyWord, "0")}},
      {"solids",
       "what the liquid flows around",
       {{"spheres", "[[X, Y, Z, RADIUS], ...]", "m", "", "", "a cell is solid if its centre is inside"}}},
      {"run", "how long", {facts_of(kTimeWord, ""), facts_of(kUntilSteadyWord, "")}},
      {"monitor",
       "mean velocity, force on the solids and mass, CSV",
       {{"file", "\"FILE.csv\"", "", "", "", "must be given"},
        facts_of(kEveryWord, "a hundredth of the run's time")}},
      output_table(),
      {"restart",
       "states, exact on any number of ranks",
       {{"read", "\"FILE\"", "", "", "", "a state to begin with"},
        {"write", "\"FILE\"", "", "", "", "the state at the end"}}}};
  return tables;
}

std::string flow_words_text() {
  std::string text = kWordTitles;
  for (const FlowTable& table : flow_tables()) {
    text += word_row(table.name, "line", {"", fmt::format("[{}]", table.name), "", "", "", table.meaning});
    for (const WordFacts& word : table.words) text += word_row(table.name, "any", word);
  }
  return text;
}

std::vector<std::pair<std::string, Precision>> precision_words() {
  return {{"double", Precision::double_precision}, {"float", Precision::float_precision}};
}

std::vector<std::pair<std::string, FaceKind>> face_kind_words() {
  std::vector<std::pair<std::string, FaceKind>> words;
  for (const FaceKind kind :
       {FaceKind::periodic, FaceKind::no_slip, FaceKind::free_slip, FaceKind::velocity, FaceKind::pressure})
    words.emplace_back(name_of(kind), kind);
  return words;
}

}  // namespace suffuse::lbm
