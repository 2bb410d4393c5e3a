#include "view/controls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/error.hpp"

namespace wold {
namespace {

std::vector<std::string> words(std::string_view text) {
  std::vector<std::string> list(1);
  for (const char c : text) {
    if (c == ' ')
      list.emplace_back();
    else
      list.back() += c;
  }
  return list;
}

TEST(Controls, EveryActionHasOneRowAndANameOfItsOwn) {
  std::set<std::string_view> names;
  for (const Control& control : all_controls())
    EXPECT_TRUE(names.insert(control.name).second) << control.name;
  for (int k = 1; k < static_cast<int>(Action::count); ++k) {
    const Control& row = control_of(static_cast<Action>(k));
    EXPECT_EQ(parse_action(row.name), row.action);
  }
}

TEST(Controls, KeysAreKnownAndDoOneThing) {
  std::set<std::string> seen;
  for (const Control& control : all_controls()) {
    if (control.action == Action::none) continue;
    for (const std::string& key : words(control.keys)) {
      EXPECT_TRUE(seen.insert(key).second) << key << " does two things";
      const bool ctrl = key.starts_with("Ctrl+");
      const std::string plain = ctrl ? key.substr(5) : key;
      EXPECT_TRUE(std::count(key_names().begin(), key_names().end(), plain)) << plain;
      EXPECT_EQ(action_of(plain, ctrl), control.action);
    }
  }
  EXPECT_EQ(action_of("Z", false), Action::zoom);
  EXPECT_EQ(action_of("Z", true), Action::undo);
  EXPECT_EQ(action_of("W", true), Action::none);
}

TEST(Controls, TheHelpTellsOfEveryRow) {
  const std::string help = controls_help();
  const std::string page = controls_markdown();
  for (const Control& control : all_controls()) {
    EXPECT_NE(help.find(control.text), std::string::npos);
    EXPECT_NE(page.find(control.text), std::string::npos);
  }
  EXPECT_NE(help.find("W or Up"), std::string::npos);
  EXPECT_NE(help.find("Page Up"), std::string::npos);
}

TEST(Controls, AWrongNameIsToldTheNearest) {
  try {
    parse_action("forwrd");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.message().find("'forward'"), std::string::npos) << error.message();
  }
}

}  // namespace
}  // namespace wold
