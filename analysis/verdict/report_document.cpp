#include "verdict/report_document.h"

#include <fmt/format.h>

namespace suffuse::analysis {
namespace {

/// A bar would end the cell of a table.
std::string in_cell(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '|' ? std::string("\\|") : std::string(1, c);
  return safe;
}

std::string row_text(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += fmt::format(" {} |", in_cell(cell));
  return text + "\n";
}

struct ToMarkdown {
  std::string operator()(const ReportHeading& heading) const {
    return fmt::format("## {}\n\n", heading.text);
  }
  std::string operator()(const ReportParagraph& paragraph) const {
    return paragraph.stressed ? fmt::format("> **{}**\n\n", paragraph.text) : paragraph.text + "\n\n";
  }
  std::string operator()(const ReportList& list) const {
    std::string text;
    for (const std::string& item : list.items) text += fmt::format("- {}\n", item);
    return text + "\n";
  }
  std::string operator()(const ReportTable& table) const {
    std::string text = row_text(table.header) + "|";
    for (std::size_t k = 0; k < table.header.size(); ++k) text += "---|";
    text += "\n";
    for (const auto& row : table.rows) text += row_text(row);
    return text + "\n";
  }
  std::string operator()(const ReportFigure& figure) const {
    if (figure.link.empty()) return {};
    return fmt::format("![{}]({})\n\n{}\n\n", figure.meaning, figure.link, figure.caption);
  }
};

}  // namespace

void ReportDocument::list(std::vector<std::string> items, bool small) {
  if (!items.empty())
    blocks_.emplace_back(std::in_place_type<ReportList>, ReportList{std::move(items), small});
}

void ReportDocument::table(ReportTable table) {
  if (!table.rows.empty()) blocks_.emplace_back(std::in_place_type<ReportTable>, std::move(table));
}

void ReportDocument::figure(ReportFigure figure) {
  if (!figure.svg.empty()) blocks_.emplace_back(std::in_place_type<ReportFigure>, std::move(figure));
}

std::string ReportDocument::markdown() const {
  std::string text = fmt::format("# {}\n\n", title_);
  for (const Block& block : blocks_) text += std::visit(ToMarkdown{}, block);
  text.pop_back();  // one line end is enough after the last block
  return text;
}

}  // namespace suffuse::analysis
