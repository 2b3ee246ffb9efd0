#pragma once

#include <optional>
#include <string>
#include <vector>

namespace suffuse::coupling {

/// One quantity of a `lbm monitor` line, as written.
struct QuantityRequest {
  std::string word;             ///< one of ours, or a reference c_ID[k], f_ID[k], v_NAME
  std::vector<double> numbers;  ///< diameters of `grains_left`, `eroded_mass`
  std::optional<double> above;  ///< of `eroded_mass`: coordinate along the axis, m
  std::string group;            ///< of `mean_force`
  bool relative = false;        ///< divided by the first sample's value
  std::string name;             ///< `as NAME`; empty: made from the word

  bool operator==(const QuantityRequest&) const = default;
};

/// Equal layers across an axis, low corner of the box included in LIGGGHTS's coordinates.
struct LayerRequest {
  double low = 0, high = 0;  ///< m
  int count = 0;             ///< 0: none given

  bool operator==(const LayerRequest&) const = default;
};

/// `lbm monitor ID every T file FILE [axis x|y|z] [layers LO HI N] QUANTITY ...`
struct MonitorRequest {
  std::string id, file;
  double every = 0;  ///< s
  int axis = 2;
  LayerRequest layers;
  std::vector<QuantityRequest> quantities;

  bool operator==(const MonitorRequest&) const = default;
};

}  // namespace suffuse::coupling
