#pragma once
// From TOML nodes to values, with their places in the file.

#include <string>

#include "base/error.hpp"
#include "base/parameters.hpp"
#include "base/value.hpp"

#define TOML_HEADER_ONLY 0
#include <toml++/toml.h>

namespace wold {

/// Where a node or a key stands.
SourceLocation location_of(const toml::source_region& region);
/// Where a key stands; of one that `override_value` made, the override.
SourceLocation key_location(const toml::key& key, const toml::node& node);

/// The value of a node. Throws Error(input) for what no parameter can be (mixed arrays, nested
/// tables).
Value value_of(const toml::node& node);

/// Sets every parameter that the table names, except the keys in `skip`. Throws Error(input).
void assign_all(const ParameterSet& set, void* object, const toml::table& table,
                std::span<const std::string> skip = {});

/// Reads text as TOML. `source` stands in error messages. Throws Error(input) with line and column.
toml::table parse_toml(const std::string& text, const std::string& source);

/// Replaces or adds the value at a dotted path such as `terrain.size`, `terrain.step.0.height`,
/// `terrain.step.ridged.height` or `species.birch.height`: an element of an array of tables is
/// named by number, `name` or `op`. `assignment` is "path=value", the value TOML or, failing that,
/// a text. Throws Error(usage).
void override_value(toml::table& root, const std::string& assignment);

}  // namespace wold
