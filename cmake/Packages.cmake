# All dependencies come from the distribution. One error lists all missing libraries with their
# packages, so that one call of the package manager installs them.
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
  find_package(${name} QUIET)
  if(NOT ${name}_FOUND)
    string(APPEND missing "\n  ${name}: apt install ${debian}")
  endif()
endmacro()
macro(need_header header debian)
  string(MAKE_C_IDENTIFIER "HAVE_${header}" found)
  find_path(${found} ${header} PATH_SUFFIXES imgui stb)
  if(NOT ${found})
    string(APPEND missing "\n  ${header}: apt install ${debian}")
  endif()
endmacro()

need_package(Eigen3 libeigen3-dev)
need_package(nlohmann_json nlohmann-json3-dev)
need_package(CLI11 libcli11-dev)
need_package(doctest doctest-dev)
need_package(fmt libfmt-dev)
need_module(TOMLPLUSPLUS tomlplusplus libtomlplusplus-dev)
need_module(DEFLATE libdeflate libdeflate-dev)
need_module(SPNG spng libspng-dev)
need_module(HDF5 hdf5 libhdf5-dev)
need_module(MPFR mpfr libmpfr-dev)
need_module(IMGUI imgui libimgui-dev)
need_module(STB stb libstb-dev)
need_module(GLFW glfw3 libglfw3-dev)
need_module(OPENAL openal libopenal-dev)
# The GL libraries are opened at run time. The build needs their headers only.
need_header(GL/glcorearb.h libgl-dev)
need_header(GL/osmesa.h libosmesa6-dev)
need_header(EGL/egl.h libegl-dev)

# pkg-config has only the C library.
find_library(HDF5_CPP hdf5_cpp HINTS ${HDF5_LIBRARY_DIRS})
if(NOT HDF5_CPP)
  string(APPEND missing "\n  hdf5_cpp: apt install libhdf5-dev")
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
