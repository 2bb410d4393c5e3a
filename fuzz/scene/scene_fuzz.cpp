#include "../fuzzing.hpp"
#include "scene/scene.hpp"

// Behind a zero byte stands a value from the command line, "path=value".
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace wold;
  const std::string all(fuzzing::text_of(data, size));
  const auto end = all.find('\0');
  std::vector<std::string> overrides;
  if (end != std::string::npos) overrides.push_back(all.substr(end + 1));
  fuzzing::accepts([&] { parse_scene(all.substr(0, end), "fuzz.toml", {}, overrides); });
  return 0;
}
