# Dependencies of the page, built with emscripten. Headers come from the packages of cmake/Packages.cmake.
# Libraries that are not headers alone are compiled from the distribution's source packages, which
# `./run web` unpacks into CLATTER_WEB_SOURCES.
set(CLATTER_WEB_SOURCES ${CMAKE_SOURCE_DIR}/build/sources
    CACHE PATH "Folder with the unpacked source packages imgui, libdeflate, libspng and zlib")

set(missing "")
# The folder of system headers itself must not be on the search path of emscripten. A folder of links
# to the needed ones is.
set(web_headers ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${web_headers})
function(link_header path debian)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "INTO" "")
  if(NOT EXISTS /usr/include/${path})
    set(missing "${missing}\n  ${path}: apt install ${debian}" PARENT_SCOPE)
    return()
  endif()
  get_filename_component(name ${path} NAME)
  file(MAKE_DIRECTORY ${web_headers}/${arg_INTO})
  file(CREATE_LINK /usr/include/${path} ${web_headers}/${arg_INTO}/${name} SYMBOLIC)
endfunction()
link_header(doctest doctest-dev)
link_header(eigen3/Eigen libeigen3-dev)
link_header(fmt libfmt-dev)
link_header(nlohmann nlohmann-json3-dev)
link_header(stb/stb_image_write.h libstb-dev)
link_header(toml++ libtomlplusplus-dev)
link_header(GL/glcorearb.h libgl-dev INTO GL)

# Libraries for the parts that cmake/web/libcxx.h adds to an older standard library.
include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_FLAGS -std=c++20)
check_cxx_source_compiles("#include <version>
                           #ifndef __cpp_lib_ranges
                           #error
                           #endif" CLATTER_WEB_RANGES)
check_cxx_source_compiles("#include <charconv>
                           const char text[] = {'1'};
                           double value;
                           auto result = std::from_chars(text, text + 1, value);"
                          CLATTER_WEB_FROM_CHARS)
unset(CMAKE_REQUIRED_FLAGS)
if(NOT CLATTER_WEB_RANGES)
  foreach(folder concepts meta range std)
    link_header(${folder} librange-v3-dev)
  endforeach()
endif()
if(NOT CLATTER_WEB_FROM_CHARS)
  link_header(fast_float libfast-float-dev)
endif()

function(find_source variable package file)
  file(GLOB found ${CLATTER_WEB_SOURCES}/${package}-*/${file})
  if(NOT found)
    set(missing "${missing}\n  sources of ${package}: apt-get source ${package}" PARENT_SCOPE)
    return()
  endif()
  list(GET found -1 found)
  string(REPLACE /${file} "" folder ${found})
  set(${variable} ${folder} PARENT_SCOPE)
endfunction()
find_source(imgui imgui imgui.cpp)
find_source(deflate libdeflate libdeflate.h)
find_source(spng libspng spng/spng.h)
find_source(zlib zlib zlib.h)
find_file(CLATTER_FONT DejaVuSans.ttf PATHS /usr/share/fonts/truetype/dejavu NO_CMAKE_FIND_ROOT_PATH)
if(NOT CLATTER_FONT)
  string(APPEND missing "\n  DejaVuSans.ttf: apt install fonts-dejavu-core")
endif()
find_program(CLATTER_PYFTSUBSET pyftsubset NO_CMAKE_FIND_ROOT_PATH)
if(NOT CLATTER_PYFTSUBSET)
  string(APPEND missing "\n  pyftsubset: apt install fonttools")
endif()
if(missing)
  message(FATAL_ERROR "These packages are missing (./run web installs them on Debian):${missing}")
endif()

# The page has the Latin and Greek letters and the signs of the typeface: a third of its bytes.
set(subset ${CMAKE_BINARY_DIR}/font/DejaVuSans.ttf)
if(NOT EXISTS ${subset})
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/font)
  execute_process(COMMAND ${CLATTER_PYFTSUBSET} ${CLATTER_FONT} --output-file=${subset}
                          --unicodes=20-17F,370-3FF,2000-209F,2190-22FF,25A0-25FF
                          --layout-features= --no-hinting
                  COMMAND_ERROR_IS_FATAL ANY)
endif()
set(CLATTER_FONT ${subset})

function(header_library name)
  add_library(${name} INTERFACE IMPORTED)
  target_include_directories(${name} INTERFACE ${web_headers})
endfunction()
header_library(Eigen3::Eigen)
header_library(fmt::fmt)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
header_library(nlohmann_json::nlohmann_json)
header_library(doctest::doctest)
header_library(stb_header)
header_library(PkgConfig::TOMLPLUSPLUS)

# Compiled as they are, without warnings.
function(compiled_library name folder)
  add_library(${name} STATIC ${ARGN})
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
  target_compile_options(${name} PRIVATE -w)
  target_include_directories(${name} SYSTEM PUBLIC ${folder})
endfunction()

file(GLOB deflate_sources ${deflate}/lib/*.c)
compiled_library(web_deflate ${deflate} ${deflate_sources})
add_library(PkgConfig::DEFLATE ALIAS web_deflate)

file(GLOB inflate_sources ${zlib}/inf*.c)
compiled_library(web_spng ${spng}/spng ${spng}/spng/spng.c ${inflate_sources} ${zlib}/adler32.c
                 ${zlib}/crc32.c ${zlib}/deflate.c ${zlib}/trees.c ${zlib}/zutil.c)
target_include_directories(web_spng PRIVATE ${zlib})
add_library(PkgConfig::SPNG ALIAS web_spng)

file(CREATE_LINK ${imgui} ${web_headers}/imgui SYMBOLIC)
compiled_library(web_imgui ${imgui} ${imgui}/imgui.cpp ${imgui}/imgui_draw.cpp
                 ${imgui}/imgui_tables.cpp ${imgui}/imgui_widgets.cpp)
target_compile_options(web_imgui PRIVATE -Oz) # small beside the time of the gas
target_include_directories(web_imgui SYSTEM PUBLIC ${web_headers})
add_library(imgui::imgui ALIAS web_imgui)
