#pragma once
// What a scene gets where its file says nothing: rolling hills and a mixed forest, as TOML.

namespace wold {

/// [[terrain.step]] of a scene without steps.
extern const char* const default_steps;
/// [[species]] and [[scatter]] of a scene without steps and plants.
extern const char* const default_forest;

}  // namespace wold
