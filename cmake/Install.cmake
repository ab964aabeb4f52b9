# Installation and Debian package. The target installed_files builds all files of `cmake --install`:
# the program, its manual page, its completions and, where it is built, the module of Python.
include(GNUInstallDirs)

# Debian packages install zsh completions in zsh/vendor-completions, see ./run package.
set(CLATTER_ZSH_FOLDER ${CMAKE_INSTALL_DATADIR}/zsh/site-functions
    CACHE STRING "Folder for the completions of zsh")
set(CLATTER_CONTACT "clatter authors <authors@clatter.invalid>"
    CACHE STRING "Name and address of the package's maintainer")

set(share ${CMAKE_BINARY_DIR}/share)
file(MAKE_DIRECTORY ${share})
find_program(GZIP gzip REQUIRED)
set(documentation ${CMAKE_INSTALL_DATADIR}/doc/clatter)

# The changelog of the package refers to the program's changelog. SOURCE_DATE_EPOCH sets its date.
string(TIMESTAMP today "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(CONFIGURE OUTPUT ${share}/changelog.Debian CONTENT
"clatter (${PROJECT_VERSION}-1) unstable; urgency=medium

  * Version ${PROJECT_VERSION}. Its changes are in changelog.gz.

 -- ${CLATTER_CONTACT}  ${today}
")

function(written_by_program file)
  add_custom_command(OUTPUT ${share}/${file} COMMAND clatter ${ARGN} > ${share}/${file}
                     DEPENDS clatter VERBATIM)
endfunction()
function(compressed file source)
  add_custom_command(OUTPUT ${share}/${file}.gz
                     COMMAND ${GZIP} -9nc ${source} > ${share}/${file}.gz
                     DEPENDS ${source} VERBATIM)
endfunction()
written_by_program(clatter.1 help --man)
written_by_program(clatter.bash completions bash)
written_by_program(clatter.zsh completions zsh)
written_by_program(clatter.fish completions fish)
compressed(clatter.1 ${share}/clatter.1)
compressed(changelog ${CMAKE_SOURCE_DIR}/CHANGELOG.md)
compressed(changelog.Debian ${share}/changelog.Debian)
add_custom_target(installed_files ALL
                  DEPENDS clatter ${share}/clatter.bash ${share}/clatter.zsh ${share}/clatter.fish
                          ${share}/clatter.1.gz ${share}/changelog.gz
                          ${share}/changelog.Debian.gz)
if(TARGET clatter_python)
  add_dependencies(installed_files clatter_python)
endif()

# Tests are not installed. The other targets need no build.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
install(TARGETS clatter)
install(FILES ${share}/clatter.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${share}/clatter.bash RENAME clatter
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES ${share}/clatter.zsh RENAME _clatter DESTINATION ${CLATTER_ZSH_FOLDER})
install(FILES ${share}/clatter.fish
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
install(FILES ${CMAKE_SOURCE_DIR}/assets/desktop/clatter.desktop
        DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES ${CMAKE_SOURCE_DIR}/assets/desktop/clatter.svg
        DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE RENAME copyright DESTINATION ${documentation})
install(FILES ${share}/changelog.gz ${share}/changelog.Debian.gz DESTINATION ${documentation})
# The guide refers to the scenes.
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs DESTINATION ${documentation})
install(DIRECTORY ${CMAKE_SOURCE_DIR}/assets/scenes DESTINATION ${documentation}/assets)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT ${CLATTER_CONTACT})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
    GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Libraries opened at run time. EGL of Mesa draws without a display and without a graphics card.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libegl1, libgl1-mesa-dri")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "ffmpeg, libgl1, libglx-mesa0")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "python3, python3-numpy")
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"simulation of driven granular gases of hard disks
clatter simulates hard disks that lose energy in collisions, in a box whose
walls return it. It computes one collision after the other, without a time
step. It shows a gas in a window, films it, and measures it with standard
errors. The module clatter of Python does the same in notebooks.")
include(CPack)
