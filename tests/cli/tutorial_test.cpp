// The tutorial, followed line by line: its files are written, its commands are run.

#include <gtest/gtest.h>

#include <sstream>

#include "image/atomic_file.hpp"
#include "process.hpp"

namespace wold {
namespace {

using testing::Outcome;
using testing::Workplace;

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// A file of the tutorial begins with a comment that is its name.
void write_file_of(const std::string& block, const Workplace& place) {
  const std::string name = block.substr(2, block.find('\n') - 2);
  place.write(name, block);
}

void run_commands_of(const std::string& block, const Workplace& place) {
  std::istringstream in(block);
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> words = words_of(line);
    ASSERT_EQ(words.at(0), "wold") << line;
    words.erase(words.begin());
    const Outcome outcome = place.run(words);
    EXPECT_EQ(outcome.exit_code, 0) << line << '\n' << outcome.err;
  }
}

TEST(Tutorial, WorksLineByLine) {
  const Workplace place;
  std::istringstream tutorial(read_file(WOLD_SOURCE_DIR "/docs/tutorial.md"));
  std::string kind;
  std::string block;
  int commands = 0;
  for (std::string line; std::getline(tutorial, line);) {
    if (!line.starts_with("```")) {
      if (!kind.empty()) block += line + "\n";
      continue;
    }
    if (kind == "toml") write_file_of(block, place);
    if (kind == "sh") {
      ++commands;
      run_commands_of(block, place);
    }
    kind = kind.empty() ? line.substr(3) : "";
    block.clear();
  }
  EXPECT_GE(commands, 5);
  for (const char* made : {"draft.png", "other.png", "hazy.png", "draft2.png", "range.png",
                           "eroded.exr", "plots/spectrum.png", "island.raw"})
    EXPECT_TRUE(place.has(made)) << made;
}

}  // namespace
}  // namespace wold
