# embed_files(TARGET TABLE FILE...): embeds files into the program and defines, in <TABLE>.cpp,
# `std::span<const clatter::EmbeddedFile> clatter::<TABLE>()`, one entry per file with its file name.
# The list of files may be empty. The assembler's .incbin reads the bytes, so that a large font costs
# no compile time.
function(embed_files target table)
  set(assembly "")
  set(declarations "")
  set(entries "")
  set(index 0)
  foreach(file ${ARGN})
    get_filename_component(name ${file} NAME)
    set(symbol "clatter_${table}_${index}")
    string(APPEND assembly "DATA(${symbol})\n.incbin \"${file}\"\nEND(${symbol})\n"
                           "DATA(${symbol}_size)\n.long .L${symbol}_end - ${symbol}\n"
                           "END(${symbol}_size)\n")
    string(APPEND declarations
           "extern const char ${symbol}[];\nextern const std::uint32_t ${symbol}_size;\n")
    string(APPEND entries "      {\"${name}\", {${symbol}, ${symbol}_size}},\n")
    math(EXPR index "${index} + 1")
  endforeach()

  set(base ${CMAKE_CURRENT_BINARY_DIR}/${table})
  # The macros of embed.h are for ELF or for WebAssembly.
  file(CONFIGURE OUTPUT ${base}_bytes.S CONTENT "#include \"cmake/embed.h\"\n${assembly}")
  file(CONFIGURE OUTPUT ${base}.cpp CONTENT
"#include <array>
#include <cstdint>

#include \"engine/embedded_file.h\"

extern \"C\" {
${declarations}}

namespace clatter {
std::span<const EmbeddedFile> ${table}() {
  static const std::array<EmbeddedFile, ${index}> files = {{
${entries}  }};
  return files;
}
}  // namespace clatter
")
  set_source_files_properties(${base}_bytes.S PROPERTIES OBJECT_DEPENDS "${ARGN}")
  target_sources(${target} PRIVATE ${base}_bytes.S ${base}.cpp)
endfunction()
