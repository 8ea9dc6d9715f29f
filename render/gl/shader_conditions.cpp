#include "render/gl/shader_conditions.h"

#include <fmt/format.h>

#include <cctype>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace render::gl {
namespace {

using Macros = std::map<std::string, std::string, std::less<>>;

// The condition of an #if, by recursive descent: or, and, comparison, sum, term.
class Condition {
 public:
  Condition(std::string text, const Macros& macros, int depth = 0)
      : text_(std::move(text)), macros_(macros), depth_(depth) {}

  bool evaluate() { return number() != 0; }

 private:
  static constexpr int kDeepest = 16;  // of macros whose values are macros

  int number() {
    const int value = any_of();
    if (!next_is("")) refuse();
    return value;
  }
  int any_of() {
    int value = all_of();
    while (take("||")) value = all_of() != 0 || value != 0;
    return value;
  }
  int all_of() {
    int value = comparison();
    while (take("&&")) value = comparison() != 0 && value != 0;
    return value;
  }
  int comparison() {
    const int left = sum();
    if (take("==")) return left == sum();
    if (take("!=")) return left != sum();
    if (take("<=")) return left <= sum();
    if (take(">=")) return left >= sum();
    if (take("<")) return left < sum();
    if (take(">")) return left > sum();
    return left;
  }
  int sum() {
    int value = term();
    for (;;) {
      if (take("+")) {
        value += term();
      } else if (take("-")) {
        value -= term();
      } else {
        return value;
      }
    }
  }
  int term() {
    if (take("!")) return term() == 0;
    if (take("(")) {
      const int value = any_of();
      if (!take(")")) refuse();
      return value;
    }
    const std::string found = word();
    if (found.empty()) refuse();
    if (found == "defined") {
      const bool bracket = take("(");
      const std::string name = word();
      if (bracket && !take(")")) refuse();
      return macros_.contains(name);
    }
    return value_of(found);
  }
  int value_of(const std::string& name) const {
    if (std::isdigit(static_cast<unsigned char>(name[0])) != 0) return std::stoi(name);
    const auto macro = macros_.find(name);
    if (macro == macros_.end() || macro->second.empty()) return 0;
    if (depth_ == kDeepest) refuse();
    return Condition(macro->second, macros_, depth_ + 1).number();
  }
  void skip_blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  bool next_is(std::string_view token) {
    skip_blanks();
    return token.empty() ? at_ == text_.size() : text_.compare(at_, token.size(), token) == 0;
  }
  bool take(std::string_view token) {
    if (!next_is(token)) return false;
    if (token == "!" && text_.compare(at_, 2, "!=") == 0) return false;
    at_ += token.size();
    return true;
  }
  std::string word() {
    skip_blanks();
    std::string found;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_')) {
      found += text_[at_++];
    }
    return found;
  }
  [[noreturn]] void refuse() const {
    throw std::invalid_argument(fmt::format("a shader's condition cannot be read: '#if {}'", text_));
  }

  std::string text_;
  const Macros& macros_;
  int depth_;
  std::size_t at_ = 0;
};

// The branches that the lines are in, outermost first.
class Branches {
 public:
  bool active() const { return branches_.empty() || branches_.back().active; }
  void open(bool condition) { branches_.push_back({active() && condition, active() && condition, active()}); }
  // `condition` is asked only where it decides.
  template <typename F>
  void other(F&& condition) {
    if (branches_.empty()) throw std::invalid_argument("a shader's #else or #elif has no #if");
    Branch& branch = branches_.back();
    branch.active = branch.enclosing && !branch.taken && condition();
    branch.taken = branch.taken || branch.active;
  }
  void close() {
    if (branches_.empty()) throw std::invalid_argument("a shader's #endif has no #if");
    branches_.pop_back();
  }

 private:
  struct Branch {
    bool active;
    bool taken;  // this one or one before it
    bool enclosing;
  };
  std::vector<Branch> branches_;
};

}  // namespace

std::string active_lines(const std::string& text) {
  static const std::regex directive(R"re(^\s*#\s*(define|undef|ifdef|ifndef|if|elif|else|endif)\b\s*(\w*)(.*)$)re");
  static const std::regex comment(R"re(\s*//.*$)re");
  Macros macros;
  Branches branches;
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    if (!std::regex_match(line, found, directive)) {
      out += (branches.active() ? line : std::string()) + "\n";
      continue;
    }
    const std::string kind = found[1];
    const std::string name = found[2];
    const std::string rest = std::regex_replace(found[3].str(), comment, "");
    const auto condition = [&] { return Condition(name + rest, macros).evaluate(); };
    if (kind == "ifdef") branches.open(macros.contains(name));
    if (kind == "ifndef") branches.open(!macros.contains(name));
    if (kind == "if") branches.open(branches.active() && condition());
    if (kind == "elif") branches.other(condition);
    if (kind == "else") branches.other([] { return true; });
    if (kind == "endif") branches.close();
    if (kind == "define" && branches.active()) {
      const auto value = rest.find_first_not_of(" \t");
      macros[name] = value == std::string::npos ? "" : rest.substr(value);
    }
    if (kind == "undef" && branches.active()) macros.erase(name);
    const bool kept = branches.active() && (kind == "define" || kind == "undef");
    out += (kept ? line : std::string()) + "\n";
  }
  return out;
}

std::set<std::string, std::less<>> declared_uniforms(const std::string& text) {
  static const std::regex plain(R"re(^\s*uniform\s+[\w\s]*?(\w+)\s*(\[[^\]]*\])?\s*;.*$)re");
  static const std::regex block(R"re(^\s*(layout\s*\([^)]*\)\s*)?uniform\s+\w+\s*\{.*$)re");
  static const std::regex member(R"re(^\s*[\w\s]*?(\w+)\s*(\[[^\]]*\])?\s*;.*$)re");
  std::set<std::string, std::less<>> names;
  bool in_block = false;
  std::istringstream lines(active_lines(text));
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    if (std::regex_match(line, block)) {
      in_block = true;
    } else if (in_block && line.find('}') != std::string::npos) {
      in_block = false;
    } else if (std::regex_match(line, found, in_block ? member : plain)) {
      names.insert(found[1]);
    }
  }
  return names;
}

}  // namespace render::gl
