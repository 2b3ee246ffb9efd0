// Packings that can be computed by hand, written to files and read back; and files that are wrong.

#include <fmt/format.h>
#include <zlib.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <functional>

#include "contacts/contact_measures.h"
#include "files/record_table.h"
#include "hand_packings.h"
#include "suffuse/common/error.h"
#include "suffuse/common/safe_file.h"
#include "user_error_message.h"

using namespace suffuse;
using namespace suffuse::analysis;
using namespace suffuse::micromechanics;
namespace files = std::filesystem;

namespace {

/// A folder of its own that goes with the test.
class Scratch {
 public:
  Scratch() : path_(files::temp_directory_path() / fmt::format("suffuse-series-{}", getpid())) {
    files::remove_all(path_);
    files::create_directory(path_);
  }
  ~Scratch() { files::remove_all(path_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }
  std::string write_gzip(const std::string& name, const std::string& text) const {
    const std::string path = (path_ / name).string();
    gzFile file = gzopen(path.c_str(), "wb");
    gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
    gzclose(file);
    return path;
  }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  files::path path_;
};

constexpr double kRadius = 0.5e-3;
constexpr int kSide = 3;
constexpr double kForce = 0.25;  // N along each contact
constexpr double kShear = 0.06;  // N across contacts along z

std::string header(long step, const char* what, std::size_t rows) {
  const double length = 2 * kRadius * kSide;
  return fmt::format(
      "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF {}\n{}\nITEM: BOX BOUNDS pp pp pp\n0 {}\n0 {}\n0 {}\n", step, what,
      rows, length, length, length);
}

/// Simple cubic, pushed by kForce, with a shear force along x on contacts along z.
Packing sample() {
  return testing::simple_cubic(kSide, kRadius, [](const Vec3& branch) -> Vec3 {
    const Vec3 normal = branch.normalized();
    return kForce * normal + (std::abs(normal.z()) > 0.9 ? kShear * normal.z() : 0) * Vec3::UnitX();
  });
}

std::string grains_text(const Packing& packing, long step) {
  std::string text = header(step, "ATOMS", packing.grains.size()) + "ITEM: ATOMS type radius z y x id \n";
  for (const Grain& g : packing.grains)
    text +=
        fmt::format("1 {} {} {} {} {} \n", g.radius, g.position.z(), g.position.y(), g.position.x(), g.id);
  return text;
}

std::string vector_text(const Vec3& v) {
  return fmt::format("{} {} {}", v.x(), v.y(), v.z());
}

std::string contacts_text(const Packing& packing, long step) {
  std::string text = header(step, "ENTRIES", packing.contacts.size()) + "ITEM: ENTRIES";
  for (int k = 1; k <= 18; ++k) text += fmt::format(" c_p[{}]", k);
  text += '\n';
  for (const Contact& c : packing.contacts) {
    const Vec3 normal = c.branch.normalized(), push = c.force.dot(normal) * normal;
    const auto at = [&](int grain) {
      return vector_text(packing.grains[static_cast<std::size_t>(grain)].position);
    };
    text += fmt::format("{} {} {} {} 1 {} {} {}\n", at(c.first), at(c.second), first_grain(packing, c).id,
                        second_id(packing, c), vector_text(c.force), vector_text(push),
                        vector_text(c.force - push));
  }
  return text;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

Record record_of(const std::vector<std::string>& paths, const ReadSettings& settings = {}) {
  Snapshot snapshot;
  const auto series = open_series(paths, settings);
  if (!series->next(snapshot)) throw UserError("no snapshot");
  return ContactMeasurer({}).measure(snapshot);
}

/// What reading all snapshots says.
std::string message_of(const std::vector<std::string>& paths) {
  const auto read_all = [&] {
    const auto series = open_series(paths, {});
    Snapshot snapshot;
    while (series->next(snapshot)) {
    }
  };
  return suffuse::message_of(read_all, "no error");
}

}  // namespace

TEST_CASE("a simple cubic packing through dumps: Z = 6, p' = F/(2r)², a third of the contacts slide") {
  const Scratch scratch;
  const Packing packing = sample();
  const std::vector<std::string> paths{scratch.write("c.dump", contacts_text(packing, 7)),
                                       scratch.write_gzip("g.dump.gz", grains_text(packing, 7))};
  ReadSettings settings;
  settings.friction = 0.24;  // kShear/kForce: contacts along z are at their limit
  const Record r = record_of(paths, settings);
  const auto value = [&](const char* name) { return value_of(r, name).value(); };
  CHECK(value("step") == 7);
  CHECK(value("coordination_number") == 6);
  CHECK(value("porosity") == Approx(1 - M_PI / 6).epsilon(1e-12));
  // One contact of each direction a grain: V σ = Σ l f, so σ_zz = F/(2r)².
  const double stress = kForce / (4 * kRadius * kRadius);
  for (const char* name : {"mean_stress_pa", "stress_xx_pa", "stress_yy_pa", "stress_zz_pa"})
    CHECK(value(name) == Approx(stress).epsilon(1e-12));
  CHECK(value("sliding_share") == Approx(1. / 3));
  CHECK(value("mean_mobilised_friction") == Approx(0.24 / 3));
  CHECK(value("constraint_ratio") == Approx(6 * (3 - 2. / 3) / 12));
  CHECK(value("fabric_xx") == Approx(1. / 3));
  CHECK(value("fabric_deviator") == Approx(0).margin(1e-12));
  CHECK(value("strong_share") == 1);
  CHECK(value("rattler_share") == 0);
  CHECK_FALSE(value_of(r, "alpha_pair_halves").has_value());
}

TEST_CASE("a region: the whole's coordination and stress, and rattlers that hang on others outside") {
  const Scratch scratch;
  const double spacing = 2 * kRadius, length = kSide * spacing;
  ReadSettings settings;
  settings.region = micromechanics::Box{Vec3(spacing, 0, 0), Vec3(2 * spacing, length, length)};
  Packing packing = sample();
  const auto value = [&](const char* name) {
    const std::vector<std::string> paths{scratch.write("g.dump", grains_text(packing, 7)),
                                         scratch.write("c.dump", contacts_text(packing, 7))};
    return value_of(record_of(paths, settings), name).value();
  };
  CHECK(value("grains") == kSide * kSide);
  CHECK(value("coordination_number") == Approx(6));
  CHECK(value("porosity") == Approx(1 - M_PI / 6).epsilon(1e-12));
  CHECK(value("mean_stress_pa") == Approx(kForce / (4 * kRadius * kRadius)).epsilon(1e-12));
  CHECK(value("rattler_share") == 0);
  // Rows along x alone, open at both ends: each grain in turn loses its last support.
  std::erase_if(packing.contacts, [&](const Contact& contact) {
    const double from = first_grain(packing, contact).position.x();
    return std::abs(contact.branch.x()) < kRadius || from - contact.branch.x() < 0 ||
           from - contact.branch.x() > length;
  });
  REQUIRE(packing.contacts.size() == static_cast<std::size_t>((kSide - 1) * kSide * kSide));
  CHECK(value("rattler_share") == 1);
}

TEST_CASE("columns are found by name, by the words of the compute, and by a name of one's own") {
  const Scratch scratch;
  const Packing packing = sample();
  const std::string grains = scratch.write("g", replaced(grains_text(packing, 1), "radius", "c_r"));
  std::string contacts = contacts_text(packing, 1);
  for (int k = 1; k <= 18; ++k) {
    // The same numbers as values of a compute with `vel` before the identifiers.
    const int shifted = k <= 6 ? k : k + 6;
    contacts = replaced(contacts, fmt::format(" c_p[{}]", k), fmt::format(" c_q[{}]", shifted));
  }
  const std::vector<std::string> paths{grains, scratch.write("c", contacts)};
  CHECK_THAT(message_of(paths), Catch::Contains("no column radius") && Catch::Contains("--column"));
  ReadSettings settings;
  settings.columns = {{"radius", "c_r"}};
  CHECK_THAT(message_of([&] { record_of(paths, settings); }),
             Catch::Contains("no identifiers of the two grains"));
  settings.contact_words = {"force", "pos", "vel", "id", "force_tangential", "force_normal"};
  CHECK(value_of(record_of(paths, settings), "coordination_number") == 6.);
  settings.contact_words = {"pos", "speed"};
  CHECK_THAT(message_of([&] { record_of(paths, settings); }), Catch::Contains("speed"));
}

TEST_CASE("snapshots over many files come in the order of their steps and those without a partner are told") {
  const Scratch scratch;
  const Packing packing = sample();
  for (const long step : {20L, 100L, 3L}) {
    scratch.write(fmt::format("g_{}.dump", step), grains_text(packing, step));
    if (step != 20) scratch.write(fmt::format("c_{}.dump", step), contacts_text(packing, step));
  }
  const auto series = open_series({scratch / "c_*.dump", scratch / "g_*.dump"}, {});
  Snapshot snapshot;
  std::vector<std::int64_t> steps;
  while (series->next(snapshot)) steps.push_back(snapshot.step);
  CHECK(steps == std::vector<std::int64_t>{3, 100});
  CHECK_THAT(series->notes(), Catch::Contains("1 snapshots of grains without contacts"));
  CHECK(series->done() == 1);
}

TEST_CASE("a state without contacts has zeros, a state without grains is refused") {
  const Scratch scratch;
  Packing packing = sample();
  packing.contacts.clear();
  const std::string grains = scratch.write("g", grains_text(packing, 1)),
                    contacts = scratch.write("c", contacts_text(packing, 1));
  const Record r = record_of({grains, contacts});
  CHECK(value_of(r, "coordination_number") == 0.);
  CHECK(value_of(r, "sliding_share") == 0.);
  CHECK(value_of(r, "rattler_share") == 1.);
  packing.grains.clear();
  CHECK_THAT(message_of({scratch.write("none", grains_text(packing, 1)), contacts}),
             Catch::Contains("no grains"));
}

TEST_CASE("a malformed dump is told in one line with its file and line") {
  const Scratch scratch;
  const Packing packing = sample();
  const std::string good_grains = grains_text(packing, 5), good_contacts = contacts_text(packing, 5);
  const std::string grains = scratch.write("grains", good_grains);
  const auto contacts_say = [&](const std::string& text) {
    return message_of({grains, scratch.write("contacts", text)});
  };
  const auto grains_say = [&](const std::string& text) {
    return message_of({scratch.write("other", text), scratch.write("contacts", good_contacts)});
  };
  const auto says = [](const std::string& message, std::initializer_list<const char*> words) {
    INFO(message);
    CHECK(message.find('\n') == std::string::npos);
    for (const char* word : words) CHECK_THAT(message, Catch::Contains(word));
  };
  CHECK(contacts_say(good_contacts) == "no error");
  const std::string cut = good_contacts.substr(0, good_contacts.size() - 300);
  says(contacts_say(cut), {"contacts, line", "cut short"});
  says(contacts_say(good_contacts.substr(0, good_contacts.size() - 2)), {"the last line has no end"});
  says(contacts_say(good_contacts.substr(0, good_contacts.find("ITEM: BOX"))),
       {"the file ends where the header should be"});
  says(contacts_say(cut.substr(0, cut.rfind('\n') + 1) + good_contacts), {"rows are missing"});
  says(contacts_say(replaced(good_contacts, " 0.25 0 0 0 0 0\n", " nan 0 0 0 0 0\n")),
       {"= nan at step 5", "time step"});
  says(contacts_say(replaced(good_contacts, " c_p[8]", "")), {"no identifiers of the two grains"});
  says(contacts_say(replaced(good_contacts, " 1 2 1 ", " 1 99 1 ")), {"names grain 99", "step 5"});
  says(contacts_say(replaced(good_contacts, " 1 2 1 ", " 1 2.5 1 ")), {"2.5", "--pair-values"});
  says(contacts_say(""), {"the file is empty"});
  says(contacts_say("time,stress\n1,2\n"), {"ITEM: TIMESTEP", "line 1"});
  says(contacts_say(good_contacts + good_contacts), {"step 5 comes after step 5"});
  says(grains_say(replaced(good_grains, "0.0005", "0.5")), {"units"});
  says(grains_say(replaced(good_grains, "0.0005", "-0.0005")), {"radius"});
  says(grains_say(replaced(good_grains, " 27 \n", " 26 \n")), {"grain 26 is there twice"});
  says(grains_say(replaced(good_grains, "0.0005", "12;3")), {"12;3 is no number"});
  // Grains in millimetres, contacts in metres.
  Packing millimetres = packing;
  for (Grain& g : millimetres.grains) {
    g.radius *= 1000;
    g.position *= 1000;
  }
  std::string box = grains_text(millimetres, 5);
  for (int k = 0; k < 3; ++k) box = replaced(box, "\n0 0.003", "\n0 3");
  says(grains_say(box), {"contact of grains", "units"});
  says(message_of({grains}), {"no file has contacts"});
  says(message_of({grains, scratch / "nothing*"}), {"match a file"});
  says(message_of({grains, scratch.write("later", contacts_text(packing, 6))}), {"no step has both"});
  const std::string whole = scratch.write_gzip("whole.gz", good_contacts);
  const std::string half = scratch / "half.gz";
  files::copy_file(whole, half);
  files::resize_file(half, files::file_size(whole) / 2);
  says(message_of({grains, half}), {"half.gz", "cut short"});
}

TEST_CASE("a file of results appears whole or not at all") {
  const Scratch scratch;
  const std::string path = scratch / "series.csv";
  {
    CsvWriter writer(path, "test");
    writer.write({{"a", 1}, {"b", std::nullopt}});
  }
  CHECK_FALSE(files::exists(path));
  CHECK_FALSE(files::exists(path + ".part"));
  CsvWriter writer(path, "test");
  writer.write({{"a", 1}, {"b", std::nullopt}});
  writer.write({{"a", 0.1}, {"b", 2e-300}});
  writer.commit();
  std::ifstream file(path);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  CHECK(text == "a,b\n1,\n0.1,2e-300\n");
  CHECK_THROWS_AS(SafeFile(scratch / "no/such/folder.csv", "test"), UserError);
}
