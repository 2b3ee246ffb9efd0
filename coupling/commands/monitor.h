#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../liggghts/scene.h"
#include "checkpoint_contents.h"
#include "monitor_request.h"
#include "styles/style_support.h"
#include "suffuse/common/time_series_file.h"
#include "suffuse/common/word_facts.h"
#include "suffuse/coupling/coupled_simulation.h"
#include "suffuse/coupling/plane_sums.h"

namespace suffuse::coupling {

/// What quantities are made from; each part is computed once a sample, and only if some quantity wants it.
class Sample {
 public:
  Sample(const Scene& of, const MappedScene& mapped, int across) : scene(of), axis(across), mapped_(mapped) {}

  const PlaneSums& planes();
  /// For those that are known already.
  void set_planes(const PlaneSums& planes) { planes_ = planes; }
  const LiggghtsPort::Summary& grains();
  /// |g| of `lbm force gravity` times the density, or with 9.81 m/s^2 where there is none, N/m^3.
  double specific_weight() const;

  Scene scene;
  int axis;

 private:
  MappedScene mapped_;
  std::optional<PlaneSums> planes_;
  std::optional<LiggghtsPort::Summary> grains_;
};

/// Some columns of a monitor's file.
struct Quantity {
  std::vector<std::string> columns;  ///< names with units
  std::function<void(Sample&, std::vector<double>&)> append;
  /// What samples refer to, in an order of the quantity's own, empty before the first one: kept in saved
  /// states. Null: nothing.
  std::shared_ptr<std::vector<double>> reference = {};
};

/// A quantity that a monitor knows by its word: what readers are told of it, what follows the word (null:
/// nothing), and how it is made.
struct QuantityKind {
  WordFacts facts;
  void (*read)(ArgumentReader&, QuantityRequest&);
  Quantity (*make)(const QuantityRequest&, const MonitorRequest&, Sample& now);
  bool of_layers = false;  ///< needs `layers LO HI N`
};

/// All of them, in the order of docs/reference/lbm.md. Another one is another row.
const std::vector<QuantityKind>& quantity_kinds();
/// Null for a reference, c_ID[k], f_ID[k] or v_NAME.
const QuantityKind* find_quantity(const std::string& word);

/// The quantity that a line of the script asks for. A UserError if it names what does not exist.
/// `box_low` is LIGGGHTS's low corner along the monitor's axis. Collective.
Quantity make_quantity(const QuantityRequest& request, const MonitorRequest& monitor, Sample& now);

/// `lbm monitor`: a CSV file with a header of names and units, one row a sample, flushed as written.
class Monitor {
 public:
  /// A new file, or with `continues` the one that is there; samples refer to what `references` has for these
  /// columns. Collective.
  Monitor(const MonitorRequest& request, const Scene& scene, const MappedScene& mapped,
          std::optional<SeriesContinuation> continues, const MonitorReferences& references);

  /// Adds what samples refer to now.
  void add_references(MonitorReferences& references) const;

  /// Fluid steps between samples.
  long every() const { return every_; }
  const MonitorRequest& request() const { return request_; }

  /// `planes`: sums of this step, if they are known; taken where they are across the monitor's axis.
  /// Collective.
  void write(const Scene& scene, const MappedScene& mapped, const std::optional<PlaneSums>& planes = {});

 private:
  void open(const Scene& scene, std::optional<SeriesContinuation> continues);
  void refuse_repeated_columns() const;
  std::string key(const Quantity& quantity) const;

  MonitorRequest request_;
  std::vector<Quantity> quantities_;
  long every_ = 1;
  long last_step_ = -1;
  std::optional<TimeSeriesFile> file_;
};

}  // namespace suffuse::coupling
