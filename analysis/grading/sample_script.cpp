#include "grading/sample_script.h"

#include <fmt/format.h>

#include "suffuse/micromechanics/coordination.h"
#include "suffuse/micromechanics/random_placement.h"

namespace suffuse::analysis {
namespace {

/// Share of the smallest diameter that a neighbour list reaches beyond contact: Appendix A's 20 um for 0.1124
/// mm.
constexpr double kSkin = 0.178;

constexpr int kFirstSeed = 11593;  // the thesis's; LIGGGHTS wants primes above 10,000

int next_prime(int from) {
  const auto is_prime = [](int n) {
    for (int k = 2; k * k <= n; ++k)
      if (n % k == 0) return false;
    return true;
  };
  while (!is_prime(from)) ++from;
  return from;
}

std::string or_none(const std::string& text) {
  return text.empty() ? "none" : text;
}

}  // namespace

void write_sample_variables(SafeFile& file, const SampleScript& script) {
  const micromechanics::GrainSample& sample = script.sample;
  file.write("# " + script.title + "\n");
  const auto number = [&](const char* name, double value) {
    file.write(fmt::format("variable {} index {:.9g}\n", name, value));
  };
  const auto text = [&](const char* name, const std::string& value) {
    file.write(fmt::format("variable {} index \"{}\"\n", name, value));
  };
  text("sample_name", script.name);
  number("sample_grains", sample.grains);
  number("coarse_grains", sample.coarse);
  number("split", sample.split);
  number("fines_share", sample.fines_share);
  number("box_edge", script.box_edge);
  number("smallest_diameter", sample.classes.front().diameter);
  number("largest_diameter", sample.classes.back().diameter);
  std::vector<micromechanics::GradingClass> sizes;
  for (const auto& size : sample.classes) sizes.push_back({size.diameter, size.mass});
  number("sauter_diameter", micromechanics::effective_diameter(sizes));
  number("solid_volume", sample.solids);
  number("skin", kSkin * sample.classes.front().diameter);
  // Lines of sample.toml: a script cannot put a variable's value between quotes.
  for (const auto& [name, value] :
       {std::pair{"table_4_1", script.table_4_1}, std::pair{"table_5_1", script.table_5_1}})
    file.write(fmt::format("variable row_{0} index '{0} = \"{1}\"'\n", name, or_none(value)));
}

void write_sample_templates(SafeFile& file, const SampleScript& script) {
  const auto& classes = script.sample.classes;
  file.write("# " + script.title +
             "\n# Needs ${density} (kg/m3) and ${distribution_seed} (a prime above 10,000). Defines the "
             "distribution `grading`.\n");
  const double smallest = micromechanics::sphere_volume(classes.front().diameter / 2);
  int seed = kFirstSeed;
  for (std::size_t k = classes.size(); k-- > 0;) {  // from the coarsest, as the thesis's scripts
    file.write(
        fmt::format("fix template{} all particletemplate/sphere {} atom_type 1 density constant ${{density}} "
                    "volume_limit {:.3g} radius constant {:.9g}\n",
                    classes.size() - k, seed, smallest / 10, classes[k].diameter / 2));
    seed = next_prime(seed + 60);
  }
  file.write(
      fmt::format("fix grading all particledistribution/discrete ${{distribution_seed}} {}", classes.size()));
  for (std::size_t k = classes.size(); k-- > 0;)
    file.write(fmt::format("{} template{} {:.9g}", (classes.size() - k) % 10 == 1 ? " &\n   " : "",
                           classes.size() - k, classes[k].mass));
  file.write("\n");
}

void write_sample_data(SafeFile& file, const SampleScript& script, double density, std::uint64_t seed) {
  const std::vector<std::size_t> numbers = micromechanics::whole_numbers(script.sample);
  std::vector<double> diameters;
  for (std::size_t k = 0; k < numbers.size(); ++k)
    diameters.insert(diameters.end(), numbers[k], script.sample.classes[k].diameter);
  const Vec3 sides(script.box_edge, script.box_edge,
                   script.box_height > 0 ? script.box_height : script.box_edge);
  const auto grains = micromechanics::place_at_random(diameters, sides, seed);
  file.write(fmt::format("{}, seed {}\n\n{} atoms\n1 atom types\n", script.title, seed, grains.size()));
  for (int axis = 0; axis < 3; ++axis)
    file.write(fmt::format("0 {:.9g} {}lo {}hi\n", sides[axis], "xyz"[axis], "xyz"[axis]));
  file.write("\nAtoms\n\n");
  for (std::size_t k = 0; k < grains.size(); ++k)
    file.write(fmt::format("{} 1 {:.9g} {:.9g} {:.12g} {:.12g} {:.12g}\n", k + 1, grains[k].diameter, density,
                           grains[k].centre.x(), grains[k].centre.y(), grains[k].centre.z()));
}

void write_sample_classes(SafeFile& file, const SampleScript& script) {
  file.write("# " + script.title + "\ndiameter_m,mass_fraction,grains\n");
  for (const micromechanics::SampleClass& one : script.sample.classes)
    file.write(fmt::format("{:.9g},{:.12g},{:.6g}\n", one.diameter, one.mass, one.grains));
}

}  // namespace suffuse::analysis
