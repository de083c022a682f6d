# SPDX-FileCopyrightText: MedialVoxel contributors
# SPDX-License-Identifier: Apache-2.0

# What `cpack -G TGZ`, `cpack -G DEB` and, for Windows, `cpack -G ZIP` pack: the program, its texts, and the licenses of what
# scripts/package and scripts/cross link in.
set(MedialVoxel_LICENSES_DIR "" CACHE PATH "Folder with the licenses of the libraries in a program that is linked statically")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/NOTICE" "${PROJECT_SOURCE_DIR}/CITATION.cff"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/medialvoxel" COMPONENT Program)
if(MedialVoxel_LICENSES_DIR)
  install(DIRECTORY "${MedialVoxel_LICENSES_DIR}" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/medialvoxel" COMPONENT Program)
endif()

set(CPACK_PACKAGE_NAME medialvoxel)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Medial sheets and wall thickness of CT volumes of any size")
set(CPACK_PACKAGE_CONTACT "The MedialVoxel contributors")
string(TOLOWER "${CMAKE_SYSTEM_NAME}" _system)
set(CPACK_PACKAGE_FILE_NAME "medialvoxel-${PROJECT_VERSION}-${_system}-${CMAKE_SYSTEM_PROCESSOR}")
set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR}" MedialVoxel Program /)
if(NOT WIN32)
  # There, what a debugger needs is in files of their own.
  set(CPACK_STRIP_FILES ON)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libc6 (>= 2.28)")
include(CPack)
