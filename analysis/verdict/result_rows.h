#pragma once

#include <optional>
#include <string>
#include <vector>

namespace suffuse::analysis {

/// One layer of a bed; empty where not known.
struct LayerRow {
  int layer = 0;
  std::optional<double> porosity, terzaghi, conductivity;
  std::optional<double> slope;              ///< of σ'/σ'_0 over the layer's gradient
  std::optional<double> local, by_lifting;  ///< critical gradients
};

/// Results as rows of quantity, symbol, value, unit, source and note, and a table of layers: for the screen,
/// as CSV and as JSON.
class ResultRows {
 public:
  struct Row {
    std::string quantity, symbol, unit, source, note;
    std::optional<double> value;
  };

  void add(std::string quantity, std::string symbol, std::optional<double> value, std::string unit,
           std::string source, std::string note);
  void add_layer(const LayerRow& row) { layers_.push_back(row); }

  const std::vector<Row>& rows() const { return rows_; }

  std::string text() const;
  /// A row a result; those of layers have the layer's number in the column `layer`, empty otherwise.
  void write_csv(const std::string& path, const std::string& who) const;
  /// {"results": [...], "layers": [...]}; null where there is no value.
  void write_json(const std::string& path, const std::string& who) const;

 private:
  std::vector<Row> rows_;
  std::vector<LayerRow> layers_;
};

}  // namespace suffuse::analysis
