#include "realtime/shader_strip.hpp"

#include <cctype>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace wold {

namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// A name, and with how many arguments it is called or defined: functions of the same name differ
/// in that. Without, for what is no function.
using Use = std::pair<std::string, int>;
constexpr int no_call = -1;

/// A stretch of text at the top level: comments above included.
struct Piece {
  std::string text;
  Use defines = {"", no_call};  ///< no name: always kept
  std::set<Use> uses = {};
};

std::string without_comments(std::string_view text) {
  std::string out;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text.substr(k, 2) == "//") k = std::min(text.find('\n', k), text.size() - 1);
    out += text[k];
  }
  return out;
}

/// Arguments of the call whose bracket opens at `open`.
int arguments_at(std::string_view code, std::size_t open) {
  int depth = 0;
  int commas = 0;
  bool empty = true;
  for (std::size_t k = open; k < code.size(); ++k) {
    const char c = code[k];
    if (c == '(' || c == '[') ++depth;
    if (c == ')' || c == ']') --depth;
    if (depth == 0) break;
    if (c == ',' && depth == 1) ++commas;
    if (k > open && std::isspace(static_cast<unsigned char>(c)) == 0) empty = false;
  }
  return empty ? 0 : commas + 1;
}

/// The names in a text, comments left out. What is called counts as used both ways: it may be a
/// function, or a struct, an array's type or a macro.
std::set<Use> uses_in(std::string_view text) {
  const std::string code = without_comments(text);
  std::set<Use> uses;
  for (std::size_t k = 0; k < code.size();) {
    if (!is_word(code[k])) {
      ++k;
      continue;
    }
    std::size_t end = k;
    while (end < code.size() && is_word(code[end])) ++end;
    const std::string name = code.substr(k, end - k);
    uses.emplace(name, no_call);
    k = end;
    while (k < code.size() && std::isspace(static_cast<unsigned char>(code[k])) != 0) ++k;
    if (k < code.size() && code[k] == '(') uses.emplace(name, arguments_at(code, k));
  }
  return uses;
}

std::string last_word(std::string_view text) {
  std::size_t end = text.size();
  while (end > 0 && !is_word(text[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && is_word(text[begin - 1])) --begin;
  return std::string(text.substr(begin, end - begin));
}

std::string word_at(std::string_view text, std::size_t k) {
  while (k < text.size() && !is_word(text[k])) ++k;
  std::size_t end = k;
  while (end < text.size() && is_word(text[end])) ++end;
  return std::string(text.substr(k, end - k));
}

/// What a declaration defines; no name for what is kept in any case.
Use definition(std::string_view code) {
  if (code.rfind("uniform", 0) == 0 || code.rfind("precision", 0) == 0 ||
      code.rfind("out ", 0) == 0 || code.rfind("in ", 0) == 0)
    return {"", no_call};
  if (code.rfind("struct", 0) == 0) return {word_at(code, 6), no_call};
  const std::size_t open = code.find('(');
  const std::size_t equals = code.find('=');
  if (equals != std::string_view::npos && equals < open) {
    const std::size_t bracket = code.find('[');
    return {last_word(code.substr(0, std::min(bracket, equals))), no_call};
  }
  if (open == std::string_view::npos) return {"", no_call};
  return {last_word(code.substr(0, open)), arguments_at(code, open)};
}

class Splitter {
 public:
  explicit Splitter(std::string_view text) : text_(text) {}

  std::vector<Piece> run() {
    while (at_ < text_.size()) {
      const std::string_view rest = text_.substr(at_);
      if (rest[0] == '\n') {
        if (!comment_.empty()) flush_comment();
        ++at_;
      } else if (rest.rfind("//", 0) == 0) {
        comment_ += take_line();
      } else if (rest[0] == '#') {
        directive();
      } else {
        declaration();
      }
    }
    flush_comment();
    return std::move(pieces_);
  }

 private:
  std::string take_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size() - 1);
    std::string line(text_.substr(at_, end + 1 - at_));
    at_ = end + 1;
    return line;
  }

  void flush_comment() {
    if (!comment_.empty()) pieces_.push_back({comment_ + "\n"});
    comment_.clear();
  }

  /// Directives belong to no declaration; a #define has a name.
  void directive() {
    const std::string line = take_line();
    Piece piece{comment_ + line};
    comment_.clear();
    piece.uses = uses_in(line);
    if (line.rfind("#define", 0) == 0 && depth_ == 0) piece.defines.first = word_at(line, 7);
    if (line.rfind("#if", 0) == 0) ++depth_;
    if (line.rfind("#endif", 0) == 0) --depth_;
    pieces_.push_back(std::move(piece));
  }

  void declaration() {
    const std::size_t begin = at_;
    int braces = 0;
    bool body = false;
    for (; at_ < text_.size(); ++at_) {
      if (text_.substr(at_, 2) == "//") at_ = std::min(text_.find('\n', at_), text_.size() - 1);
      const char c = text_[at_];
      if (c == '{') {
        ++braces;
        body = true;
      }
      if (c == '}') --braces;
      if (braces > 0) continue;
      const bool is_struct = text_.substr(begin, 6) == "struct";
      if (c == ';' || (c == '}' && body && !is_struct)) break;
    }
    ++at_;
    std::string code(text_.substr(begin, at_ - begin));
    if (at_ < text_.size() && text_[at_] == '\n') ++at_;
    Piece piece{comment_ + code + "\n", definition(without_comments(code)), uses_in(code)};
    comment_.clear();
    pieces_.push_back(std::move(piece));
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::string comment_;
  std::vector<Piece> pieces_;
};

}  // namespace

std::string stripped_shader(std::string_view text, std::string_view root) {
  const std::vector<Piece> pieces = Splitter(text).run();
  std::multimap<Use, const Piece*> definitions;
  std::set<Use> reached;
  std::vector<Use> open;
  const auto reach = [&](const Use& use) {
    if (reached.insert(use).second) open.push_back(use);
  };
  for (const Piece& piece : pieces) {
    if (piece.defines.first == root) reach(piece.defines);
    if (!piece.defines.first.empty())
      definitions.emplace(piece.defines, &piece);
    else
      for (const Use& use : piece.uses) reach(use);
  }
  while (!open.empty()) {
    const Use use = open.back();
    open.pop_back();
    const auto [first, last] = definitions.equal_range(use);
    for (auto k = first; k != last; ++k)
      for (const Use& inner : k->second->uses) reach(inner);
  }
  std::string out;
  bool gap = false;
  for (const Piece& piece : pieces) {
    if (!piece.defines.first.empty() && reached.find(piece.defines) == reached.end()) continue;
    const bool line = piece.text[0] == '#' || piece.text.find('\n') + 1 == piece.text.size();
    if (!out.empty() && (!line || gap) && !out.ends_with("\n\n")) out += "\n";
    out += piece.text;
    gap = !line;
  }
  return out;
}

}  // namespace wold
