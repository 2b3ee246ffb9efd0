#include "verdict/verdict_figures.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "contacts/force_table.h"
#include "contacts/rose_table.h"
#include "files/figure_script.h"
#include "files/record_table.h"
#include "files/shell_word.h"
#include "grading/constriction_table.h"
#include "grading/grading_table.h"
#include "suffuse/common/error.h"
#include "suffuse/micromechanics/directional_distribution.h"
#include "verdict/flow_record.h"

namespace suffuse::analysis {
namespace {

constexpr const char* kVerdictFigures = "verdict";
/// Inches: on a phone, where the page is some 3.7 wide, the text of a figure stays readable.
constexpr const char* kWidth = "4.2";

template <typename Write>
void write_file(const std::string& path, Write write) {
  SafeFile file(path, kVerdictFigures);
  write(file);
  file.commit();
}

/// What a figure is drawn by: the script, and its arguments with file names inside the folder.
struct Drawing {
  VerdictFigure figure;
  std::string script;
  std::vector<std::string> words;
};

std::vector<Drawing> grading_drawings(const VerdictInput& input, const VerdictFindings& findings,
                                      const std::string& folder) {
  using Of = VerdictFigure::Of;
  write_file(folder + "/curve.csv", [&](SafeFile& file) { write_curve(file, input.grading); });
  write_file(folder + "/shape.csv", [&](SafeFile& file) { write_shape(file, input.grading, input.limits); });
  std::vector<Drawing> drawings;
  if (!findings.analysis) {
    drawings.push_back(
        {{Of::grading, "grading", "", "Cumulative curve of the grain sizes", "The grading.", ""},
         "grading.py",
         {"curve.csv"}});
  } else {
    micromechanics::ConstrictionOptions options = input.constriction;
    options.relative_density = input.relative_density.value_or(0);
    write_file(folder + "/constrictions.csv",
               [&](SafeFile& file) { write_distribution(file, options, findings.analysis); });
    write_file(folder + "/prediction.csv", [&](SafeFile& file) {
      write_prediction(file, input.grading, options, input.constriction_limits, input.limits);
    });
    drawings.push_back(
        {{Of::grading, "grading", "",
          "Cumulative curves of the grain sizes and of the constrictions of the coarse fraction",
          "The grading, and the constriction sizes of its coarse fraction.", ""},
         "constriction.py",
         {"--distribution", "constrictions.csv", "--grading", "curve.csv"}});
  }
  drawings.push_back(
      {{Of::shape, "shape", "", "Kenney and Lau's shape curve, H against F, and its limit",
        "Kenney and Lau's shape curve; thick where it is searched. Stable above the line.", ""},
       "grading.py",
       {"--shape", "shape.csv", "--names=" + input.name}});
  return drawings;
}

std::vector<Drawing> sample_drawings(const SampleFindings& sample, const micromechanics::Packing& packing,
                                     const std::string& folder) {
  using Of = VerdictFigure::Of;
  CsvWriter contacts(folder + "/sample.csv", kVerdictFigures);
  contacts.write(sample.record);
  contacts.commit();
  CsvWriter pdf(folder + "/forces.csv", kVerdictFigures);
  write_force_pdf(pdf, sample.step, sample.bins, sample.forces);
  pdf.commit();
  const auto plane = micromechanics::plane_distribution(packing, micromechanics::Plane::xz,
                                                        micromechanics::kOrientationBins);
  write_rose(folder + "/rose.csv", plane, roses_of(plane, 4), kVerdictFigures);
  return {{{Of::forces, "forces", "",
            "Probability densities of normal and tangential contact forces over their means",
            "Distribution of the contact forces.", ""},
           "forces.py",
           {"forces.csv"}},
          {{Of::rose, "rose", "", "Rose diagrams of the contacts and of the normal forces in the xz plane",
            "Directions of the contacts and of the normal forces in the xz plane, with fits of second and "
            "fourth order.",
            ""},
           "rose.py",
           {"rose.csv", "--plane", "xz", "--panels", "2"}}};
}

/// Quantities of the layers that are drawn, where the record has them.
constexpr const char* kLayerQuantities[] = {"porosity_layer", "hydraulic_gradient_layer",
                                            "effective_stress_ratio", "coordination_layer"};

std::vector<Drawing> flow_drawings(const std::string& flow, const ResultRows& results,
                                   const std::string& folder) {
  using Of = VerdictFigure::Of;
  std::error_code problem;
  std::filesystem::copy_file(flow, folder + "/flow.csv", problem);
  if (problem) throw_user_error({kVerdictFigures, "--flow", flow, "be readable", problem.message()});
  results.write_csv(folder + "/flow_results.csv", kVerdictFigures);
  Drawing layers{{Of::layers, "layers", "", "Profiles over the layers of the bed at four instants",
                  "Layers of the bed, 1 at the top, from the first sample to the last.", ""},
                 "layers.py",
                 {"flow.csv", "--quantities"}};
  const NumberTable table(flow, kVerdictFigures);
  for (const char* quantity : kLayerQuantities)
    if (table.find(fmt::format("{}_2", quantity)) != nullptr) layers.words.push_back(quantity);
  std::vector<Drawing> drawings{
      {{Of::flow, "flow", "",
        "Superficial velocity, stresses and rise of the bed over the hydraulic gradient",
        "Velocity, effective stresses of the layers and rise of the bed over the gradient.", ""},
       "fluidisation.py",
       {"flow.csv", "--results", "flow_results.csv"}}};
  if (layers.words.size() > 2) drawings.push_back(std::move(layers));
  return drawings;
}

std::string content_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void draw(Drawing& drawing, const std::string& folder, bool png) {
  VerdictFigure& figure = drawing.figure;
  std::vector<std::string> words = drawing.words;
  figure.command = figure_script_as_called(drawing.script, kVerdictFigures);
  for (std::string& word : words) {
    figure.command += fmt::format(" {}", shell_word(word));
    if (word.ends_with(".csv")) word = folder + "/" + word;
  }
  figure.command += fmt::format(" --width {} --output {}.svg", kWidth, figure.file);
  words.insert(words.end(), {"--width", kWidth, "--output", ""});
  for (const char* ending : {".svg", ".png"}) {
    if (!png && std::string_view(ending) == ".png") continue;
    words.back() = folder + "/" + figure.file + ending;
    make_figure(drawing.script, words, kVerdictFigures);
  }
  figure.svg = content_of(folder + "/" + figure.file + ".svg");
}

}  // namespace

std::vector<VerdictFigure> draw_verdict_figures(const VerdictInput& input, const VerdictFindings& findings,
                                                const micromechanics::Packing* packing,
                                                const std::string& folder, bool png) {
  std::vector<Drawing> drawings = grading_drawings(input, findings, folder);
  if (packing != nullptr)
    for (Drawing& drawing : sample_drawings(*findings.sample, *packing, folder)) drawings.push_back(drawing);
  if (findings.flow)
    for (Drawing& drawing : flow_drawings(input.flow, *findings.flow, folder)) drawings.push_back(drawing);
  const bool measured = !findings.measured.empty();
  if (findings.analysis || measured) {
    Drawing boundaries{
        {VerdictFigure::Of::boundaries, "z_alpha", "",
         "Coordination number against stress reduction factor, with the limits of both",
         "Z and alpha, and their limits. Grey: one of the two is low; dark grey: both are. The line is "
         "predicted from the constriction sizes, from the loosest to the densest state.",
         ""},
        "constriction.py",
        {}};
    if (findings.analysis) boundaries.words = {"--prediction", "prediction.csv", "--names=" + input.name};
    if (measured) boundaries.words.insert(boundaries.words.end(), {"--measured", "sample.csv"});
    drawings.push_back(std::move(boundaries));
  }
  std::vector<VerdictFigure> figures;
  for (Drawing& drawing : drawings) {
    draw(drawing, folder, png);
    figures.push_back(std::move(drawing.figure));
  }
  return figures;
}

}  // namespace suffuse::analysis
