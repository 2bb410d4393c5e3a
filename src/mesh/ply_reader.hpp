#pragma once
// The header of a PLY file and the numbers behind it, one after the other; used by all that reads
// it.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"

namespace wold {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyFormat { ascii, little, big };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count_type;  ///< of a list

  bool is_vertex_list() const {
    return count_type && (name == "vertex_indices" || name == "vertex_index");
  }
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::map<long long, std::string> materials;  ///< comments "material INDEX NAME"
};

std::size_t size_of(PlyType type);
/// The bytes of a number as the file has them.
std::string ply_bytes_of(double value, PlyType type, PlyFormat format);

class PlyReader {
 public:
  PlyReader(std::string_view bytes, const std::string& file)
      : all_(bytes), rest_(bytes), where_{file, 0, 0} {}

  /// Throws Error(input). To be called first.
  const PlyHeader& read_header();

  /// Throws unless the file could hold this element's data: a count that lies must not cost memory.
  void check_count(const PlyElement& element) const;
  /// The next number, of this type.
  double number(PlyType type);
  /// Where in the file the last number stands.
  std::string_view last() const { return last_; }
  /// The length of a list, which comes next.
  std::size_t list_size(const PlyProperty& list);
  /// A vertex' number, which comes next, of a list.
  std::uint32_t vertex_index(const PlyProperty& list);
  void skip(const PlyProperty& property);

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorKind::input, message, where_);
  }

 private:
  std::string_view line();
  std::string_view word();
  void comment(const std::vector<std::string_view>& words, std::string_view line);
  PlyFormat format_named(std::string_view name) const;
  std::uint64_t whole_number(std::string_view word) const;
  PlyProperty property(const std::vector<std::string_view>& words) const;

  std::string_view all_;
  std::string_view rest_;
  std::string_view last_;
  SourceLocation where_;
  PlyHeader header_;
};

}  // namespace wold
