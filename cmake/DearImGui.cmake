# Defines imgui::imgui: Dear ImGui with its backend for GLFW. Debian has it with a file of pkg-config,
# vcpkg with a package of CMake. Fedora, openSUSE and Arch have no such library, so it can also be
# compiled from its sources.
set(CLATTER_IMGUI_SOURCES "" CACHE PATH
    "Folder with the sources of Dear ImGui, version 1.86 or from 1.89 on; empty: an installed library")

if(CLATTER_IMGUI_SOURCES)
  add_library(imgui_sources STATIC
              ${CLATTER_IMGUI_SOURCES}/imgui.cpp ${CLATTER_IMGUI_SOURCES}/imgui_draw.cpp
              ${CLATTER_IMGUI_SOURCES}/imgui_tables.cpp ${CLATTER_IMGUI_SOURCES}/imgui_widgets.cpp
              ${CLATTER_IMGUI_SOURCES}/backends/imgui_impl_glfw.cpp)
  set_target_properties(imgui_sources PROPERTIES UNITY_BUILD OFF POSITION_INDEPENDENT_CODE ON
                        CXX_VISIBILITY_PRESET hidden)
  target_compile_options(imgui_sources PRIVATE -w)
  target_include_directories(imgui_sources SYSTEM PUBLIC ${CLATTER_IMGUI_SOURCES}
                             ${CLATTER_IMGUI_SOURCES}/backends)
  target_link_libraries(imgui_sources PRIVATE PkgConfig::GLFW)
  add_library(imgui::imgui ALIAS imgui_sources)
  return()
endif()

pkg_check_modules(IMGUI QUIET IMPORTED_TARGET imgui)
if(IMGUI_FOUND)
  find_path(IMGUI_BACKENDS imgui_impl_glfw.h HINTS ${IMGUI_INCLUDE_DIRS}
            PATH_SUFFIXES backends imgui/backends)
  add_library(imgui::imgui INTERFACE IMPORTED)
  target_include_directories(imgui::imgui INTERFACE ${IMGUI_BACKENDS})
  target_link_libraries(imgui::imgui INTERFACE PkgConfig::IMGUI)
else()
  find_package(imgui CONFIG QUIET)
endif()
