#include <fmt/format.h>

#include <array>
#include <cmath>
#include <set>

#include "plants/expression_parser.hpp"
#include "plants/grammar_parser.hpp"
#include "plants/plant.hpp"
#include "plants/statement.hpp"

namespace wold {

namespace {

/// The settings that belong to the plant itself.
Description<Plant> describe_plant() {
  return Description<Plant>("plant", "A plant.")
      .add("iterations", &Plant::iterations, {.min = 0, .max = 10000}, "Derivation steps.")
      .add("height", &Plant::height, {.unit = "m", .min = 0, .max = 1e6},
           "Height of a model; 0: as the turtle draws it.");
}

Description<PlantMaterial> describe(const PlantMaterial&) {
  return Description<PlantMaterial>("material", "How a material looks.")
      .add("reflectance", &PlantMaterial::reflectance, {.min = 0, .max = 1},
           "Diffuse albedo, linear Rec. 709.")
      .add("transmittance", &PlantMaterial::transmittance, {.min = 0, .max = 1},
           "Diffuse albedo through to the other side.")
      .add("roughness", &PlantMaterial::roughness, {.min = 0, .max = 1},
           "Of a dielectric coat; 0 for none.");
}

class PlantParser {
 public:
  Plant parse(std::string_view text, const std::string& file) {
    for (const Statement& statement : split_statements(text, file)) {
      StatementReader reader(statement);
      parse_statement(reader);
      if (!reader.at_end()) reader.fail_expected("the end of the line");
    }
    if (!grammar_.has_axiom())
      throw Error(ErrorKind::input, "this plant has no axiom; expected a line 'axiom: WORD'",
                  {file, 0, 0});
    plant_.system = grammar_.take();
    return std::move(plant_);
  }

 private:
  void parse_statement(StatementReader& reader) {
    reader.accept("#");
    const std::size_t begin = reader.offset();
    const std::string name = reader.accept_name();
    if (name == "axiom") return grammar_.axiom(reader);
    if (name == "ignore") return grammar_.ignore(reader);
    if (name == "define") return grammar_.define(reader);
    const char next = reader.peek();
    const bool arrow =
        next == '-' && (reader.rest().starts_with("->") || reader.rest().starts_with("-->"));
    if (name.size() < 2 || arrow || std::string_view(":<>([").find(next) != std::string::npos) {
      reader.rewind(begin);
      return grammar_.production(reader);
    }
    if (name == "organ") return organ(reader);
    if (name == "material") return material(reader);
    setting(reader, name, begin);
  }

  /// "angle 22.5" or "angle = 22.5".
  void setting(StatementReader& reader, const std::string& name, std::size_t begin) {
    const ParameterSet plant = describe_plant();
    const ParameterSet turtle = describe(plant_.turtle);
    const ParameterSet geometry = describe(plant_.geometry);
    const std::array<std::pair<const ParameterSet*, void*>, 3> sets{
        {{&plant, &plant_}, {&turtle, &plant_.turtle}, {&geometry, &plant_.geometry}}};
    std::vector<std::string> known{"axiom", "ignore", "define", "organ", "material"};
    for (const auto& [set, object] : sets) {
      if (const Parameter* p = set->find(name)) {
        if (!seen_.insert(name).second)
          throw Error(ErrorKind::input, fmt::format("'{}' is set twice", name),
                      reader.location(begin));
        reader.accept("=");
        return assign(reader, *set, object, *p);
      }
      for (const std::string& other : set->names()) known.push_back(other);
    }
    throw Error(ErrorKind::input,
                fmt::format("unknown setting '{}'.{}", name, suggestion(name, known)),
                reader.location(begin));
  }

  void organ(StatementReader& reader) {
    const SourceLocation where = reader.location();
    const std::string name = reader.take_word();
    if (name.size() != 1) {
      throw Error(ErrorKind::input,
                  fmt::format("expected one letter, the name of an organ, found '{}'", name),
                  where);
    }
    Organ o;
    o.name = name[0];
    const ParameterSet set = describe(o);
    while (!reader.at_end()) keyword(reader, set, &o);
    plant_.organs.push_back(o);
  }

  void material(StatementReader& reader) {
    PlantMaterial m;
    m.name = reader.accept_name();
    if (m.name.empty()) reader.fail_expected("the name of a material");
    const ParameterSet set = describe(m);
    while (!reader.at_end()) keyword(reader, set, &m);
    plant_.materials.push_back(m);
  }

  /// One of "length 0.05 width 0.6 …".
  void keyword(StatementReader& reader, const ParameterSet& set, void* object) {
    const SourceLocation where = reader.location();
    const std::string name = reader.accept_name();
    if (name.empty()) reader.fail_expected("the name of a setting");
    const Parameter* p = set.find(name);
    if (p == nullptr)
      throw Error(ErrorKind::input,
                  fmt::format("unknown setting '{}' of '{}'.{}", name, set.name,
                              suggestion(name, set.names())),
                  where);
    assign(reader, set, object, *p);
  }

  void assign(StatementReader& reader, const ParameterSet& set, void* object, const Parameter& p) {
    const SourceLocation where = reader.location();
    if (reader.at_end()) reader.fail_expected("a value");
    set.assign(object, p.name, value(reader, p), where);
  }

  static Value value(StatementReader& reader, const Parameter& p) {
    switch (p.kind) {
      case ParameterKind::boolean: {
        if (reader.accept("true")) return true;
        if (reader.accept("false")) return false;
        reader.fail_expected("true or false");
      }
      case ParameterKind::text:
      case ParameterKind::choice: return reader.take_word();
      case ParameterKind::texts: {
        std::vector<std::string> words;
        while (!reader.at_end()) words.push_back(reader.take_word());
        return words;
      }
      case ParameterKind::numbers: {
        std::vector<double> list;
        do list.push_back(number(reader));
        while (reader.accept(","));
        return list;
      }
      default: break;
    }
    const double x = number(reader);
    if (p.kind == ParameterKind::integer && x == std::floor(x) && std::abs(x) < 1e15)
      return static_cast<std::int64_t>(x);
    return x;
  }

  static double number(StatementReader& reader) {
    return parse_expression(reader, {}).evaluate({});
  }

  Plant plant_;
  GrammarParser grammar_;
  std::set<std::string> seen_;
};

}  // namespace

Plant parse_plant(std::string_view text, const std::string& file) {
  return PlantParser().parse(text, file);
}

}  // namespace wold
