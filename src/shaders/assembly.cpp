#include "shaders/assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <set>

#include "base/error.hpp"
#include "shaders/library.hpp"

namespace wold {

namespace {

constexpr int deepest_include = 32;

std::string_view trimmed(std::string_view line) {
  const auto first = line.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(" \t\r") + 1 - first);
}

/// The path of a line #include "path".
std::optional<std::string_view> included(std::string_view line) {
  constexpr std::string_view word = "#include";
  line = trimmed(line);
  if (!line.starts_with(word)) return std::nullopt;
  line = trimmed(line.substr(word.size()));
  if (line.size() < 3 || line.front() != '"' || line.back() != '"') return std::nullopt;
  return line.substr(1, line.size() - 2);
}

/// Puts files together, each once.
class Assembler {
 public:
  explicit Assembler(bool numbered) : numbered_(numbered) {}

  void add(std::string_view name, std::string_view body, int depth = 0) {
    const std::size_t number = files_.size();
    files_.emplace_back(name);
    if (numbered_) text_ += fmt::format("#line 1 {}\n", number);
    int line_number = 0;
    while (!body.empty()) {
      const auto end = body.find('\n');
      const std::string_view line = body.substr(0, end);
      body.remove_prefix(end == std::string_view::npos ? body.size() : end + 1);
      ++line_number;
      const std::optional<std::string_view> path = included(line);
      if (!path) {
        text_.append(line).push_back('\n');
        continue;
      }
      include(*path, {std::string(name), line_number, 0}, depth);
      if (numbered_) text_ += fmt::format("#line {} {}\n", line_number + 1, number);
    }
  }

  ShaderText finished(std::string name) && {
    return {std::move(name), std::move(text_), std::move(files_)};
  }
  void begin(std::string head) { text_ = std::move(head); }

 private:
  void include(std::string_view path, const SourceLocation& where, int depth) {
    if (std::find(files_.begin(), files_.end(), path) != files_.end()) return;
    if (depth >= deepest_include)
      throw Error(ErrorKind::internal, "shader files include one another too deeply", where);
    try {
      add(path, shader_file(path), depth + 1);
    } catch (const Error& error) {
      throw error.at(where);
    }
  }

  bool numbered_;
  std::string text_;
  std::vector<std::string> files_;
};

std::string head(ShaderDialect dialect, std::span<const ShaderDefine> defines) {
  std::string text;
  switch (dialect) {
    case ShaderDialect::gl_430: text = "#version 430 core\n"; break;
    case ShaderDialect::gl_330: text = "#version 330 core\n"; break;
    case ShaderDialect::es_300:
      text =
          "#version 300 es\nprecision highp float;\nprecision highp int;\n"
          "precision highp sampler2D;\nprecision highp sampler2DArray;\n"
          "precision highp usampler2D;\n";
      break;
  }
  for (const ShaderDefine& d : defines) text += fmt::format("#define {} {}\n", d.name, d.value);
  return text;
}

/// A number at the beginning of a text, taken off it.
std::optional<int> take_number(std::string_view& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

struct LogPlace {
  int file = 0;
  int line = 0;
};

/// The place that a line of a log speaks of, taken off it: F:L(C): or F(L) : or ERROR: F:L:.
std::optional<LogPlace> take_place(std::string_view& line) {
  std::string_view rest = line;
  for (const std::string_view word : {"ERROR: ", "WARNING: "})
    if (rest.starts_with(word)) rest.remove_prefix(word.size());
  const std::optional<int> file = take_number(rest);
  if (!file || rest.empty()) return std::nullopt;
  const char mark = rest.front();
  if (mark != ':' && mark != '(') return std::nullopt;
  rest.remove_prefix(1);
  const std::optional<int> number = take_number(rest);
  if (!number) return std::nullopt;
  if (mark == ':' && rest.starts_with('('))
    rest.remove_prefix(std::min(rest.find(')'), rest.size() - 1));
  line = rest.substr(std::min(rest.find_first_not_of("): "), rest.size()));
  return LogPlace{*file, *number};
}

}  // namespace

ShaderText assemble_shader_text(std::string name, std::string_view body, ShaderDialect dialect,
                                std::span<const ShaderDefine> defines) {
  Assembler assembler(true);
  assembler.begin(head(dialect, defines));
  assembler.add(name, body);
  return std::move(assembler).finished(std::move(name));
}

ShaderText assemble_shader(std::string_view path, ShaderDialect dialect,
                           std::span<const ShaderDefine> defines) {
  return assemble_shader_text(std::string(path), shader_file(path), dialect, defines);
}

std::string flatten_shader(std::string_view body) {
  Assembler assembler(false);
  assembler.add("", body);
  return std::move(assembler).finished({}).text;
}

std::string readable_shader_log(std::string_view log, const ShaderText& shader) {
  std::string out;
  while (!log.empty()) {
    const auto end = log.find('\n');
    std::string_view line = trimmed(log.substr(0, end));
    log.remove_prefix(end == std::string_view::npos ? log.size() : end + 1);
    if (line.empty() || line.front() == '\0') continue;
    const std::optional<LogPlace> place = take_place(line);
    if (place && place->file >= 0 && place->file < static_cast<int>(shader.files.size()))
      out +=
          fmt::format("{}:{}: ", shader.files[static_cast<std::size_t>(place->file)], place->line);
    out.append(line).push_back('\n');
  }
  while (!out.empty() && out.back() == '\n') out.pop_back();
  return out;
}

}  // namespace wold
