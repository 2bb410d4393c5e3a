#pragma once
// page.html, built into the library.

#include <string_view>

namespace wold {

/// With %%TITLE%%, %%FRAGMENT%% and %%SCENE%% to be filled in.
std::string_view page_template();

}  // namespace wold
