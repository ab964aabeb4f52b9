# All dependencies come from the distribution. One error lists all missing libraries with their
# packages in Debian, so that one call of the package manager installs them.
find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)

set(missing "")
macro(need_module target module debian)
  pkg_check_modules(${target} QUIET IMPORTED_TARGET ${module})
  if(NOT ${target}_FOUND)
    string(APPEND missing "\n  ${module}: apt install ${debian}")
  endif()
endmacro()
macro(need_package name debian)
  find_package(${name} QUIET ${ARGN})
  if(NOT ${name}_FOUND)
    string(APPEND missing "\n  ${name}: apt install ${debian}")
  endif()
endmacro()
macro(need_header variable header debian)
  find_path(${variable} ${header} PATH_SUFFIXES stb)
  if(NOT ${variable})
    string(APPEND missing "\n  ${header}: apt install ${debian}")
  endif()
endmacro()

need_package(Eigen3 libeigen3-dev)
need_package(nlohmann_json nlohmann-json3-dev)
need_package(CLI11 libcli11-dev)
need_package(doctest doctest-dev)
need_package(fmt libfmt-dev)
# Some distributions have no file of pkg-config for HDF5, and Debian has variants, serial and with
# MPI. CMake's own module knows them all.
need_package(HDF5 libhdf5-dev COMPONENTS C CXX)
need_module(TOMLPLUSPLUS tomlplusplus libtomlplusplus-dev)
need_module(DEFLATE libdeflate libdeflate-dev)
need_module(SPNG spng libspng-dev)
need_module(MPFR mpfr libmpfr-dev)
need_module(GLFW glfw3 libglfw3-dev)
need_module(OPENAL openal libopenal-dev)
need_header(STB_FOLDER stb_image_write.h libstb-dev)
# The GL libraries are opened at run time. The build needs their headers only.
need_header(GL_FOLDER GL/glcorearb.h libgl-dev)
need_header(EGL_FOLDER EGL/egl.h libegl-dev)
include(DearImGui)
if(NOT TARGET imgui::imgui)
  string(APPEND missing "\n  imgui: apt install libimgui-dev, or its sources: "
                        "cmake --preset release -DCLATTER_IMGUI_SOURCES=FOLDER")
endif()

find_file(CLATTER_FONT DejaVuSans.ttf
          PATHS /usr/share/fonts/truetype/dejavu /usr/share/fonts/TTF /usr/share/fonts/dejavu
                /usr/share/fonts/dejavu-sans-fonts)
if(NOT CLATTER_FONT)
  string(APPEND missing "\n  DejaVuSans.ttf: apt install fonts-dejavu-core")
endif()

if(missing)
  message(FATAL_ERROR "These packages are missing (./run build installs them on Debian and Ubuntu; "
                      "elsewhere look for packages of the same name):${missing}")
endif()

add_library(stb_header INTERFACE)
target_include_directories(stb_header INTERFACE ${STB_FOLDER})
