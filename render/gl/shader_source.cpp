#include "render/gl/shader_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace render::gl {
namespace {

// The file between the quotes of an #include line.
std::optional<std::string> included_file(const std::string& line) {
  static const std::regex include(R"re(^\s*#\s*include\s+"([^"]+)"\s*(//.*)?$)re");
  std::smatch match;
  if (!std::regex_match(line, match, include)) return std::nullopt;
  return match[1].str();
}

class Expander {
 public:
  explicit Expander(const Defines& defines) : defines_(defines) {}

  void add(const std::string& path, const std::string& includer) {
    const std::optional<std::string_view> text = embedded_shader(path);
    if (!text) throw std::logic_error(fmt::format("no shader {} (included by {})", path, includer));
    const std::size_t number = out_.files.size();
    out_.files.push_back("shaders/" + path);
    if (number > 0) mark(1, number);
    std::istringstream lines{std::string(*text)};
    std::size_t line_number = 0;
    for (std::string line; std::getline(lines, line);) {
      ++line_number;
      if (const auto file = included_file(line)) {
        if (!is_in("shaders/" + *file)) add(*file, path);
        mark(line_number + 1, number);
      } else {
        out_.text += line + "\n";
        if (line.starts_with("#version")) add_defines(line_number + 1);
      }
    }
  }

  ShaderSource take() { return std::move(out_); }

 private:
  bool is_in(const std::string& file) const {
    return std::find(out_.files.begin(), out_.files.end(), file) != out_.files.end();
  }
  void mark(std::size_t line, std::size_t number) { out_.text += fmt::format("#line {} {}\n", line, number); }
  void add_defines(std::size_t next_line) {
    for (const Define& define : defines_) out_.text += fmt::format("#define {} {}\n", define.name, define.value);
    mark(next_line, 0);
  }

  const Defines& defines_;
  ShaderSource out_;
};

}  // namespace

ShaderSource expand_shader(std::string_view path, const Defines& defines) {
  Expander expander(defines);
  expander.add(std::string(path), "the program");
  return expander.take();
}

std::string readable_log(const std::string& log, const std::vector<std::string>& files) {
  static const std::regex place(R"(^(ERROR: |WARNING: )?(\d+)(?::(\d+)(?:\(\d+\))?|\((\d+)\)) ?: ?(.*)$)");
  std::string out;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, place)) {
      const std::size_t number = std::stoul(match[2]);
      const std::string at = match[3].matched ? match[3] : match[4];
      line = fmt::format("{}:{}: {}{}", number < files.size() ? files[number] : match[2].str(), at, match[1].str(),
                         match[5].str());
    }
    out += line + "\n";
  }
  return out;
}

}  // namespace render::gl
