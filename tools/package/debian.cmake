# cpack -G DEB in the build folder: intarsia, intarsia-dev, intarsia-doc and, with the module, python3-intarsia.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME intarsia)
set(CPACK_PACKAGE_VENDOR Intarsia)
set(CPACK_PACKAGE_CONTACT "Intarsia developers <intarsia@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "patch layouts of triangle meshes along their ridges and valleys")
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime dev doc)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME intarsia)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "Turns a 3D scan or a CAD mesh into a few meaningful patches whose borders run along its ridges, valleys
 and creases. This package has the program and the shared library.")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_GENERATE_SHLIBS ON)

set(CPACK_DEBIAN_DEV_PACKAGE_NAME intarsia-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "intarsia (= ${PROJECT_VERSION}), libtbb-dev")
set(CPACK_DEBIAN_DEV_DESCRIPTION "Header, static library and CMake package.")

set(CPACK_DEBIAN_DOC_PACKAGE_NAME intarsia-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_DESCRIPTION "Documents.")

if(TARGET intarsia_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-intarsia)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= ${INTARSIA_PYTHON_VERSION}), python3 (<< ${INTARSIA_PYTHON_NEXT}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "The Python module intarsia, for NumPy arrays.")
endif()
include(CPack)
