#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "verdict/report_document.h"

namespace suffuse::analysis {
namespace {

// One column, as wide as lines stay easy to read; wide tables scroll in their own box. Verdicts differ in
// their words, and in colours that people with the common kinds of colour blindness tell apart (blue, purple,
// vermilion; each at least 4.5 : 1 against white).
constexpr const char* kStyle = R"(
:root { color-scheme: light; }
* { box-sizing: border-box; }
body { max-width: 50rem; margin: 0 auto; padding: 1rem; background: #fff; color: #1a1a1a;
  font: 1rem/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; overflow-wrap: break-word; }
h1 { font-size: 1.6rem; line-height: 1.25; margin: 0.5rem 0 1rem; }
h2 { font-size: 1.2rem; line-height: 1.3; margin: 2rem 0 0.6rem; padding-top: 0.6rem; border-top: 1px solid #ccc; }
p, ul { margin: 0.6rem 0; }
ul { padding-left: 1.3rem; }
li { margin: 0.25rem 0; }
.stressed { border-left: 0.35rem solid #0072b2; background: #f0f5f9; padding: 0.7rem 0.9rem; font-weight: 600; }
.notes { font-size: 0.875rem; color: #404040; }
/* a shade at the side says that there is more to scroll to */
.scroll { overflow-x: auto; margin: 0.8rem 0; background:
  linear-gradient(to right, #fff 40%, #fff0) left / 2.5rem 100% no-repeat local,
  linear-gradient(to left, #fff 40%, #fff0) right / 2.5rem 100% no-repeat local,
  linear-gradient(to right, #0003, #0000) left / 0.7rem 100% no-repeat scroll,
  linear-gradient(to left, #0003, #0000) right / 0.7rem 100% no-repeat scroll; }
.scroll:focus { outline: 2px solid #0072b2; }
table { border-collapse: collapse; font-size: 0.9rem; min-width: 100%; }
th, td { text-align: left; vertical-align: top; padding: 0.35rem 0.7rem 0.35rem 0; border-bottom: 1px solid #ddd; }
th { border-bottom: 2px solid #888; }
td { font-variant-numeric: tabular-nums; overflow-wrap: normal; }
th, td.short { white-space: nowrap; }
td.long { min-width: 9rem; }
.stable { color: #005b8f; font-weight: 600; }
.transitional { color: #7a3e76; font-weight: 600; }
.unstable { color: #a33f00; font-weight: 600; }
.not-applicable { color: #606060; }
code { font-family: ui-monospace, "DejaVu Sans Mono", monospace; font-size: 0.85em; overflow-wrap: anywhere; }
figure { margin: 1.2rem 0; }
figure img { display: block; width: 100%; max-width: 34rem; height: auto; margin: 0 auto; }
figcaption { font-size: 0.875rem; color: #404040; margin: 0.4rem auto 0; max-width: 34rem; }
/* on a phone a row is a block, with the column's name before each cell */
@media screen and (max-width: 34rem) {
  .scroll { overflow: visible; background: none; }
  table, tbody, tr, td { display: block; }
  thead { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
  tr { border-bottom: 2px solid #888; padding: 0.4rem 0; }
  tr:first-child { border-top: 2px solid #888; }
  td, td.short, td.long { display: grid; grid-template-columns: 7rem 1fr; gap: 0.6rem; padding: 0.15rem 0; border: 0;
    min-width: 0; white-space: normal; overflow-wrap: anywhere; }
  td::before { content: attr(data-name); color: #404040; font-weight: 400; }
}
@media print {
  body { max-width: none; padding: 0; font-size: 10pt; }
  .scroll { overflow: visible; background: none; }
  table { font-size: 8pt; }
  th, td.short { white-space: normal; }
  h2, figcaption { break-after: avoid; }
  h2 { break-inside: avoid; }
  tr, figure, .stressed { break-inside: avoid; }
  figure img { max-width: 12cm; }
}
)";

/// Cells of at most so many bytes stay on one line.
constexpr std::size_t kShortCell = 18;

std::string escaped(const std::string& text) {
  std::string safe;
  bool code = false;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '`':
        safe += code ? "</code>" : "<code>";
        code = !code;
        break;
      default:
        safe += c;
    }
  }
  return code ? safe + "</code>" : safe;
}

/// As an attribute: no elements within.
std::string attribute(std::string text) {
  std::erase(text, '`');
  return escaped(text);
}

std::string cell_class(const std::string& text) {
  static constexpr std::array<std::string_view, 4> verdicts{"stable", "transitional", "unstable",
                                                            "not applicable"};
  std::string classes = text.size() <= kShortCell ? "short" : "long";
  if (std::find(verdicts.begin(), verdicts.end(), text) != verdicts.end())
    classes += text == "not applicable" ? " not-applicable" : " " + text;
  return classes;
}

struct ToHtml {
  std::string operator()(const ReportHeading& heading) const {
    return "<h2>" + escaped(heading.text) + "</h2>\n";
  }
  std::string operator()(const ReportParagraph& paragraph) const {
    return fmt::format("<p{}>{}</p>\n", paragraph.stressed ? " class=\"stressed\"" : "",
                       escaped(paragraph.text));
  }
  std::string operator()(const ReportList& list) const {
    std::string text = list.small ? "<ul class=\"notes\">\n" : "<ul>\n";
    for (const std::string& item : list.items) text += "<li>" + escaped(item) + "</li>\n";
    return text + "</ul>\n";
  }
  std::string operator()(const ReportTable& table) const {
    std::string text = "<div class=\"scroll\" tabindex=\"0\"><table>\n<thead><tr>";
    for (const std::string& name : table.header) text += "<th scope=\"col\">" + escaped(name) + "</th>";
    text += "</tr></thead>\n<tbody>\n";
    for (const auto& row : table.rows) {
      text += "<tr>";
      for (std::size_t k = 0; k < row.size(); ++k)
        text += fmt::format("<td class=\"{}\" data-name=\"{}\">{}</td>", cell_class(row[k]),
                            k < table.header.size() ? attribute(table.header[k]) : "", escaped(row[k]));
      text += "</tr>\n";
    }
    return text + "</tbody>\n</table></div>\n";
  }
  std::string operator()(const ReportFigure& figure) const {
    return fmt::format(
        "<figure><img alt=\"{}\" "
        "src=\"data:image/svg+xml;base64,{}\">\n<figcaption>{}</figcaption></figure>\n",
        attribute(figure.meaning), base64(figure.svg), escaped(figure.caption));
  }
};

}  // namespace

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    const std::size_t here = std::min<std::size_t>(3, bytes.size() - at);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < here ? static_cast<unsigned char>(bytes[at + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= here ? letters[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string ReportDocument::html() const {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}</title>\n"
      "<style>{1}</style>\n</head>\n<body>\n<main>\n<h1>{0}</h1>\n",
      escaped(title_), kStyle);
  for (const Block& block : blocks_) text += std::visit(ToHtml{}, block);
  return text + "</main>\n</body>\n</html>\n";
}

}  // namespace suffuse::analysis
