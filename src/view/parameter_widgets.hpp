#pragma once
// One parameter as a widget of Dear ImGui.

#include <optional>

#include "base/parameters.hpp"

namespace wold {

/// Draws the widget that suits the parameter, as wide as there is room, and returns the new value
/// if the user changed it. `usual` is the value that an open slider is made for.
std::optional<Value> edit_parameter(const Parameter& parameter, const Value& value,
                                    const Value& usual);

/// "soil_color1" as people write it: "Soil color 1".
std::string title_of(std::string_view name);

/// "a, b, c": a list as it is typed, and back. Throws Error(input) for what is no number.
std::string list_text(const std::vector<double>& numbers);
std::vector<double> parse_list(std::string_view text);

/// Of a moment, hours since midnight, and with another hour.
double hour_of(const DateTime& time);
DateTime with_hour(DateTime time, double hour);

}  // namespace wold
