#include "verdict/verdict_report.h"

#include <fmt/format.h>

#include <cmath>

#include "suffuse/micromechanics/constraint_ratio.h"
#include "verdict/verdict_sentences.h"

namespace suffuse::analysis {
namespace {

using namespace micromechanics;

std::string number(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.4g}", value);
}

/// Figures of one kind, with the command below.
void add_figures(ReportDocument& report, const std::vector<VerdictFigure>& figures, VerdictFigure::Of of,
                 const std::string& links) {
  for (const VerdictFigure& figure : figures) {
    if (figure.of != of) continue;
    std::string caption = figure.caption;
    if (!links.empty()) caption += fmt::format(" Again from its CSV: `{}`", figure.command);
    report.figure({figure.svg, links.empty() ? std::string() : links + "/" + figure.file + ".svg",
                   figure.meaning, caption});
  }
}

void add_criteria(ReportDocument& report, const std::vector<CriterionResult>& results) {
  ReportTable table{{"criterion", "verdict", "value", "limit", "measure", "source"}, {}};
  std::vector<std::string> notes;
  for (const CriterionResult& result : results) {
    table.rows.push_back({result.criterion, to_string(result.verdict), number(result.value), result.limit,
                          result.measure, result.source});
    if (!result.note.empty()) notes.push_back(result.criterion + ": " + result.note + ".");
  }
  report.table(std::move(table));
  report.list(std::move(notes), true);
}

void add_summary(ReportDocument& report, const VerdictInput& input, const VerdictFindings& findings) {
  report.stressed(headline(input, findings));
  ReportTable table{{"criteria on", "verdict", "stable", "unstable", "between", "n/a"}, {}};
  for (const CriteriaGroup& group : findings.groups) {
    const bool applies = group.count(Verdict::not_applicable) < group.results.size();
    const auto count = [&](Verdict verdict) { return fmt::format("{}", group.count(verdict)); };
    const auto common = group.common();
    table.rows.push_back({group.name, common ? to_string(*common) : (applies ? "divided" : "not applicable"),
                          count(Verdict::stable), count(Verdict::unstable), count(Verdict::transitional),
                          count(Verdict::not_applicable)});
  }
  report.table(std::move(table));
  report.heading("Where the criteria agree");
  report.list(agreement_sentences(findings));
  report.heading("Where they disagree");
  report.list(disagreement_sentences(input, findings));
}

void add_basis(ReportDocument& report, const VerdictInput& input, const VerdictFindings& findings) {
  report.heading("What was judged");
  std::vector<std::string> items{"Grading: " + input.grading_from + "."};
  if (findings.sample)
    items.push_back(fmt::format("Sample: {}, step {}, friction {:g}.", findings.sample->files,
                                findings.sample->step, findings.sample->friction));
  else
    items.emplace_back("No sample: nothing was measured at the scale of grains.");
  items.push_back(
      input.relative_density
          ? fmt::format("Relative density: {:g}.", *input.relative_density)
          : "Relative density: not given; constrictions are those of the loosest state, the largest.");
  items.push_back(input.porosity ? fmt::format("Porosity: {:.4g}, {}.", *input.porosity, input.porosity_from)
                                 : "Porosity: not given; no gradients, no conductivity.");
  items.emplace_back(
      "What is called the thesis's is of S. Haq's thesis (key `haq`), with its chapters and equations.");
  report.list(std::move(items));
}

void add_grading(ReportDocument& report, const VerdictInput& input, const VerdictFindings& findings,
                 const std::vector<VerdictFigure>& figures, const std::string& links) {
  report.heading("Grading");
  const GradingIndices d = grading_indices(input.grading);
  const auto mm = [](double diameter) { return number(1e3 * diameter); };
  report.table({{"d5", "d10", "d15", "d30", "d50", "d60", "d85", "d90", "Cu", "Cc"},
                {{mm(d.d5), mm(d.d10), mm(d.d15), mm(d.d30), mm(d.d50), mm(d.d60), mm(d.d85), mm(d.d90),
                  number(d.uniformity), number(d.curvature)}}});
  std::string text = "Sizes in mm. ";
  if (const auto& gap = input.grading.gap())
    text +=
        fmt::format("Gap-graded: from {:.4g} to {:.4g} mm, ratio {:.3g}, with {:.3g} % of fines.",
                    1e3 * gap->finer_diameter, 1e3 * gap->coarser_diameter, gap->ratio(), 100 * gap->finer);
  else
    text += "Continuously graded.";
  if (input.grading.unknown_below() > 0)
    text +=
        fmt::format(" Not known whole: {}; what needs more is not defined (-).", curve_end(input.grading));
  report.paragraph(text);
  add_figures(report, figures, VerdictFigure::Of::grading, links);
  report.heading("Criteria on grain sizes");
  add_criteria(report, findings.grading);
  add_figures(report, figures, VerdictFigure::Of::shape, links);
}

void add_constrictions(ReportDocument& report, const VerdictInput& input, const VerdictFindings& findings) {
  report.heading("Criteria on constriction sizes");
  if (!findings.analysis) {
    report.paragraph("They do not apply: " + findings.no_constrictions + ".");
    return;
  }
  const ConstrictionAnalysis& analysis = *findings.analysis;
  const double density = input.relative_density.value_or(0);
  const bool in_mm = input.grading.largest() >= 1e-3;  // as the figure's axis
  const double factor = in_mm ? 1e3 : 1e6;
  const auto at = [&](double share) { return factor * analysis.sizes.at(share, density); };
  report.paragraph(fmt::format(
      "The coarse fraction is the filter, the fine one the base that it must hold; split at {:.3g} % ({}). "
      "A constriction is the narrowest passage between neighbouring grains. Those of the coarse fraction, "
      "{}: smallest {:.4g}, Dc35 (35 % are narrower) {:.4g}, Dc50 {:.4g}, largest {:.4g}. d85 of the fine "
      "fraction {:.4g} {}.",
      100 * analysis.split.finer, analysis.split.rule, in_mm ? "mm" : "um", at(0), at(0.35), at(0.5), at(1),
      factor * analysis.largest_erodible, in_mm ? "mm" : "um"));
  add_criteria(report, findings.constriction);
}

/// Chapter 4's boundary in both wordings, on all pairs of Z and alpha that there are.
void add_boundaries(ReportDocument& report, const VerdictInput& input, const VerdictFindings& findings) {
  const MicroscaleLimits limits{input.constriction_limits.coordination,
                                input.constriction_limits.stress_reduction};
  ReportTable table{{"Z and alpha", "Z", "alpha", "unstable if either is low", "if both are"}, {}};
  const auto add = [&](const char* origin, double z, double alpha) {
    table.rows.push_back({origin, number(z), number(alpha),
                          to_string(microscale_verdict(z, alpha, BoundaryWording::either, limits)),
                          to_string(microscale_verdict(z, alpha, BoundaryWording::both, limits))});
  };
  if (findings.sample) {
    const auto z = value_of(findings.sample->record, "coordination_number");
    if (const auto alpha = value_of(findings.sample->record, "alpha_pair_halves"); z && alpha)
      add("measured, by pair halves (the thesis's)", *z, *alpha);
    if (const auto alpha = value_of(findings.sample->record, "alpha_contact_point"); z && alpha)
      add("measured, by contact point", *z, *alpha);
  }
  if (findings.analysis)
    add("predicted from the constriction sizes (fits)", findings.analysis->coordination,
        findings.analysis->stress_reduction);
  if (table.rows.empty()) return;
  report.heading("Contacts and stress of the fines: Z and alpha");
  report.paragraph(fmt::format(
      "Z is the mean number of contacts of a grain, alpha the mean stress in the fine grains over that of "
      "the whole sample: with few contacts and little stress the fines lie loose in the pores. They are low "
      "at Z <= {0:g} and at alpha <= {1:g}. The thesis calls a soil unstable if either is low where it draws "
      "this boundary (sections 4.4.1, 4.5, 5.3.6), and if both are in its summaries (1.3, 7.2.1). By either "
      "reading:",
      limits.coordination, limits.stress_reduction));
  report.table(std::move(table));
}

void add_fabric(ReportDocument& report, const VerdictInput& input, const VerdictFindings& findings) {
  std::vector<std::string> items;
  std::optional<double> fines;
  std::string origin = "of the grading";
  if (input.grading.gap()) fines = input.grading.gap()->finer;
  if (findings.sample) {
    const Record& record = findings.sample->record;
    const MicroscaleLimits limits{input.constriction_limits.coordination,
                                  input.constriction_limits.stress_reduction};
    for (const auto& [name, by] : {std::pair{"alpha_pair_halves", "alpha by pair halves"},
                                   std::pair{"alpha_contact_point", "alpha by contact point"}}) {
      const auto fc = value_of(record, "coordination_fine_coarse"), alpha = value_of(record, name);
      if (!fc || !alpha) continue;
      const FabricCase fabric = fabric_case(*fc, *alpha, limits);
      items.push_back(fmt::format("Fabric case {}, {}: Z_fc = {:.3g}, alpha = {:.3g}: {}.", to_string(fabric),
                                  by, *fc, *alpha, description(fabric)));
    }
    if (input.grading.gap() && value_of(record, "fines_solid_share")) {
      fines = value_of(record, "fines_solid_share");
      origin = "of the sample";
    }
  }
  if (fines) {
    const FinesZone zone = fines_zone(*fines);
    items.push_back(fmt::format("Shire's zones (25 and 35 % of fines): {:.3g} % {}, {}: {}.", 100 * *fines,
                                origin, to_string(zone), description(zone)));
  } else {
    items.emplace_back(
        "Shire's zones of the fines content (25 and 35 %) are for gap-graded soils; this one has no gap.");
  }
  if (!findings.sample)
    items.emplace_back("The fabric case (I to IV, chapter 5 of the thesis) needs a sample.");
  report.heading("Fabric and fines content");
  report.list(std::move(items));
}

void add_constraints(ReportDocument& report, const VerdictFindings& findings) {
  if (!findings.sample) return;
  ReportTable table{{"constraint ratio", "value", "state"}, {}};
  for (const auto& [name, title] :
       {std::pair{"constraint_ratio", "R"}, std::pair{"constraint_ratio_geometric", "R, with Z_geo"},
        std::pair{"constraint_ratio_mechanical", "R, with Z_mech"}})
    if (const auto value = value_of(findings.sample->record, name))
      table.rows.push_back({title, number(*value), to_string(hydromechanical_state(*value))});
  report.heading("Constraint ratio");
  report.paragraph(
      "Constraints that the contacts set over the grains' degrees of freedom, a sliding contact counting "
      "less: stable above 1, transitional at 1, fluid-like below.");
  report.table(std::move(table));
}

void add_sample(ReportDocument& report, const VerdictFindings& findings,
                const std::vector<VerdictFigure>& figures, const std::string& links) {
  if (!findings.sample) return;
  static const std::vector<std::pair<const char*, const char*>> rows{
      {"grains", "grains"},
      {"contacts", "contacts"},
      {"porosity", "porosity"},
      {"Z", "coordination_number"},
      {"Z_mech", "coordination_mechanical"},
      {"Z_geo", "coordination_geometric"},
      {"Z, volume-weighted", "coordination_volume_weighted"},
      {"Z_cc, coarse-coarse", "coordination_coarse_coarse"},
      {"Z_fc, fine-coarse (eq 5.8)", "coordination_fine_coarse"},
      {"alpha (Shire), pair halves", "alpha_pair_halves"},
      {"alpha (Shire), contact point", "alpha_contact_point"},
      {"alpha (Sufian), pair halves", "alpha_sufian_pair_halves"},
      {"alpha (Sufian), contact point", "alpha_sufian_contact_point"},
      {"share of p' on coarse-coarse contacts", "load_share_coarse_coarse"},
      {"on fine-coarse contacts", "load_share_fine_coarse"},
      {"on fine-fine contacts", "load_share_fine_fine"},
      {"fines, share of the solids", "fines_solid_share"},
      {"fines without a contact, share by number", "unconnected_fines_share"},
      {"rattlers, share of the grains", "rattler_share"},
      {"sliding contacts, share", "sliding_share"},
      {"mean mobilised friction", "mean_mobilised_friction"},
      {"strong contacts, share", "strong_share"},
      {"deviator of the fabric", "fabric_deviator"}};
  report.heading("The sample");
  report.paragraph(findings.sample->split_origin);
  ReportTable table{{"measured", "value"}, {}};
  if (const auto stress = value_of(findings.sample->record, "mean_stress_pa"))
    table.rows.push_back({"mean stress p', kPa", number(1e-3 * *stress)});
  for (const auto& [title, name] : rows)
    if (value_of(findings.sample->record, name))
      table.rows.push_back({title, measured_text(findings.sample->record, name)});
  report.table(std::move(table));
  add_figures(report, figures, VerdictFigure::Of::forces, links);
  add_figures(report, figures, VerdictFigure::Of::rose, links);
}

void add_hydraulic(ReportDocument& report, const VerdictFindings& findings) {
  report.heading("Gradients and conductivity");
  if (findings.hydraulic.empty()) {
    report.paragraph("They need the porosity (`--porosity`).");
    return;
  }
  report.paragraph(
      "An internally stable soil lifts as a whole at Terzaghi's gradient; in an unstable one the fines move "
      "at "
      "Skempton and Brogan's.");
  ReportTable table{{"quantity", "value", "unit", "source", "note"}, {}};
  for (const HydraulicRow& row : findings.hydraulic)
    table.rows.push_back({row.quantity, number(row.value), row.unit, row.source, row.note});
  report.table(std::move(table));
}

void add_flow(ReportDocument& report, const VerdictFindings& findings,
              const std::vector<VerdictFigure>& figures, const std::string& links) {
  if (!findings.flow) return;
  report.heading("Upward flow");
  report.paragraph(
      "What a run measured, beside the formulas (`analysis/fluidisation.md` of the documentation). Its bed "
      "is that of the "
      "run, whose porosity may differ from the soil's above.");
  ReportTable table{{"quantity", "value", "unit", "source", "note"}, {}};
  for (const ResultRows::Row& row : findings.flow->rows())
    table.rows.push_back(
        {row.quantity, row.value ? number(*row.value) : std::string("-"), row.unit, row.source, row.note});
  report.table(std::move(table));
  add_figures(report, figures, VerdictFigure::Of::flow, links);
  add_figures(report, figures, VerdictFigure::Of::layers, links);
}

}  // namespace

ReportDocument verdict_report(const VerdictInput& input, const VerdictFindings& findings,
                              const std::vector<VerdictFigure>& figures, const std::string& links) {
  ReportDocument report("Internal stability: " + input.name);
  add_summary(report, input, findings);
  add_basis(report, input, findings);
  add_grading(report, input, findings, figures, links);
  add_constrictions(report, input, findings);
  add_boundaries(report, input, findings);
  add_figures(report, figures, VerdictFigure::Of::boundaries, links);
  add_fabric(report, input, findings);
  add_constraints(report, findings);
  add_hydraulic(report, findings);
  add_flow(report, findings, figures, links);
  add_sample(report, findings, figures, links);
  report.heading("Sources");
  report.paragraph(
      "Keys stand for entries of `references.bib` in the documentation; `haq` is the thesis, whose limits "
      "are "
      "the defaults. Formulas, limits and misprints: `analysis/criteria.md` there.");
  return report;
}

}  // namespace suffuse::analysis
