#include "monitor_request.h"

#include <fmt/format.h>

#include <algorithm>

#include "suffuse/common/error.h"

namespace suffuse::coupling {

namespace {

constexpr const char* kKnown =
    "every, file, axis, layers, superficial_velocity, hydraulic_gradient, layer_gradient, layer_porosity, "
    "layer_pressure, solid_force, mean_force GROUP, mass, discharge, kinetic_energy, bed, grains, "
    "grains_left D ..., eroded_mass [above H] D ..., extremes, or c_ID[k], f_ID[k], v_NAME [as NAME], with "
    "`relative` before it";

bool is_reference(const std::string& word) {
  return word.size() > 2 && word[1] == '_' && std::string("cfv").find(word[0]) != std::string::npos;
}

QuantityRequest read_quantity(ArgumentReader& reader, const std::string& first) {
  static const std::vector<std::string> plain{"superficial_velocity",
                                              "hydraulic_gradient",
                                              "layer_gradient",
                                              "layer_porosity",
                                              "layer_pressure",
                                              "solid_force",
                                              "mass",
                                              "discharge",
                                              "kinetic_energy",
                                              "bed",
                                              "grains",
                                              "extremes"};
  QuantityRequest quantity;
  quantity.word = first;
  if (first == "relative") {
    quantity.relative = true;
    quantity.word = reader.word("c_ID[k], f_ID[k] or v_NAME after relative");
    if (!is_reference(quantity.word)) reader.unknown(quantity.word, "c_ID[k], f_ID[k], v_NAME");
  }
  if (is_reference(quantity.word)) {
    if (reader.accept("as")) quantity.name = reader.word("name of the column");
    if (quantity.name.find_first_of(",\"\n") != std::string::npos)
      throw_user_error(
          {reader.who(), "as", quantity.name, "have no comma or quote: it names a column of a CSV file", ""});
  } else if (first == "mean_force") {
    quantity.group = reader.word("group of mean_force");
  } else if (first == "grains_left" || first == "eroded_mass") {
    if (first == "eroded_mass" && reader.accept("above"))
      quantity.above = reader.number("height of eroded_mass");
    while (reader.next_is_number()) quantity.numbers.push_back(reader.positive("diameter of " + first));
    if (!std::is_sorted(quantity.numbers.begin(), quantity.numbers.end()))
      throw_user_error({reader.who(), first, "diameters out of order", "rise", "sort them"});
  } else if (std::find(plain.begin(), plain.end(), first) == plain.end()) {
    reader.unknown(first, kKnown);
  }
  return quantity;
}

LayerRequest read_layers(ArgumentReader& reader) {
  LayerRequest layers;
  layers.low = reader.number("low end of layers");
  layers.high = reader.number("high end of layers");
  layers.count =
      static_cast<int>(std::min<std::int64_t>(reader.positive_integer("number of layers"), 1000000));
  if (!(layers.high > layers.low))
    throw_user_error({reader.who(), "layers", fmt::format("{:g} {:g}", layers.low, layers.high),
                      "have the low end first", "layers 0 0.012 10"});
  return layers;
}

}  // namespace

MonitorRequest read_monitor_request(ArgumentReader& reader, const std::string& id) {
  MonitorRequest monitor;
  monitor.id = id;
  while (!reader.done()) {
    if (reader.keyword("every")) {
      monitor.every = reader.positive("every");
    } else if (reader.keyword("file")) {
      monitor.file = reader.word("file");
    } else if (reader.keyword("axis")) {
      const std::string axis = reader.word("axis");
      if (axis != "x" && axis != "y" && axis != "z") reader.unknown(axis, "x, y, z");
      monitor.axis = axis[0] - 'x';
    } else if (reader.keyword("layers")) {
      monitor.layers = read_layers(reader);
    } else {
      monitor.quantities.push_back(read_quantity(reader, reader.word("quantity")));
    }
  }
  if (monitor.every <= 0 || monitor.file.empty() || monitor.quantities.empty())
    throw_user_error({reader.who(), "monitor " + id, "incomplete", "have every, file and quantities",
                      "lbm monitor m every 1e-3 file flow.csv superficial_velocity"});
  for (const QuantityRequest& quantity : monitor.quantities)
    if (quantity.word.starts_with("layer_") && monitor.layers.count == 0)
      throw_user_error({reader.who(), quantity.word, "without layers", "come with layers LO HI N",
                        "lbm monitor m every 1e-3 file flow.csv layers 0 0.012 10 layer_gradient"});
  return monitor;
}

}  // namespace suffuse::coupling
