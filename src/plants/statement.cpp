#include "plants/statement.hpp"

#include <fmt/format.h>

#include <cctype>

namespace wold {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}
bool is_name_start(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool is_name_part(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Without comment and blanks at the end.
std::string_view strip(std::string_view line) {
  for (std::size_t k = 0; k + 1 < line.size(); ++k) {
    if (line[k] == '/' && line[k + 1] == '/' && (k == 0 || is_blank(line[k - 1]))) {
      line = line.substr(0, k);
      break;
    }
  }
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

}  // namespace

SourceLocation Statement::location(std::size_t offset) const {
  const Piece* piece = &pieces.front();
  for (const Piece& p : pieces)
    if (p.offset <= offset) piece = &p;
  return {file, piece->line, piece->column + static_cast<int>(offset - piece->offset)};
}

std::vector<Statement> split_statements(std::string_view text, const std::string& file) {
  std::vector<Statement> statements;
  int line_number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = strip(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    ++line_number;
    std::size_t indent = 0;
    while (indent < line.size() && is_blank(line[indent])) ++indent;
    line.remove_prefix(indent);
    if (line.empty()) continue;
    if (indent == 0 || statements.empty()) statements.push_back({{}, {}, file});
    Statement& s = statements.back();
    if (!s.text.empty()) s.text += ' ';
    s.pieces.push_back({s.text.size(), line_number, static_cast<int>(indent) + 1});
    s.text += line;
  }
  return statements;
}

std::size_t StatementReader::offset() {
  while (offset_ < statement_->text.size() && is_blank(statement_->text[offset_])) ++offset_;
  return offset_;
}

bool StatementReader::at_end() {
  return offset() >= statement_->text.size();
}

char StatementReader::peek() {
  return at_end() ? '\0' : statement_->text[offset_];
}

char StatementReader::peek_second() {
  return offset() + 1 < statement_->text.size() ? statement_->text[offset_ + 1] : '\0';
}

char StatementReader::take() {
  const char c = peek();
  if (c != '\0') ++offset_;
  return c;
}

bool StatementReader::accept(std::string_view token) {
  if (!std::string_view(statement_->text).substr(offset()).starts_with(token)) return false;
  offset_ += token.size();
  return true;
}

void StatementReader::expect(std::string_view token) {
  if (!accept(token)) fail_expected(fmt::format("'{}'", token));
}

std::string StatementReader::accept_name() {
  if (!is_name_start(peek())) return {};
  const std::size_t begin = offset_;
  while (offset_ < statement_->text.size() && is_name_part(statement_->text[offset_])) ++offset_;
  return statement_->text.substr(begin, offset_ - begin);
}

std::string StatementReader::take_word() {
  const std::size_t begin = offset();
  while (offset_ < statement_->text.size() && !is_blank(statement_->text[offset_])) ++offset_;
  return statement_->text.substr(begin, offset_ - begin);
}

std::string StatementReader::found() {
  if (at_end()) return "the end of the line";
  const std::size_t begin = offset_;
  std::string name = accept_name();
  rewind(begin);
  if (name.empty()) name = std::string(1, peek());
  return fmt::format("'{}'", name);
}

void StatementReader::fail_expected(const std::string& expected) {
  throw Error(ErrorKind::input, fmt::format("expected {}, found {}", expected, found()),
              location());
}

}  // namespace wold
