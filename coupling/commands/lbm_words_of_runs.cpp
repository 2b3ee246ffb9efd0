#include "lbm_words_of_runs.h"

#include <algorithm>
#include <filesystem>

#include "lbm_words.h"
#include "monitor.h"
#include "suffuse/lbm/flow_words.h"

namespace suffuse::coupling {

namespace {

using Given = std::set<std::string>;

bool is_reference(const std::string& word) {
  return word.size() > 2 && word[1] == '_' && std::string("cfv").find(word[0]) != std::string::npos;
}

/// `c_ID[k] as NAME`, from the word itself on.
QuantityRequest read_reference(ArgumentReader& reader, const std::string& word, bool relative) {
  QuantityRequest quantity;
  quantity.word = word;
  quantity.relative = relative;
  if (reader.accept("as")) quantity.name = reader.word("name of the column");
  if (quantity.name.find_first_of(",\"\n") != std::string::npos)
    throw_user_error(
        {reader.who(), "as", quantity.name, "have no comma or quote: it names a column of a CSV file", ""});
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

Word<MonitorRequest> quantity_word(const QuantityKind& kind) {
  Word<MonitorRequest> word{kind.facts,
                            [&kind](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, MonitorRequest& m) {
                              QuantityRequest quantity;
                              quantity.word = kind.facts.word;
                              if (kind.read != nullptr) kind.read(reader, quantity);
                              m.quantities.push_back(quantity);
                            }};
  word.repeats = word.listed = true;
  return word;
}

Word<MonitorRequest> relative_word() {
  Word<MonitorRequest> word{
      {"relative", "c_ID[k]|f_ID[k]|v_NAME [as NAME]", "", "", "",
       "a value of the script over that of the first sample, which must not be 0, as for σ'/σ'₀ of layers: "
       "`relative c_layers[*][3] as effective_stress_ratio`"},
      [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, MonitorRequest& m) {
        const std::string of = reader.word("c_ID[k], f_ID[k] or v_NAME after relative");
        if (!is_reference(of)) reader.unknown(of, "c_ID[k], f_ID[k], v_NAME");
        m.quantities.push_back(read_reference(reader, of, true));
      }};
  word.repeats = word.listed = true;
  return word;
}

void refuse_incomplete(ArgumentReader& reader, const MonitorRequest&, MonitorRequest& monitor, const Given&) {
  if (monitor.every <= 0 || monitor.file.empty() || monitor.quantities.empty())
    throw_user_error({reader.who(), "monitor " + monitor.id, "incomplete", "have every, file and quantities",
                      "lbm monitor m every 1e-3 file flow.csv superficial_velocity"});
  for (const QuantityRequest& quantity : monitor.quantities) {
    const QuantityKind* kind = find_quantity(quantity.word);
    if (kind != nullptr && kind->of_layers && monitor.layers.count == 0)
      throw_user_error({reader.who(), quantity.word, "without layers", "come with layers LO HI N",
                        "lbm monitor m every 1e-3 file flow.csv layers 0 0.012 10 layer_gradient"});
  }
}

Command<MonitorRequest> make_monitor_command() {
  using D = Declare<MonitorRequest>;
  Command<MonitorRequest> line{.name = "monitor", .meaning = "a CSV file of time and quantities"};
  line.before = "ID";
  line.after = "QUANTITY ... | ID off";
  line.words = {D::required(D::number(lbm::kEveryWord, [](MonitorRequest& m) -> double& { return m.every; })),
                D::required(D::text(
                    "file", "FILE", [](MonitorRequest& m) -> std::string& { return m.file; }, "CSV")),
                D::choice<int>(
                    "axis", {{"x", 0}, {"y", 1}, {"z", 2}}, [](MonitorRequest& m) -> int& { return m.axis; },
                    "of gradients, layers and the bed"),
                {{"layers", "LO HI N", "m", "", "", "N equal layers between two coordinates along the axis"},
                 [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, MonitorRequest& m) {
                   m.layers = read_layers(reader);
                 }}};
  for (const QuantityKind& kind : quantity_kinds()) line.words.push_back(quantity_word(kind));
  line.words.push_back(relative_word());
  line.other = [](const std::string& word, ArgumentReader& reader, MonitorRequest& m) {
    if (is_reference(word)) m.quantities.push_back(read_reference(reader, word, false));
    return is_reference(word);
  };
  line.other_words = "c_ID[k], f_ID[k], v_NAME [as NAME]";
  line.finish = refuse_incomplete;
  return line;
}

Command<OutputRequest> make_output_command() {
  using D = Declare<OutputRequest>;
  Command<OutputRequest> line{.name = "output", .meaning = "HDF5 files of fields, grains and contacts"};
  line.before = "ID";
  line.after = "FIELD ... [grains] [contacts] | ID off";
  line.words = {D::required(D::number(lbm::kEveryWord, [](OutputRequest& o) -> double& { return o.every; })),
                D::required(D::text(
                    "file", "FILE.h5", [](OutputRequest& o) -> std::string& { return o.file; },
                    "HDF5; FILE.xdmf beside it is for ParaView"))};
  const auto add = [&](const std::string& name, const char* unit, const std::string& meaning, auto take) {
    line.words.push_back({{name, "", unit, "", "", meaning},
                          [take](ArgumentReader&, LAMMPS_NS::LAMMPS*, OutputRequest& o) { take(o); }});
    line.words.back().listed = true;
  };
  for (const lbm::FieldFacts& field : lbm::kFields)
    add(field.word, field.unit, "on the cells",
        [of = field.field](OutputRequest& o) { o.fields.push_back(of); });
  add("grains", "", "FILE_grains.h5: positions, radii, velocities, loads",
      [](OutputRequest& o) { o.grains = true; });
  add("contacts", "", "with the grains, all contacts between them, and FILE_contacts.xdmf",
      [](OutputRequest& o) { o.grains = o.contacts = true; });
  line.begin = [](ArgumentReader&, OutputRequest& o) { o.fields.clear(); };
  line.other = [](const std::string& word, ArgumentReader&, OutputRequest&) { return word == "fields"; };
  line.finish = [](ArgumentReader& reader, const OutputRequest&, OutputRequest& o, const Given&) {
    if (o.every <= 0 || o.file.empty())
      throw_user_error({reader.who(), "output " + o.id, "incomplete", "have every and file",
                        "lbm output o every 1e-2 file bed.h5 velocity pressure solid_fraction grains"});
    if (o.fields.empty()) o.fields = {lbm::Field::velocity, lbm::Field::pressure, lbm::Field::solid_fraction};
    if (std::filesystem::path(o.file).extension() == ".xdmf")
      throw_user_error({reader.who(), "file", o.file, "be the HDF5 file", "FILE.xdmf comes beside FILE.h5"});
  };
  return line;
}

std::optional<double> read_share(ArgumentReader& reader) {
  const std::string given = reader.word("accuracy, such as 3%");
  if (given == "none") return std::nullopt;
  try {
    std::size_t used = 0;
    const double value = std::stod(given, &used);
    const std::string unit = given.substr(used);
    if ((!unit.empty() && unit != "%") || !(value > 0)) throw std::invalid_argument(given);
    return unit.empty() ? value : value / 100;
  } catch (const std::logic_error&) {
    throw_user_error({reader.who(), "accuracy", given, "be a share such as 3% or 0.03, or none", ""});
  }
}

const Command<AccuracyRequest>& accuracy_command() {
  using D = Declare<AccuracyRequest>;
  static const Command<AccuracyRequest> line = [] {
    Command<AccuracyRequest> accuracy{.name = "accuracy", .meaning = "chooses the lattice, in its place"};
    accuracy.only_before_run = true;
    accuracy.first = {{{"accuracy", "SHARE|none", "", "1.4% to 30%", "",
                        "error to be expected; `none`: `lbm lattice` stands as it was written"},
                       [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, AccuracyRequest& a) {
                         a.accuracy = read_share(reader);
                       }}};
    accuracy.words = {
        D::choice<AccuracyOf>(
            "of",
            {{"permeability", AccuracyOf::permeability},
             {"critical_gradient", AccuracyOf::critical_gradient},
             {"forces", AccuracyOf::forces}},
            [](AccuracyRequest& a) -> AccuracyOf& { return a.of; },
            "what is to be that accurate: permeability and speeds, the gradient that lifts a bed, or the "
            "forces on single grains"),
        D::number(lbm::kMaxVelocityWord,
                  [](AccuracyRequest& a) -> std::optional<double>& { return a.largest_velocity; }),
        D::text(
            "region", "ID", [](AccuracyRequest& a) -> std::string& { return a.region; },
            "a block that the water fills instead of the whole box"),
        D::text(
            "write", "FILE", [](AccuracyRequest& a) -> std::string& { return a.file; },
            "script variables of cells and steps, to be included: lattice_spacing (m), lattice_timestep "
            "(s), lattice_sound (m/s)")};
    return accuracy;
  }();
  return line;
}

Word<double> time_word(const char* meaning) {
  return {{"time", "TIME", "s", kPositive.text(), "", meaning},
          [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, double& time) { time = reader.positive("time"); }};
}

const Command<double>& plan_command() {
  static const Command<double> line{
      .name = "plan", .meaning = "what a run would cost; runs nothing", .first = {time_word("of the run")}};
  return line;
}

void read_steady(ArgumentReader& reader, RunLine& run) {
  if (!reader.accept("steady")) reader.unknown(reader.word("condition"), "steady");
  run.steady = reader.positive("share");
  if (*run.steady >= 1)
    throw_user_error({reader.who(), "until steady", fmt::format("{:g}", *run.steady), "be below 1",
                      "it is a share of the flow"});
  if (reader.accept("window")) run.window = reader.positive("window");
}

const Command<RunLine>& run_command() {
  static const Command<RunLine> line{
      .name = "run",
      .meaning = "runs water and grains",
      .first = {{{"time", "[until] TIME", "s", kPositive.text(), "",
                  "so long, or until the water's time is TIME"},
                 [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, RunLine& run) {
                   run.until = reader.accept("until");
                   run.time = reader.positive("time");
                 }}},
      .words = {
          {{"until", "steady SHARE [window T]", "s", "", "",
            "ends once flow and grains change by less than SHARE over T (a twentieth of TIME)"},
           [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, RunLine& run) { read_steady(reader, run); }}}};
  return line;
}

const Command<RestartLine>& restart_command() {
  static const Command<RestartLine> line = [] {
    Command<RestartLine> restart{.name = "restart", .meaning = "states of water and grains"};
    restart.at_least_one = restart.one_of = true;
    restart.words = {{{"write", "FILE [every T]", "s", "", "", "saves a state, now or while runs go"},
                      [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, RestartLine& r) {
                        r.file = reader.word("file");
                        if (reader.accept("every")) r.every = reader.positive("every");
                      }},
                     {{"read", "FILE", "", "", "", "goes on from a state at the next `lbm run`"},
                      [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, RestartLine& r) {
                        r.read = true;
                        r.file = reader.word("file");
                      }}};
    return restart;
  }();
  return line;
}

const Command<WallLimit>& stop_command() {
  static const Command<WallLimit> line = [] {
    Command<WallLimit> stop{.name = "stop", .meaning = "ends a run in order after a time of the clock"};
    stop.at_least_one = true;
    stop.words = {
        {{"after", "TIME", "", "", "", "from the program's start, with its unit: 90min, 2h, 1d"},
         [](ArgumentReader& reader, LAMMPS_NS::LAMMPS*, WallLimit& w) { w = WallLimit::read(reader); },
         true}};
    return stop;
  }();
  return line;
}

template <class Request>
Request read_alone(const Command<Request>& command, ArgumentReader& reader) {
  Request request{};
  read_words(command, reader, nullptr, request);
  return request;
}

}  // namespace

const Command<MonitorRequest>& monitor_command() {
  static const Command<MonitorRequest> line = make_monitor_command();
  return line;
}

const Command<OutputRequest>& output_command() {
  static const Command<OutputRequest> line = make_output_command();
  return line;
}

std::vector<CommandFacts> commands_of_runs() {
  return {facts_of(monitor_command()),
          facts_of(output_command()),
          facts_of(accuracy_command()),
          facts_of(plan_command()),
          facts_of(run_command()),
          facts_of(restart_command()),
          facts_of(stop_command()),
          {"clear", "ends the water; all lines may then be given anew", "lbm clear", {}, {}}};
}

RunLine read_run(ArgumentReader& reader) {
  return read_alone(run_command(), reader);
}
double read_plan(ArgumentReader& reader) {
  return read_alone(plan_command(), reader);
}
AccuracyRequest read_accuracy(ArgumentReader& reader) {
  return read_alone(accuracy_command(), reader);
}
RestartLine read_restart(ArgumentReader& reader) {
  return read_alone(restart_command(), reader);
}
WallLimit read_stop(ArgumentReader& reader) {
  return read_alone(stop_command(), reader);
}
void read_nothing(ArgumentReader& reader) {
  if (!reader.done()) refuse_word(reader, "keyword", reader.word("keyword"), {});
}

}  // namespace suffuse::coupling
