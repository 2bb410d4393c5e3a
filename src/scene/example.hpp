#pragma once
// The text of scenes/forest.toml, built into the library: scenes that say nothing take its land and
// its plants, and `wold new` writes it.

namespace wold {

extern const char* const example_scene;

}  // namespace wold
