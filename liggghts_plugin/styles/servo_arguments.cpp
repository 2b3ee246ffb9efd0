#include "servo_arguments.h"

#include <fmt/format.h>

#include "suffuse/common/error.h"

namespace suffuse {
namespace {

constexpr const char* kServoKeywords =
    "every, inertial_number, diameter, max_rate, approach, tolerance, static_window, unbalanced, progress, "
    "until";

int axis_index(const std::string& who, const std::string& word) {
  if (word == "x") return 0;
  if (word == "y") return 1;
  if (word == "z") return 2;
  throw_user_error({who, "axis", word, "be x, y or z", ""});
}

void read_shear_path(ArgumentReader& reader, const std::string& name, servo::Settings& settings) {
  if (settings.path != servo::Path::constant_volume) settings.target = reader.positive("target stress");
  bool bounds_given = false, direction_given = false;
  const auto set_direction = [&](int direction) {
    if (direction_given)
      throw_user_error(
          {reader.who(), "direction", "compression and extension", "be one of them", "drop the other"});
    direction_given = true;
    settings.direction = direction;
  };
  while (!reader.done()) {
    if (reader.keyword("axis")) {
      settings.axis = axis_index(reader.who(), reader.word("axis"));
    } else if (reader.keyword("compression")) {
      set_direction(1);
    } else if (reader.keyword("extension")) {
      set_direction(-1);
    } else if (reader.keyword("rate")) {
      settings.axial_rate = reader.positive("axial strain rate");
    } else if (name == "cyclic" && reader.keyword("deviator")) {
      settings.deviator_low = reader.number("lower bound of the deviator");
      settings.deviator_high = reader.number("upper bound of the deviator");
      bounds_given = true;
    } else {
      break;
    }
  }
  if (settings.path != servo::Path::cyclic) return;
  if (!bounds_given || settings.deviator_low >= settings.deviator_high)
    throw_user_error(
        {reader.who(), "deviator",
         bounds_given ? fmt::format("{:g} {:g}", settings.deviator_low, settings.deviator_high) : "none",
         "be two bounds, lower < upper", "e.g. `deviator -20e3 40e3`"});
}

void read_path(ArgumentReader& reader, servo::Settings& settings) {
  constexpr const char* kPaths = "isotropic, constant_p, triaxial, cyclic, constant_volume";
  const std::string name = reader.word(fmt::format("stress path ({})", kPaths));
  if (name == "isotropic") {
    settings.path = servo::Path::isotropic;
    settings.target = reader.positive("target mean stress");
    return;
  }
  if (name == "constant_p")
    settings.path = servo::Path::constant_mean;
  else if (name == "triaxial")
    settings.path = servo::Path::triaxial;
  else if (name == "cyclic")
    settings.path = servo::Path::cyclic;
  else if (name == "constant_volume")
    settings.path = servo::Path::constant_volume;
  else
    throw_user_error({reader.who(), "stress path", name, fmt::format("be one of: {}", kPaths), ""});
  read_shear_path(reader, name, settings);
}

void read_stop(ArgumentReader& reader, servo::Settings& settings) {
  const std::string condition = reader.word("stop condition (target, static, axial_strain or cycles)");
  const bool shears = settings.path != servo::Path::isotropic;
  if (condition == "target") {
    settings.stop = servo::Stop::target;
  } else if (condition == "static") {
    settings.stop = servo::Stop::static_state;
    if (shears)
      throw_user_error({reader.who(), "until", "static", "go with isotropic",
                        "a sheared sample is never static; use axial_strain"});
  } else if (condition == "axial_strain") {
    settings.stop = servo::Stop::axial_strain;
    settings.stop_value = reader.positive("axial_strain");
    if (!shears)
      throw_user_error({reader.who(), "until", condition, "go with a shear path", "use `until static`"});
    if (settings.direction > 0 && settings.stop_value >= 1)
      throw_user_error({reader.who(), "axial_strain", fmt::format("{:g}", settings.stop_value), "be < 1",
                        "it is a fraction: 15 % is 0.15"});
  } else if (condition == "cycles") {
    settings.stop = servo::Stop::cycles;
    settings.stop_value = static_cast<double>(reader.positive_integer("cycles"));
    if (settings.path != servo::Path::cyclic)
      throw_user_error({reader.who(), "until", condition, "go with cyclic", ""});
  } else {
    throw_user_error({reader.who(), "until", condition, "be target, static, axial_strain or cycles", ""});
  }
}

/// A share, or a ratio whose meaning ends at 1.
double share(ArgumentReader& reader, const char* what) {
  const double value = reader.positive(what);
  if (value > 1)
    throw_user_error({reader.who(), what, fmt::format("{:g}", value), "be <= 1", "it is a share"});
  return value;
}

void read_option(ArgumentReader& reader, ServoArguments& arguments) {
  const std::string key = reader.keyword();
  if (key == "every") {
    arguments.every = reader.positive_integer("every");
    arguments.every_given = true;
  } else if (key == "inertial_number") {
    arguments.settings.inertial_number = share(reader, "inertial_number");
  } else if (key == "diameter") {
    if (reader.accept("mass")) {
      arguments.diameter_kind = MeanDiameter::mass;
    } else if (reader.accept("number")) {
      arguments.diameter_kind = MeanDiameter::number;
    } else if (reader.next_is_number()) {
      arguments.diameter_kind = MeanDiameter::given;
      arguments.diameter = reader.positive("diameter");
    } else {
      throw_user_error({reader.who(), "diameter", reader.word("diameter (mass, number or a value in m)"),
                        "be mass, number or a value in m", ""});
    }
  } else if (key == "max_rate") {
    arguments.settings.max_rate = reader.positive("max_rate");
  } else if (key == "approach") {
    arguments.approach_given = true;
    arguments.settings.approach_share = share(reader, "approach");
  } else if (key == "unbalanced") {
    arguments.settings.unbalanced = reader.accept("off") ? 0 : share(reader, "unbalanced (off or a ratio)");
  } else if (key == "tolerance") {
    arguments.settings.tolerance = share(reader, "tolerance");
  } else if (key == "static_window") {
    arguments.window_steps = reader.positive_integer("static_window");
  } else if (key == "progress") {
    arguments.progress_every = reader.number("progress");
  } else if (key == "until") {
    read_stop(reader, arguments.settings);
  } else {
    reader.unknown(key, kServoKeywords);
  }
}

}  // namespace

ServoArguments read_servo_arguments(ArgumentReader& reader) {
  ServoArguments arguments;
  read_path(reader, arguments.settings);
  while (!reader.done()) read_option(reader, arguments);
  return arguments;
}

}  // namespace suffuse
