# What `cpack -G DEB` makes of the components: weft, libweft0, libweft-dev, python3-weft, weft-plugins.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME weft)
# Where the summary is CMake's own, CPack takes that of each package.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "weft built using CMake")
set(CPACK_PACKAGE_VENDOR "the weft authors")
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "the weft authors <weft@packages.invalid>" CACHE STRING
    "Whom the packages name as their maintainer")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(CMAKE_CROSSCOMPILING AND CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
    set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE arm64)
endif()

# ---- The packages ----

set(same "= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")
set(CPACK_COMPONENTS_ALL)

# wf_package(COMPONENT PACKAGE SECTION SUMMARY TEXT): one row of what there is.
macro(wf_package component package section summary text)
    string(TOUPPER ${component} upper)
    list(APPEND CPACK_COMPONENTS_ALL ${component})
    set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
    set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section})
    set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${text}")
endmacro()
set(what "weft turns progressive renders that are oversampled in time and space into
interlaced broadcast video: each field is filtered from the subframes around
its own instant, in linear light.\n")

wf_package(program weft video "oversampled renders to interlaced broadcast video" "${what}
This package has the program, its manual page, completions for bash, zsh and
fish, guides, and examples for renderers and farms.")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "weft-plugins (${same})")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, mpv, python3-weft")

if(BUILD_SHARED_LIBS)
    wf_package(library libweft0 libs "renders to interlaced broadcast video - shared library" "${what}
This package has the shared library.")
    set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "weft-plugins (${same})")
    # finish.cmake writes the list of symbols before the package is made.
    set(made ${CMAKE_BINARY_DIR}/generated/packages)
    file(WRITE ${made}/symbols "")
    file(WRITE ${made}/shlibs "libweft ${PROJECT_VERSION_MAJOR} libweft0 (>= ${PROJECT_VERSION})\n")
    set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA
        "${CMAKE_CURRENT_LIST_DIR}/triggers;${made}/symbols;${made}/shlibs")

    wf_package(python python3-weft python "renders to interlaced broadcast video - Python binding" "${what}
This package has the Python binding: what the program does as calls, with
NumPy arrays for samples and fields.")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS OFF)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "libweft0 (${same}), python3 (>= 3.9), python3-numpy")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
        "${CMAKE_CURRENT_LIST_DIR}/postinst;${CMAKE_CURRENT_LIST_DIR}/prerm")
endif()

wf_package(development libweft-dev libdevel "renders to interlaced broadcast video - development files" "${what}
This package has the header and what pkg-config and CMake read.")
if(BUILD_SHARED_LIBS)
    set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libweft0 (${same})")
else()
    set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
        "libopenexr-dev, libdeflate-dev, libxxhash-dev, liblua5.4-dev, libjansson-dev")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)

if(weft_modules)
    wf_package(plugins weft-plugins video "renders to interlaced broadcast video - modules" "${what}
This package has the modules that other libraries are loaded by when a job
needs them: pictures of other programs (OpenImageIO), color configurations
(OpenColorIO), containers, codecs and deinterlacers (libav), plots (Cairo).")
    set(CPACK_DEBIAN_PLUGINS_PACKAGE_ENHANCES "weft, libweft0")
    # A module is loaded by the very version that it was built with.
    set(CPACK_DEBIAN_PLUGINS_PACKAGE_DEPENDS "weft (${same}) | libweft0 (${same})")
endif()

# ---- What Debian wants besides ----

configure_file(${CMAKE_CURRENT_LIST_DIR}/finish.cmake.in generated/packages/finish.cmake @ONLY)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_BINARY_DIR}/generated/packages/finish.cmake)
include(CPack)
