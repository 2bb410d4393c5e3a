#include "mesh/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <iterator>
#include <map>
#include <optional>

#include "base/error.hpp"
#include "mesh/parts.hpp"

namespace wold {

namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

constexpr std::array<std::size_t, 8> type_sizes{1, 1, 2, 2, 4, 4, 4, 8};

std::optional<Type> type_named(std::string_view name) {
  static const std::map<std::string_view, Type> types{
      {"char", Type::int8},      {"int8", Type::int8},       {"uchar", Type::uint8},
      {"uint8", Type::uint8},    {"short", Type::int16},     {"int16", Type::int16},
      {"ushort", Type::uint16},  {"uint16", Type::uint16},   {"int", Type::int32},
      {"int32", Type::int32},    {"uint", Type::uint32},     {"uint32", Type::uint32},
      {"float", Type::float32},  {"float32", Type::float32}, {"double", Type::float64},
      {"float64", Type::float64}};
  const auto found = types.find(name);
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

struct Property {
  std::string name;
  Type type = Type::float32;
  std::optional<Type> count_type;  // of a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};

enum class Format { ascii, little, big };

/// The bytes of a file, taken from the front.
class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& file) : bytes_(bytes), where_{file, 0, 0} {}

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorKind::input, message, where_);
  }

  std::string_view line() {
    if (bytes_.empty()) fail("the file ends too early");
    ++where_.line;
    const auto end = std::min(bytes_.find('\n'), bytes_.size());
    std::string_view text = bytes_.substr(0, end);
    bytes_.remove_prefix(std::min(end + 1, bytes_.size()));
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    return text;
  }

  std::string_view word() {
    while (!bytes_.empty() && is_blank(bytes_.front())) {
      if (bytes_.front() == '\n') ++where_.line;
      bytes_.remove_prefix(1);
    }
    std::size_t size = 0;
    while (size < bytes_.size() && !is_blank(bytes_[size])) ++size;
    if (size == 0) fail("the file ends too early");
    const std::string_view text = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return text;
  }

  void begin_data(Format format) {
    format_ = format;
    if (format == Format::ascii)
      ++where_.line;
    else
      where_.line = 0;  // bytes have no lines
  }

  double number(Type type) {
    if (format_ == Format::ascii) return text_number();
    const std::size_t size = type_sizes[static_cast<std::size_t>(type)];
    if (bytes_.size() < size) fail("the file ends too early");
    std::array<char, 8> raw{};
    constexpr bool host_is_little = std::endian::native == std::endian::little;
    const bool turned = (format_ == Format::little) != host_is_little;
    for (std::size_t k = 0; k < size; ++k) raw[turned ? size - 1 - k : k] = bytes_[k];
    bytes_.remove_prefix(size);
    switch (type) {
      case Type::int8: return as<std::int8_t>(raw);
      case Type::uint8: return as<std::uint8_t>(raw);
      case Type::int16: return as<std::int16_t>(raw);
      case Type::uint16: return as<std::uint16_t>(raw);
      case Type::int32: return as<std::int32_t>(raw);
      case Type::uint32: return as<std::uint32_t>(raw);
      case Type::float32: return static_cast<double>(as<float>(raw));
      case Type::float64: return as<double>(raw);
    }
    return 0;
  }

  std::size_t bytes_left() const { return bytes_.size(); }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

  template <class T>
  static T as(const std::array<char, 8>& raw) {
    T value{};
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }

  double text_number() {
    const std::string_view text = word();
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc::invalid_argument || end != text.data() + text.size())
      fail(fmt::format("'{}' is not a number", text));
    return value;
  }

  std::string_view bytes_;
  SourceLocation where_;
  Format format_ = Format::ascii;
};

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const auto first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos) return words;
    line.remove_prefix(first);
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

class PlyParser {
 public:
  PlyParser(std::string_view bytes, const std::string& file) : reader_(bytes, file) {}

  TriangleMesh parse() {
    header();
    for (const Element& element : elements_) read(element);
    for (const UVec3& t : triangles_) {
      const auto count = static_cast<std::uint32_t>(mesh_.positions.size());
      if (t.x >= count || t.y >= count || t.z >= count)
        reader_.fail(fmt::format("a face refers to vertex {}, but there are {} (counted from 0)",
                                 std::max({t.x, t.y, t.z}), count));
    }
    parts_.finish(mesh_);
    return std::move(mesh_);
  }

 private:
  void header() {
    if (reader_.line() != "ply") reader_.fail("a PLY file begins with the line 'ply'");
    std::optional<Format> format;
    for (;;) {
      const std::string_view line = reader_.line();
      const auto words = words_of(line);
      if (words.empty() || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (words[0] == "comment") {
        comment(words, line);
      } else if (words[0] == "format" && words.size() >= 2) {
        format = format_named(words[1]);
      } else if (words[0] == "element" && words.size() == 3) {
        elements_.push_back({std::string(words[1]), whole_number(words[2]), {}});
      } else if (words[0] == "property" && words.size() >= 3 && !elements_.empty()) {
        elements_.back().properties.push_back(property(words));
      } else {
        reader_.fail(fmt::format("'{}' is not a line of a PLY header", line.substr(0, 40)));
      }
    }
    if (!format) reader_.fail("the header names no format");
    reader_.begin_data(*format);
  }

  void comment(const std::vector<std::string_view>& words, std::string_view line) {
    if (words.size() < 4 || words[1] != "material") return;
    const auto name = static_cast<std::size_t>(words[3].data() - line.data());
    materials_[static_cast<long long>(whole_number(words[2]))] = std::string(line.substr(name));
  }

  Format format_named(std::string_view name) const {
    if (name == "ascii") return Format::ascii;
    if (name == "binary_little_endian") return Format::little;
    if (name == "binary_big_endian") return Format::big;
    reader_.fail(fmt::format(
        "unknown format '{}'; known are ascii, binary_little_endian, binary_big_endian", name));
  }

  std::uint64_t whole_number(std::string_view word) const {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || value > 0xffffffffU)
      reader_.fail(fmt::format("'{}' is not a number of things", word));
    return value;
  }

  Property property(const std::vector<std::string_view>& words) const {
    const bool list = words[1] == "list";
    if (words.size() != (list ? 5U : 3U)) reader_.fail("a property has a type and a name");
    const auto type = [&](std::string_view name) {
      const auto known = type_named(name);
      if (!known) reader_.fail(fmt::format("unknown type '{}'", name));
      return *known;
    };
    Property p;
    p.name = std::string(words.back());
    if (list) p.count_type = type(words[2]);
    p.type = type(words[list ? 3 : 1]);
    return p;
  }

  void read(const Element& element) {
    // Every thing takes at least a byte: a count that lies must not cost memory.
    if (element.count > reader_.bytes_left() && !element.properties.empty())
      reader_.fail(fmt::format("{} of element '{}' are announced, but the file ends too early",
                               element.count, element.name));
    if (element.properties.empty()) return;
    if (element.name == "vertex") return vertices(element);
    for (std::uint64_t k = 0; k < element.count; ++k) {
      if (element.name == "face")
        face(element);
      else
        for (const Property& p : element.properties) skip(p);
    }
  }

  void skip(const Property& p) {
    const std::size_t count = p.count_type ? list_size(p) : 1;
    for (std::size_t k = 0; k < count; ++k) reader_.number(p.type);
  }

  std::size_t list_size(const Property& p) {
    const double count = reader_.number(*p.count_type);
    if (!(count >= 0) || count > static_cast<double>(reader_.bytes_left()))
      reader_.fail(fmt::format("a list of {} numbers, but the file ends too early", count));
    return static_cast<std::size_t>(count);
  }

  void vertices(const Element& element) {
    enum Slot { x, y, z, nx, ny, nz, u, v, slots };
    static const std::map<std::string_view, Slot> names{
        {"x", x}, {"y", y}, {"z", z}, {"nx", nx},       {"ny", ny},       {"nz", nz},
        {"u", u}, {"v", v}, {"s", u}, {"texture_u", u}, {"texture_v", v}, {"t", v}};
    std::array<bool, slots> has{};
    for (const Property& p : element.properties)
      if (const auto slot = names.find(p.name); slot != names.end()) has[slot->second] = true;
    if (!has[x] || !has[y] || !has[z]) reader_.fail("the vertices have no x, y and z");
    for (std::uint64_t k = 0; k < element.count; ++k) {
      std::array<float, slots> values{};
      for (const Property& p : element.properties) {
        const auto slot = names.find(p.name);
        if (slot == names.end() || p.count_type)
          skip(p);
        else
          values[slot->second] = static_cast<float>(reader_.number(p.type));
      }
      mesh_.positions.emplace_back(values[x], values[y], values[z]);
      if (has[nx] && has[ny] && has[nz])
        mesh_.normals.emplace_back(values[nx], values[ny], values[nz]);
      if (has[u] && has[v]) mesh_.uvs.emplace_back(values[u], values[v]);
    }
  }

  void face(const Element& element) {
    corners_.clear();
    long long material = -1;
    for (const Property& p : element.properties) {
      if (p.count_type && (p.name == "vertex_indices" || p.name == "vertex_index")) {
        const std::size_t count = list_size(p);
        for (std::size_t k = 0; k < count; ++k) corners_.push_back(vertex_index(p));
      } else if (p.name == "material_index" && !p.count_type) {
        material = static_cast<long long>(std::clamp(reader_.number(p.type), -1.0, 4e9));
      } else {
        skip(p);
      }
    }
    const auto name = materials_.find(material);
    if (material != material_ || triangles_.empty())
      parts_.use_material(name == materials_.end() ? "" : name->second);
    material_ = material;
    for (std::size_t k = 2; k < corners_.size(); ++k) {
      triangles_.emplace_back(corners_[0], corners_[k - 1], corners_[k]);
      parts_.add(triangles_.back());
    }
  }

  std::uint32_t vertex_index(const Property& p) {
    const double index = reader_.number(p.type);
    if (!(index >= 0 && index < 4294967295.0))
      reader_.fail(fmt::format("a face refers to vertex {}", index));
    return static_cast<std::uint32_t>(index);
  }

  PlyReader reader_;
  std::vector<Element> elements_;
  std::map<long long, std::string> materials_;
  TriangleMesh mesh_;
  std::vector<UVec3> triangles_;  // kept until the vertices are known: elements come in any order
  PartCollector parts_;
  std::vector<std::uint32_t> corners_;
  long long material_ = -1;
};

template <class T>
void append(std::string& bytes, const T& value) {
  static_assert(std::endian::native == std::endian::little);
  std::array<char, sizeof(T)> raw{};
  std::memcpy(raw.data(), &value, sizeof(T));
  bytes.append(raw.data(), raw.size());
}

std::string ply_header(const TriangleMesh& mesh, const std::vector<MeshPart>& parts) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment wold: metres, Z up\n";
  for (std::size_t k = 0; k < parts.size(); ++k)
    if (!parts[k].material.empty())
      text += fmt::format("comment material {} {}\n", k, parts[k].material);
  text += fmt::format("element vertex {}\n", mesh.positions.size());
  for (const char* name : {"x", "y", "z"}) text += fmt::format("property float {}\n", name);
  if (!mesh.normals.empty())
    for (const char* name : {"nx", "ny", "nz"}) text += fmt::format("property float {}\n", name);
  if (!mesh.uvs.empty())
    for (const char* name : {"u", "v"}) text += fmt::format("property float {}\n", name);
  text += fmt::format(
      "element face {}\nproperty list uchar int vertex_indices\nproperty int material_index\n"
      "end_header\n",
      mesh.triangles.size());
  return text;
}

}  // namespace

std::string ply_bytes(const TriangleMesh& mesh) {
  check_mesh(mesh);
  const std::vector<MeshPart> parts = all_parts(mesh);
  std::string bytes = ply_header(mesh, parts);
  bytes.reserve(bytes.size() + mesh.positions.size() * 32 + mesh.triangles.size() * 17);
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    append(bytes, mesh.positions[k]);
    if (!mesh.normals.empty()) append(bytes, mesh.normals[k]);
    if (!mesh.uvs.empty()) append(bytes, mesh.uvs[k]);
  }
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (std::uint32_t t = 0; t < parts[k].triangle_count; ++t) {
      append(bytes, std::uint8_t{3});
      append(bytes, mesh.triangles[parts[k].first_triangle + t]);
      append(bytes, static_cast<std::int32_t>(k));
    }
  return bytes;
}

TriangleMesh parse_ply(std::string_view bytes, const std::string& file) {
  return PlyParser(bytes, file).parse();
}

}  // namespace wold
