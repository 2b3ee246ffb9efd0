#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace suffuse::analysis {

/// A table of a report. A cell that is a verdict ("stable", "unstable", …) is coloured in HTML.
struct ReportTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< as long as the header each
};

struct ReportFigure {
  std::string svg;      ///< the picture itself, for HTML
  std::string link;     ///< its file as seen from the Markdown page; empty: left out there
  std::string meaning;  ///< what it shows, for people who do not see it
  std::string caption;
};

struct ReportHeading {
  std::string text;
};
struct ReportParagraph {
  std::string text;
  bool stressed = false;  ///< in a frame of its own: what a reader must not miss
};
struct ReportList {
  std::vector<std::string> items;
  bool small = false;  ///< notes
};

/// A report of headings, paragraphs, lists, tables and figures, written once and given as Markdown or as an
/// HTML page. Texts are plain; `words between back-quotes` are code.
class ReportDocument {
 public:
  explicit ReportDocument(std::string title) : title_(std::move(title)) {}

  void heading(std::string text) {
    blocks_.emplace_back(std::in_place_type<ReportHeading>, ReportHeading{std::move(text)});
  }
  void paragraph(std::string text) {
    blocks_.emplace_back(std::in_place_type<ReportParagraph>, ReportParagraph{std::move(text), false});
  }
  void stressed(std::string text) {
    blocks_.emplace_back(std::in_place_type<ReportParagraph>, ReportParagraph{std::move(text), true});
  }
  /// Nothing is added for an empty list, table or figure without picture.
  void list(std::vector<std::string> items, bool small = false);
  void table(ReportTable table);
  void figure(ReportFigure figure);

  std::string markdown() const;
  /// One file that refers to nothing outside itself: pictures are in it.
  std::string html() const;

 private:
  using Block = std::variant<ReportHeading, ReportParagraph, ReportList, ReportTable, ReportFigure>;
  std::string title_;
  std::vector<Block> blocks_;
};

/// Bytes as text (RFC 4648), as data: addresses want them.
std::string base64(std::string_view bytes);

}  // namespace suffuse::analysis
