// No source file and no function is long: what grows beyond these does more than one thing.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <string>
#include <vector>

#include "tests/testing/sources.h"

namespace {

using namespace sources;

constexpr int kLongestFile = 300;
constexpr int kLongestFunction = 60;

bool is_source(const fs::path& path) {
  return is_cpp(path) || path.extension() == ".glsl" || path.extension() == ".vert" || path.extension() == ".frag" ||
         path.extension() == ".comp";
}

// Where a comment or a literal that begins at `at` ends; `at` itself where none begins there.
std::size_t end_of_quiet(const std::string& text, std::size_t at) {
  const auto after = [&](const std::string& mark, std::size_t from) {
    const std::size_t found = text.find(mark, from);
    return found == std::string::npos ? text.size() : found + mark.size();
  };
  if (text.compare(at, 2, "//") == 0) return std::min(text.find('\n', at), text.size());
  if (text.compare(at, 2, "/*") == 0) return after("*/", at + 2);
  if (text.compare(at, 2, "R\"") == 0) {
    const std::size_t open = text.find('(', at);
    return after(")" + text.substr(at + 2, open - at - 2) + "\"", open);
  }
  // An apostrophe between digits only groups them.
  const bool groups = at > 0 && std::isxdigit(static_cast<unsigned char>(text[at - 1])) != 0;
  if (text[at] != '"' && (text[at] != '\'' || groups)) return at;
  std::size_t end = at + 1;
  while (end < text.size() && text[end] != text[at] && text[end] != '\n') end += text[end] == '\\' ? 2 : 1;
  return std::min(end + 1, text.size());
}

// The same text with comments, strings and characters blanked, line by line as it was.
std::string code_of(const std::string& text) {
  std::string code;
  while (code.size() < text.size()) {
    const std::size_t end = std::max(end_of_quiet(text, code.size()), code.size() + 1);
    const bool quiet = end > code.size() + 1;
    while (code.size() < end) code += quiet && text[code.size()] != '\n' ? ' ' : text[code.size()];
  }
  return code;
}

enum class Braces { Scope, Function, Other };

// What a brace opens, by what stands before it since the last ';', '{' or '}'. In a list of initializers of members
// that may be nothing.
Braces kind_of(const std::string& head) {
  static const std::regex function(R"(^\s*$|\)\s*((const|noexcept|override|final|mutable|&|&&)\s*)*(->.*)?$)");
  static const std::regex scope(R"(\b(namespace|struct|class|union|extern)\b)");
  if (std::regex_search(head, function)) return Braces::Function;
  return std::regex_search(head, scope) ? Braces::Scope : Braces::Other;
}

struct Function {
  int line = 0;
  int lines = 0;
};

std::vector<Function> functions_of(const std::string& text) {
  const std::string code = code_of(text);
  std::vector<Function> found;
  int scopes = 0;  // open namespaces and classes
  int inside = 0;  // braces open in a function or a table
  int line = 1;
  bool function = false;
  Function current;
  std::string head;
  for (const char c : code) {
    if (c == '\n') ++line;
    if (c == '{') {
      if (inside > 0) {
        ++inside;
      } else if (const Braces kind = kind_of(head); kind == Braces::Scope) {
        ++scopes;
      } else {
        inside = 1;
        function = kind == Braces::Function;
        current.line = line;
      }
    } else if (c == '}') {
      if (inside == 0) --scopes;
      if (inside == 1 && function) found.push_back({current.line, line - current.line + 1});
      if (inside > 0) --inside;
    }
    head = c == '{' || c == '}' || c == ';' ? "" : head + (c == '\n' ? ' ' : c);
  }
  EXPECT_EQ(scopes, 0) << "braces that do not match";
  return found;
}

TEST(SourceLength, NoFileIsLong) {
  for (const std::string& file : sources_below({"app", "ar", "calib", "render", "shaders", "tests"}, is_source)) {
    const std::string text = text_of(root() / file);
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), kLongestFile) << file << " does more than one thing";
  }
}

TEST(SourceLength, FunctionsAreCounted) {
  const std::vector<Function> found = functions_of(R"(
namespace a { enum class E { A, B };
const int table[] = {1,
                     2};
struct S final {
  S() : x{1} {}  // "}"
  template <class T>
  auto f(T) const noexcept -> int {
    if (true) {
      return '{';
    }
  }
  int x;
};
}
)");
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].lines, 1);
  EXPECT_EQ(found[1].lines, 5);
  EXPECT_EQ(found[1].line, 8);
}

TEST(SourceLength, NoFunctionIsLong) {
  std::size_t functions = 0;
  for (const std::string& file : sources_below({"app", "ar", "calib", "render", "tests"}, is_cpp)) {
    for (const Function& function : functions_of(text_of(root() / file))) {
      ++functions;
      EXPECT_LE(function.lines, kLongestFunction) << file << ":" << function.line;
    }
  }
  EXPECT_GT(functions, 2000U) << "the walk saw too few functions to mean anything";
}

}  // namespace
