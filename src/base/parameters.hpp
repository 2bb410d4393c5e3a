#pragma once
// The description of parameters: each operator, scene section or material is a plain struct, and
// one function `describe` that lists each of its members once, with name, unit, range and one line
// of text. Reading from TOML, checking, help, reference pages, schema and interfaces follow from
// it.
//
//   struct Ridged {
//     float height = 900;
//     int octaves = 10;
//   };
//
//   Description<Ridged> describe(const Ridged&) {
//     return Description<Ridged>("ridged", "Mountains with sharp crests.")
//         .add("height", &Ridged::height, {.unit = "m", .min = 0}, "Height of the crests.")
//         .add("octaves", &Ridged::octaves, {.min = 1, .max = 24}, "Number of frequencies.");
//   }

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/value.hpp"
#include "base/vec.hpp"

namespace wold {

enum class ParameterKind {
  boolean,
  integer,
  number,
  text,
  file,     ///< a path, relative to the file that names it
  choice,   ///< one of a few names
  numbers,  ///< a list of numbers (a vector, a range, a size)
  texts,    ///< a list of texts
  date_time,
  weights  ///< names with a weight each
};

/// What a parameter may be. Both ends are allowed values.
struct Limits {
  std::string unit = {};
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// One parameter of a described struct, without its type.
struct Parameter {
  std::string name;
  std::string text;  ///< one sentence
  ParameterKind kind = ParameterKind::number;
  Limits limits;
  int min_items = 0;  ///< of a list
  int max_items = 0;
  bool ascending = false;            ///< a list [low, high]
  std::vector<std::string> choices;  ///< of a choice
  std::function<Value(const void*)> get;
  std::function<void(void*, const Value&)> set;  ///< expects a checked value of the right kind

  /// "m, 0 to 9000", "one of a, b", "2 numbers, degrees, 0 to 90": what is allowed.
  std::string allowed() const;
};

/// All parameters of a described struct, without its type.
struct ParameterSet {
  std::string name;  ///< as users write it: "ridged", "sky"
  std::string text;  ///< one or two sentences
  std::vector<Parameter> parameters;

  const Parameter* find(std::string_view name) const;
  std::vector<std::string> names() const;

  /// Sets one parameter of `object` after checking kind and range; an integer is accepted for a
  /// number and a text for a date. Throws Error(input) that names the parameter, what was given,
  /// what is allowed, and for an unknown name the nearest known one.
  void assign(void* object, std::string_view name, const Value& value,
              const SourceLocation& where = {}) const;

  /// Throws Error(input) as `assign` does if a value of `object` is not what it may be: for structs
  /// that were filled in by a program.
  void check(const void* object) const;
};

/// A range with low <= high, written `[low, high]`.
struct Range {
  float low = 0;
  float high = 0;

  bool contains(float x) const { return x >= low && x <= high; }
  friend bool operator==(const Range&, const Range&) = default;
};

/// A file named in a scene, as written there; resolved against the scene's folder when read.
struct FilePath {
  std::string path;

  bool empty() const { return path.empty(); }
  friend bool operator==(const FilePath&, const FilePath&) = default;
};

namespace detail {

template <class T>
struct ParameterType;  // kind, list length, and conversion to and from Value

template <>
struct ParameterType<bool> {
  static constexpr ParameterKind kind = ParameterKind::boolean;
  static Value get(bool v) { return v; }
  static bool set(const Value& v) { return std::get<bool>(v); }
};

template <class Int, class Stored = std::int64_t>
struct IntegerType {
  static constexpr ParameterKind kind = ParameterKind::integer;
  static Value get(Int v) { return static_cast<Stored>(v); }
  static Int set(const Value& v) { return static_cast<Int>(std::get<Stored>(v)); }
};
template <>
struct ParameterType<int> : IntegerType<int> {};
template <>
struct ParameterType<std::uint32_t> : IntegerType<std::uint32_t> {};
template <>
struct ParameterType<std::uint64_t> : IntegerType<std::uint64_t> {};

template <class Real>
struct NumberType {
  static constexpr ParameterKind kind = ParameterKind::number;
  static Value get(Real v) { return static_cast<double>(v); }
  static Real set(const Value& v) { return static_cast<Real>(std::get<double>(v)); }
};
template <>
struct ParameterType<float> : NumberType<float> {};
template <>
struct ParameterType<double> : NumberType<double> {};

template <>
struct ParameterType<std::string> {
  static constexpr ParameterKind kind = ParameterKind::text;
  static Value get(const std::string& v) { return v; }
  static std::string set(const Value& v) { return std::get<std::string>(v); }
};
template <>
struct ParameterType<FilePath> {
  static constexpr ParameterKind kind = ParameterKind::file;
  static Value get(const FilePath& v) { return v.path; }
  static FilePath set(const Value& v) { return {std::get<std::string>(v)}; }
};
template <>
struct ParameterType<DateTime> {
  static constexpr ParameterKind kind = ParameterKind::date_time;
  static Value get(const DateTime& v) { return v; }
  static DateTime set(const Value& v) { return std::get<DateTime>(v); }
};
template <>
struct ParameterType<Weights> {
  static constexpr ParameterKind kind = ParameterKind::weights;
  static Value get(const Weights& v) { return v; }
  static Weights set(const Value& v) { return std::get<Weights>(v); }
};
template <>
struct ParameterType<std::vector<std::string>> {
  static constexpr ParameterKind kind = ParameterKind::texts;
  static Value get(const std::vector<std::string>& v) { return v; }
  static std::vector<std::string> set(const Value& v) {
    return std::get<std::vector<std::string>>(v);
  }
};

template <class Vector, int count, bool is_range = false>
struct FixedListType {
  static constexpr ParameterKind kind = ParameterKind::numbers;
  static constexpr int items = count;
  static constexpr bool ascending = is_range;
};
template <class Vector, int count>
struct VectorType : FixedListType<Vector, count> {
  static Value get(const Vector& v) {
    std::vector<double> list;
    for (int k = 0; k < count; ++k) list.push_back(static_cast<double>(v[k]));
    return list;
  }
  static Vector set(const Value& value) {
    const auto& list = std::get<std::vector<double>>(value);
    Vector v{};
    using Element = std::remove_reference_t<decltype(v[0])>;
    for (int k = 0; k < count; ++k) v[k] = static_cast<Element>(list[static_cast<std::size_t>(k)]);
    return v;
  }
};
template <>
struct ParameterType<Vec2> : VectorType<Vec2, 2> {};
template <>
struct ParameterType<Vec3> : VectorType<Vec3, 3> {};
template <>
struct ParameterType<DVec2> : VectorType<DVec2, 2> {};
template <>
struct ParameterType<DVec3> : VectorType<DVec3, 3> {};
template <>
struct ParameterType<IVec2> : VectorType<IVec2, 2> {};
template <>
struct ParameterType<Range> : FixedListType<Range, 2, true> {
  static Value get(const Range& v) { return std::vector<double>{v.low, v.high}; }
  static Range set(const Value& value) {
    const auto& list = std::get<std::vector<double>>(value);
    return {static_cast<float>(list[0]), static_cast<float>(list[1])};
  }
};
template <>
struct ParameterType<std::vector<double>> {
  static constexpr ParameterKind kind = ParameterKind::numbers;
  static Value get(const std::vector<double>& v) { return v; }
  static std::vector<double> set(const Value& v) { return std::get<std::vector<double>>(v); }
};

}  // namespace detail

/// A ParameterSet built with the type at hand. Converts to a ParameterSet.
template <class T>
class Description {
 public:
  Description(std::string name, std::string text) {
    set_.name = std::move(name);
    set_.text = std::move(text);
  }

  /// A member and what it may be. `text` is one sentence for help and tooltips.
  template <class Member>
  Description& add(const char* name, Member T::*member, Limits limits, const char* text) {
    using Type = detail::ParameterType<Member>;
    Parameter p;
    p.name = name;
    p.text = text;
    p.kind = Type::kind;
    p.limits = std::move(limits);
    if constexpr (requires { Type::items; }) {
      p.min_items = p.max_items = Type::items;
      p.ascending = Type::ascending;
    }
    p.get = [member](const void* object) {
      return Type::get(static_cast<const T*>(object)->*member);
    };
    p.set = [member](void* object, const Value& value) {
      static_cast<T*>(object)->*member = Type::set(value);
    };
    set_.parameters.push_back(std::move(p));
    return *this;
  }
  template <class Member>
  Description& add(const char* name, Member T::*member, const char* text) {
    return add(name, member, Limits{}, text);
  }

  /// An enumeration whose values 0, 1, 2, … have the given names.
  template <class Enum>
  Description& choice(const char* name, Enum T::*member, const std::vector<std::string>& names,
                      const char* text) {
    Parameter p;
    p.name = name;
    p.text = text;
    p.kind = ParameterKind::choice;
    p.choices = names;
    p.get = [member, names](const void* object) -> Value {
      return names.at(static_cast<std::size_t>(static_cast<const T*>(object)->*member));
    };
    p.set = [member, names](void* object, const Value& value) {
      const auto& chosen = std::get<std::string>(value);
      for (std::size_t k = 0; k < names.size(); ++k)
        if (names[k] == chosen) static_cast<T*>(object)->*member = static_cast<Enum>(k);
    };
    set_.parameters.push_back(std::move(p));
    return *this;
  }

  /// Adds the parameters of a member that is itself described, under their own names.
  template <class Member>
  Description& include(Member T::*member) {
    const ParameterSet inner = describe(Member{});
    for (Parameter p : inner.parameters) {
      p.get = [member, get = p.get](const void* object) {
        return get(&(static_cast<const T*>(object)->*member));
      };
      p.set = [member, set = p.set](void* object, const Value& value) {
        set(&(static_cast<T*>(object)->*member), value);
      };
      set_.parameters.push_back(std::move(p));
    }
    return *this;
  }

  operator const ParameterSet&() const { return set_; }
  const ParameterSet& parameters() const { return set_; }

 private:
  ParameterSet set_;
};

/// A value of some described type, and its description. A value type: copies are independent.
class Described {
 public:
  template <class T>
  static Described of(T value) {
    Described d;
    d.set_ = std::make_shared<const ParameterSet>(describe(value));
    d.data_ = std::make_shared<T>(std::move(value));
    d.copy_ = [](const void* data) -> std::shared_ptr<void> {
      return std::make_shared<T>(*static_cast<const T*>(data));
    };
    return d;
  }
  Described() = default;
  Described(const Described& other)
      : set_(other.set_),
        data_(other.data_ ? other.copy_(other.data_.get()) : nullptr),
        copy_(other.copy_) {}
  Described(Described&&) noexcept = default;
  Described& operator=(Described other) noexcept {
    set_ = std::move(other.set_);
    data_ = std::move(other.data_);
    copy_ = other.copy_;
    return *this;
  }
  ~Described() = default;

  const ParameterSet& parameters() const { return *set_; }
  void* data() { return data_.get(); }
  const void* data() const { return data_.get(); }
  /// The value as its own type, which the caller must know.
  template <class T>
  const T& as() const {
    return *static_cast<const T*>(data());
  }

  void assign(std::string_view name, const Value& value, const SourceLocation& where = {}) {
    set_->assign(data(), name, value, where);
  }

 private:
  std::shared_ptr<const ParameterSet> set_;
  std::shared_ptr<void> data_;
  std::shared_ptr<void> (*copy_)(const void*) = nullptr;
};

/// Help for a terminal: name, text, and a line per parameter with default, unit and range.
std::string help_text(const ParameterSet& set, const void* defaults);

/// The same as a section of a Markdown page, with a table.
std::string reference_markdown(const ParameterSet& set, const void* defaults);

}  // namespace wold
