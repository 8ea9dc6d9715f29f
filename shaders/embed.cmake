# Writes OUTPUT, a C++ file that holds the text of every shader listed in the file LIST (paths relative to ROOT).
# Run by the build: cmake -DROOT= -DLIST= -DOUTPUT= -P embed.cmake

file(STRINGS "${LIST}" paths)
set(entries "")
foreach(path IN LISTS paths)
  file(READ "${ROOT}/${path}" text)
  string(APPEND entries "    {\"${path}\", R\"__glsl(${text})__glsl\"},\n")
endforeach()
file(
  WRITE "${OUTPUT}"
  "// Made by shaders/embed.cmake.\n"
  "#include \"render/gl/shader_source.h\"\n\n"
  "namespace render::gl {\nnamespace {\n\n"
  "struct Entry {\n  std::string_view path;\n  std::string_view text;\n};\n\n"
  "constexpr Entry kShaders[] = {\n${entries}};\n\n"
  "}  // namespace\n\n"
  "std::optional<std::string_view> embedded_shader(std::string_view path) {\n"
  "  for (const Entry& entry : kShaders) {\n    if (entry.path == path) return entry.text;\n  }\n"
  "  return std::nullopt;\n}\n\n"
  "}  // namespace render::gl\n")
