// Checkpoints and field files, written on some ranks and read on others.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "lbm_test_tools.h"
#include "suffuse/common/collective_text.h"
#include "suffuse/common/error.h"
#include "suffuse/common/hdf5_file.h"
#include "suffuse/common/xdmf_series.h"
#include "suffuse/lbm/checkpoint.h"
#include "suffuse/lbm/field_output.h"

using namespace suffuse;
using namespace suffuse::lbm;
using namespace suffuse::lbm::test;

namespace {

constexpr Index3 kCells{9, 7, 8};

/// One folder for all ranks, of this run only.
std::filesystem::path folder() {
  int ranks = 1, rank = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const std::filesystem::path path =
      std::filesystem::current_path() / ("lbm_files_test_" + std::to_string(ranks));
  if (rank == 0) std::filesystem::create_directories(path);
  MPI_Barrier(MPI_COMM_WORLD);
  return path;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

FluidSettings settings_for(Precision precision) {
  FluidSettings settings;
  settings.precision = precision;
  settings.faces = by_axis(FaceKind::no_slip, FaceKind::periodic, FaceKind::pressure);
  settings.faces[4].density = 1.01;
  settings.collision.smagorinsky = 0.1;
  return settings;
}

Fluid started(const FluidSettings& settings, MPI_Comm communicator) {
  Fluid fluid(settings, Decomposition::balanced(communicator, kCells));
  fluid.set_solids([](const Index3& c) { return noise(c, 2, 3) > 0.75 ? std::uint8_t{3} : std::uint8_t{0}; });
  fluid.set_force(Vec3(1e-4, 0, 0));
  for_each_cell(fluid.decomposition().local_box(), [&](int x, int y, int z) {
    if (fluid.is_solid({x, y, z})) return;
    for (int i = 0; i < kDirections; ++i) fluid.set_population(i, {x, y, z}, random_population(i, {x, y, z}));
  });
  return fluid;
}

long differences(const Fluid& one, const Fluid& other) {
  long mine = 0, all = 0;
  for_each_cell(one.decomposition().local_box(), [&](int x, int y, int z) {
    if (one.is_solid({x, y, z}) != other.is_solid({x, y, z})) ++mine;
    for (int i = 0; i < kDirections; ++i)
      if (!one.is_solid({x, y, z}) && one.population(i, {x, y, z}) != other.population(i, {x, y, z})) ++mine;
  });
  MPI_Allreduce(&mine, &all, 1, MPI_LONG, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

}  // namespace

TEST_CASE("a saved fluid goes on bit for bit, on another number of ranks and from either kind of step") {
  const std::filesystem::path path = folder() / "state.h5";
  for (const Precision precision : {Precision::double_precision, Precision::float_precision})
    for (const long saved_at : {4, 7}) {
      const FluidSettings settings = settings_for(precision);
      Fluid shared = started(settings, MPI_COMM_WORLD);
      shared.run(saved_at);
      save_state(shared, path.string());
      shared.run(5);

      // Every rank goes on by itself with the whole box.
      Fluid alone(settings, Decomposition::balanced(MPI_COMM_SELF, kCells));
      alone.set_force(Vec3(1e-4, 0, 0));
      load_state(alone, path.string());
      CHECK(alone.steps() == saved_at);
      alone.run(5);
      CHECK(differences(shared, alone) == 0);

      Fluid again = started(settings, MPI_COMM_WORLD);
      again.step();  // whatever it did before is forgotten
      load_state(again, path.string());
      again.run(5);
      CHECK(differences(again, shared) == 0);
      CHECK_FALSE(std::filesystem::exists(path.string() + ".part"));
    }
}

TEST_CASE("a text that cannot be written is one error, the same on all ranks, and leaves nothing") {
  const std::filesystem::path path = folder() / "words.txt";
  write_text(path.string(), "test", "words", MPI_COMM_WORLD);
  CHECK(std::filesystem::file_size(path) == 5);
  CHECK_FALSE(std::filesystem::exists(path.string() + ".part"));
  CHECK_THROWS_WITH(
      write_text((folder() / "nowhere" / "words.txt").string(), "test", "words", MPI_COMM_WORLD),
      Catch::Contains("test: file") && Catch::Contains("be writable"));
  // A device that is always full.
  if (std::filesystem::exists("/dev/full")) {
    std::error_code ignored;
    std::filesystem::create_symlink("/dev/full", folder() / "full.txt.part", ignored);
    CHECK_THROWS_WITH(write_text((folder() / "full.txt").string(), "test", "words", MPI_COMM_WORLD),
                      Catch::Contains("is the disk full"));
    CHECK_FALSE(std::filesystem::exists(folder() / "full.txt"));
  }
}

TEST_CASE("a state of another size or storage type is refused") {
  const std::filesystem::path path = folder() / "other.h5";
  save_state(started(settings_for(Precision::double_precision), MPI_COMM_WORLD), path.string());
  Fluid single(settings_for(Precision::float_precision), Decomposition::balanced(MPI_COMM_WORLD, kCells));
  CHECK_THROWS_WITH(load_state(single, path.string()),
                    Catch::Contains("precision = double") && Catch::Contains("set precision to double"));
  Fluid larger(settings_for(Precision::double_precision), Decomposition::balanced(MPI_COMM_WORLD, {9, 7, 9}));
  CHECK_THROWS_WITH(load_state(larger, path.string()), Catch::Contains("8 7 9") && Catch::Contains("9 7 9"));
  CHECK_THROWS_WITH(load_state(larger, (folder() / "absent.h5").string()),
                    Catch::Contains("readable HDF5 file"));
}

TEST_CASE("a state goes on only in the units in which it was saved") {
  const std::filesystem::path path = folder() / "units.h5";
  UnitsRequest request;
  request.spacing = 1e-3;
  request.time_step = 0.01;
  const Units saved(request);
  Fluid fluid = started(settings_for(Precision::double_precision), MPI_COMM_WORLD);
  save_state(fluid, path.string(), &saved);
  CHECK_NOTHROW(load_state(fluid, path.string(), &saved));
  request.density = 1025;
  const Units salt(request);
  CHECK_THROWS_WITH(load_state(fluid, path.string(), &salt),
                    Catch::Contains("density = 1025, must be 1000 as in the run that saved it"));
  request.density = 1000;
  request.spacing = 2e-3;
  const Units coarse(request);
  CHECK_THROWS_WITH(load_state(fluid, path.string(), &coarse), Catch::Contains("spacing = 0.002"));
}

TEST_CASE("fields are written in SI, and a series that is continued keeps what came before") {
  const std::filesystem::path path = folder() / "flow.h5";
  std::filesystem::remove(path);
  MPI_Barrier(MPI_COMM_WORLD);
  UnitsRequest request;
  request.spacing = 1e-3;
  request.time_step = 0.01;
  const Units units(request);
  FieldOutputSettings output;
  output.path = path.string();
  output.fields = {Field::velocity, Field::pressure, Field::density, Field::solid_fraction};
  Fluid fluid = started(settings_for(Precision::double_precision), MPI_COMM_WORLD);
  {
    FieldOutput writer(output, units);
    for (int n = 0; n < 3; ++n) {
      writer.write(fluid);
      fluid.run(2);
    }
  }
  // Grids added one by one, and all that are in the file: the last step is replaced, and the list made anew.
  const std::filesystem::path list = folder() / "flow.xdmf";
  const std::string one_by_one = text_of(list);
  output.append = true;
  MPI_Barrier(MPI_COMM_WORLD);
  {
    Fluid again = started(settings_for(Precision::double_precision), MPI_COMM_WORLD);
    again.run(4);
    FieldOutput(output, units).write(again);
  }
  CHECK(one_by_one.find("flow.h5:/step_000000000004/velocity") != std::string::npos);
  CHECK(text_of(list) == one_by_one);
  MPI_Barrier(MPI_COMM_WORLD);

  Fluid second = started(settings_for(Precision::double_precision), MPI_COMM_WORLD);
  second.run(3);
  FieldOutput continued(output, units);
  continued.write(second);  // step 3: keeps 0 and 2, drops 4

  const Hdf5File file(path.string(), Hdf5File::Mode::read, MPI_COMM_WORLD);
  const std::vector<std::string> expected{"step_000000000000", "step_000000000002", "step_000000000003"};
  CHECK(file.names_in("/") == expected);
  CHECK(file.number_attribute("/step_000000000003", "time_s") == Approx(0.03));
  const CellBox& box = second.decomposition().local_box();
  const auto n = [](int v) { return static_cast<std::size_t>(v); };
  ArrayPart part{{8, 7, 9},
                 {n(box.lo[2]), n(box.lo[1]), n(box.lo[0])},
                 {n(box.extent(2)), n(box.extent(1)), n(box.extent(0))}};
  const std::vector<float> pressure = file.read<float>("/step_000000000003/pressure", part);
  const std::vector<float> density = file.read<float>("/step_000000000003/density", part);
  const std::vector<float> solid = file.read<float>("/step_000000000003/solid_fraction", part);
  part.whole.push_back(3);
  part.offset.push_back(0);
  part.count.push_back(3);
  const std::vector<float> velocity = file.read<float>("/step_000000000003/velocity", part);
  std::size_t cell = 0;
  for_each_cell(box, [&](int x, int y, int z) {
    const FluidPoint here = second.at({x, y, z});
    // rho c_s^2 (dx/dt)^2 and dx/dt by hand; six digits of float.
    CHECK(pressure[cell] == Approx((here.density - 1) / 3 * 1000 * 0.01).margin(1e-6));
    CHECK(density[cell] == Approx(1000 * here.density));
    CHECK(velocity[3 * cell + 1] == Approx(here.velocity[1] * 0.1).margin(1e-8));
    CHECK(solid[cell] == (second.is_solid({x, y, z}) ? 1.f : 0.f));
    ++cell;
  });
}

TEST_CASE("a series whose file has been taken away, or put back, goes on with what is there") {
  const std::filesystem::path path = folder() / "moved.h5", list = folder() / "moved.xdmf",
                              kept = folder() / "moved_kept.h5";
  std::filesystem::remove(path);
  MPI_Barrier(MPI_COMM_WORLD);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  UnitsRequest request;
  request.spacing = 1e-3;
  request.time_step = 0.01;
  FieldOutputSettings output;
  output.path = path.string();
  Fluid fluid = started(settings_for(Precision::double_precision), MPI_COMM_WORLD);
  FieldOutput writer(output, Units(request));
  const auto write_next = [&] {
    writer.write(fluid);
    fluid.run(1);
    MPI_Barrier(MPI_COMM_WORLD);
  };
  const auto states = [&] {  // in the list; the file has the same
    const std::string text = text_of(list);
    std::string listed, there;
    for (int n = 0; n < 9; ++n)
      if (text.find("step_00000000000" + std::to_string(n)) != std::string::npos) listed += std::to_string(n);
    {
      const Hdf5File file(path.string(), Hdf5File::Mode::read, MPI_COMM_WORLD);
      for (const std::string& name : file.names_in("/")) there += name.back();
    }
    CHECK(listed == there);
    MPI_Barrier(MPI_COMM_WORLD);
    return there;
  };
  write_next();
  if (rank == 0) std::filesystem::copy_file(path, kept, std::filesystem::copy_options::overwrite_existing);
  write_next();
  CHECK(states() == "01");
  if (rank == 0) std::filesystem::rename(kept, path);  // an older copy of it
  write_next();
  CHECK(states() == "02");
  if (rank == 0) std::filesystem::remove(path);
  write_next();
  CHECK(states() == "3");
}

TEST_CASE("what removed states have left in a file is not taken for its tables, in a later process either") {
  const std::string path = (folder() / "back.h5").string();
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  constexpr std::size_t length = 100'000, tables = 20'000;
  const ArrayPart part{{length}, {0}, {rank == 0 ? length : 0}};
  const std::vector<double> values(part.count[0], 3.);
  const auto add_state = [&](Hdf5Growth& growth, const std::string& name, bool killed = false) {
    const auto mode = name == "step_1" ? Hdf5File::Mode::create : Hdf5File::Mode::append;
    Hdf5File file(path, mode, MPI_COMM_WORLD, &growth);
    if (rank == 0) CHECK(std::filesystem::file_size(path + ".undo") < tables);
    file.create_group("/" + name);
    file.create_array<double>("/" + name + "/a", {length});
    file.write("/" + name + "/a", part, values);
    if (killed && rank == 0) std::filesystem::copy_file(path + ".undo", path + ".kept");
    file.close();
  };
  const auto check_states = [&](const std::vector<std::string>& expected) {
    const Hdf5File file(path, Hdf5File::Mode::read, MPI_COMM_WORLD);
    CHECK(file.names_in("/") == expected);
    for (const std::string& name : expected) CHECK(file.read<double>("/" + name + "/a", part) == values);
  };
  if (rank == 0) std::filesystem::remove(path + ".kept");
  {
    Hdf5Growth growth;
    for (const char* name : {"step_1", "step_2", "step_3", "step_4"}) add_state(growth, name);
    remove_states_from("step_2", "step_", path, growth, MPI_COMM_WORLD);
    check_states({"step_1"});
    add_state(growth, "step_2");
    add_state(growth, "step_3");
  }
  Hdf5Growth later;
  remove_states_from("step_3", "step_", path, later, MPI_COMM_WORLD);
  add_state(later, "step_5");
  Hdf5Growth last;
  add_state(last, "step_6", true);
  check_states({"step_1", "step_2", "step_5", "step_6"});
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank == 0) {
    std::filesystem::rename(path + ".kept", path + ".undo");
    std::fstream(path, std::ios::in | std::ios::out | std::ios::binary) << std::string(64, 'x');
  }
  MPI_Barrier(MPI_COMM_WORLD);
  Hdf5File(path, Hdf5File::Mode::append, MPI_COMM_WORLD, &last).close();
  check_states({"step_1", "step_2", "step_5"});
}

TEST_CASE("a list of grids grows at its end, and stays as it was where it cannot") {
  const std::filesystem::path path = folder() / "list.xdmf";
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const std::string first = "      <Grid Name=\"1\"/>\n", second = "      <Grid Name=\"2\"/>\n";
  std::filesystem::remove(path);
  MPI_Barrier(MPI_COMM_WORLD);
  XdmfSeries series(path.string(), "things");
  CHECK_FALSE(series.add(first, MPI_COMM_WORLD));  // nothing there yet
  CHECK_FALSE(std::filesystem::exists(path));
  MPI_Barrier(MPI_COMM_WORLD);
  series.write(first, MPI_COMM_WORLD);
  CHECK(series.add(second, MPI_COMM_WORLD));
  const std::string both = text_of(path);
  XdmfSeries((folder() / "other.xdmf").string(), "things").write(first + second, MPI_COMM_WORLD);
  CHECK(both == text_of(folder() / "other.xdmf"));

  // No room for more than a few bytes.
  rlimit usual{};
  getrlimit(RLIMIT_FSIZE, &usual);
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit little{both.size() + 3, usual.rlim_max};
  if (rank == 0) setrlimit(RLIMIT_FSIZE, &little);
  CHECK_THROWS_WITH(series.add(first, MPI_COMM_WORLD), Catch::Contains("list.xdmf"));
  if (rank == 0) setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, before);
  CHECK(text_of(path) == both);
  MPI_Barrier(MPI_COMM_WORLD);
  CHECK_FALSE(series.add(second, MPI_COMM_WORLD));  // one is missing: the list is to be made anew
  series.write(first, MPI_COMM_WORLD);
  CHECK(series.add(second, MPI_COMM_WORLD));

  if (rank == 0) std::ofstream(path) << "someone else's";
  MPI_Barrier(MPI_COMM_WORLD);
  CHECK_FALSE(series.add(second, MPI_COMM_WORLD));
  CHECK(text_of(path) == "someone else's");
}

TEST_CASE(
    "a series whose writer was killed holds the states of before, whatever was written over its tables") {
  const std::string path = (folder() / "killed.h5").string();
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const ArrayPart part{{6}, {0}, {rank == 0 ? std::size_t{6} : 0}};
  const ArrayPart many{{1000}, {0}, {rank == 0 ? std::size_t{1000} : 0}};
  const std::vector<double> values =
      rank == 0 ? std::vector<double>{1, 2, 3, 4, 5, 6} : std::vector<double>{};
  const auto add_state = [&](Hdf5File& file, const std::string& name) {
    file.create_group("/" + name);
    file.create_array<double>("/" + name + "/a", {6});
    file.write("/" + name + "/a", part, values);
    file.create_array<double>("/" + name + "/large", {1000});  // whose values are not noted
    file.write("/" + name + "/large", many, std::vector<double>(many.count[0], 7.));
  };
  Hdf5Growth growth;
  const auto states = [&] {
    Hdf5File file(path, Hdf5File::Mode::append, MPI_COMM_WORLD, &growth);
    const std::vector<std::string> names = file.names_in("/");
    for (const std::string& name : names) {
      CHECK(file.read<double>("/" + name + "/a", part) == values);
      CHECK(file.read<double>("/" + name + "/large", many) == std::vector<double>(many.count[0], 7.));
    }
    file.close();
    return names;
  };
  {
    Hdf5File file(path, Hdf5File::Mode::create, MPI_COMM_WORLD, &growth);
    add_state(file, "step_1");
    file.close();
  }
  {
    Hdf5File file(path, Hdf5File::Mode::append, MPI_COMM_WORLD, &growth);
    add_state(file, "step_2");
    if (rank == 0) {
      std::filesystem::copy_file(path + ".undo", path + ".kept");
      CHECK(std::filesystem::file_size(path + ".undo") < 8000);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    file.close();
  }
  CHECK(states() == std::vector<std::string>{"step_1", "step_2"});
  MPI_Barrier(MPI_COMM_WORLD);  // the first rank drops the note
  CHECK_FALSE(std::filesystem::exists(path + ".undo"));
  MPI_Barrier(MPI_COMM_WORLD);
  if (rank == 0) {
    std::filesystem::rename(path + ".kept", path + ".undo");
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);  // what HDF5 begins with
    file.write(std::string(64, 'x').data(), 64);
  }
  MPI_Barrier(MPI_COMM_WORLD);
  CHECK(states() == std::vector<std::string>{"step_1"});
}
