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

/// A stretch of text at the top level: comments above included.
struct Piece {
  std::string text;
  std::string name;  ///< what it defines; empty: always kept
  std::set<std::string> uses;
};

/// The names in a text, comments left out.
std::set<std::string> names_in(std::string_view text) {
  std::set<std::string> names;
  for (std::size_t k = 0; k < text.size();) {
    if (text.substr(k, 2) == "//") {
      k = std::min(text.find('\n', k), text.size());
    } else if (is_word(text[k])) {
      std::size_t end = k;
      while (end < text.size() && is_word(text[end])) ++end;
      names.emplace(text.substr(k, end - k));
      k = end;
    } else {
      ++k;
    }
  }
  return names;
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

/// The name that a declaration defines; "" for what is kept in any case.
std::string defined_name(std::string_view code) {
  if (code.rfind("uniform", 0) == 0 || code.rfind("precision", 0) == 0 ||
      code.rfind("out ", 0) == 0 || code.rfind("in ", 0) == 0)
    return "";
  if (code.rfind("struct", 0) == 0) return word_at(code, 6);
  const std::size_t open = code.find('(');
  const std::size_t equals = code.find('=');
  if (equals != std::string_view::npos && equals < open) {
    const std::size_t bracket = code.find('[');
    return last_word(code.substr(0, std::min(bracket, equals)));
  }
  return open == std::string_view::npos ? "" : last_word(code.substr(0, open));
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
    if (!comment_.empty()) pieces_.push_back({comment_ + "\n", "", {}});
    comment_.clear();
  }

  /// Directives belong to no declaration; a #define has a name.
  void directive() {
    const std::string line = take_line();
    Piece piece{comment_ + line, "", {}};
    comment_.clear();
    piece.uses = names_in(line);
    if (line.rfind("#define", 0) == 0 && depth_ == 0) piece.name = word_at(line, 7);
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
    Piece piece{comment_ + code + "\n", defined_name(code), names_in(code)};
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
  std::multimap<std::string, const Piece*> by_name;
  std::set<std::string> reached{std::string(root)};
  std::vector<std::string> open{std::string(root)};
  const auto reach = [&](const Piece& piece) {
    for (const std::string& name : piece.uses)
      if (reached.insert(name).second) open.push_back(name);
  };
  for (const Piece& piece : pieces) {
    if (!piece.name.empty())
      by_name.emplace(piece.name, &piece);
    else
      reach(piece);
  }
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    const auto [first, last] = by_name.equal_range(name);
    for (auto k = first; k != last; ++k) reach(*k->second);
  }
  std::string out;
  bool gap = false;
  for (const Piece& piece : pieces) {
    if (!piece.name.empty() && reached.find(piece.name) == reached.end()) continue;
    const bool line = piece.text[0] == '#' || piece.text.find('\n') + 1 == piece.text.size();
    if (!out.empty() && (!line || gap) && !out.ends_with("\n\n")) out += "\n";
    out += piece.text;
    gap = !line;
  }
  return out;
}

}  // namespace wold
